//! What the figure is made of.

use bindpose::format;

use crate::maps;

/// One of the figure's materials.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Material {
    /// White lacquer.
    Shell,
    /// Anodised orange.
    Trim,
    /// Black rubber of joints, hoses and soles.
    Rubber,
    /// Dark metal of rings and bolts.
    Metal,
    /// Gold on glass.
    Visor,
}

impl Material {
    /// In the order of the file's subsets.
    pub(crate) const ALL: [Material; 5] = [
        Material::Shell,
        Material::Trim,
        Material::Rubber,
        Material::Metal,
        Material::Visor,
    ];

    /// The file's words; diffuse colours are as they are shown, sRGB. They are right without the maps too, which stay near white.
    pub(crate) fn entry(self) -> format::Material {
        let (name, diffuse, fresnel0, roughness) = match self {
            Material::Shell => ("Shell", [0.888, 0.882, 0.848], [0.05; 3], 0.24),
            Material::Trim => ("Trim", [0.93, 0.4, 0.08], [0.07, 0.05, 0.04], 0.32),
            Material::Rubber => ("Rubber", [0.17, 0.175, 0.185], [0.04; 3], 0.62),
            Material::Metal => ("Metal", [0.13, 0.135, 0.15], [0.2, 0.205, 0.22], 0.33),
            Material::Visor => ("Visor", [0.3, 0.17, 0.03], [1.0, 0.68, 0.2], 0.08),
        };
        let [diffuse_map, normal_map] = maps::NAMES;
        format::Material {
            name: name.into(),
            diffuse,
            reflectance: format::Reflectance::Fresnel { fresnel0, roughness },
            alpha_clip: false,
            type_name: "Skinned".into(),
            diffuse_map: Some(diffuse_map.into()),
            normal_map: Some(normal_map.into()),
        }
    }
}
