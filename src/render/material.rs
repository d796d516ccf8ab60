//! A material as the shader wants it.

use crate::model::{Material, Reflectance};
use crate::{scene, shaders};

/// Specular colours of the first book are meant for a lobe that peaks at 1; a twentieth of them is the reflectance of the
/// dielectrics they stand for.
const PHONG_TO_FRESNEL: f32 = 0.05;

pub(super) fn material_uniform(index: usize, material: &Material) -> shaders::Material {
    let (fresnel0, roughness) = match material.reflectance {
        Reflectance::Fresnel { fresnel0, roughness } => (fresnel0, roughness),
        Reflectance::Phong {
            specular, spec_power, ..
        } => (
            specular.map(|channel| channel * PHONG_TO_FRESNEL),
            roughness_from_power(spec_power),
        ),
    };
    shaders::Material {
        albedo: scene::display_color(index, material),
        roughness: roughness.clamp(0.0, 1.0),
        fresnel0: fresnel0.map(|channel| channel.clamp(0.0, 1.0)),
        unused: 0.0,
    }
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
