//! A model in GPU memory.

use std::cell::OnceCell;
use std::ops::Range;

use super::bones::BoneTexture;
use super::drawn::Drawn;
use super::edges::Edges;
use super::layouts::Layouts;
use super::maps::{MapTextures, MaterialImages};
use super::materials::GpuMaterials;
use super::pipelines::{Cut, Draw, ModelDraw, Pipelines};
use super::upload::{UploadError, Uploader};
use crate::model::{Material, Mesh, Model};
use crate::scene::VertexColors;
use crate::shaders;

/// How a model is drawn in a pass.
#[derive(Clone, Copy)]
pub(super) struct Posed<'a> {
    pub(super) pipelines: &'a Pipelines,
    /// Bound as group 1; read only when `skinned`.
    pub(super) bones: &'a BoneTexture,
    /// By the bones, or as bind space has it.
    pub(super) skinned: bool,
    /// Submeshes that are left out.
    pub(super) hidden: &'a [bool],
}

/// A submesh: a range of indices with one material.
struct DrawRange {
    submesh: usize,
    indices: Range<u32>,
    /// From the first to the last vertex that it uses.
    vertices: Range<u32>,
    material: u32,
}

pub(super) struct GpuModel {
    geometry: wgpu::Buffer,
    influences: Option<wgpu::Buffer>,
    indices: wgpu::Buffer,
    materials: GpuMaterials,
    ranges: Vec<DrawRange>,
    /// The indices again, for edges.
    triangles: Vec<u32>,
    edges: OnceCell<Edges>,
    vertex_count: usize,
    colors: Option<(u64, wgpu::Buffer)>,
    /// Not there for a static model.
    pub(super) bones: Option<BoneTexture>,
    /// +1 when triangles are clockwise from the side their normals point to (left-handed view), else −1.
    pub(super) winding: f32,
}

impl GpuModel {
    pub(super) fn upload(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
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

        let geometry = (0..mesh.vertex_count()).map(|vertex| geometry_vertex(mesh, vertex));
        let influences = mesh.influences.iter().map(|influences| shaders::InfluenceVertex {
            joints: influences.joints,
            weights: influences.weights,
        });
        let is_skinned = joints > 0 && !mesh.influences.is_empty();
        let vertex = wgpu::BufferUsages::VERTEX;
        let materials = GpuMaterials::upload(&uploader, layouts, textures, &model.materials)?;
        Ok(Self {
            geometry: uploader.upload("vertices", vertex, mesh.vertex_count(), geometry)?,
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
        })
    }

    /// Gives the materials their maps; those before are forgotten.
    pub(super) fn set_maps(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        layouts: &Layouts,
        textures: &MapTextures,
        maps: &[MaterialImages<'_>],
    ) {
        self.materials.set_maps(device, queue, layouts, textures, maps);
    }

    /// Takes other values for the materials; their maps stay.
    pub(super) fn set_materials(&mut self, queue: &wgpu::Queue, materials: &[Material]) {
        self.materials.set_values(queue, materials);
    }

    /// Takes up colours of the vertices, if they are others than those it has.
    pub(super) fn set_colors(&mut self, device: &wgpu::Device, queue: &wgpu::Queue, colors: &VertexColors<'_>) {
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

    /// Every submesh in view with its material; `draw` says what to draw where alpha cuts in a way. Group 0 is set, and group 2
    /// where it is read.
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
                // Through the holes of a cut triangle another cut one may be seen.
                let parts = if is_cut {
                    drawn.missing(&range.indices)
                } else {
                    drawn.add(&range.indices)
                };
                if !parts.is_empty() {
                    self.materials.bind(pass, range.material);
                }
                for part in parts {
                    pass.draw_indexed(part, 0, 0..1);
                }
            }
        }
    }

    /// All triangles in view without their materials, in as few draws as can be. Group 0 is set.
    pub(super) fn draw_shape(&self, pass: &mut wgpu::RenderPass<'_>, posed: Posed<'_>, draw: ModelDraw) {
        self.bind(pass, posed, draw);
        let mut shape = Drawn::default();
        for range in self.in_view(posed.hidden) {
            shape.add(&range.indices);
        }
        for range in shape.ranges() {
            pass.draw_indexed(range, 0, 0..1);
        }
    }

    /// Depth from the first light. Group 0 is set.
    pub(super) fn draw_caster(&self, pass: &mut wgpu::RenderPass<'_>, posed: Posed<'_>) {
        if self.ranges.iter().any(|range| self.materials.is_cut(range.material)) {
            self.draw(pass, posed, Cut::Hard, ModelDraw::Caster);
        } else {
            self.draw_shape(pass, posed, ModelDraw::Caster(Cut::Whole));
        }
    }

    /// One submesh alone. Groups 0 and 3 are set.
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
            pass.draw_indexed(range.indices.clone(), 0, 0..1);
        }
    }

    /// The edges of all triangles in view, each once. Groups 0 and 3 are set.
    pub(super) fn draw_edges(&self, device: &wgpu::Device, pass: &mut wgpu::RenderPass<'_>, posed: Posed<'_>) {
        let edges = self.edges.get_or_init(|| {
            let ranges = self.ranges.iter().map(|range| range.indices.clone());
            Edges::new(device, &self.triangles, ranges)
        });
        self.bind(pass, posed, ModelDraw::Edges);
        pass.set_index_buffer(edges.buffer.slice(..), wgpu::IndexFormat::Uint32);
        for (range, edges) in self.ranges.iter().zip(&edges.ranges) {
            if !is_hidden(posed.hidden, range.submesh) {
                pass.draw_indexed(edges.clone(), 0, 0..1);
            }
        }
    }

    /// A line at each vertex in view. Groups 0 and 3 are set.
    pub(super) fn draw_vertex_lines(&self, pass: &mut wgpu::RenderPass<'_>, posed: Posed<'_>, draw: ModelDraw) {
        self.bind(pass, posed, draw);
        for range in self.in_view(posed.hidden) {
            // WebGL2 has no first instance: the buffers start there instead.
            let start = |stride: usize| u64::from(range.vertices.start) * stride as u64;
            pass.set_vertex_buffer(0, self.geometry.slice(start(size_of::<shaders::GeometryVertex>())..));
            if let (true, Some(influences)) = (posed.skinned, &self.influences) {
                pass.set_vertex_buffer(1, influences.slice(start(size_of::<shaders::InfluenceVertex>())..));
            }
            pass.draw(0..2, 0..range.vertices.len() as u32);
        }
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
        pass.set_vertex_buffer(0, self.geometry.slice(..));
        if let (true, Some(influences)) = (skinned, &self.influences) {
            pass.set_vertex_buffer(1, influences.slice(..));
        }
        if let (ModelDraw::SkinView(_), Some((_, colors))) = (draw, &self.colors) {
            pass.set_vertex_buffer(2, colors.slice(..));
        }
        pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
    }
}

