//! A model in GPU memory, and how its parts are drawn.

use std::cell::{Cell, OnceCell};
use std::ops::Range;

use super::buffers::{Queue, UploadError, Uploader};
use super::instances::{BoneTexture, InstanceRange};
use super::maps::MapTextures;
use super::materials::GpuMaterials;
use super::pipelines::{COLOR_SLOT, INFLUENCE_SLOT, INSTANCE_SLOT, Layouts, POSITION_SLOT, Pipelines, SURFACE_SLOT};
use super::recipe::{Cut, Draw, ModelDraw};
use super::triangles::{DrawRange, Drawn, Edges, draw_ranges, winding};
use crate::model::{Mesh, Model};
use crate::scene::VertexColors;
use crate::shaders;

/// How a model is drawn in a pass.
#[derive(Clone, Copy)]
pub(super) struct Posed<'a> {
    pub(super) pipelines: &'a Pipelines,
    /// Bound as group 1, read only when `skinned`.
    pub(super) bones: &'a BoneTexture,
    /// Those that are drawn.
    pub(super) instances: InstanceRange<'a>,
    /// Whether the bones pose it; else it is drawn in bind space.
    pub(super) skinned: bool,
    /// Submeshes that are not drawn.
    pub(super) hidden: &'a [bool],
}

pub(super) struct GpuModel {
    positions: wgpu::Buffer,
    surface: wgpu::Buffer,
    influences: Option<wgpu::Buffer>,
    indices: wgpu::Buffer,
    pub(super) materials: GpuMaterials,
    ranges: Vec<DrawRange>,
    /// The indices, kept for the edges.
    triangles: Vec<u32>,
    edges: OnceCell<Edges>,
    vertex_count: usize,
    colors: Option<(u64, wgpu::Buffer)>,
    /// None for a static model.
    pub(super) bones: Option<BoneTexture>,
    /// See [`winding`].
    pub(super) winding: f32,
    drawn_vertices: Cell<u64>,
}

impl GpuModel {
    pub(super) fn upload(
        device: &wgpu::Device,
        queue: &Queue,
        layouts: &Layouts,
        textures: &MapTextures,
        model: &Model,
    ) -> Result<Self, UploadError> {
        let mesh = &model.mesh;
        let limits = device.limits();
        let joints = model.skeleton.joint_count();
        let max_joints = BoneTexture::max_joints(&limits);
        if joints > max_joints {
            return Err(UploadError::TooManyJoints {
                joints,
                limit: max_joints,
            });
        }
        let uploader = Uploader { device, queue, limits };

        let positions = mesh.positions.iter().map(glam::Vec3::to_array);
        let surface = (0..mesh.vertex_count()).map(|vertex| surface_vertex(mesh, vertex));
        let influences = mesh.influences.iter().map(|influences| shaders::InfluenceVertex {
            joints: influences.joints,
            weights: influences.weights,
        });
        let is_skinned = joints > 0 && !mesh.influences.is_empty();
        let vertex = wgpu::BufferUsages::VERTEX;
        let materials = GpuMaterials::upload(&uploader, layouts, textures, &model.materials)?;
        Ok(Self {
            positions: uploader.upload("positions", vertex, mesh.vertex_count(), positions)?,
            surface: uploader.upload("vertices", vertex, mesh.vertex_count(), surface)?,
            influences: if is_skinned {
                Some(uploader.upload("influences", vertex, mesh.influences.len(), influences)?)
            } else {
                None
            },
            indices: uploader.upload(
                "indices",
                wgpu::BufferUsages::INDEX,
                mesh.indices.len(),
                mesh.indices.iter().copied(),
            )?,
            materials,
            ranges: draw_ranges(mesh, model.materials.len()),
            triangles: mesh.indices.clone(),
            edges: OnceCell::new(),
            vertex_count: mesh.vertex_count(),
            colors: None,
            bones: is_skinned.then(|| BoneTexture::new(device, &layouts.bones, joints)),
            winding: winding(mesh),
            drawn_vertices: Cell::new(0),
        })
    }

