//! One way to reflect in the words of another.

use super::{Material, Reflectance};
use crate::image::srgb;

/// The DirectX 11 book's specular colours multiply a lobe that peaks at 1. A twentieth of them is the Fresnel reflectance of the
/// dielectrics that they stand for.
const PHONG_TO_FRESNEL: f32 = 0.05;

/// Above this at normal incidence a surface is taken for a metal: of all others diamonds reflect most, 0.17.
const LEAST_OF_METAL: f32 = 0.2;

/// A surface in the words of the DirectX 12 book.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FresnelSurface {
    /// Diffuse colour, linear.
    pub diffuse: [f32; 3],
    /// Reflectance at normal incidence, linear.
    pub fresnel0: [f32; 3],
    /// 0 smooth … 1 rough.
    pub roughness: f32,
}

/// A surface in the words of glTF.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MetallicSurface {
    /// Diffuse colour, or of a metal its reflectance, linear.
    pub base_color: [f32; 3],
    /// 0 none … 1 a metal.
    pub metallic: f32,
    /// 0 smooth … 1 rough.
    pub roughness: f32,
}

impl Material {
    /// The diffuse colour, linear; of a metal its reflectance.
    pub fn base_color(&self) -> [f32; 3] {
        match self.reflectance {
            Reflectance::MetallicRoughness { .. } => self.diffuse,
            Reflectance::Fresnel { .. } | Reflectance::Phong { .. } => self.diffuse.map(srgb::curve),
        }
    }

    /// The surface in the words of the DirectX 12 book. A metal by glTF 2.0, appendix B: Fresnel0 is mix(dielectric, diffuse, metallic),
    /// where the dielectric's is 0.04 or what [`Layers`](super::Layers) say, and what a metal reflects is not diffuse. Of a Phong lobe
    /// Fresnel0 is a twentieth of the specular colour, to which the mirrored sky comes, and the roughness is [`roughness_from_power`].
    pub fn fresnel_surface(&self) -> FresnelSurface {
        let diffuse = self.base_color();
        match self.reflectance {
            Reflectance::Fresnel { fresnel0, roughness } => FresnelSurface {
                diffuse,
                fresnel0,
                roughness,
            },
            Reflectance::MetallicRoughness { metallic, roughness } => FresnelSurface {
                diffuse: diffuse.map(|channel| channel * (1.0 - metallic)),
                fresnel0: std::array::from_fn(|channel| {
                    let dielectric = self.layers.fresnel0()[channel];
                    dielectric + (diffuse[channel] - dielectric) * metallic
                }),
                roughness,
            },
            Reflectance::Phong {
                specular,
                spec_power,
                reflectivity,
                ..
            } => FresnelSurface {
                diffuse,
                fresnel0: std::array::from_fn(|channel| {
                    let of_lobe = specular[channel].clamp(0.0, 1.0) * PHONG_TO_FRESNEL;
                    // The book's mirrored sky becomes the mirrored environment.
                    of_lobe + (1.0 - of_lobe) * reflectivity[channel].clamp(0.0, 1.0)
                }),
                roughness: roughness_from_power(spec_power).clamp(0.0, 1.0),
            },
        }
    }

    /// The surface in the words of glTF. What reflects as only metals do is one, in the colour that it reflects.
    pub fn metallic_surface(&self) -> MetallicSurface {
        if let Reflectance::MetallicRoughness { metallic, roughness } = self.reflectance {
            return MetallicSurface {
                base_color: self.base_color(),
                metallic,
                roughness,
            };
        }
        let surface = self.fresnel_surface();
        let reflected = surface.fresnel0.into_iter().sum::<f32>() / 3.0;
        let (base_color, metallic) = if reflected > LEAST_OF_METAL {
            (surface.fresnel0, 1.0)
        } else {
            (surface.diffuse, 0.0)
        };
        MetallicSurface {
            base_color,
            metallic,
            roughness: surface.roughness,
        }
    }
}

/// Roughness whose GGX lobe is as wide as a Blinn-Phong one (Walter and others 2007): alpha² = 2 / (power + 2), alpha = roughness².
pub fn roughness_from_power(power: f32) -> f32 {
    (2.0 / (power.max(0.0) + 2.0)).powf(0.25)
}
