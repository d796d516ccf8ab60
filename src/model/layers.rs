//! What glTF's extensions say of a surface beside colour, metalness and roughness.

use serde::{Deserialize, Serialize};

/// What `KHR_materials_ior`, `_specular`, `_clearcoat`, `_sheen` and `_transmission` say. The default changes nothing. Colours are
/// linear; all but `ior`, `specular_color` and `clearcoat_normal_scale` are 0…1.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Layers {
    /// Index of refraction of what is no metal, 1 or more; or 0, with which it mirrors everything.
    pub ior: f32,
    /// Scales what is mirrored where it is no metal.
    pub specular: f32,
    /// Scales what is mirrored face on where it is no metal, 0 or more.
    pub specular_color: [f32; 3],
    /// How much of the surface has a clear coat, which mirrors 4 % face on.
    pub clearcoat: f32,
    /// Of the coat: 0 smooth … 1 rough.
    pub clearcoat_roughness: f32,
    /// How far the coat's normal map bends its normals.
    pub clearcoat_normal_scale: f32,
    /// Light that fibres on the surface give back, most where it turns away from the viewer.
    pub sheen_color: [f32; 3],
    /// Of the fibres: 0 upright … 1 in all directions.
    pub sheen_roughness: f32,
    /// How much of the light that enters goes through.
    pub transmission: f32,
}

impl Default for Layers {
    fn default() -> Self {
        Self {
            ior: 1.5,
            specular: 1.0,
            specular_color: [1.0; 3],
            clearcoat: 0.0,
            clearcoat_roughness: 0.0,
            clearcoat_normal_scale: 1.0,
            sheen_color: [0.0; 3],
            sheen_roughness: 0.0,
            transmission: 0.0,
        }
    }
}

impl Layers {
    /// What a smooth boundary of this index to air mirrors face on, by Fresnel's equations: 0.04 for 1.5.
    pub fn boundary(&self) -> f32 {
        // In f64, or 1.5 would not give the nearest number to 0.04.
        let ior = f64::from(self.ior);
        ((ior - 1.0) / (ior + 1.0)).powi(2) as f32
    }

    /// Fresnel0 of what is no metal, linear: as `KHR_materials_specular` has it, with `KHR_materials_ior`.
    pub fn fresnel0(&self) -> [f32; 3] {
        self.specular_color
            .map(|channel| (self.boundary() * channel).min(1.0) * self.specular)
    }
}
