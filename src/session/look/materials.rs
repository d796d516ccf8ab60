//! Materials as they are drawn: those of the file, with the values that were edited.

use std::sync::Arc;

use crate::model::{AlphaMode, Layers, Material, Reflectance};

/// The greatest specular exponent that can be asked for: a highlight a few pixels wide.
pub const MAX_SPEC_POWER: f32 = 1024.0;

/// A command about a material, by its index. An index without a material is ignored.
#[derive(Clone, Debug, PartialEq)]
pub enum MaterialCommand {
    /// Draws a material with the values of another. Its names, the names of its maps and its book stay; numbers are brought
    /// into their range.
    Edit {
        /// Which of the model's.
        index: usize,
        material: Box<Material>,
    },
    /// Draws a material as the file has it.
    Reset(usize),
    /// Draws all materials from both sides, or each from those that the file says.
    DrawBothSides(bool),
}

/// The materials of the open model as they are drawn. A copy of them is cheap.
#[derive(Clone, Debug, Default)]
pub(in crate::session) struct Materials {
    drawn: Arc<[Material]>,
}

impl Materials {
    pub(in crate::session) fn drawn(&self) -> &[Material] {
        &self.drawn
    }

    /// Whether these are those of a copy, without a change of either since.
    pub(in crate::session) fn are_shared_with(&self, copy: &Self) -> bool {
        Arc::ptr_eq(&self.drawn, &copy.drawn)
    }

    pub(in crate::session) fn get(&self, index: usize) -> Option<&Material> {
        self.drawn.get(index)
    }

    /// A model's, as its file has them.
    pub(in crate::session) fn of_file(of_file: &[Material]) -> Self {
        Self { drawn: of_file.into() }
    }

    /// Those of a file that was read again. Materials that were edited, unlike those of the `file_before`, stay edited, by their
    /// names.
    pub(in crate::session) fn of_file_again(of_file: &[Material], before: &Self, file_before: &[Material]) -> Self {
        let mut materials = Self::of_file(of_file);
        let drawn_before = before.drawn.iter().zip(file_before);
        for (edited, _) in drawn_before.filter(|(drawn, of_file)| drawn != of_file) {
            let mut all = Arc::make_mut(&mut materials.drawn).iter_mut();
            if let Some(drawn) = all.find(|drawn| drawn.name == edited.name) {
                *drawn = with_values(drawn, edited);
            }
        }
        materials
    }

    /// Applies a command; `of_file` are the materials of the file. Returns whether a material changed.
    pub(in crate::session) fn apply(&mut self, command: MaterialCommand, of_file: &[Material]) -> bool {
        let (index, material) = match command {
            MaterialCommand::Edit { index, material } => {
                (index, self.get(index).map(|drawn| with_values(drawn, &material)))
            }
            MaterialCommand::Reset(index) => (index, of_file.get(index).cloned()),
            MaterialCommand::DrawBothSides(both) => return self.draw_both_sides(both, of_file),
        };
        material.is_some_and(|material| self.replace(index, material))
    }

    fn draw_both_sides(&mut self, both: bool, of_file: &[Material]) -> bool {
        let mut changed = false;
        for (index, material) in of_file.iter().enumerate() {
            let double_sided = both || material.double_sided;
            let drawn = self.get(index).cloned();
            changed |= drawn.is_some_and(|drawn| self.replace(index, Material { double_sided, ..drawn }));
        }
        changed
    }

    /// Draws a material with all of another. Returns whether that changed it.
    pub(in crate::session) fn replace(&mut self, index: usize, material: Material) -> bool {
        let changes = self.get(index).is_some_and(|drawn| *drawn != material);
        if changes {
            Arc::make_mut(&mut self.drawn)[index] = material;
        }
        changes
    }
}

/// A material with the values of another. Names, names of maps and the book stay. NaN and infinity are ignored. A new value is
/// clamped to its range. A value from the file is kept even outside the range.
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
            (
                Reflectance::MetallicRoughness { metallic, roughness },
                Reflectance::MetallicRoughness {
                    metallic: wanted_metallic,
                    roughness: wanted_roughness,
                },
            ) => Reflectance::MetallicRoughness {
                metallic: number(metallic, wanted_metallic, 1.0),
                roughness: number(roughness, wanted_roughness, 1.0),
            },
            (of_one_book, _of_the_other) => of_one_book,
        },
        layers: layers(&material.layers, &wanted.layers),
        alpha: match wanted.alpha {
            AlphaMode::Mask { cutoff } if !cutoff.is_finite() => material.alpha,
            alpha => alpha,
        },
        opacity: number(material.opacity, wanted.opacity, 1.0),
        emissive: color(material.emissive, wanted.emissive),
        occlusion_strength: number(material.occlusion_strength, wanted.occlusion_strength, 1.0),
        normal_scale: if wanted.normal_scale.is_finite() {
            wanted.normal_scale
        } else {
            material.normal_scale
        },
        double_sided: wanted.double_sided,
        unlit: wanted.unlit,
        ..material.clone()
    }
}

fn layers(current: &Layers, wanted: &Layers) -> Layers {
    let part = |of: fn(&Layers) -> f32| number(of(current), of(wanted), 1.0);
    let is_ior = wanted.ior == 0.0 || (1.0..f32::INFINITY).contains(&wanted.ior);
    Layers {
        ior: if is_ior { wanted.ior } else { current.ior },
        specular: part(|layers| layers.specular),
        specular_color: color(current.specular_color, wanted.specular_color),
        clearcoat: part(|layers| layers.clearcoat),
        clearcoat_roughness: part(|layers| layers.clearcoat_roughness),
        clearcoat_normal_scale: if wanted.clearcoat_normal_scale.is_finite() {
            wanted.clearcoat_normal_scale
        } else {
            current.clearcoat_normal_scale
        },
        sheen_color: color(current.sheen_color, wanted.sheen_color),
        sheen_roughness: part(|layers| layers.sheen_roughness),
        transmission: part(|layers| layers.transmission),
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
