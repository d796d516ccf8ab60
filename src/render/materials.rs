//! The materials of a model in GPU memory: for each the values that shaders read, and a bind group with its maps. A white texel
//! stands in for a missing map.

use std::collections::HashMap;
use std::sync::Arc;

use super::buffers::{Queue, UploadError, Uploader, bind_group};
use super::device::is_software;
use super::maps::{MapTextures, MaterialImages};
use super::pipelines::Layouts;
use super::recipe::{Alpha, Kind, Maps};
use crate::image::{Channels, Image};
use crate::model::{AlphaMode, Layers, MapSlot, Material, Reflectance, Sampling, Wrap};
use crate::shaders::MapPlace;
use crate::{scene, shaders};

/// Samples along the longer side of a pixel's footprint, where the device supports it: floors stay sharp far away.
const ANISOTROPY: u16 = 8;

/// What is blended with less alpha than this casts no shadow, and does not stand in the way of ambient light.
const LEAST_SOLID_ALPHA: f32 = 0.5;

/// How much less is seen of what a surface scatters that lets all light through. Something stays, since blending does not tint what is
/// behind it.
const LEAST_SEEN: f32 = 0.8;

/// The materials in the model's order, each with a bind group for group 3.
pub(super) struct GpuMaterials {
    materials: Vec<Material>,
    /// Whether vertices have colours, with alpha.
    has_colors: bool,
    /// Two slots for each material: its values, and what it says about all maps.
    uniforms: wgpu::Buffer,
    stride: u32,
    samplers: HashMap<SamplerKey, wgpu::Sampler>,
    /// For each material the maps that it has.
    maps: Vec<BoundMaps>,
    bound: Vec<BoundMaterial>,
}

struct BoundMaps {
    views: [wgpu::TextureView; MapSlot::ALL.len()],
    facts: MapFacts,
}

struct BoundMaterial {
    group: wgpu::BindGroup,
    kind: Kind,
}

/// Along u and v; whether texels have hard edges.
type SamplerKey = ([Wrap; 2], bool);

