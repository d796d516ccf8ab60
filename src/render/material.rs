//! A material as the shader wants it.

use super::materials::MaterialImages;
use crate::image::Channels;
use crate::model::{Material, Reflectance};
use crate::{scene, shaders};

/// Specular colours of the first book are meant for a lobe that peaks at 1; a twentieth of them is the reflectance of the
/// dielectrics they stand for.
const PHONG_TO_FRESNEL: f32 = 0.05;

/// The share of alpha below which the books cut.
const ALPHA_CLIP: f32 = 0.1;

/// What is drawn of a material depends on the maps that are there.
pub(super) fn material_uniform(index: usize, material: &Material, images: MaterialImages<'_>) -> shaders::Material {
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
        albedo: match images.diffuse {
            Some(_) => material.diffuse.map(|channel| channel.clamp(0.0, 1.0)),
            None => scene::display_color(index, material),
        },
        roughness: roughness.clamp(0.0, 1.0),
        fresnel0: fresnel0.map(|channel| channel.clamp(0.0, 1.0)),
        alpha_clip: match images.diffuse {
            Some(image) if material.alpha_clip && image.has_alpha() => ALPHA_CLIP,
            _ => 0.0,
        },
        normal_channels: match images.normal {
            Some(image) if image.channels() == Channels::RedGreen => 2,
            Some(_) => 3,
            None => 0,
        },
        unused: [0; 3],
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
