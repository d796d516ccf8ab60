//! One way to reflect in the words of another.

use super::{Material, Reflectance};

/// The DirectX 11 book's specular colours multiply a lobe that peaks at 1. A twentieth of them is the Fresnel reflectance of the
/// dielectrics that they stand for.
const PHONG_TO_FRESNEL: f32 = 0.05;

/// What all that is no metal reflects at normal incidence: glTF 2.0, appendix B.
const DIELECTRIC: f32 = 0.04;

/// Above this at normal incidence a surface is taken for a metal: of all others diamonds reflect most, 0.17.
const LEAST_OF_METAL: f32 = 0.2;

/// A greater exponent is not written: the lobe is smaller than a pixel.
const MOST_SPEC_POWER: f32 = 4096.0;

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

/// A surface in the words of the DirectX 11 book.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PhongSurface {
    /// Diffuse colour, linear.
    pub diffuse: [f32; 3],
    /// Ambient reflectance.
    pub ambient: [f32; 3],
    /// Specular reflectance.
    pub specular: [f32; 3],
    /// Specular exponent.
    pub spec_power: f32,
    /// Scale of the mirrored sky.
    pub reflectivity: [f32; 3],
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
    /// The surface in the words of the DirectX 12 book. A metal by glTF 2.0, appendix B: Fresnel0 is mix(0.04, diffuse, metallic), and
    /// what it reflects so is not diffuse. Of a Phong lobe Fresnel0 is a twentieth of the specular colour, to which the mirrored sky
    /// comes, and the roughness is [`roughness_from_power`].
    pub fn fresnel_surface(&self) -> FresnelSurface {
        let diffuse = self.diffuse;
        match self.reflectance {
            Reflectance::Fresnel { fresnel0, roughness } => FresnelSurface {
                diffuse,
                fresnel0,
                roughness,
            },
            Reflectance::MetallicRoughness { metallic, roughness } => FresnelSurface {
                diffuse: diffuse.map(|channel| channel * (1.0 - metallic)),
                fresnel0: diffuse.map(|channel| DIELECTRIC + (channel - DIELECTRIC) * metallic),
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

    /// The surface in the words of the DirectX 11 book: the inverse of [`Material::fresnel_surface`]. Ambient light meets the diffuse
    /// colour, as in the DirectX 12 book.
    pub fn phong_surface(&self) -> PhongSurface {
        if let Reflectance::Phong {
            ambient,
            specular,
            spec_power,
            reflectivity,
        } = self.reflectance
        {
            return PhongSurface {
                diffuse: self.diffuse,
                ambient,
                specular,
                spec_power,
                reflectivity,
            };
        }
        let FresnelSurface {
            diffuse,
            fresnel0,
            roughness,
        } = self.fresnel_surface();
        let of_lobe = fresnel0.map(|channel| channel.clamp(0.0, PHONG_TO_FRESNEL));
        PhongSurface {
            diffuse,
            ambient: diffuse,
            specular: of_lobe.map(|channel| channel / PHONG_TO_FRESNEL),
            spec_power: power_from_roughness(roughness),
            reflectivity: std::array::from_fn(|channel| {
                ((fresnel0[channel] - of_lobe[channel]) / (1.0 - of_lobe[channel])).clamp(0.0, 1.0)
            }),
        }
    }

    /// The surface in the words of glTF. What reflects as only metals do is one, in the colour that it reflects.
    pub fn metallic_surface(&self) -> MetallicSurface {
        if let Reflectance::MetallicRoughness { metallic, roughness } = self.reflectance {
            return MetallicSurface {
                base_color: self.diffuse,
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

/// The inverse of [`roughness_from_power`], to at most 4096.
fn power_from_roughness(roughness: f32) -> f32 {
    (2.0 / roughness.clamp(0.0, 1.0).powi(4) - 2.0).min(MOST_SPEC_POWER)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_higher_power_is_smoother_and_comes_back() {
        assert_eq!(roughness_from_power(0.0), 1.0);
        assert!(roughness_from_power(8.0) > roughness_from_power(64.0));
        assert!(roughness_from_power(1e6) > 0.0);
        for power in [0.0, 8.0, 64.0, 1000.0] {
            let back = power_from_roughness(roughness_from_power(power));
            assert!((back - power).abs() <= 1e-3 * (power + 1.0), "{power} became {back}");
        }
        assert_eq!(power_from_roughness(0.0), MOST_SPEC_POWER);
    }

    #[test]
    fn fresnel_becomes_phong_and_comes_back() {
        let material = Material {
            diffuse: [0.8, 0.5, 0.1],
            reflectance: Reflectance::Fresnel {
                fresnel0: [0.02, 0.05, 0.6],
                roughness: 0.4,
            },
            ..Material::default()
        };
        let PhongSurface {
            diffuse,
            ambient,
            specular,
            spec_power,
            reflectivity,
        } = material.phong_surface();
        let back = Material {
            diffuse,
            reflectance: Reflectance::Phong {
                ambient,
                specular,
                spec_power,
                reflectivity,
            },
            ..Material::default()
        }
        .fresnel_surface();
        let wanted = material.fresnel_surface();
        assert_eq!(back.diffuse, wanted.diffuse);
        for (back, wanted) in back.fresnel0.iter().zip(wanted.fresnel0) {
            assert!((back - wanted).abs() < 1e-6);
        }
        assert!((back.roughness - wanted.roughness).abs() < 1e-5);
    }

    #[test]
    fn gold_is_a_metal_in_each_of_the_words() {
        let gold = [1.0, 0.77, 0.34];
        let material = Material {
            diffuse: gold,
            reflectance: Reflectance::MetallicRoughness {
                metallic: 1.0,
                roughness: 0.3,
            },
            ..Material::default()
        };
        let surface = material.fresnel_surface();
        assert_eq!((surface.diffuse, surface.fresnel0), ([0.0; 3], gold));
        let of_book = Material {
            diffuse: surface.diffuse,
            reflectance: Reflectance::Fresnel {
                fresnel0: surface.fresnel0,
                roughness: surface.roughness,
            },
            ..Material::default()
        };
        assert_eq!(of_book.metallic_surface(), material.metallic_surface());
    }
}