impl GpuMaterials {
    /// Uploads them without maps. `has_colors`: the mesh has colours of vertices.
    pub(super) fn upload(
        uploader: &Uploader<'_>,
        layouts: &Layouts,
        textures: &MapTextures,
        materials: &[Material],
        has_colors: bool,
    ) -> Result<Self, UploadError> {
        let (device, queue) = (uploader.device, uploader.queue);
        let alignment = uploader.limits.min_uniform_buffer_offset_alignment;
        let slot = size_of::<shaders::Material>().max(size_of::<shaders::MaterialMaps>());
        let stride = (slot as u32).next_multiple_of(alignment);
        let bytes = 2 * materials.len() * stride as usize;
        let uniforms = uploader.upload(
            "materials",
            wgpu::BufferUsages::UNIFORM,
            bytes,
            std::iter::repeat_n(0u8, bytes),
        )?;
        let mut gpu_materials = Self {
            materials: materials.to_vec(),
            has_colors,
            uniforms,
            stride,
            samplers: HashMap::new(),
            maps: Vec::new(),
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
        let of_materials = maps.take(self.materials.len());
        self.maps = of_materials
            .map(|images| BoundMaps {
                views: MapSlot::ALL.map(|slot| textures.view(images[slot as usize], slot).clone()),
                facts: MapFacts::of(images),
            })
            .collect();
        self.bind_all(device, queue, layouts);
    }

    /// Replaces the values of the materials, in their order; their maps stay.
    pub(super) fn set_values(
        &mut self,
        device: &wgpu::Device,
        queue: &Queue,
        layouts: &Layouts,
        materials: &[Material],
    ) {
        for (material, values) in self.materials.iter_mut().zip(materials) {
            material.clone_from(values);
        }
        self.bind_all(device, queue, layouts);
    }

    /// Writes the values of all, and binds them with their maps.
    fn bind_all(&mut self, device: &wgpu::Device, queue: &Queue, layouts: &Layouts) {
        let mut bytes = vec![0; 2 * self.materials.len() * self.stride as usize];
        let mut slots = bytes.chunks_exact_mut(self.stride as usize);
        let mut write = |uniform: &[u8]| {
            if let Some(slot) = slots.next() {
                slot[..uniform.len()].copy_from_slice(uniform);
            }
        };
        self.bound.clear();
        for (index, (material, maps)) in self.materials.iter().zip(&self.maps).enumerate() {
            let uniform = material_uniform(index, material, maps.facts, self.has_colors);
            let kind = Kind {
                alpha: alpha(material, &uniform, maps.facts, self.has_colors),
                maps: maps_of(material, self.has_colors),
                double_sided: material.double_sided,
            };
            let maps_uniform = maps_uniform(material, &uniform, maps.facts, kind.alpha);
            write(bytemuck::bytes_of(&uniform));
            write(bytemuck::bytes_of(&maps_uniform));
            for slot in MapSlot::ALL {
                let key = sampler_key(material, slot);
                self.samplers.entry(key).or_insert_with(|| sampler(device, key));
            }
            self.bound.push(BoundMaterial {
                group: self.group(device, layouts, index, kind.maps),
                kind,
            });
        }
        queue.write_buffer(&self.uniforms, 0, &bytes);
    }

    pub(super) fn kind(&self, material: u32) -> Kind {
        let bound = self.bound.get(material as usize);
        bound.map(|material| material.kind).unwrap_or_default()
    }

    pub(super) fn read_all_maps(&self) -> bool {
        self.bound.iter().any(|material| material.kind.maps == Maps::All)
    }

    pub(super) fn bind(&self, pass: &mut wgpu::RenderPass<'_>, material: u32) {
        if let Some(material) = self.bound.get(material as usize) {
            pass.set_bind_group(3, &material.group, &[]);
        }
    }

    fn group(&self, device: &wgpu::Device, layouts: &Layouts, index: usize, maps: Maps) -> wgpu::BindGroup {
        use wgpu::BindingResource::{Buffer, Sampler, TextureView};
        let uniform = |slot: usize, size: usize| {
            Buffer(wgpu::BufferBinding {
                buffer: &self.uniforms,
                offset: (2 * index + slot) as u64 * u64::from(self.stride),
                size: std::num::NonZeroU64::new(size as u64),
            })
        };
        let (material, views) = (&self.materials[index], &self.maps[index].views);
        let sampler = |slot| Sampler(&self.samplers[&sampler_key(material, slot)]);
        let values = uniform(0, size_of::<shaders::Material>());
        match maps {
            Maps::Two => {
                let [diffuse, normal] = [MapSlot::Diffuse, MapSlot::Normal].map(|slot| &views[slot as usize]);
                let resources = [
                    values,
                    TextureView(diffuse),
                    TextureView(normal),
                    sampler(MapSlot::Diffuse),
                ];
                bind_group(device, "material", &layouts.material, resources)
            }
            Maps::All => {
                let mut resources = vec![values, uniform(1, size_of::<shaders::MaterialMaps>())];
                for slot in MapSlot::ALL {
                    resources.extend([TextureView(&views[slot as usize]), sampler(slot)]);
                }
                bind_group(device, "material with all maps", &layouts.material_all, resources)
            }
        }
    }
}

fn sampler_key(material: &Material, slot: MapSlot) -> SamplerKey {
    let sampling = material.map(slot).map(|map| map.sampling).unwrap_or_default();
    (sampling.wrap, sampling.nearest)
}

/// Trilinear. Devices without anisotropic filtering treat the number as 1. It is off on software devices, where it would cost many
/// times as much as the rest of the frame.
fn sampler(device: &wgpu::Device, (wrap, nearest): SamplerKey) -> wgpu::Sampler {
    let is_software = is_software(&device.adapter_info());
    let [address_mode_u, address_mode_v] = wrap.map(|wrap| match wrap {
        Wrap::Repeat => wgpu::AddressMode::Repeat,
        Wrap::Mirror => wgpu::AddressMode::MirrorRepeat,
        Wrap::Clamp => wgpu::AddressMode::ClampToEdge,
    });
    device.create_sampler(&wgpu::SamplerDescriptor {
        label: Some("maps"),
        address_mode_u,
        address_mode_v,
        mag_filter: if nearest {
            wgpu::FilterMode::Nearest
        } else {
            wgpu::FilterMode::Linear
        },
        min_filter: wgpu::FilterMode::Linear,
        mipmap_filter: wgpu::MipmapFilterMode::Linear,
        // Only linear filters may be anisotropic.
        anisotropy_clamp: if is_software || nearest { 1 } else { ANISOTROPY },
        ..Default::default()
    })
}

/// What a material's uniforms depend on in its maps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct MapFacts {
    /// A bit for each map, in the order of [`MapSlot::ALL`].
    present: u32,
    has_alpha: bool,
    normal: NormalFacts,
    coat_normal: NormalFacts,
}

