//! A model in GPU memory.

use super::bones::BoneTexture;
use super::materials::{GpuMaterials, MaterialImages};
use super::pipelines::{Layouts, PosedPipelines};
use super::upload::{UploadError, Uploader};
use crate::model::{Mesh, Model};
use crate::shaders;

/// How a model is posed in a draw.
#[derive(Clone, Copy)]
pub(super) enum Posing<'a> {
    /// By these bones.
    Skinned(&'a BoneTexture),
    /// As bind space has it; the bones are bound, not read.
    Static(&'a BoneTexture),
}

/// A range of indices with one material.
struct DrawRange {
    indices: std::ops::Range<u32>,
    material: u32,
}

pub(super) struct GpuModel {
    geometry: wgpu::Buffer,
    influences: Option<wgpu::Buffer>,
    indices: wgpu::Buffer,
    index_count: u32,
    materials: GpuMaterials,
    ranges: Vec<DrawRange>,
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
        let materials = GpuMaterials::upload(&uploader, layouts, &model.materials)?;
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
            index_count: mesh.indices.len() as u32,
            materials,
            ranges: draw_ranges(mesh),
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
        maps: &[MaterialImages<'_>],
    ) {
        self.materials.set_maps(device, queue, layouts, maps);
    }

    /// Every submesh with its material. Groups 0 and 2 are set.
    pub(super) fn draw(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        whole: &PosedPipelines,
        cut: &PosedPipelines,
        posing: Posing<'_>,
    ) {
        self.draw_materials(pass, whole, posing, false);
        self.draw_materials(pass, cut, posing, true);
    }

    /// All triangles that a submesh names, in one draw where they are all the mesh has and alpha cuts none. Groups 0 and 2
    /// are set.
    pub(super) fn draw_depth(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        whole: &PosedPipelines,
        cut: &PosedPipelines,
        posing: Posing<'_>,
    ) {
        let of_whole = self
            .ranges
            .iter()
            .filter(|range| !self.materials.is_cut(range.material));
        let named: u64 = of_whole.map(|range| range.indices.len() as u64).sum();
        if named == u64::from(self.index_count) {
            self.bind(pass, whole, posing);
            pass.draw_indexed(0..self.index_count, 0, 0..1);
        } else {
            self.draw(pass, whole, cut, posing);
        }
    }

    /// The submeshes that alpha cuts, or the others.
    fn draw_materials(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        pipelines: &PosedPipelines,
        posing: Posing<'_>,
        is_cut: bool,
    ) {
        let ranges = self
            .ranges
            .iter()
            .filter(|range| self.materials.is_cut(range.material) == is_cut);
        for (index, range) in ranges.enumerate() {
            if index == 0 {
                self.bind(pass, pipelines, posing);
            }
            self.materials.bind(pass, range.material);
            pass.draw_indexed(range.indices.clone(), 0, 0..1);
        }
    }

    fn bind(&self, pass: &mut wgpu::RenderPass<'_>, pipelines: &PosedPipelines, posing: Posing<'_>) {
        let (pipeline, bones) = match posing {
            Posing::Skinned(bones) => (&pipelines.skinned, bones),
            Posing::Static(bones) => (&pipelines.unskinned, bones),
        };
        pass.set_pipeline(pipeline);
        pass.set_bind_group(1, bones.group(), &[]);
        pass.set_vertex_buffer(0, self.geometry.slice(..));
        if let (Posing::Skinned(_), Some(influences)) = (posing, &self.influences) {
            pass.set_vertex_buffer(1, influences.slice(..));
        }
        pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
    }
}

fn geometry_vertex(mesh: &Mesh, vertex: usize) -> shaders::GeometryVertex {
    shaders::GeometryVertex {
        position: mesh.positions[vertex].to_array(),
        normal: mesh.normals.get(vertex).copied().unwrap_or_default().to_array(),
        tangent: mesh.tangents.get(vertex).copied().unwrap_or_default().to_array(),
        tex_coord: mesh.tex_coords.get(vertex).copied().unwrap_or_default().to_array(),
    }
}

fn draw_ranges(mesh: &Mesh) -> Vec<DrawRange> {
    let drawn = mesh.submeshes.iter().filter(|submesh| submesh.triangle_count > 0);
    drawn
        .map(|submesh| DrawRange {
            indices: submesh.triangle_start * 3..(submesh.triangle_start + submesh.triangle_count) * 3,
            material: submesh.material,
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
