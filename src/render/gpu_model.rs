//! A model in GPU memory.

use super::bones::BoneTexture;
use super::material::material_uniform;
use super::pipelines::{Layouts, PosedPipelines};
use crate::model::{Mesh, Model};
use crate::shaders;

/// Vertices converted at a time: uploads need no second copy of the mesh.
const CHUNK: usize = 16 * 1024;

/// Why a model cannot be drawn on this device.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum UploadError {
    /// A stream is larger than the device's largest buffer.
    #[error("the model's {stream} need {bytes} bytes; this device holds {limit} in one buffer")]
    TooLarge {
        /// Which stream.
        stream: &'static str,
        /// Its size.
        bytes: u64,
        /// The device's limit.
        limit: u64,
    },
    /// More joints than the bone texture can have.
    #[error("the model has {joints} bones; this device can blend with {limit}")]
    TooManyJoints {
        /// In the skeleton.
        joints: usize,
        /// The device's limit.
        limit: usize,
    },
}

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
    material_offset: u32,
}

pub(super) struct GpuModel {
    geometry: wgpu::Buffer,
    influences: Option<wgpu::Buffer>,
    indices: wgpu::Buffer,
    index_count: u32,
    material_group: wgpu::BindGroup,
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
        let stride = material_stride(&uploader.limits);
        let material_bytes = material_bytes(model, stride);
        let materials = uploader.upload(
            "materials",
            wgpu::BufferUsages::UNIFORM,
            material_bytes.len(),
            material_bytes.into_iter(),
        )?;
        let material_group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("materials"),
            layout: &layouts.material,
            entries: &[wgpu::BindGroupEntry {
                binding: 0,
                resource: wgpu::BindingResource::Buffer(wgpu::BufferBinding {
                    buffer: &materials,
                    offset: 0,
                    size: std::num::NonZeroU64::new(size_of::<shaders::Material>() as u64),
                }),
            }],
        });
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
            material_group,
            ranges: draw_ranges(mesh, stride),
            bones: is_skinned.then(|| BoneTexture::new(device, &layouts.bones, joints)),
            winding: winding(mesh),
        })
    }

    /// Every submesh with its material. Groups 0 and 2 are set.
    pub(super) fn draw(&self, pass: &mut wgpu::RenderPass<'_>, pipelines: &PosedPipelines, posing: Posing<'_>) {
        self.bind(pass, pipelines, posing);
        for range in &self.ranges {
            pass.set_bind_group(3, &self.material_group, &[range.material_offset]);
            pass.draw_indexed(range.indices.clone(), 0, 0..1);
        }
    }

    /// All triangles that a submesh names, in one draw where they are all the mesh has. Group 0 is set.
    pub(super) fn draw_depth(&self, pass: &mut wgpu::RenderPass<'_>, pipelines: &PosedPipelines, posing: Posing<'_>) {
        self.bind(pass, pipelines, posing);
        let named: u64 = self.ranges.iter().map(|range| range.indices.len() as u64).sum();
        if named == u64::from(self.index_count) {
            pass.draw_indexed(0..self.index_count, 0, 0..1);
        } else {
            for range in &self.ranges {
                pass.draw_indexed(range.indices.clone(), 0, 0..1);
            }
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

/// Distance between materials in their buffer: dynamic offsets want this alignment.
fn material_stride(limits: &wgpu::Limits) -> u32 {
    (size_of::<shaders::Material>() as u32).next_multiple_of(limits.min_uniform_buffer_offset_alignment)
}

fn material_bytes(model: &Model, stride: u32) -> Vec<u8> {
    let stride = stride as usize;
    let mut bytes = vec![0; model.materials.len().max(1) * stride];
    for ((index, material), slot) in model.materials.iter().enumerate().zip(bytes.chunks_exact_mut(stride)) {
        let uniform = material_uniform(index, material);
        slot[..size_of_val(&uniform)].copy_from_slice(bytemuck::bytes_of(&uniform));
    }
    bytes
}

fn draw_ranges(mesh: &Mesh, material_stride: u32) -> Vec<DrawRange> {
    let drawn = mesh.submeshes.iter().filter(|submesh| submesh.triangle_count > 0);
    drawn
        .map(|submesh| DrawRange {
            indices: submesh.triangle_start * 3..(submesh.triangle_start + submesh.triangle_count) * 3,
            material_offset: submesh.material * material_stride,
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

struct Uploader<'a> {
    device: &'a wgpu::Device,
    queue: &'a wgpu::Queue,
    limits: wgpu::Limits,
}

impl Uploader<'_> {
    /// A buffer of `count` elements. An empty one gets a few bytes, since no slice of it may be empty.
    fn upload<T: bytemuck::NoUninit>(
        &self,
        stream: &'static str,
        usage: wgpu::BufferUsages,
        count: usize,
        elements: impl Iterator<Item = T>,
    ) -> Result<wgpu::Buffer, UploadError> {
        let bytes = (count as u64 * size_of::<T>() as u64)
            .next_multiple_of(wgpu::COPY_BUFFER_ALIGNMENT)
            .max(16);
        if bytes > self.limits.max_buffer_size {
            return Err(UploadError::TooLarge {
                stream,
                bytes,
                limit: self.limits.max_buffer_size,
            });
        }
        let buffer = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(stream),
            size: bytes,
            usage: usage | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let mut elements = elements;
        let mut offset = 0;
        loop {
            let chunk: Vec<T> = elements.by_ref().take(CHUNK).collect();
            if chunk.is_empty() {
                return Ok(buffer);
            }
            let bytes = bytemuck::cast_slice(&chunk);
            self.queue.write_buffer(&buffer, offset, bytes);
            offset += bytes.len() as u64;
        }
    }
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