/// Of a normal map.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct NormalFacts {
    /// 4 with alpha, 3, 2 where z follows from x and y; 0 without one.
    channels: u32,
    /// Whether its smaller levels are means, not of unit length.
    has_lengths: bool,
}

impl NormalFacts {
    fn of(image: Option<&Arc<Image>>) -> Self {
        Self {
            channels: match image {
                Some(image) if image.channels() == Channels::RedGreen => 2,
                Some(image) if image.has_alpha() => 4,
                Some(_) => 3,
                None => 0,
            },
            has_lengths: image.is_some_and(|image| image.mips_generated()),
        }
    }
}

impl MapFacts {
    fn of(images: MaterialImages<'_>) -> Self {
        let present = |slot: MapSlot| u32::from(images[slot as usize].is_some()) << slot as u32;
        Self {
            present: MapSlot::ALL.into_iter().map(present).sum(),
            has_alpha: images[MapSlot::Diffuse as usize].is_some_and(|image| image.has_alpha()),
            normal: NormalFacts::of(images[MapSlot::Normal as usize]),
            coat_normal: NormalFacts::of(images[MapSlot::ClearcoatNormal as usize]),
        }
    }
}

/// Which maps a material reads. Those of a .m3d file say nothing that two maps, sampled as the books do, do not show.
fn maps_of(material: &Material, has_colors: bool) -> Maps {
    let is_sampled_otherwise = |slot| {
        let map = material.map(slot);
        map.is_some_and(|map| map.sampling != Sampling::default())
    };
    let says_more = has_colors
        || matches!(material.reflectance, Reflectance::MetallicRoughness { .. })
        || material.alpha == AlphaMode::Blend
        || material.opacity != 1.0
        || material.unlit
        || material.emissive != [0.0; 3]
        || material.normal_scale != 1.0
        || material.layers != Layers::default()
        || MapSlot::ALL.into_iter().any(|slot| match slot {
            MapSlot::Diffuse | MapSlot::Normal => is_sampled_otherwise(slot),
            _ => material.map(slot).is_some(),
        });
    if says_more { Maps::All } else { Maps::Two }
}

/// The fraction of what a material scatters that is seen: less than 1 where light goes through. What alpha cuts stays opaque.
fn solid(material: &Material) -> f32 {
    if material.unlit || material.is_cut() {
        return 1.0;
    }
    1.0 - LEAST_SEEN * material.layers.transmission.clamp(0.0, 1.0)
}

/// What alpha does to a material whose uniform this is.
fn alpha(material: &Material, uniform: &shaders::Material, maps: MapFacts, has_colors: bool) -> Alpha {
    match material.alpha {
        AlphaMode::Mask { .. } if uniform.alpha_clip > 0.0 => Alpha::Cut,
        AlphaMode::Blend if maps.has_alpha || has_colors => Alpha::BlendedByTexel,
        AlphaMode::Blend if material.opacity < 1.0 => Alpha::Blended,
        AlphaMode::Blend | AlphaMode::Opaque if solid(material) < 1.0 => Alpha::Blended,
        AlphaMode::Opaque | AlphaMode::Mask { .. } | AlphaMode::Blend => Alpha::Whole,
    }
}

/// The uniform of the material with this index, which depends on the maps that are there.
fn material_uniform(index: usize, material: &Material, maps: MapFacts, has_colors: bool) -> shaders::Material {
    let unit = |color: [f32; 3]| color.map(|channel| channel.clamp(0.0, 1.0));
    let surface = material.fresnel_surface();
    let has_diffuse = maps.present & 1 << MapSlot::Diffuse as u32 != 0;
    let stand_in = scene::stand_in_color(index, material).filter(|_| !has_diffuse);
    let varies = maps.has_alpha || has_colors;
    let least_alpha = material.least_alpha();
    let common = shaders::Material {
        albedo: stand_in.unwrap_or(unit(material.base_color())),
        alpha_clip: if varies || material.opacity < least_alpha {
            least_alpha
        } else {
            0.0
        },
        book_albedo: stand_in.map_or(unit(material.diffuse), |color| color.map(srgb_from_linear)),
        normal_channels: maps.normal.channels,
        normal_lengths: u32::from(maps.normal.has_lengths),
        identity_srgb: identity_color(index),
        // Of any two materials the steps are incommensurable, so that their noise is independent.
        threshold_step: (index as f32 * 0.618_034 + 0.754_877_7).fract(),
        roughness: surface.roughness.clamp(0.0, 1.0),
        ..Default::default()
    };
    match material.reflectance {
        Reflectance::Fresnel { .. } => shaders::Material {
            fresnel0: unit(surface.fresnel0),
            ..common
        },
        // Shaders take Fresnel0 from the diffuse colour and the metalness of each point. Alpha of the normal map is no gloss.
        Reflectance::MetallicRoughness { .. } => shaders::Material {
            normal_channels: maps.normal.channels.min(3),
            ..common
        },
        Reflectance::Phong {
            ambient,
            specular,
            spec_power,
            reflectivity,
        } => shaders::Material {
            fresnel0: unit(surface.fresnel0),
            is_phong: 1,
            // The DirectX 11 book reads no gloss.
            normal_channels: maps.normal.channels.min(3),
            ambient: unit(ambient),
            specular: unit(specular),
            spec_power: spec_power.max(0.0),
            reflectivity: unit(reflectivity),
            ..common
        },
    }
}

