//! What is drawn beside the model: a highlighted submesh, ghosts, lines of the model, and shapes that stand in the world.

use glam::Vec3;

use super::band::Band;
use super::buffers::{Queue, bind_group, buffer, uniform_buffer};
use super::instances::Instances;
use super::light_passes::Common;
use super::model::{GpuModel, Posed};
use super::pipelines::{Layouts, Pipelines};
use super::recipe::{Draw, ModelDraw, WorldShape};
use super::uniforms::{encoded, instance_size, theme_colors};
use crate::scene::{AXES_SRGB, Overlay, OverlayGeometry, OverlayVertex, RenderFrame};
use crate::shaders::Line;

const NORMAL_SRGB: [f32; 4] = [0.36, 0.72, 1.0, 0.95];
const TANGENT_SRGB: [f32; 4] = [1.0, 0.56, 0.33, 0.95];

const BOUNDS_SRGB: [u8; 4] = [255, 181, 84, 230];
/// Length of the axes, in radii of the scene.
const AXIS_LENGTH: f32 = 0.5;

/// The nearest fraction of the depth range holds what is seen through the model.
const THROUGH_DEPTH: f32 = 0.01;

/// All lines and shapes: those on the model, those seen through it, and those beside it.
pub(super) struct Overlays {
    wire: LineStyle,
    normals: LineStyle,
    tangents: LineStyle,
    shapes: WorldShapes,
}

impl Overlays {
    pub(super) fn new(device: &wgpu::Device, layouts: &Layouts) -> Self {
        Self {
            wire: LineStyle::new(device, layouts),
            normals: LineStyle::new(device, layouts),
            tangents: LineStyle::new(device, layouts),
            shapes: WorldShapes::new(device),
        }
    }

    pub(super) fn write(&mut self, device: &wgpu::Device, queue: &Queue, frame: &RenderFrame<'_>) {
        self.shapes.write(device, queue, frame);
        let colors = theme_colors(frame.options.theme);
        let length = frame.options.overlays.line_length * instance_size(frame).length() * 0.5;
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
    }

    /// Draws what lies on the finished model: ghosts, highlight, its edges and normals. The caller sets group 0, and an empty group 2.
    pub(super) fn draw_on_model(
        &self,
        common: &Common,
        pass: &mut wgpu::RenderPass<'_>,
        frame: &RenderFrame<'_>,
        (model, posed): (&GpuModel, Posed<'_>),
        instances: &Instances,
    ) {
        if posed.skinned {
            for instances in instances.ghosts() {
                model.draw_shape(pass, Posed { instances, ..posed }, ModelDraw::Highlight);
            }
        }
        let has = |overlay| frame.options.overlays.has(overlay);
        if let Some(submesh) = frame.highlighted_submesh {
            let instances = instances.highlight();
            model.draw_submesh(pass, Posed { instances, ..posed }, ModelDraw::Highlight, submesh);
        }
        if let (true, Some(mesh)) = (has(Overlay::Wireframe), frame.mesh) {
            pass.set_bind_group(3, &self.wire.group, &[]);
            model.draw_edges((&common.device, &common.queue), pass, posed, mesh);
            pass.set_bind_group(2, &common.nothing, &[]);
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

    /// Draws the shapes of the world that the model can hide, or those that are seen `through` it. The caller sets group 0. `band` is the
    /// target's.
    pub(super) fn draw_shapes(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        pipelines: &Pipelines,
        nothing: &wgpu::BindGroup,
        band: Band,
        through: bool,
    ) {
        // Their vertices have colours of their own, but the lines' layout has a style all the same.
        self.shapes
            .draw(pass, pipelines, (nothing, &self.wire.group), band, through);
    }
}

/// How lines look, bound as group 3.
struct LineStyle {
    buffer: wgpu::Buffer,
    group: wgpu::BindGroup,
}

impl LineStyle {
    fn new(device: &wgpu::Device, layouts: &Layouts) -> Self {
        let buffer = uniform_buffer::<Line>(device, "line");
        Self {
            group: bind_group(device, "line", &layouts.line, [buffer.as_entire_binding()]),
            buffer,
        }
    }

    fn write(&self, queue: &Queue, line: &Line) {
        queue.write_buffer(&self.buffer, 0, bytemuck::bytes_of(line));
    }
}

/// World shapes of one kind, in a buffer that grows.
struct Shapes {
    buffer: wgpu::Buffer,
    capacity: usize,
    /// First come the vertices that the model hides, then those that are seen through it.
    depth_tested_count: u32,
    count: u32,
}

impl Shapes {
    fn new(device: &wgpu::Device) -> Self {
        let capacity = 64;
        Self {
            buffer: Self::buffer(device, capacity),
            capacity,
            depth_tested_count: 0,
            count: 0,
        }
    }

    fn buffer(device: &wgpu::Device, capacity: usize) -> wgpu::Buffer {
        let bytes = (capacity * size_of::<OverlayVertex>()) as u64;
        buffer(device, "world shapes", bytes, wgpu::BufferUsages::VERTEX)
    }

    fn write(&mut self, device: &wgpu::Device, queue: &Queue, hidden: &[OverlayVertex], through: &[&[OverlayVertex]]) {
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
        self.depth_tested_count = hidden.len() as u32;
        self.count = count as u32;
    }
}

/// Lines and triangles that stand in the world: the scene's box, its axes, and what is seen through the model.
struct WorldShapes {
    lines: Shapes,
    triangles: Shapes,
}

impl WorldShapes {
    fn new(device: &wgpu::Device) -> Self {
        Self {
            lines: Shapes::new(device),
            triangles: Shapes::new(device),
        }
    }

    fn write(&mut self, device: &wgpu::Device, queue: &Queue, frame: &RenderFrame<'_>) {
        let nothing = OverlayGeometry::default();
        let seen_through = frame.seen_through.unwrap_or(&nothing);
        let axes = axes(frame);
        self.lines
            .write(device, queue, &bounds(frame).lines, &[&seen_through.lines, &axes.lines]);
        self.triangles.write(device, queue, &[], &[&seen_through.triangles]);
    }

    fn draw(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        pipelines: &Pipelines,
        (nothing, line_group): (&wgpu::BindGroup, &wgpu::BindGroup),
        band: Band,
        through: bool,
    ) {
        if self.lines.count + self.triangles.count == 0 {
            return;
        }
        pass.set_bind_group(1, nothing, &[]);
        pass.set_bind_group(2, nothing, &[]);
        pass.set_bind_group(3, line_group, &[]);
        let farthest = if through { THROUGH_DEPTH } else { 1.0 };
        band.set_viewport(pass, farthest);
        for (shape, shapes) in [
            (WorldShape::Triangles, &self.triangles),
            (WorldShape::Lines, &self.lines),
        ] {
            let vertices = if through {
                shapes.depth_tested_count..shapes.count
            } else {
                0..shapes.depth_tested_count
            };
            if !vertices.is_empty() {
                pass.set_pipeline(&pipelines.get(Draw::World { shape, through }));
                let start = u64::from(vertices.start) * size_of::<OverlayVertex>() as u64;
                pass.set_vertex_buffer(0, shapes.buffer.slice(start..));
                let count = vertices.len() as u32;
                match shape {
                    WorldShape::Lines => pass.draw(0..4, 0..count / 2),
                    WorldShape::Triangles => pass.draw(0..count, 0..1),
                }
            }
        }
        band.set_viewport(pass, 1.0);
    }
}

/// The twelve edges of the scene's box; empty when they are not shown.
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

/// The world's axes; empty when they are not shown. They are mostly inside the model, so they are seen through it.
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