    /// Uploads colours of the vertices, if their revision is another one.
    pub(super) fn set_colors(&mut self, device: &wgpu::Device, queue: &Queue, colors: &VertexColors<'_>) {
        if self
            .colors
            .as_ref()
            .is_some_and(|(revision, _)| *revision == colors.revision)
        {
            return;
        }
        let buffer = self.colors.take().map(|(_, buffer)| buffer).unwrap_or_else(|| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("vertex colours"),
                size: (self.vertex_count.max(1) * size_of::<[u8; 4]>()) as u64,
                usage: wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        });
        let given = &colors.colors_srgb[..colors.colors_srgb.len().min(self.vertex_count)];
        queue.write_buffer(&buffer, 0, bytemuck::cast_slice(given));
        self.colors = Some((colors.revision, buffer));
    }

    /// Draws every visible submesh with its material. `cut` is how those with alpha are cut; `draw` says what to draw for a cut.
    /// The caller sets group 0, and group 2 where it is read.
    pub(super) fn draw(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        posed: Posed<'_>,
        cut: Cut,
        draw: impl Fn(Cut) -> ModelDraw,
    ) {
        let mut drawn = Drawn::default();
        for (is_cut, cut) in [(false, Cut::Whole), (true, cut)] {
            let mut ranges = self
                .in_view(posed.hidden)
                .filter(|range| self.materials.is_cut(range.material) == is_cut)
                .peekable();
            if ranges.peek().is_some() {
                self.bind(pass, posed, draw(cut));
            }
            for range in ranges {
                // All cut triangles are drawn: one may be seen through the holes of another.
                let parts = if is_cut {
                    drawn.missing(&range.indices)
                } else {
                    drawn.add(&range.indices)
                };
                if !parts.is_empty() {
                    self.materials.bind(pass, range.material);
                }
                for part in parts {
                    self.draw_indices(pass, posed, part);
                }
            }
        }
    }

    /// Draws all visible triangles without their materials, in as few draws as possible. The caller sets group 0.
    pub(super) fn draw_shape(&self, pass: &mut wgpu::RenderPass<'_>, posed: Posed<'_>, draw: ModelDraw) {
        self.bind(pass, posed, draw);
        let mut shape = Drawn::default();
        for range in self.in_view(posed.hidden) {
            shape.add(&range.indices);
        }
        for range in shape.ranges() {
            self.draw_indices(pass, posed, range);
        }
    }

    /// Whether the alpha of a map cuts some of it.
    pub(super) fn has_cut_submeshes(&self) -> bool {
        self.ranges.iter().any(|range| self.materials.is_cut(range.material))
    }

    /// Draws what casts a shadow. The caller sets group 0.
    pub(super) fn draw_caster(&self, pass: &mut wgpu::RenderPass<'_>, posed: Posed<'_>) {
        if self.has_cut_submeshes() {
            self.draw(pass, posed, Cut::Hard, ModelDraw::Caster);
        } else {
            self.draw_shape(pass, posed, ModelDraw::Caster(Cut::Whole));
        }
    }

    /// Draws one submesh alone. The caller sets groups 0 and 3.
    pub(super) fn draw_submesh(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        posed: Posed<'_>,
        draw: ModelDraw,
        submesh: usize,
    ) {
        let mut ranges = self.in_view(posed.hidden);
        if let Some(range) = ranges.find(|range| range.submesh == submesh) {
            self.bind(pass, posed, draw);
            self.draw_indices(pass, posed, range.indices.clone());
        }
    }

    /// Draws the edges of all visible triangles. The caller sets groups 0 and 3.
    pub(super) fn draw_edges(&self, device: &wgpu::Device, pass: &mut wgpu::RenderPass<'_>, posed: Posed<'_>) {
        let edges = self.edges.get_or_init(|| {
            let ranges = self.ranges.iter().map(|range| range.indices.clone());
            Edges::new(device, &self.triangles, ranges)
        });
        self.bind(pass, posed, ModelDraw::Edges);
        pass.set_index_buffer(edges.buffer.slice(..), wgpu::IndexFormat::Uint32);
        for (range, edges) in self.ranges.iter().zip(&edges.ranges) {
            if !is_hidden(posed.hidden, range.submesh) {
                self.draw_indices(pass, posed, edges.clone());
            }
        }
    }

    /// Draws a line at each visible vertex. The caller sets groups 0 and 3.
    pub(super) fn draw_vertex_lines(&self, pass: &mut wgpu::RenderPass<'_>, posed: Posed<'_>, draw: ModelDraw) {
        self.bind(pass, posed, draw);
        for range in self.in_view(posed.hidden) {
            // WebGL2 has no first instance: the buffers start there instead.
            let start = |stride: usize| u64::from(range.vertices.start) * stride as u64;
            let positions = self.positions.slice(start(size_of::<shaders::PositionVertex>())..);
            pass.set_vertex_buffer(POSITION_SLOT, positions);
            let surface = self.surface.slice(start(size_of::<shaders::SurfaceVertex>())..);
            pass.set_vertex_buffer(SURFACE_SLOT, surface);
            if let (true, Some(influences)) = (posed.skinned, &self.influences) {
                let influences = influences.slice(start(size_of::<shaders::InfluenceVertex>())..);
                pass.set_vertex_buffer(INFLUENCE_SLOT, influences);
            }
            for instance in 0..posed.instances.count {
                pass.set_vertex_buffer(INSTANCE_SLOT, posed.instances.from(instance));
                let lines = range.vertices.len() as u32;
                pass.draw(0..2, 0..lines);
                self.count(2 * u64::from(lines));
            }
        }
    }

    /// The vertices that were drawn since this was last asked: each index once for each instance.
    pub(super) fn take_drawn_vertices(&self) -> u64 {
        self.drawn_vertices.take()
    }

    fn draw_indices(&self, pass: &mut wgpu::RenderPass<'_>, posed: Posed<'_>, indices: Range<u32>) {
        self.count(indices.len() as u64 * u64::from(posed.instances.count));
        pass.draw_indexed(indices, 0, 0..posed.instances.count);
    }

    fn count(&self, vertices: u64) {
        self.drawn_vertices.set(self.drawn_vertices.get() + vertices);
    }

    fn in_view<'a>(&'a self, hidden: &'a [bool]) -> impl Iterator<Item = &'a DrawRange> {
        self.ranges
            .iter()
            .filter(move |range| !is_hidden(hidden, range.submesh))
    }

    fn bind(&self, pass: &mut wgpu::RenderPass<'_>, posed: Posed<'_>, draw: ModelDraw) {
        let Posed { skinned, .. } = posed;
        pass.set_pipeline(&posed.pipelines.get(Draw::Model { draw, skinned }));
        pass.set_bind_group(1, posed.bones.group(), &[]);
        pass.set_vertex_buffer(INSTANCE_SLOT, posed.instances.from(0));
        pass.set_vertex_buffer(POSITION_SLOT, self.positions.slice(..));
        if draw.reads_surface() {
            pass.set_vertex_buffer(SURFACE_SLOT, self.surface.slice(..));
        }
        if let (true, Some(influences)) = (skinned, &self.influences) {
            pass.set_vertex_buffer(INFLUENCE_SLOT, influences.slice(..));
        }
        if let (true, Some((_, colors))) = (draw.reads_colors(), &self.colors) {
            pass.set_vertex_buffer(COLOR_SLOT, colors.slice(..));
        }
        pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
    }
}

fn is_hidden(hidden: &[bool], submesh: usize) -> bool {
    hidden.get(submesh).copied().unwrap_or(false)
}

fn surface_vertex(mesh: &Mesh, vertex: usize) -> shaders::SurfaceVertex {
    shaders::SurfaceVertex {
        normal: mesh.normals.get(vertex).copied().unwrap_or_default().to_array(),
        tangent: mesh.tangents.get(vertex).copied().unwrap_or_default().to_array(),
        tex_coord: mesh.tex_coords.get(vertex).copied().unwrap_or_default().to_array(),
    }
}
