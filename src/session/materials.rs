//! Materials that are edited while one looks on.

use super::Session;
use crate::model::{Material, Reflectance};

/// The greatest specular exponent that can be asked for: a highlight a few pixels wide.
pub const MAX_SPEC_POWER: f32 = 1024.0;

/// The materials of the open model as they are drawn.
#[derive(Clone, Debug, Default)]
pub(super) struct Materials {
    drawn: Vec<Material>,
    revision: u64,
}

impl Materials {
    pub(super) fn get(&self, index: usize) -> Option<&Material> {
        self.drawn.get(index)
    }

    pub(super) fn revision(&self) -> u64 {
        self.revision
    }

    /// Takes up another model's, as the file has them.
    pub(super) fn take_up(&mut self, of_file: &[Material]) {
        self.drawn = of_file.to_vec();
        self.revision += 1;
    }

    /// Takes up those of the same file read again. What was edited, beside `before`, stays so, by its name.
    pub(super) fn take_up_again(&mut self, of_file: &[Material], before: &[Material]) {
        let old = std::mem::take(&mut self.drawn);
        self.take_up(of_file);
        let edited = old.into_iter().zip(before).filter(|(drawn, before)| drawn != *before);
        for (edited, _) in edited {
            if let Some(drawn) = self.drawn.iter_mut().find(|drawn| drawn.name == edited.name) {
                *drawn = with_values(drawn, &edited);
            }
        }
    }

    pub(super) fn edit(&mut self, index: usize, wanted: &Material) {
        if let Some(drawn) = self.drawn.get_mut(index) {
            let edited = with_values(drawn, wanted);
            if edited != *drawn {
                *drawn = edited;
                self.revision += 1;
            }
        }
    }

    pub(super) fn reset(&mut self, index: usize, of_file: &[Material]) {
        if let (Some(drawn), Some(of_file)) = (self.drawn.get_mut(index), of_file.get(index))
            && drawn != of_file
        {
            drawn.clone_from(of_file);
            self.revision += 1;
        }
    }
}

impl Session {
    /// The materials of the model on screen as they are drawn: the file's, but for what was edited.
    pub fn materials(&self) -> &[Material] {
        &self.materials.drawn
    }

    /// Whether a material is another one than the file's.
    pub fn is_edited(&self, material: usize) -> bool {
        let of_file = self.open.as_ref().and_then(|open| open.model.materials.get(material));
        self.materials.get(material) != of_file
    }

    /// Counts changes of the materials, those by another model included.
    pub fn materials_revision(&self) -> u64 {
        self.materials.revision()
    }

    pub(super) fn reset_material(&mut self, material: usize) {
        if let Some(open) = &self.open {
            self.materials.reset(material, &open.model.materials);
        }
    }
}

/// A material with the values of another. Names, names of maps and the book stay. A number that is none leaves the one
/// that was; one that is new comes into its range, and one that the file has out of it may stay.
fn with_values(material: &Material, wanted: &Material) -> Material {
    Material {
        diffuse: color(material.diffuse, wanted.diffuse),
        reflectance: match (material.reflectance, wanted.reflectance) {
            (
                Reflectance::Fresnel { fresnel0, roughness },
                Reflectance::Fresnel {
                    fresnel0: wanted_fresnel0,
                    roughness: wanted_roughness,
                },
            ) => Reflectance::Fresnel {
                fresnel0: color(fresnel0, wanted_fresnel0),
                roughness: number(roughness, wanted_roughness, 1.0),
            },
            (
                Reflectance::Phong {
                    ambient,
                    specular,
                    spec_power,
                    reflectivity,
                },
                Reflectance::Phong {
                    ambient: wanted_ambient,
                    specular: wanted_specular,
                    spec_power: wanted_spec_power,
                    reflectivity: wanted_reflectivity,
                },
            ) => Reflectance::Phong {
                ambient: color(ambient, wanted_ambient),
                specular: color(specular, wanted_specular),
                spec_power: number(spec_power, wanted_spec_power, MAX_SPEC_POWER),
                reflectivity: color(reflectivity, wanted_reflectivity),
            },
            (of_one_book, _of_the_other) => of_one_book,
        },
        alpha_clip: wanted.alpha_clip,
        ..material.clone()
    }
}

fn color(current: [f32; 3], wanted: [f32; 3]) -> [f32; 3] {
    std::array::from_fn(|channel| number(current[channel], wanted[channel], 1.0))
}

fn number(current: f32, wanted: f32, greatest: f32) -> f32 {
    if wanted == current || !wanted.is_finite() {
        current
    } else {
        wanted.clamp(0.0, greatest)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn phong(ambient: f32, spec_power: f32) -> Material {
        Material {
            name: "coat".to_owned(),
            diffuse: [0.5; 3],
            reflectance: Reflectance::Phong {
                ambient: [ambient; 3],
                specular: [0.2; 3],
                spec_power,
                reflectivity: [0.0; 3],
            },
            alpha_clip: false,
            diffuse_map: Some("coat.dds".to_owned()),
            normal_map: None,
        }
    }

    #[test]
    fn values_come_over_in_their_range_and_names_and_the_book_stay() {
        let wanted = Material {
            name: "other".to_owned(),
            diffuse: [f32::NAN, -3.0, 7.0],
            alpha_clip: true,
            diffuse_map: None,
            ..phong(0.25, 1e9)
        };
        let expected = Material {
            diffuse: [0.5, 0.0, 1.0],
            alpha_clip: true,
            ..phong(0.25, MAX_SPEC_POWER)
        };
        assert_eq!(with_values(&phong(0.1, 16.0), &wanted), expected);

        let of_the_other_book = Material {
            reflectance: Reflectance::Fresnel {
                fresnel0: [0.1; 3],
                roughness: 0.1,
            },
            ..phong(0.1, 16.0)
        };
        assert_eq!(with_values(&phong(0.1, 16.0), &of_the_other_book), phong(0.1, 16.0));
    }

    #[test]
    fn a_number_that_the_file_has_out_of_its_range_stays_while_another_is_edited() {
        let wanted = phong(3.0, 32.0);
        assert_eq!(with_values(&phong(3.0, 16.0), &wanted), wanted);
        assert_eq!(with_values(&phong(3.0, 16.0), &phong(2.9, 16.0)), phong(1.0, 16.0));
    }
}
