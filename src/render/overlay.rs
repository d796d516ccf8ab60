//! Lines over the model, and the part of it that stands out.

use super::model::{GpuModel, Posed};
use super::pipelines::Layouts;
use super::recipe::ModelDraw;
use super::uniforms::theme_colors;
use crate::scene::{Overlay, RenderFrame};
use crate::shaders::{Line, Veil};

const NORMAL_SRGB: [f32; 4] = [0.36, 0.72, 1.0, 0.95];
const TANGENT_SRGB: [f32; 4] = [1.0, 0.56, 0.33, 0.95];
/// How much of the surface a part that stands out shows under its veil.
const VEIL_ALPHA: f32 = 0.55;

/// A small uniform, bound as group 3.
pub(super) struct Style {
    buffer: wgpu::Buffer,
    group: wgpu::BindGroup,
}

impl Style {
    pub(super) fn new(device: &wgpu::Device, layouts: &Layouts) -> Self {
        let buffer = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("line"),
            size: size_of::<Line>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("line"),
            layout: &layouts.line,
            entries: &[wgpu::BindGroupEntry {
                binding: 0,
                resource: buffer.as_entire_binding(),
            }],
        });
        Self { buffer, group }
    }

    /// A [`Line`], or what is as large.
    pub(super) fn write(&self, queue: &wgpu::Queue, uniform: &impl bytemuck::NoUninit) {
        queue.write_buffer(&self.buffer, 0, bytemuck::bytes_of(uniform));
    }

    pub(super) fn group(&self) -> &wgpu::BindGroup {
        &self.group
    }
}

/// Buffers of all overlays.
pub(super) struct Overlays {
    wire: Style,
    normals: Style,
    tangents: Style,
    veil: Style,
}

impl Overlays {
    pub(super) fn new(device: &wgpu::Device, layouts: &Layouts) -> Self {
        Self {
            wire: Style::new(device, layouts),
            normals: Style::new(device, layouts),
            tangents: Style::new(device, layouts),
            veil: Style::new(device, layouts),
        }
    }

    /// Uploads what the frame's overlays need.
    pub(super) fn write(&mut self, queue: &wgpu::Queue, frame: &RenderFrame<'_>) {
        let colors = theme_colors(frame.options.theme);
        let encoded = |[red, green, blue]: [u8; 3], alpha: f32| {
            let [red, green, blue] = [red, green, blue].map(|channel| f32::from(channel) / 255.0);
            [red, green, blue, alpha]
        };
        let length = frame.options.overlays.line_length * frame.world_bounds.radius();
        for (style, color_srgb) in [
            (&self.wire, encoded(colors.wire, colors.wire_opacity)),
            (&self.normals, NORMAL_SRGB),
            (&self.tangents, TANGENT_SRGB),
        ] {
            let line = Line {
                color_srgb,
                length,
                ..Default::default()
            };
            style.write(queue, &line);
        }
        let veil = Veil {
            color_srgb: encoded(colors.accent, VEIL_ALPHA),
            ..Default::default()
        };
        self.veil.write(queue, &veil);
    }

    /// A group that fits where lines have a colour of their own.
    pub(super) fn any_line(&self) -> &wgpu::BindGroup {
        self.wire.group()
    }

    /// Draws them over the finished model. Group 0 is set, and so is an empty group 2.
    pub(super) fn draw_model(
        &self,
        device: &wgpu::Device,
        pass: &mut wgpu::RenderPass<'_>,
        frame: &RenderFrame<'_>,
        model: &GpuModel,
        posed: Posed<'_>,
    ) {
        let has = |overlay| frame.options.overlays.has(overlay);
        if let Some(submesh) = frame.highlighted_submesh {
            pass.set_bind_group(3, &self.veil.group, &[]);
            model.draw_submesh(pass, posed, ModelDraw::Highlight, submesh);
        }
        if has(Overlay::Wireframe) {
            pass.set_bind_group(3, &self.wire.group, &[]);
            model.draw_edges(device, pass, posed);
        }
        for (overlay, draw, style) in [
            (Overlay::Normals, ModelDraw::Normals, &self.normals),
            (Overlay::Tangents, ModelDraw::Tangents, &self.tangents),
        ] {
            if has(overlay) {
                pass.set_bind_group(3, &style.group, &[]);
                model.draw_vertex_lines(pass, posed, draw);
            }
        }
    }
}