/// What a material says about all maps, beside its uniform.
fn maps_uniform(
    material: &Material,
    uniform: &shaders::Material,
    maps: MapFacts,
    alpha: Alpha,
) -> shaders::MaterialMaps {
    let (layers, solid) = (&material.layers, solid(material));
    // Nothing but glass is blended that is opaque by its mode.
    let is_opaque = solid < 1.0 && material.alpha == AlphaMode::Opaque;
    shaders::MaterialMaps {
        places: MapSlot::ALL.map(|slot| {
            let sampling = material.map(slot).map(|map| map.sampling).unwrap_or_default();
            map_place(&sampling)
        }),
        emissive: material.emissive.map(|channel| channel.max(0.0)),
        opacity: if is_opaque {
            solid
        } else {
            solid * material.opacity.clamp(0.0, 1.0)
        },
        metallic: match material.reflectance {
            Reflectance::MetallicRoughness { metallic, .. } => metallic.clamp(0.0, 1.0),
            Reflectance::Fresnel { .. } | Reflectance::Phong { .. } => 0.0,
        },
        normal_scale: material.normal_scale,
        occlusion_strength: material.occlusion_strength.clamp(0.0, 1.0),
        least_solid_alpha: if alpha.is_blended() {
            LEAST_SOLID_ALPHA
        } else {
            uniform.alpha_clip
        },
        present: maps.present,
        has_map_alpha: u32::from(maps.has_alpha && !is_opaque),
        is_metallic_roughness: u32::from(matches!(material.reflectance, Reflectance::MetallicRoughness { .. })),
        is_unlit: u32::from(material.unlit),
        dielectric_fresnel0: layers.specular_color.map(|channel| layers.boundary() * channel),
        specular: layers.specular.clamp(0.0, 1.0),
        sheen: layers.sheen_color.map(|channel| channel.clamp(0.0, 1.0)),
        sheen_roughness: layers.sheen_roughness.clamp(0.0, 1.0),
        coat: layers.clearcoat.clamp(0.0, 1.0),
        coat_roughness: layers.clearcoat_roughness.clamp(0.0, 1.0),
        boundary_fresnel0: layers.boundary(),
        solid,
        coat_normal_scale: layers.clearcoat_normal_scale,
        coat_normal_channels: maps.coat_normal.channels.min(3),
        coat_normal_lengths: u32::from(maps.coat_normal.has_lengths),
        unused: 0,
    }
}

fn map_place(sampling: &Sampling) -> MapPlace {
    let (matrix, moved) = (sampling.map_from_mesh.matrix2, sampling.map_from_mesh.translation);
    let second = if sampling.second_tex_coords { 1.0 } else { 0.0 };
    let channels = (0..).zip(sampling.channels);
    let channels: u32 = channels.map(|(bit, is_read)| u32::from(is_read) << bit).sum();
    MapPlace {
        u: [matrix.x_axis.x, matrix.y_axis.x, moved.x, second],
        v: [matrix.x_axis.y, matrix.y_axis.y, moved.y, channels as f32],
    }
}

fn srgb_from_linear(linear: f32) -> f32 {
    f32::from(scene::srgb8_from_linear(linear)) / 255.0
}

/// Colours far apart on the wheel: each hue is a golden angle further than the one before.
fn identity_color(index: usize) -> [f32; 3] {
    let turn = (index as f32 * 0.618_034 + 0.58).fract() * 6.0;
    let channel = |shift: f32| {
        let wheel = ((turn + shift).rem_euclid(6.0) - 3.0).abs() - 1.0;
        0.30 + 0.58 * wheel.clamp(0.0, 1.0)
    };
    [channel(0.0), channel(4.0), channel(2.0)]
}
