//! The materials of a model in GPU memory: a bind group each, with its maps or what stands for them.

use std::sync::Arc;

use super::layouts::Layouts;
use super::map_textures::MapTextures;
use super::material::{MapFacts, material_uniform};
use super::upload::{UploadError, Uploader};
use crate::image::{Image, MapKind};
use crate::model::Material;
use crate::shaders;

/// Samples along the longer side of a pixel's footprint, where the device can: floors stay sharp far away.
const ANISOTROPY: u16 = 8;

/// The pictures of one material's maps, as far as they are there. The same `Arc` is the same picture.
#[derive(Clone, Copy, Debug, Default)]
pub struct MaterialImages<'a> {
    /// Colours, sRGB; alpha cuts where the material says so.
    pub diffuse: Option<&'a Arc<Image>>,
    /// Directions, linear.
    pub normal: Option<&'a Arc<Image>>,
}

/// Materials in the order of the model's, each ready to be bound as group 3.
pub(super) struct GpuMaterials {
    materials: Vec<Material>,
    uniforms: wgpu::Buffer,
    /// Distance between materials in their buffer.
    stride: u32,
    sampler: wgpu::Sampler,
    bound: Vec<BoundMaterial>,
}

struct BoundMaterial {
    group: wgpu::BindGroup,
    maps: MapFacts,
    is_cut: bool,
}

impl GpuMaterials {
    /// Without maps as yet.
    pub(super) fn upload(
        uploader: &Uploader<'_>,
        layouts: &Layouts,
        textures: &MapTextures,
        materials: &[Material],
    ) -> Result<Self, UploadError> {
        let (device, queue) = (uploader.device, uploader.queue);
        let alignment = uploader.limits.min_uniform_buffer_offset_alignment;
        let stride = (size_of::<shaders::Material>() as u32).next_multiple_of(alignment);
        let bytes = materials.len() * stride as usize;
        let uniforms = uploader.upload(
            "materials",
            wgpu::BufferUsages::UNIFORM,
            bytes,
            std::iter::repeat_n(0u8, bytes),
        )?;
        let mut gpu_materials = Self {
            materials: materials.to_vec(),
            uniforms,
            stride,
            sampler: sampler(device),
            bound: Vec::new(),
        };
        gpu_materials.set_maps(device, queue, layouts, textures, &[]);
        Ok(gpu_materials)
    }

    /// See [`Renderer::set_maps`](super::Renderer::set_maps). The textures have taken the maps up.
    pub(super) fn set_maps(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        layouts: &Layouts,
        textures: &MapTextures,
        maps: &[MaterialImages<'_>],
    ) {
        let maps = maps.iter().copied().chain(std::iter::repeat(MaterialImages::default()));
        let mut bound = Vec::with_capacity(self.materials.len());
        for (index, images) in (0..self.materials.len()).zip(maps) {
            let diffuse = textures.view(images.diffuse, MapKind::Diffuse);
            let normal = textures.view(images.normal, MapKind::Normal);
            bound.push(BoundMaterial {
                group: self.group(device, layouts, index, diffuse, normal),
                maps: MapFacts::of(images),
                is_cut: false,
            });
        }
        self.bound = bound;
        self.write(queue);
    }

    /// Takes other values for the materials, in their order; their maps stay.
    pub(super) fn set_values(&mut self, queue: &wgpu::Queue, materials: &[Material]) {
        for (material, values) in self.materials.iter_mut().zip(materials) {
            material.clone_from(values);
        }
        self.write(queue);
    }

    fn write(&mut self, queue: &wgpu::Queue) {
        let mut bytes = vec![0; self.materials.len() * self.stride as usize];
        let slots = bytes.chunks_exact_mut(self.stride as usize);
        for (((index, material), bound), slot) in self.materials.iter().enumerate().zip(&mut self.bound).zip(slots) {
            let uniform = material_uniform(index, material, bound.maps);
            slot[..size_of_val(&uniform)].copy_from_slice(bytemuck::bytes_of(&uniform));
            bound.is_cut = uniform.alpha_clip > 0.0;
        }
        queue.write_buffer(&self.uniforms, 0, &bytes);
    }

    /// Whether alpha cuts a material.
    pub(super) fn is_cut(&self, material: u32) -> bool {
        self.bound
            .get(material as usize)
            .is_some_and(|material| material.is_cut)
    }

    pub(super) fn bind(&self, pass: &mut wgpu::RenderPass<'_>, material: u32) {
        if let Some(material) = self.bound.get(material as usize) {
            pass.set_bind_group(3, &material.group, &[]);
        }
    }

    fn group(
        &self,
        device: &wgpu::Device,
        layouts: &Layouts,
        index: usize,
        diffuse: &wgpu::TextureView,
        normal: &wgpu::TextureView,
    ) -> wgpu::BindGroup {
        let uniform = wgpu::BufferBinding {
            buffer: &self.uniforms,
            offset: index as u64 * u64::from(self.stride),
            size: std::num::NonZeroU64::new(size_of::<shaders::Material>() as u64),
        };
        let resources = [
            wgpu::BindingResource::Buffer(uniform),
            wgpu::BindingResource::TextureView(diffuse),
            wgpu::BindingResource::TextureView(normal),
            wgpu::BindingResource::Sampler(&self.sampler),
        ];
        let entries = (0..).zip(resources);
        let entries: Vec<_> = entries
            .map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource })
            .collect();
        device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("material"),
            layout: &layouts.material,
            entries: &entries,
        })
    }
}

/// Repeats, trilinear. Devices without anisotropic filtering take the number as 1. Software devices do it texel by texel, at
/// many times the cost of all else in a frame, so there it is off.
fn sampler(device: &wgpu::Device) -> wgpu::Sampler {
    let is_software = device.adapter_info().device_type == wgpu::DeviceType::Cpu;
    device.create_sampler(&wgpu::SamplerDescriptor {
        label: Some("maps"),
        address_mode_u: wgpu::AddressMode::Repeat,
        address_mode_v: wgpu::AddressMode::Repeat,
        mag_filter: wgpu::FilterMode::Linear,
        min_filter: wgpu::FilterMode::Linear,
        mipmap_filter: wgpu::MipmapFilterMode::Linear,
        anisotropy_clamp: if is_software { 1 } else { ANISOTROPY },
        ..Default::default()
    })
}
