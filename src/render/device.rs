//! Opens a GPU, tests whether it draws right, and reports its errors. Limits and features are WebGL2's on every platform.

use std::future::Future;
use std::pin::Pin;
use std::task::{Context, Poll, Waker};

use glam::{Affine3A, Vec3};

use super::buffers::{Queue, bind_group, layout};
use super::instances::BoneTexture;
use super::pipelines::module;
use super::read_back::{ReadBackError, read_back};
use super::recipe::depth;
use super::target::{COLOR_FORMAT, DEPTH_FORMAT, MEAN_FORMAT, SampleCount, Target};
use super::timing::FrameEncoder;
use crate::anim::Palette;
use crate::shaders;

/// How to reach a GPU without a window.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Backend {
    Vulkan,
    /// OpenGL ES through EGL: the nearest to WebGL2.
    Gl,
}

impl std::fmt::Display for Backend {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Vulkan => "Vulkan",
            Self::Gl => "GL",
        })
    }
}

#[derive(Clone, Debug)]
pub struct Gpu {
    pub info: wgpu::AdapterInfo,
    /// Makes buffers, textures and pipelines.
    pub device: wgpu::Device,
    pub queue: wgpu::Queue,
    /// How many samples targets and renderer should use.
    pub samples: SampleCount,
    /// See [`draws_means`].
    pub draws_means: bool,
}

/// Why no GPU was opened.
#[derive(Clone, Debug, thiserror::Error)]
pub enum DeviceError {
    /// No adapter was found.
    #[error("no {backend} adapter was found ({reason}); on Debian, `apt-get install {packages}` brings a software one", packages = packages(*backend))]
    NoAdapter {
        /// The backend that was tried.
        backend: Backend,
        reason: String,
    },
    /// The adapter would not open.
    #[error("the {backend} adapter \"{adapter}\" would not open: {reason}")]
    NoDevice {
        /// The backend that was tried.
        backend: Backend,
        adapter: String,
        reason: String,
    },
}

fn packages(backend: Backend) -> &'static str {
    match backend {
        Backend::Vulkan => "mesa-vulkan-drivers",
        Backend::Gl => "libgl1-mesa-dri libegl1",
    }
}

/// The limits to ask of any adapter: WebGL2's, but for the size of textures.
pub fn required_limits(adapter: &wgpu::Adapter) -> wgpu::Limits {
    wgpu::Limits::downlevel_webgl2_defaults().using_resolution(adapter.limits())
}

/// The features to ask of any adapter, where it has them: block-compressed textures, and times of passes. GL's times are not asked for:
/// it waits for them.
pub fn required_features(adapter: &wgpu::Adapter) -> wgpu::Features {
    let mut wanted = wgpu::Features::TEXTURE_COMPRESSION_BC;
    wanted.set(
        wgpu::Features::TIMESTAMP_QUERY,
        adapter.get_info().backend != wgpu::Backend::Gl,
    );
    adapter.features() & wanted
}

/// What to ask of any adapter.
pub fn descriptor(adapter: &wgpu::Adapter) -> wgpu::DeviceDescriptor<'static> {
    wgpu::DeviceDescriptor {
        label: Some("bindpose"),
        required_features: required_features(adapter),
        required_limits: required_limits(adapter),
        ..Default::default()
    }
}

/// How many samples a pixel an adapter can draw and resolve.
pub fn sample_count(adapter: &wgpu::Adapter) -> SampleCount {
    let four = SampleCount::Four.count();
    let flags = |format| adapter.get_texture_format_features(format).flags;
    let resolves = flags(COLOR_FORMAT).contains(wgpu::TextureFormatFeatureFlags::MULTISAMPLE_RESOLVE);
    let both = [COLOR_FORMAT, DEPTH_FORMAT]
        .into_iter()
        .all(|format| flags(format).sample_count_supported(four));
    if both && resolves {
        SampleCount::Four
    } else {
        SampleCount::One
    }
}

/// Opens a GPU without a window, for pictures from the command line and from tests.
pub async fn headless(backend: Backend) -> Result<Gpu, DeviceError> {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor {
        backends: match backend {
            Backend::Vulkan => wgpu::Backends::VULKAN,
            Backend::Gl => wgpu::Backends::GL,
        },
        ..wgpu::InstanceDescriptor::new_without_display_handle()
    });
    let adapter = instance
        .request_adapter(&wgpu::RequestAdapterOptions::default())
        .await
        .map_err(|error| DeviceError::NoAdapter {
            backend,
            reason: error.to_string(),
        })?;
    let info = adapter.get_info();
    let (device, queue) =
        adapter
            .request_device(&descriptor(&adapter))
            .await
            .map_err(|error| DeviceError::NoDevice {
                backend,
                adapter: info.name.clone(),
                reason: error.to_string(),
            })?;
    Ok(Gpu {
        samples: sample_count(&adapter),
        draws_means: draws_means(&adapter),
        info,
        device,
        queue,
    })
}

const PROBE_SIDE: u32 = 16;
/// Colours of the near and of the far triangle, sRGB: what [`shaders::PROBE`] writes, encoded.
const PROBE_COLORS: [[u8; 4]; 2] = [[188, 137, 99, 255], [99, 137, 188, 255]];

