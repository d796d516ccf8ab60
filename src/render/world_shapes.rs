//! Lines and triangles that stand in the world: the scene's box, its axes, and what is seen through the model.

use glam::Vec3;

use super::pipelines::Pipelines;
use super::recipe::{Draw, WorldShape};
use crate::scene::{Overlay, OverlayGeometry, OverlayVertex, RenderFrame};

const BOUNDS_SRGB: [u8; 4] = [255, 181, 84, 230];
/// x, y, z as every tool colours them.
const AXES_SRGB: [[u8; 4]; 3] = [[242, 77, 87, 255], [128, 204, 51, 255], [61, 138, 250, 255]];
/// Length of the axes, in radii of the scene.
const AXIS_LENGTH: f32 = 0.5;

/// Share of the depth range in which lies what is seen through everything: before the model, with a depth of its own.
const THROUGH_DEPTH: f32 = 0.01;

/// Shapes of one kind, in a buffer that grows.
struct Shapes {
    buffer: wgpu::Buffer,
    capacity: usize,
    /// Vertices that the model hides come first, then those that are seen through it.
    hidden_count: u32,
    count: u32,
}

impl Shapes {
    fn new(device: &wgpu::Device) -> Self {
        let capacity = 64;
        Self {
            buffer: Self::buffer(device, capacity),
            capacity,
            hidden_count: 0,
            count: 0,
        }
    }

    fn buffer(device: &wgpu::Device, capacity: usize) -> wgpu::Buffer {
        device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("world shapes"),
            size: (capacity * size_of::<OverlayVertex>()) as u64,
            usage: wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        })
    }

    fn write(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        hidden: &[OverlayVertex],
        through: &[&[OverlayVertex]],
    ) {
        let count = hidden.len() + through.iter().map(|part| part.len()).sum::<usize>();
        if count > self.capacity {
            self.capacity = count.next_power_of_two();
            self.buffer = Self::buffer(device, self.capacity);
        }
        let mut at = 0;
        for part in std::iter::once(&hidden).chain(through) {
            queue.write_buffer(&self.buffer, at, bytemuck::cast_slice(part));
            at += size_of_val(*part) as u64;
        }
        self.hidden_count = hidden.len() as u32;
        self.count = count as u32;
    }
}

/// All shapes of a frame.
pub(super) struct WorldShapes {
    lines: Shapes,
    triangles: Shapes,
}

impl WorldShapes {
    pub(super) fn new(device: &wgpu::Device) -> Self {
        Self {
            lines: Shapes::new(device),
            triangles: Shapes::new(device),
        }
    }

    pub(super) fn write(&mut self, device: &wgpu::Device, queue: &wgpu::Queue, frame: &RenderFrame<'_>) {
        let nothing = OverlayGeometry::default();
        let over_model = frame.over_model.unwrap_or(&nothing);
        let axes = axes(frame);
        self.lines
            .write(device, queue, &bounds(frame).lines, &[&over_model.lines, &axes.lines]);
        self.triangles.write(device, queue, &[], &[&over_model.triangles]);
    }

    /// Draws them. Group 0 is set, `line_group` is any that fits group 3. `size` is the target's.
    pub(super) fn draw(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        pipelines: &Pipelines,
        nothing: &wgpu::BindGroup,
        line_group: &wgpu::BindGroup,
        size: [u32; 2],
    ) {
        if self.lines.count + self.triangles.count == 0 {
            return;
        }
        pass.set_bind_group(1, nothing, &[]);
        pass.set_bind_group(2, nothing, &[]);
        pass.set_bind_group(3, line_group, &[]);
        let [width, height] = size.map(|side| side as f32);
        for through in [false, true] {
            if through {
                pass.set_viewport(0.0, 0.0, width, height, 0.0, THROUGH_DEPTH);
            }
            for (shape, shapes) in [
                (WorldShape::Triangles, &self.triangles),
                (WorldShape::Lines, &self.lines),
            ] {
                let vertices = if through {
                    shapes.hidden_count..shapes.count
                } else {
                    0..shapes.hidden_count
                };
                if !vertices.is_empty() {
                    pass.set_pipeline(&pipelines.get(Draw::World { shape, through }));
                    pass.set_vertex_buffer(0, shapes.buffer.slice(..));
                    pass.draw(vertices, 0..1);
                }
            }
        }
        pass.set_viewport(0.0, 0.0, width, height, 0.0, 1.0);
    }
}

/// The twelve edges of the scene's box, if they are shown.
fn bounds(frame: &RenderFrame<'_>) -> OverlayGeometry {
    let mut geometry = OverlayGeometry::default();
    let bounds = &frame.world_bounds;
    if !frame.options.overlays.has(Overlay::Bounds) || bounds.is_empty() {
        return geometry;
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
    for from in 0..8 {
        for to in (0..3).map(|axis| from | 1 << axis).filter(|&to| to != from) {
            geometry.line(corner(from), corner(to), BOUNDS_SRGB);
        }
    }
    geometry
}

/// The world's axes, if they are shown. They are mostly inside the model, so they are seen through it.
fn axes(frame: &RenderFrame<'_>) -> OverlayGeometry {
    let mut geometry = OverlayGeometry::default();
    if frame.options.overlays.has(Overlay::Axes) {
        let length = frame.world_bounds.radius().max(f32::MIN_POSITIVE) * AXIS_LENGTH;
        for (axis, color) in Vec3::AXES.into_iter().zip(AXES_SRGB) {
            geometry.line(Vec3::ZERO, axis * length, color);
        }
    }
    geometry
}
