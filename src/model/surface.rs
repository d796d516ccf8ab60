//! From the file's materials to ours.

use super::names::unique;
use super::{Material, Reflectance};
use crate::diagnostic::collect::{Diagnostics, Place};
use crate::diagnostic::{Subject, codes};
use crate::format::{self, Document, LineMap};

/// What a subset without a material is drawn with: a mid grey that reads as no colour of the file.
pub(super) fn default_material(others: &[Material]) -> Material {
    let names = others.iter().map(|material| material.name.as_str()).chain(["default"]);
    let name = unique(names, "material", |_, _| ()).pop().unwrap_or_default();
    Material {
        name,
        diffuse: [0.8; 3],
        reflectance: Reflectance::Fresnel {
            fresnel0: [0.05; 3],
            roughness: 0.6,
        },
        alpha_clip: false,
        diffuse_map: None,
        normal_map: None,
    }
}

/// One material for each of the file's.
pub(super) fn materials_from_document(
    document: &Document,
    lines: &LineMap,
    diagnostics: &mut Diagnostics,
) -> Vec<Material> {
    let names = unique(
        document.materials.iter().map(|material| material.name.as_str()),
        "material",
        |index, name| {
            diagnostics.add(
                &codes::DUPLICATE_MATERIAL_NAME,
                Place::of(Subject::Material(index), &lines.materials),
                format!("Another material has the same name; this one is shown as \"{name}\"."),
            );
        },
    );
    document
        .materials
        .iter()
        .zip(names)
        .map(|(material, name)| Material {
            name,
            diffuse: finite(material.diffuse),
            reflectance: reflectance(material.reflectance),
            alpha_clip: material.alpha_clip,
            diffuse_map: material.diffuse_map.clone(),
            normal_map: material.normal_map.clone(),
        })
        .collect()
}

fn reflectance(stored: format::Reflectance) -> Reflectance {
    match stored {
        format::Reflectance::Fresnel { fresnel0, roughness } => Reflectance::Fresnel {
            fresnel0: finite(fresnel0),
            roughness: finite([roughness])[0],
        },
        format::Reflectance::Phong {
            ambient,
            specular,
            spec_power,
            reflectivity,
        } => Reflectance::Phong {
            ambient: finite(ambient),
            specular: finite(specular),
            spec_power: finite([spec_power])[0],
            reflectivity: finite(reflectivity),
        },
    }
}

/// Shading must not see a NaN: one such pixel spreads through every blur. Zero adds nothing.
fn finite<const N: usize>(numbers: [f32; N]) -> [f32; N] {
    numbers.map(|number| if number.is_finite() { number } else { 0.0 })
}