fn is_hidden(hidden: &[bool], submesh: usize) -> bool {
    hidden.get(submesh).copied().unwrap_or(false)
}

fn geometry_vertex(mesh: &Mesh, vertex: usize) -> shaders::GeometryVertex {
    shaders::GeometryVertex {
        position: mesh.positions[vertex].to_array(),
        normal: mesh.normals.get(vertex).copied().unwrap_or_default().to_array(),
        tangent: mesh.tangents.get(vertex).copied().unwrap_or_default().to_array(),
        tex_coord: mesh.tex_coords.get(vertex).copied().unwrap_or_default().to_array(),
    }
}

/// What has no material is not drawn.
fn draw_ranges(mesh: &Mesh, material_count: usize) -> Vec<DrawRange> {
    let submeshes = mesh.submeshes.iter().enumerate();
    submeshes
        .filter(|(_, submesh)| submesh.triangle_count > 0 && (submesh.material as usize) < material_count)
        .map(|(index, submesh)| {
            let indices = submesh.triangle_start * 3..(submesh.triangle_start + submesh.triangle_count) * 3;
            let used = &mesh.indices[indices.start as usize..indices.end as usize];
            let (first, last) = (used.iter().min(), used.iter().max());
            DrawRange {
                submesh: index,
                indices,
                vertices: first.copied().unwrap_or(0)..last.map_or(0, |last| last + 1),
                material: submesh.material,
            }
        })
        .collect()
}

/// Asks the normals which way the triangles are wound, so that a file wound the other way is lit from the right side. Each
/// triangle votes with its area.
fn winding(mesh: &Mesh) -> f32 {
    let vote: f64 = mesh
        .indices
        .chunks_exact(3)
        .map(|triangle| {
            let at = |corner: usize| triangle[corner] as usize;
            let position = |corner| mesh.positions[at(corner)];
            let normal = |corner| mesh.normals.get(at(corner)).copied().unwrap_or_default();
            let area = (position(1) - position(0)).cross(position(2) - position(0));
            f64::from(area.dot(normal(0) + normal(1) + normal(2)))
        })
        .filter(|vote| vote.is_finite())
        .sum();
    if vote < 0.0 { -1.0 } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;

    // Seen from -z in a left-handed space (x right, y up, z away), 0 1 2 goes clockwise.
    fn triangle(normal: Vec3) -> Mesh {
        Mesh {
            positions: vec![Vec3::ZERO, Vec3::Y, Vec3::X],
            normals: vec![normal; 3],
            indices: vec![0, 1, 2],
            ..Mesh::default()
        }
    }

    #[test]
    fn normals_tell_which_way_triangles_are_wound() {
        assert_eq!(winding(&triangle(Vec3::NEG_Z)), 1.0);
        assert_eq!(winding(&triangle(Vec3::Z)), -1.0);
        assert_eq!(winding(&Mesh::default()), 1.0);
    }
}
