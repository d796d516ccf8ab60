//! The materials of a model in GPU memory: for each the values that shaders read, and a bind group with its maps. A white texel
//! stands in for a missing map.

use super::buffers::{Queue, UploadError, Uploader, bind_group};
use super::device::is_software;
use super::maps::{MapTextures, MaterialImages};
use super::pipelines::Layouts;
use crate::image::{Channels, MapKind};
use crate::model::{AlphaMode, Material, Reflectance};
use crate::{scene, shaders};

/// Samples along the longer side of a pixel's footprint, where the device supports it: floors stay sharp far away.
const ANISOTROPY: u16 = 8;

/// The DirectX 11 book's specular colours multiply a lobe that peaks at 1. A twentieth of them is the Fresnel reflectance of the
/// dielectrics that they stand for.
const PHONG_TO_FRESNEL: f32 = 0.05;

/// The materials in the model's order, each with a bind group for group 3.
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
    /// Uploads them without maps.
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

    /// See [`Renderer::set_maps`](super::Renderer::set_maps). `textures` was updated with the same maps.
    pub(super) fn set_maps(
        &mut self,
        device: &wgpu::Device,
        queue: &Queue,
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

    /// Replaces the values of the materials, in their order; their maps stay.
    pub(super) fn set_values(&mut self, queue: &Queue, materials: &[Material]) {
        for (material, values) in self.materials.iter_mut().zip(materials) {
            material.clone_from(values);
        }
        self.write(queue);
    }

    fn write(&mut self, queue: &Queue) {
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
        bind_group(device, "material", &layouts.material, resources)
    }
}

/// Repeats, trilinear. Devices without anisotropic filtering treat the number as 1. It is off on software devices, where it would
/// cost many times as much as the rest of the frame.
fn sampler(device: &wgpu::Device) -> wgpu::Sampler {
    let is_software = is_software(&device.adapter_info());
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

/// What a material's uniform depends on in its maps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct MapFacts {
    has_diffuse: bool,
    /// Of the diffuse map.
    has_alpha: bool,
    /// Of the normal map: 4 with alpha, 3, 2 where z follows from x and y; 0 without one.
    normal_channels: u32,
}

impl MapFacts {
    pub(super) fn of(images: MaterialImages<'_>) -> Self {
        Self {
            has_diffuse: images.diffuse.is_some(),
            has_alpha: images.diffuse.is_some_and(|image| image.has_alpha()),
            normal_channels: match images.normal {
                Some(image) if image.channels() == Channels::RedGreen => 2,
                Some(image) if image.has_alpha() => 4,
                Some(_) => 3,
                None => 0,
            },
        }
    }
}

/// The uniform of the material with this index, which depends on the maps that are there.
pub(super) fn material_uniform(index: usize, material: &Material, maps: MapFacts) -> shaders::Material {
    let unit = |color: [f32; 3]| color.map(|channel| channel.clamp(0.0, 1.0));
    let stand_in = scene::stand_in_color(index, material).filter(|_| !maps.has_diffuse);
    let common = shaders::Material {
        albedo: stand_in.unwrap_or(unit(material.diffuse)),
        alpha_clip: match material.alpha {
            AlphaMode::Mask { cutoff } if maps.has_alpha => cutoff,
            _ => 0.0,
        },
        book_albedo: stand_in.map_or(unit(material.diffuse), |color| color.map(srgb_from_linear)),
        normal_channels: maps.normal_channels,
        identity_srgb: identity_color(index),
        ..Default::default()
    };
    match material.reflectance {
        Reflectance::Fresnel { fresnel0, roughness } => shaders::Material {
            fresnel0: unit(fresnel0),
            roughness: roughness.clamp(0.0, 1.0),
            ..common
        },
        Reflectance::MetallicRoughness { metallic, roughness } => shaders::Material {
            fresnel0: unit(material.diffuse).map(|channel| 0.04 + (channel - 0.04) * metallic.clamp(0.0, 1.0)),
            roughness: roughness.clamp(0.0, 1.0),
            ..common
        },
        Reflectance::Phong {
            ambient,
            specular,
            spec_power,
            reflectivity,
        } => shaders::Material {
            fresnel0: std::array::from_fn(|channel| {
                let of_lobe = specular[channel].clamp(0.0, 1.0) * PHONG_TO_FRESNEL;
                // The book's mirrored sky becomes the mirrored environment.
                of_lobe + (1.0 - of_lobe) * reflectivity[channel].clamp(0.0, 1.0)
            }),
            roughness: roughness_from_power(spec_power).clamp(0.0, 1.0),
            is_phong: 1,
            // The DirectX 11 book reads no gloss.
            normal_channels: maps.normal_channels.min(3),
            ambient: unit(ambient),
            specular: unit(specular),
            spec_power: spec_power.max(0.0),
            reflectivity: unit(reflectivity),
            ..common
        },
    }
}

fn srgb_from_linear(linear: f32) -> f32 {
    f32::from(scene::srgb8_from_linear(linear)) / 255.0
}

/// Colours far apart on the wheel: each hue is a golden angle further than the one before.
fn identity_color(index: usize) -> [f32; 4] {
    let turn = (index as f32 * 0.618_034 + 0.58).fract() * 6.0;
    let channel = |shift: f32| {
        let wheel = ((turn + shift).rem_euclid(6.0) - 3.0).abs() - 1.0;
        0.30 + 0.58 * wheel.clamp(0.0, 1.0)
    };
    [channel(0.0), channel(4.0), channel(2.0), 1.0]
}

/// Roughness whose GGX lobe is as wide as a Blinn-Phong one: alpha² = 2 / (power + 2), alpha = roughness².
fn roughness_from_power(power: f32) -> f32 {
    (2.0 / (power.max(0.0) + 2.0)).powf(0.25)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_higher_power_is_smoother() {
        assert_eq!(roughness_from_power(0.0), 1.0);
        assert!(roughness_from_power(8.0) > roughness_from_power(64.0));
        assert!(roughness_from_power(1e6) > 0.0);
    }
}
