//! A material as the shader wants it.

use super::materials::MaterialImages;
use crate::image::Channels;
use crate::model::{Material, Reflectance};
use crate::{scene, shaders};

/// Specular colours of the first book are meant for a lobe that peaks at 1; a twentieth of them is the reflectance of the
/// dielectrics they stand for.
const PHONG_TO_FRESNEL: f32 = 0.05;

/// What a material's values must know of its maps.
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

/// What is drawn of a material depends on the maps that are there.
pub(super) fn material_uniform(index: usize, material: &Material, maps: MapFacts) -> shaders::Material {
    let unit = |color: [f32; 3]| color.map(|channel| channel.clamp(0.0, 1.0));
    let stand_in = scene::stand_in_color(index, material).filter(|_| !maps.has_diffuse);
    let common = shaders::Material {
        albedo: stand_in.unwrap_or(unit(material.diffuse)),
        alpha_clip: if material.alpha_clip && maps.has_alpha {
            Material::ALPHA_CLIP
        } else {
            0.0
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
        Reflectance::Phong {
            ambient,
            specular,
            spec_power,
            reflectivity,
        } => shaders::Material {
            fresnel0: std::array::from_fn(|channel| {
                let of_lobe = specular[channel].clamp(0.0, 1.0) * PHONG_TO_FRESNEL;
                // What mirrors the sky in the book mirrors the surroundings here.
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

/// Colours far apart on the wheel: each next hue is a golden angle on.
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
