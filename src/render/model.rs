//! A model in GPU memory, and how its parts are drawn.
//!
//! Positions are a vertex stream of their own, so that shadow map, contact map and edges fetch 12 bytes of a vertex and its influences.
//! Normals, tangents and texture coordinates are another stream.

use std::cell::{Cell, OnceCell};
use std::collections::BTreeSet;
use std::ops::Range;

use glam::Vec4;

use super::blending::{Center, Run, farthest_first};
use super::buffers::{Queue, UploadError, Uploader, buffer};
use super::instances::{BoneTexture, InstanceRange};
use super::maps::{MapTextures, MaterialImages};
use super::materials::GpuMaterials;
use super::pipelines::{
    COLOR_SLOT, INFLUENCE_SLOT, INSTANCE_SLOT, Layouts, MORE_MAPS_SLOT, POSITION_SLOT, Pipelines, SURFACE_SLOT,
};
use super::recipe::{Alpha, Draw, Faces, Kind, Maps, ModelDraw, Purpose};
use super::triangles::{DrawRange, Drawn, Edges, draw_ranges, wound_one_way};
use crate::model::{Handedness, Material, Mesh, Model};
use crate::scene::{RenderFrame, VertexColors};
use crate::shaders;

/// How a model is drawn in a pass.
#[derive(Clone, Copy)]
pub(super) struct Posed<'a> {
    pub(super) pipelines: &'a Pipelines,
    /// Bound as group 1, read only when `skinned`.
    pub(super) bones: &'a BoneTexture,
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
    /// Colours and second texture coordinates, when a material reads all maps.
    more_maps: Option<wgpu::Buffer>,
    indices: wgpu::Buffer,
    materials: GpuMaterials,
    ranges: Vec<DrawRange>,
    /// Of each range.
    centers: Vec<Center>,
    /// None where the device has no room for them.
    edges: OnceCell<Option<Edges>>,
    vertex_count: usize,
    colors: Option<(u64, wgpu::Buffer)>,
    /// None for a static model.
    pub(super) bones: Option<BoneTexture>,
    /// All its triangles are wound by it.
    pub(super) handedness: Handedness,
    /// The fronts of its triangles, as they stand in the frame's world.
    pub(super) front: Faces,
    drawn: Cell<[u64; 2]>,
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
        let tangents = mesh.tangents_or_computed();
        let surface = (0..mesh.vertex_count()).map(|vertex| surface_vertex(mesh, &tangents, vertex));
        let influences = mesh.influences.iter().map(|influences| shaders::InfluenceVertex {
            joints: influences.joints,
            weights: influences.weights,
        });
        let is_skinned = joints > 0 && !mesh.influences.is_empty();
        let vertex = wgpu::BufferUsages::VERTEX;
        let has_colors = !mesh.colors.is_empty();
        let materials = GpuMaterials::upload(&uploader, layouts, textures, &model.materials, has_colors)?;
        let has_more = has_colors || !mesh.second_tex_coords.is_empty() || materials.read_all_maps();
        let ranges = draw_ranges(mesh, model.materials.len());
        let indices = wound_one_way(model);
        Ok(Self {
            positions: uploader.upload("positions", vertex, mesh.vertex_count(), positions)?,
            surface: uploader.upload("vertices", vertex, mesh.vertex_count(), surface)?,
            influences: if is_skinned {
                Some(uploader.upload("influences", vertex, mesh.influences.len(), influences)?)
            } else {
                None
            },
            more_maps: if has_more {
                let vertices = (0..mesh.vertex_count()).map(|vertex| more_maps_vertex(mesh, vertex));
                Some(uploader.upload("colours", vertex, mesh.vertex_count(), vertices)?)
            } else {
                None
            },
            indices: uploader.upload(
                "indices",
                wgpu::BufferUsages::INDEX,
                indices.len(),
                indices.iter().copied(),
            )?,
            materials,
            centers: Center::of(mesh, &ranges, joints),
            ranges,
            edges: OnceCell::new(),
            vertex_count: mesh.vertex_count(),
            colors: None,
            bones: is_skinned.then(|| BoneTexture::new(device, &layouts.bones, joints)),
            handedness: model.handedness,
            front: Faces::Clockwise,
            drawn: Cell::default(),
        })
    }

    /// See [`Renderer::set_maps`](super::Renderer::set_maps). `textures` was updated with the same maps.
    pub(super) fn set_maps(
        &mut self,
        device: &wgpu::Device,
        queue: &Queue,
        layouts: &Layouts,
        textures: &MapTextures,
        maps: &[MaterialImages<'_>],
    ) {
        self.materials.set_maps(device, queue, layouts, textures, maps);
    }

    /// Replaces the values of the materials, in their order; their maps stay.
    pub(super) fn set_materials(
        &mut self,
        device: &wgpu::Device,
        queue: &Queue,
        layouts: &Layouts,
        materials: &[Material],
    ) {
        self.materials.set_values(device, queue, layouts, materials);
        if self.more_maps.is_none() && self.materials.read_all_maps() {
            let (usage, limits) = (wgpu::BufferUsages::VERTEX, device.limits());
            let uploader = Uploader { device, queue, limits };
            let white = std::iter::repeat_n(more_maps_vertex(&Mesh::default(), 0), self.vertex_count);
            // It is smaller than the vertices that are there.
            self.more_maps = uploader.upload("colours", usage, self.vertex_count, white).ok();
        }
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
            let bytes = (self.vertex_count.max(1) * size_of::<[u8; 4]>()) as u64;
            buffer(device, "vertex colours", bytes, wgpu::BufferUsages::VERTEX)
        });
        let given = &colors.colors_srgb[..colors.colors_srgb.len().min(self.vertex_count)];
        queue.write_buffer(&buffer, 0, bytemuck::cast_slice(given));
        self.colors = Some((colors.revision, buffer));
    }

    /// Draws every visible submesh with its material. The caller sets group 0, and group 2 where it is read.
    pub(super) fn draw(&self, pass: &mut wgpu::RenderPass<'_>, posed: Posed<'_>, purpose: Purpose) {
        let mut drawn = Drawn::default();
        for kind in self.kinds() {
            let mut ranges = self
                .in_view(posed.hidden)
                .filter(|range| self.materials.kind(range.material) == kind)
                .peekable();
            if ranges.peek().is_some() {
                let draw = purpose.draw(kind);
                self.bind(pass, posed, draw, self.faces(draw, kind));
            }
            for range in ranges {
                // All cut triangles are drawn: one may be seen through the holes of another.
                let parts = if kind.alpha == Alpha::Whole {
                    drawn.add(&range.indices)
                } else {
                    drawn.missing(&range.indices)
                };
                if !parts.is_empty() {
                    self.materials.bind(pass, range.material);
                }
                for part in parts {
                    self.draw_indices(pass, part, posed.instances.count);
                }
            }
        }
    }

    /// Instances and ranges to blend, the farthest first; without `own`, those of the crowd alone.
    pub(super) fn blended(&self, frame: &RenderFrame<'_>, own: bool) -> Vec<Run> {
        let sides = |range: usize| -> &[bool] {
            let range = &self.ranges[range];
            match self.materials.kind(range.material) {
                _ if is_hidden(frame.hidden_submeshes, range.submesh) => &[],
                Kind { alpha, .. } if !alpha.is_blended() => &[],
                // It is drawn among the opaque ones.
                Kind { alpha, .. } if alpha == Alpha::BlendedByTexel && frame.sample.is_some() => &[],
                Kind { double_sided, .. } if double_sided => &[false, true],
                _ => &[true],
            }
        };
        farthest_first(frame, &self.centers, sides, own)
    }

    /// Draws what [`GpuModel::blended`] found of these instances. The caller sets groups 0 and 2.
    pub(super) fn draw_blended(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        posed: Posed<'_>,
        order: &[Run],
        draw: ModelDraw,
    ) {
        let mut bound = None;
        for (instances, range, is_front) in order {
            let faces = if *is_front { self.front } else { self.front.turned() };
            if bound != Some(faces) {
                self.bind(pass, posed, draw, faces);
                bound = Some(faces);
            }
            let range = &self.ranges[*range];
            pass.set_vertex_buffer(INSTANCE_SLOT, posed.instances.from(instances.start));
            self.materials.bind(pass, range.material);
            self.draw_indices(pass, range.indices.clone(), instances.len() as u32);
        }
    }

    /// Draws all visible triangles without their materials, in as few draws as possible. The caller sets group 0.
    pub(super) fn draw_shape(&self, pass: &mut wgpu::RenderPass<'_>, posed: Posed<'_>, draw: ModelDraw) {
        let faces_of = |range: &DrawRange| self.faces(draw, self.materials.kind(range.material));
        for faces in [Faces::All, Faces::Clockwise, Faces::Counterclockwise] {
            let mut shape = Drawn::default();
            for range in self.in_view(posed.hidden).filter(|range| faces_of(range) == faces) {
                shape.add(&range.indices);
            }
            for (index, range) in shape.ranges().enumerate() {
                if index == 0 {
                    self.bind(pass, posed, draw, faces);
                }
                self.draw_indices(pass, range, posed.instances.count);
            }
        }
    }

    /// The kinds of its materials, each once, in the order in which they are drawn.
    pub(super) fn kinds(&self) -> BTreeSet<Kind> {
        let materials = self.ranges.iter().map(|range| range.material);
        materials.map(|material| self.materials.kind(material)).collect()
    }

    /// Draws what casts a shadow or is near the ground, without what alpha cuts away. The caller sets groups 0 and 2.
    pub(super) fn draw_solid(&self, pass: &mut wgpu::RenderPass<'_>, posed: Posed<'_>, purpose: Purpose) {
        let is_holed = |range: &DrawRange| self.materials.kind(range.material).alpha != Alpha::Whole;
        if self.ranges.iter().any(is_holed) {
            self.draw(pass, posed, purpose);
        } else {
            self.draw_shape(pass, posed, purpose.draw(Kind::default()));
        }
    }

    fn faces(&self, draw: ModelDraw, kind: Kind) -> Faces {
        match draw {
            // It shows where the model is, not how it looks.
            ModelDraw::Highlight => Faces::All,
            ModelDraw::Contact(..) => kind.faces(self.front.turned()),
            _ => kind.faces(self.front),
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
            self.bind(pass, posed, draw, Faces::All);
            self.draw_indices(pass, range.indices.clone(), posed.instances.count);
        }
    }

    /// Draws the edges of all visible triangles of the frame's own instance. The caller sets groups 0 and 3; group 2 has the edges' vertices
    /// after it.
    pub(super) fn draw_edges(
        &self,
        gpu: (&wgpu::Device, &Queue),
        pass: &mut wgpu::RenderPass<'_>,
        posed: Posed<'_>,
        mesh: &Mesh,
    ) {
        let edges = self.edges.get_or_init(|| {
            let ranges = self.ranges.iter().map(|range| range.indices.clone());
            Edges::new(gpu, &posed.pipelines.layouts, mesh, ranges)
        });
        let Some(edges) = edges else { return };
        self.bind(pass, posed, ModelDraw::Edges, Faces::All);
        pass.set_bind_group(2, &edges.vertices, &[]);
        for (range, lines) in self.ranges.iter().zip(&edges.ranges) {
            if !is_hidden(posed.hidden, range.submesh) && !lines.is_empty() {
                let start = u64::from(lines.start) * size_of::<[u32; 2]>() as u64;
                pass.set_vertex_buffer(POSITION_SLOT, edges.buffer.slice(start..));
                self.draw_lines(pass, lines.len() as u32);
            }
        }
    }

    fn draw_lines(&self, pass: &mut wgpu::RenderPass<'_>, lines: u32) {
        pass.draw(0..4, 0..lines);
        self.count(4 * u64::from(lines));
    }

    /// Draws a line at each visible vertex of the frame's own instance. The caller sets groups 0 and 3.
    pub(super) fn draw_vertex_lines(&self, pass: &mut wgpu::RenderPass<'_>, posed: Posed<'_>, draw: ModelDraw) {
        self.bind(pass, posed, draw, Faces::All);
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
            self.draw_lines(pass, range.vertices.len() as u32);
        }
    }

    /// The draws since this was last asked, and the vertices that they drew: each index once for each instance.
    pub(super) fn take_drawn(&self) -> [u64; 2] {
        self.drawn.take()
    }

    fn draw_indices(&self, pass: &mut wgpu::RenderPass<'_>, indices: Range<u32>, instances: u32) {
        self.count(indices.len() as u64 * u64::from(instances));
        pass.draw_indexed(indices, 0, 0..instances);
    }

    fn count(&self, vertices: u64) {
        let [draws, before] = self.drawn.get();
        self.drawn.set([draws + 1, before + vertices]);
    }

    fn in_view<'a>(&'a self, hidden: &'a [bool]) -> impl Iterator<Item = &'a DrawRange> {
        self.ranges
            .iter()
            .filter(move |range| !is_hidden(hidden, range.submesh))
    }

    fn bind(&self, pass: &mut wgpu::RenderPass<'_>, posed: Posed<'_>, draw: ModelDraw, faces: Faces) {
        let Posed { skinned, .. } = posed;
        pass.set_pipeline(&posed.pipelines.get(Draw::Model { draw, skinned, faces }));
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
        if let (Some(Maps::All), Some(more_maps)) = (draw.maps(), &self.more_maps) {
            pass.set_vertex_buffer(MORE_MAPS_SLOT, more_maps.slice(..));
        }
        pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
    }
}

fn is_hidden(hidden: &[bool], submesh: usize) -> bool {
    hidden.get(submesh).copied().unwrap_or(false)
}

fn surface_vertex(mesh: &Mesh, tangents: &[Vec4], vertex: usize) -> shaders::SurfaceVertex {
    shaders::SurfaceVertex {
        normal: mesh.normals.get(vertex).copied().unwrap_or_default().to_array(),
        tangent: tangents.get(vertex).copied().unwrap_or_default().to_array(),
        tex_coord: mesh.tex_coords.get(vertex).copied().unwrap_or_default().to_array(),
    }
}

/// White where the mesh has no colours.
fn more_maps_vertex(mesh: &Mesh, vertex: usize) -> shaders::MoreMapsVertex {
    let color = mesh.colors.get(vertex).copied().unwrap_or(Vec4::ONE);
    let second = mesh.second_tex_coords.get(vertex).copied().unwrap_or_default();
    shaders::MoreMapsVertex {
        color: color
            .to_array()
            .map(|channel| (channel.clamp(0.0, 1.0) * 65535.0).round() as u16),
        second_tex_coord: second.to_array(),
    }
}