/// Why a device cannot be trusted.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ProbeError {
    /// The picture could not be read.
    #[error(transparent)]
    ReadBack(#[from] ReadBackError),
    /// A pixel has the wrong colour.
    #[error("known triangles came out as {found:?} instead of {expected:?} at ({x}, {y})")]
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

/// The bones of the probe, two rows of their texture. The first joint of the first row brings a triangle over the lower left half of the
/// picture, the first of the second row brings one behind it, over the whole picture.
pub fn probe_bones() -> Palette {
    let mut bones = vec![Affine3A::IDENTITY; shaders::JOINTS_PER_ROW as usize + 1];
    bones[0] = Affine3A::from_translation(Vec3::new(0.0, 0.0, 0.25));
    let far = Affine3A::from_translation(Vec3::new(1.0, 1.0, 0.75));
    bones[shaders::JOINTS_PER_ROW as usize] = far * Affine3A::from_scale(Vec3::new(2.0, 2.0, 1.0));
    Palette(bones)
}

/// Draws two triangles where [`probe_bones`] bring them into a small picture, the nearer one first, and checks a pixel in which it hides
/// the farther one and a pixel beside it: some browsers have a WebGPU that starts and draws wrong. `pause` as in [`read_back`].
///
/// # Errors
/// When a pixel is wrong, or the picture cannot be read.
pub async fn probe(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    bones: &Palette,
    pause: impl AsyncFn(),
) -> Result<(), ProbeError> {
    let bones_layout = BoneTexture::layout(device);
    let mut bone_texture = BoneTexture::new(device, &bones_layout, bones.0.len());
    bone_texture.write(&Queue::new(queue), [&bones.0[..]]);
    let nothing_layout = layout(device, "nothing", &[]);
    let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some("probe"),
        bind_group_layouts: &[Some(&nothing_layout), Some(&bones_layout)],
        immediate_size: 0,
    });
    let module = module(device, &shaders::PROBE);
    let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("probe"),
        layout: Some(&pipeline_layout),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("vertex"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &[],
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: Some(depth(true, wgpu::CompareFunction::Less)),
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
    let target = Target::with_samples(device, PROBE_SIDE, PROBE_SIDE, SampleCount::Four);
    let mut encoder = FrameEncoder::new(device, "probe");
    {
        let mut pass = target.begin_pass(&mut encoder, wgpu::Color::TRANSPARENT, None);
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &bind_group(device, "nothing", &nothing_layout, []), &[]);
        pass.set_bind_group(1, bone_texture.group(), &[]);
        pass.draw(0..6, 0..1);
    }
    queue.submit([encoder.commands.finish()]);
    let pixels = read_back(device, queue, &target, pause).await?;
    expect_pixel(&pixels, 3, PROBE_SIDE - 4, PROBE_COLORS[0])?;
    expect_pixel(&pixels, PROBE_SIDE - 4, 3, PROBE_COLORS[1])
}

fn expect_pixel(pixels: &[u8], x: u32, y: u32, expected: [u8; 4]) -> Result<(), ProbeError> {
    let at = ((y * PROBE_SIDE + x) * 4) as usize;
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

/// Whether an adapter can draw the mean of many pictures.
pub fn draws_means(adapter: &wgpu::Adapter) -> bool {
    let usages = adapter.get_texture_format_features(MEAN_FORMAT).allowed_usages;
    usages.contains(wgpu::TextureUsages::RENDER_ATTACHMENT)
}

/// Whether an adapter draws with the CPU. Browsers do not always mark it.
pub fn is_software(info: &wgpu::AdapterInfo) -> bool {
    let name = info.name.to_lowercase();
    info.device_type == wgpu::DeviceType::Cpu
        || [
            "swiftshader",
            "llvmpipe",
            "lavapipe",
            "softpipe",
            "software",
            "basic render",
            "warp",
        ]
        .iter()
        .any(|word| name.contains(word))
}

/// Why a device could not do what it was asked for.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum GpuError {
    /// The GPU's own memory, not the program's.
    #[error("the GPU has too little free memory for it")]
    OutOfMemory,
    #[error("the GPU refused it: {0}")]
    Refused(String),
}

/// Resolves when the device has done the work, or could not. Natively it is ready at once.
pub type GpuAnswer = Pin<Box<dyn Future<Output = Result<(), GpuError>>>>;

/// Runs some work with a device and catches the errors of all of it. They reach nobody else.
pub fn watched<T>(device: &wgpu::Device, work: impl FnOnce() -> T) -> (T, GpuAnswer) {
    let memory = device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
    let validation = device.push_error_scope(wgpu::ErrorFilter::Validation);
    let internal = device.push_error_scope(wgpu::ErrorFilter::Internal);
    let done = work();
    let others = [Box::pin(internal.pop()) as Answer, Box::pin(validation.pop())];
    let memory = memory.pop();
    let answer = async move {
        // Out of memory is asked first: what could not be allocated is also invalid.
        if memory.await.is_some() {
            return Err(GpuError::OutOfMemory);
        }
        for other in others {
            if let Some(error) = other.await {
                return Err(GpuError::Refused(error.to_string()));
            }
        }
        Ok(())
    };
    (done, Box::pin(answer))
}

type Answer = Pin<Box<dyn Future<Output = Option<wgpu::Error>>>>;

/// The answer of a native device, which is always ready.
pub(super) fn answer_at_once(mut answer: GpuAnswer) -> Result<(), GpuError> {
    match answer.as_mut().poll(&mut Context::from_waker(Waker::noop())) {
        Poll::Ready(answer) => answer,
        Poll::Pending => Ok(()),
    }
}
