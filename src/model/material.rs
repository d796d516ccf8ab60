//! Surface parameters. Colours are linear where nothing else is said.

use glam::{Affine2, Vec2};
use serde::{Deserialize, Serialize};

use super::Layers;
use crate::modes::modes;

/// A material. Its name and its maps are not serialized: they are the file's, and cannot be edited.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Material {
    /// Name to show, unique in the model.
    #[serde(skip)]
    pub name: String,
    /// Diffuse colour as the file has it: linear in glTF's words, where it is a metal's reflectance; as it is shown, sRGB, in the books',
    /// whose light is summed without a curve. [`Material::base_color`] is linear in both.
    pub diffuse: [f32; 3],
    /// Alpha beside `diffuse`, 0…1, which the map's alpha multiplies.
    pub opacity: f32,
    /// How it reflects.
    pub reflectance: Reflectance,
    /// What glTF's extensions say of how it reflects.
    pub layers: Layers,
    /// What alpha does.
    pub alpha: AlphaMode,
    /// Drawn from both sides, as all of a `.m3d` file is, which may have holes and triangles that are turned: the normals then tell its
    /// fronts. Otherwise triangles are seen from where their corners run clockwise alone, and cast no shadow from behind.
    pub double_sided: bool,
    /// Shown in its diffuse colour without any light.
    pub unlit: bool,
    /// Light that it gives itself, linear, 0 or more; times the emissive map.
    pub emissive: [f32; 3],
    /// How far the normal map bends normals: x and y of its texels are multiplied by this.
    pub normal_scale: f32,
    /// How much of the occlusion map counts, 0…1.
    pub occlusion_strength: f32,
    /// Colours, sRGB, with alpha.
    #[serde(skip)]
    pub diffuse_map: Option<MaterialMap>,
    /// Directions, linear.
    #[serde(skip)]
    pub normal_map: Option<MaterialMap>,
    /// Roughness in green and metalness in blue, linear; multiplied by the numbers of [`Reflectance::MetallicRoughness`].
    #[serde(skip)]
    pub metallic_roughness_map: Option<MaterialMap>,
    /// How much of the surrounding light arrives, in red, linear.
    #[serde(skip)]
    pub occlusion_map: Option<MaterialMap>,
    /// Colours that `emissive` multiplies, sRGB.
    #[serde(skip)]
    pub emissive_map: Option<MaterialMap>,
    /// Of [`Layers`]: colours that `specular_color` multiplies, sRGB, and in alpha what multiplies `specular`.
    #[serde(skip)]
    pub specular_map: Option<MaterialMap>,
    /// What multiplies `clearcoat`, in red, and `clearcoat_roughness`, in green, linear.
    #[serde(skip)]
    pub clearcoat_map: Option<MaterialMap>,
    /// Directions of the clear coat, linear.
    #[serde(skip)]
    pub clearcoat_normal_map: Option<MaterialMap>,
    /// Colours that `sheen_color` multiplies, sRGB, and in alpha what multiplies `sheen_roughness`.
    #[serde(skip)]
    pub sheen_map: Option<MaterialMap>,
}

/// Grey, opaque, without maps: what is drawn where a file has no material. The grey reads as no colour of a file.
impl Default for Material {
    fn default() -> Self {
        Self {
            name: String::new(),
            // 0.8 of the light.
            diffuse: [0.906; 3],
            opacity: 1.0,
            reflectance: Reflectance::Fresnel {
                fresnel0: [0.05; 3],
                roughness: 0.6,
            },
            layers: Layers::default(),
            alpha: AlphaMode::Opaque,
            double_sided: true,
            unlit: false,
            emissive: [0.0; 3],
            normal_scale: 1.0,
            occlusion_strength: 1.0,
            diffuse_map: None,
            normal_map: None,
            metallic_roughness_map: None,
            occlusion_map: None,
            emissive_map: None,
            specular_map: None,
            clearcoat_map: None,
            clearcoat_normal_map: None,
            sheen_map: None,
        }
    }
}

impl Material {
    /// The alpha below which the books cut.
    pub const ALPHA_CLIP: f32 = 0.1;

    /// Blended with less alpha nothing is seen of a surface: half a step of eight bits.
    pub const LEAST_BLENDED_ALPHA: f32 = 0.5 / 255.0;

    /// Whether alpha cuts it.
    pub fn is_cut(&self) -> bool {
        self.cutoff().is_some()
    }

    /// The alpha below which it is cut, 0…1; `None` where it is not.
    pub fn cutoff(&self) -> Option<f32> {
        match self.alpha {
            AlphaMode::Mask { cutoff } => Some(cutoff),
            AlphaMode::Opaque | AlphaMode::Blend => None,
        }
    }

    /// What has less alpha than this is not there: it is not drawn, and looked through. 0 where alpha does nothing.
    pub fn least_alpha(&self) -> f32 {
        match self.alpha {
            AlphaMode::Opaque => 0.0,
            AlphaMode::Mask { cutoff } => cutoff,
            AlphaMode::Blend => Self::LEAST_BLENDED_ALPHA,
        }
    }

