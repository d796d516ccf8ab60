//! Draws a known triangle and looks at it: some browsers have a WebGPU that starts and draws wrong.

use super::read_back::{ReadBackError, read_back};
use super::target::{COLOR_FORMAT, DEPTH_FORMAT, SampleCount, Target};
use crate::shaders;

/// Side of the probe's picture.
const SIDE: u32 = 16;
/// The triangle's colour, sRGB: what [`shaders::PROBE`] writes, encoded.
const COLOR: [u8; 4] = [188, 137, 99, 255];

/// Why a device is not to be trusted.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ProbeError {
    /// The picture did not arrive.
    #[error(transparent)]
    ReadBack(#[from] ReadBackError),
    /// It arrived wrong.
    #[error("a known triangle came out as {found:?} instead of {expected:?} at ({x}, {y})")]
    WrongPicture {
        /// Pixels from the left.
        x: u32,
        /// Pixels from the top.
        y: u32,
        /// What was read.
        found: [u8; 4],
        /// What was drawn.
        expected: [u8; 4],
    },
}

/// Draws a triangle over the lower left half of a small picture and compares a pixel inside and one outside with what they
/// must be. `pause` as in [`read_back`].
///
/// # Errors
/// When they differ, or cannot be read.
pub async fn probe(device: &wgpu::Device, queue: &wgpu::Queue, pause: impl AsyncFn()) -> Result<(), ProbeError> {
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some(shaders::PROBE.name),
        source: wgpu::ShaderSource::Wgsl(shaders::PROBE.source().into()),
    });
    let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("probe"),
        layout: None,
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("vertex"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &[],
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: Some(wgpu::DepthStencilState {
            format: DEPTH_FORMAT,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::Less),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState::default(),
        }),
        multisample: wgpu::MultisampleState {
            count: SampleCount::Four.count(),
            ..Default::default()
        },
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some("fragment"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &[Some(COLOR_FORMAT.into())],
        }),
        multiview_mask: None,
        cache: None,
    });
    let target = Target::with_samples(device, SIDE, SIDE, SampleCount::Four);
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("probe") });
    {
        let mut pass = target.begin_pass(&mut encoder);
        pass.set_pipeline(&pipeline);
        pass.draw(0..3, 0..1);
    }
    queue.submit([encoder.finish()]);
    let pixels = read_back(device, queue, &target, pause).await?;
    expect_pixel(&pixels, 3, SIDE - 4, COLOR)?;
    expect_pixel(&pixels, SIDE - 4, 3, [0; 4])
}

fn expect_pixel(pixels: &[u8], x: u32, y: u32, expected: [u8; 4]) -> Result<(), ProbeError> {
    let at = ((y * SIDE + x) * 4) as usize;
    let found: [u8; 4] = std::array::from_fn(|channel| pixels.get(at + channel).copied().unwrap_or_default());
    let near = found
        .iter()
        .zip(expected)
        .all(|(found, expected)| found.abs_diff(expected) <= 2);
    if near {
        Ok(())
    } else {
        Err(ProbeError::WrongPicture { x, y, found, expected })
    }
}
