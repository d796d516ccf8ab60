//! Lines over the model and beside it, and the part that stands out.

use glam::Vec3;

use super::gpu_model::{GpuModel, Posed};
use super::layouts::Layouts;
use super::look::look;
use super::pipelines::{Draw, ModelDraw, Pipelines};
use crate::scene::{Overlay, RenderFrame};
use crate::shaders::{Line, LineVertex, Veil};

const NORMAL_SRGB: [f32; 4] = [0.36, 0.72, 1.0, 0.95];
const TANGENT_SRGB: [f32; 4] = [1.0, 0.56, 0.33, 0.95];
const BOUNDS_SRGB: [f32; 4] = [1.0, 0.71, 0.33, 0.9];
/// x, y, z as every tool colours them.
const AXES_SRGB: [[f32; 4]; 3] = [
    [0.95, 0.30, 0.34, 1.0],
    [0.50, 0.80, 0.20, 1.0],
    [0.24, 0.54, 0.98, 1.0],
];
/// How much of the surface a part that stands out shows under its veil.
const VEIL_ALPHA: f32 = 0.55;
/// Length of the axes, in radii of the scene.
const AXIS_LENGTH: f32 = 0.5;

/// 12 edges of a box and 3 axes, two ends each.
const MAX_WORLD_ENDS: usize = (12 + 3) * 2;

/// A small uniform, bound as group 3.
struct Style {
    buffer: wgpu::Buffer,
    group: wgpu::BindGroup,
}

impl Style {
    fn new(device: &wgpu::Device, layouts: &Layouts) -> Self {
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
}

/// Buffers of all overlays.
pub(super) struct Overlays {
    wire: Style,
    normals: Style,
    tangents: Style,
    veil: Style,
    world_ends: wgpu::Buffer,
    /// Ends of the box come first, then those of the axes.
    box_end_count: u32,
    axis_end_count: u32,
}

impl Overlays {
    pub(super) fn new(device: &wgpu::Device, layouts: &Layouts) -> Self {
        Self {
            wire: Style::new(device, layouts),
            normals: Style::new(device, layouts),
            tangents: Style::new(device, layouts),
            veil: Style::new(device, layouts),
            world_ends: device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("box and axes"),
                size: (MAX_WORLD_ENDS * size_of::<LineVertex>()) as u64,
                usage: wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            }),
            box_end_count: 0,
            axis_end_count: 0,
        }
    }

    /// Uploads what the frame's overlays need.
    pub(super) fn write(&mut self, queue: &wgpu::Queue, frame: &RenderFrame<'_>) {
        let look = look(frame.options.theme);
        let encoded = |[red, green, blue]: [u8; 3], alpha: f32| {
            let [red, green, blue] = [red, green, blue].map(|channel| f32::from(channel) / 255.0);
            [red, green, blue, alpha]
        };
        let length = frame.options.overlays.line_length * frame.world_bounds.radius();
        for (style, color_srgb) in [
            (&self.wire, encoded(look.wire, look.wire_opacity)),
            (&self.normals, NORMAL_SRGB),
            (&self.tangents, TANGENT_SRGB),
        ] {
            let line = Line {
                color_srgb,
                length,
                ..Default::default()
            };
            queue.write_buffer(&style.buffer, 0, bytemuck::bytes_of(&line));
        }
        let veil = Veil {
            color_srgb: encoded(look.accent, VEIL_ALPHA),
            ..Default::default()
        };
        queue.write_buffer(&self.veil.buffer, 0, bytemuck::bytes_of(&veil));
        let mut ends = box_ends(frame);
        self.box_end_count = ends.len() as u32;
        ends.extend(axis_ends(frame));
        self.axis_end_count = ends.len() as u32 - self.box_end_count;
        queue.write_buffer(&self.world_ends, 0, bytemuck::cast_slice(&ends));
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

    /// Draws what stands in the world. Group 0 is set.
    pub(super) fn draw_world(&self, pass: &mut wgpu::RenderPass<'_>, pipelines: &Pipelines, nothing: &wgpu::BindGroup) {
        let axes_start = self.box_end_count;
        // Axes are mostly inside the model.
        for (through, ends) in [
            (false, 0..axes_start),
            (true, axes_start..axes_start + self.axis_end_count),
        ] {
            if ends.is_empty() {
                continue;
            }
            pass.set_pipeline(&pipelines.get(Draw::WorldLines { through }));
            pass.set_bind_group(1, nothing, &[]);
            pass.set_bind_group(2, nothing, &[]);
            pass.set_bind_group(3, &self.wire.group, &[]);
            pass.set_vertex_buffer(0, self.world_ends.slice(..));
            pass.draw(ends, 0..1);
        }
    }
}

fn line(from: Vec3, to: Vec3, color_srgb: [f32; 4]) -> [LineVertex; 2] {
    [from, to].map(|position| LineVertex {
        position: position.to_array(),
        color_srgb,
    })
}

/// Ends of the twelve edges of the scene's box, if they are shown.
fn box_ends(frame: &RenderFrame<'_>) -> Vec<LineVertex> {
    let bounds = &frame.world_bounds;
    if !frame.options.overlays.has(Overlay::Bounds) || bounds.is_empty() {
        return Vec::new();
    }
    let corner = |bits: usize| {
        let pick = |axis: usize| {
            if bits >> axis & 1 == 0 {
                bounds.min[axis]
            } else {
                bounds.max[axis]
            }
        };
        Vec3::new(pick(0), pick(1), pick(2))
    };
    let edges = (0..8).flat_map(|bits| (0..3).map(move |axis| (bits, bits | 1 << axis)));
    edges
        .filter(|(from, to)| from != to)
        .flat_map(|(from, to)| line(corner(from), corner(to), BOUNDS_SRGB))
        .collect()
}

/// Ends of the world's axes, if they are shown.
fn axis_ends(frame: &RenderFrame<'_>) -> Vec<LineVertex> {
    if !frame.options.overlays.has(Overlay::Axes) {
        return Vec::new();
    }
    let length = frame.world_bounds.radius().max(f32::MIN_POSITIVE) * AXIS_LENGTH;
    let axes = Vec3::AXES.into_iter().zip(AXES_SRGB);
    axes.flat_map(|(axis, color)| line(Vec3::ZERO, axis * length, color))
        .collect()
}