    /// The map of a slot, when it names one.
    pub fn map(&self, slot: MapSlot) -> Option<&MaterialMap> {
        let map = match slot {
            MapSlot::Diffuse => &self.diffuse_map,
            MapSlot::Normal => &self.normal_map,
            MapSlot::MetallicRoughness => &self.metallic_roughness_map,
            MapSlot::Occlusion => &self.occlusion_map,
            MapSlot::Emissive => &self.emissive_map,
            MapSlot::Specular => &self.specular_map,
            MapSlot::Clearcoat => &self.clearcoat_map,
            MapSlot::ClearcoatNormal => &self.clearcoat_normal_map,
            MapSlot::Sheen => &self.sheen_map,
        };
        map.as_ref()
    }

    /// Whether it has a map of directions, for which vertices need tangents: its own or its clear coat's.
    pub fn has_normal_map(&self) -> bool {
        self.normal_map.is_some() || self.clearcoat_normal_map.is_some()
    }

    /// The name that it gives for a map of this slot; `None` for a blank one.
    pub fn map_name(&self, slot: MapSlot) -> Option<&str> {
        self.map(slot)
            .map(|map| map.name.trim())
            .filter(|name| !name.is_empty())
    }
}

/// What alpha, the material's times its map's, does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum AlphaMode {
    /// Nothing.
    #[default]
    Opaque,
    /// What is below `cutoff` is not drawn; the rest is opaque.
    Mask {
        /// 0…1; the books have [`Material::ALPHA_CLIP`].
        cutoff: f32,
    },
    /// It is how much of the surface is seen.
    Blend,
}

impl AlphaMode {
    /// What the books' `AlphaClip` says.
    pub const fn clipped(is_clipped: bool) -> Self {
        if is_clipped {
            Self::Mask {
                cutoff: Material::ALPHA_CLIP,
            }
        } else {
            Self::Opaque
        }
    }
}

modes! {
    /// What a material uses a map for.
    #[derive(PartialOrd, Ord)]
    pub enum MapSlot {
        /// Colours, sRGB.
        Diffuse = "diffuse", "diffuse map";
        /// Directions, linear.
        Normal = "normal", "normal map";
        /// Roughness and metalness, linear.
        MetallicRoughness = "metallic-roughness", "metallic-roughness map";
        /// Occlusion, linear.
        Occlusion = "occlusion", "occlusion map";
        /// Colours, sRGB.
        Emissive = "emissive", "emissive map";
        /// Colours and a factor, sRGB with alpha.
        Specular = "specular", "specular map";
        /// A factor and roughness, linear.
        Clearcoat = "clearcoat", "clear coat map";
        /// Directions, linear.
        ClearcoatNormal = "clearcoat-normal", "clear coat normal map";
        /// Colours and roughness, sRGB with alpha.
        Sheen = "sheen", "sheen map";
    }
}

/// A map that a material names, and how it is sampled.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MaterialMap {
    /// Name as the file has it.
    pub name: String,
    /// Which texture coordinates it takes, and what becomes of them.
    pub sampling: Sampling,
}

/// A map sampled as the books do.
impl<T: Into<String>> From<T> for MaterialMap {
    fn from(name: T) -> Self {
        Self {
            name: name.into(),
            sampling: Sampling::default(),
        }
    }
}

/// How a map is sampled. By default with the first texture coordinates as they are, repeating.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sampling {
    /// Takes the mesh's second texture coordinates.
    pub second_tex_coords: bool,
    /// Texture coordinates of the mesh -> those that are looked up.
    pub map_from_mesh: Affine2,
    /// What is beyond 0…1 along u and v.
    pub wrap: [Wrap; 2],
    /// Texels have hard edges when seen near.
    pub nearest: bool,
    /// Which of red, green, blue and alpha are read; the others are 1. For maps of [`Layers`], whose values may be without a map each.
    pub channels: [bool; 4],
}

impl Default for Sampling {
    fn default() -> Self {
        Self {
            second_tex_coords: false,
            map_from_mesh: Affine2::IDENTITY,
            wrap: [Wrap::Repeat; 2],
            nearest: false,
            channels: [true; 4],
        }
    }
}

impl Sampling {
    /// What is looked up for texture coordinates of the mesh.
    pub fn tex_coords(&self, first: Vec2, second: Vec2) -> Vec2 {
        let of_mesh = if self.second_tex_coords { second } else { first };
        self.map_from_mesh.transform_point2(of_mesh)
    }
}

modes! {
    /// What a map shows beyond 0…1.
    #[derive(Default)]
    pub enum Wrap {
        /// Itself, again and again.
        #[default]
        Repeat = "repeat", "Repeat";
        /// Itself, every other time mirrored.
        Mirror = "mirror", "Mirrored repeat";
        /// Its edge.
        Clamp = "clamp", "Clamp to edge";
    }
}

/// How a material reflects.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Reflectance {
    /// DirectX 12 book.
    Fresnel {
        /// Reflectance at normal incidence, linear.
        fresnel0: [f32; 3],
        /// 0 smooth … 1 rough.
        roughness: f32,
    },
    /// DirectX 11 book.
    Phong {
        /// Ambient reflectance.
        ambient: [f32; 3],
        /// Specular reflectance.
        specular: [f32; 3],
        /// Specular exponent.
        spec_power: f32,
        /// Scale of the mirrored sky.
        reflectivity: [f32; 3],
    },
    /// glTF: what is no metal reflects 4 % at normal incidence unless [`Layers`] say otherwise, a metal its diffuse colour.
    MetallicRoughness {
        /// 0 none … 1 a metal.
        metallic: f32,
        /// 0 smooth … 1 rough.
        roughness: f32,
    },
}
