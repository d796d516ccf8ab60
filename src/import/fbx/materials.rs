//! Materials of a file as ours: Lambert's, Phong's, and those of Stingray and 3ds Max that are metals or not.

use super::file::File;
use super::images::Images;
use super::objects::{Object, ObjectIndex, Objects};
use crate::diagnostic::collect::{Few, counted};
use crate::diagnostic::{Subject, codes};
use crate::model::{AlphaMode, Layers, Material, MaterialMap, Reflectance, unique_names};

/// The names that programs give what we have, the most telling first. Where there are several, all but the first are of
/// Autodesk's physical materials: Stingray's of Maya, and 3ds Max's of three kinds.
mod names {
    pub(super) const BASE_COLOR: &[&str] = &[
        "Maya|base_color",
        "Maya|baseColor",
        "3dsMax|Parameters|base_color",
        "3dsMax|main|baseColor",
        "3dsMax|main|basecolor",
        "DiffuseColor",
        "Diffuse",
    ];
    /// How much of it there is.
    pub(super) const BASE_FACTOR: &[&str] = &["Maya|base", "3dsMax|Parameters|base_weight", "DiffuseFactor"];
    pub(super) const METALLIC: &[&str] = &[
        "Maya|metallic",
        "Maya|metalness",
        "3dsMax|Parameters|metalness",
        "3dsMax|main|metalness",
    ];
    pub(super) const ROUGHNESS: &[&str] = &[
        "Maya|roughness",
        "Maya|specularRoughness",
        "3dsMax|Parameters|roughness",
        "3dsMax|main|roughness",
        "3dsMax|main|glossiness",
        "3dsMax|main|Glossiness",
    ];
    pub(super) const METALLIC_MAP: &[&str] = &[
        "Maya|TEX_metallic_map",
        "Maya|metalness",
        "3dsMax|Parameters|metalness_map",
        "3dsMax|main|metalness_map",
    ];
    pub(super) const ROUGHNESS_MAP: &[&str] = &[
        "Maya|TEX_roughness_map",
        "Maya|specularRoughness",
        "3dsMax|Parameters|roughness_map",
        "3dsMax|main|Roughness_Map",
        "3dsMax|main|roughness_map",
    ];
    /// 1 where the number is glossiness.
    pub(super) const IS_GLOSSINESS: &[&str] = &["3dsMax|Parameters|roughness_inv", "3dsMax|main|useGlossiness"];
    /// Each with how much of it there is.
    pub(super) const EMISSIVE: &[[&str; 2]] = &[
        ["Maya|emissive", "Maya|emissive_intensity"],
        ["Maya|emissionColor", "Maya|emission"],
        ["3dsMax|Parameters|emit_color", "3dsMax|Parameters|emission"],
        ["3dsMax|main|emit_color", ""],
        ["EmissiveColor", "EmissiveFactor"],
        ["Emissive", "EmissiveFactor"],
    ];
    pub(super) const COLOR_MAP: &[&str] = &[
        "Maya|TEX_color_map",
        "Maya|baseColor",
        "3dsMax|Parameters|base_color_map",
        "3dsMax|main|base_color_map",
        "DiffuseColor",
        "Diffuse",
        // Those of 6.1 hang on the model.
        "",
    ];
    pub(super) const NORMAL_MAP: &[&str] = &[
        "Maya|TEX_normal_map",
        "Maya|normalCamera",
        "3dsMax|Parameters|bump_map",
        "3dsMax|main|norm_map",
        "NormalMap",
        "Bump",
    ];
    pub(super) const OCCLUSION_MAP: &[&str] = &["Maya|TEX_ao_map", "3dsMax|main|ao_map"];
    /// Of Stingray's environment, which is no part of the material.
    pub(super) const SCENE_MAPS: &[&str] = &[
        "Maya|TEX_global_diffuse_cube",
        "Maya|TEX_global_specular_cube",
        "Maya|TEX_brdf_lut",
    ];
    pub(super) const EMISSIVE_MAP: &[&str] = &[
        "Maya|TEX_emissive_map",
        "Maya|emissionColor",
        "3dsMax|Parameters|emit_color_map",
        "3dsMax|main|emit_color_map",
        "EmissiveColor",
        "Emissive",
    ];
    pub(super) const OPACITY_MAP: &[&str] = &[
        "TransparentColor",
        "TransparencyFactor",
        "3dsMax|main|opacity_map",
        "3dsMax|Parameters|cutout_map",
    ];
}

/// The materials of a file, and which of them each object is.
pub(super) struct Materials {
    pub(super) materials: Vec<Material>,
    /// Their objects, in the same order.
    pub(super) objects: Vec<ObjectIndex>,
}

impl Materials {
    /// The materials that hang on models, and behind them one of what has none.
    pub(super) fn read(file: &mut File<'_, '_>, objects: &Objects<'_, '_>, images: &Images) -> Self {
        let used = |object: &Object<'_, '_>| {
            object
                .parents
                .iter()
                .any(|parent| objects.get(parent.to).record.name == "Model")
        };
        let found = objects.of_class("Material").filter(|(_, object)| used(object));
        let found: Vec<ObjectIndex> = found.map(|(index, _)| index).collect();
        let names = found.iter().map(|&index| &*objects.get(index).name).chain(["default"]);
        let names = unique_names(names, "material", |index, name| {
            if let Some(&object) = found.get(index as usize) {
                let message = format!("Another material has the same name; this one is shown as \"{name}\".");
                let place = objects.get(object).record.place;
                file.note_at(
                    place,
                    Subject::Material(index),
                    &codes::DUPLICATE_MATERIAL_NAME,
                    message,
                );
            }
        });
        // Blender writes the diffuse colour for the specular one, and half of the strength that it draws with.
        let creator = file.document.find("Creator").and_then(|record| record.text(0));
        let is_of_blender = creator.is_some_and(|creator| creator.starts_with("Blender"));
        let mut left_out = Few::default();
        let mut materials = Vec::with_capacity(names.len());
        for (index, name) in names.into_iter().enumerate() {
            materials.push(match found.get(index) {
                Some(&object) => {
                    let made = material(name, objects, object, images, &mut left_out);
                    let layers = if is_of_blender { Layers::default() } else { made.layers };
                    Material { layers, ..made }
                }
                None => Material {
                    name,
                    ..Material::default()
                },
            });
        }
        if left_out.count > 0 {
            let count = counted(left_out.count, "map is", "maps are");
            let message = format!("{count} of a kind that has no place in a model: {left_out}.");
            file.note(&codes::FBX_LEFT_OUT, message);
        }
        Self {
            materials,
            objects: found,
        }
    }

    /// The material of an object; the one behind all where it is none of them.
    pub(super) fn index(&self, object: Option<ObjectIndex>) -> u32 {
        let found = object.and_then(|object| self.objects.binary_search(&object).ok());
        found.unwrap_or(self.objects.len()) as u32
    }
}

fn color(object: &Object<'_, '_>, names: &[&str]) -> Option<[f32; 3]> {
    let found = names.iter().find_map(|name| object.vector(name))?;
    Some(found.as_vec3().to_array()).filter(|color| color.iter().all(|number| number.is_finite()))
}

fn number(object: &Object<'_, '_>, names: &[&str]) -> Option<f32> {
    let found = names.iter().find_map(|name| object.number(name))? as f32;
    Some(found).filter(|number| number.is_finite())
}

fn material(
    name: String,
    objects: &Objects<'_, '_>,
    index: ObjectIndex,
    images: &Images,
    left_out: &mut Few,
) -> Material {
    let object = objects.get(index);
    let maps = maps(objects, object, images);
    let map = |names: &[&str]| {
        let found = names
            .iter()
            .find_map(|name| maps.iter().find(|(property, _)| property == name));
        found.map(|(_, map)| map.clone())
    };
    let [diffuse_map, emissive_map, opacity_map] = [names::COLOR_MAP, names::EMISSIVE_MAP, names::OPACITY_MAP].map(map);
    let is_glossiness = number(object, names::IS_GLOSSINESS) == Some(1.0);
    let roughness_map = map(names::ROUGHNESS_MAP).filter(|_| !is_glossiness);
    // The file does not say how one picture for both is packed. Unreal's way is glTF's, and is taken.
    let is_of_both = |map: &MaterialMap| roughness_map.as_ref().is_some_and(|other| other.name == map.name);
    let metallic_roughness_map = map(names::METALLIC_MAP).filter(is_of_both);
    let one = |_: &MaterialMap| [1.0; 3];
    let factor = |names: &[&str]| number(object, names).unwrap_or(1.0).max(0.0);
    let diffuse = diffuse_map
        .as_ref()
        .map(one)
        .or_else(|| color(object, names::BASE_COLOR));
    let emissive = names::EMISSIVE
        .iter()
        .find_map(|&[name, times]| Some((color(object, &[name])?, factor(&[times]))));
    let (emissive, emissive_factor) = emissive.unwrap_or_else(|| ([0.0; 3], factor(&["EmissiveFactor"])));
    // A map stands in the place of the colour.
    let emissive = emissive_map.as_ref().map_or(emissive, one);
    let opacity = opacity(object);
    let is_cut_by_own = opacity_map
        .as_ref()
        .is_some_and(|map| diffuse_map.as_ref().is_some_and(|diffuse| diffuse.name == map.name));
    let of_both = match metallic_roughness_map {
        Some(_) => [names::METALLIC_MAP, names::ROUGHNESS_MAP],
        None => [&[][..]; 2],
    };
    let known = [
        of_both[0],
        of_both[1],
        names::COLOR_MAP,
        names::NORMAL_MAP,
        names::EMISSIVE_MAP,
        names::OCCLUSION_MAP,
    ]
    .concat();
    let is_left = |property: &str| {
        let is_scenes = names::SCENE_MAPS.contains(&property);
        !(is_scenes || known.contains(&property) || is_cut_by_own && names::OPACITY_MAP.contains(&property))
    };
    left_out.extend(
        maps.iter()
            .filter(|(property, _)| is_left(property))
            .map(|(property, _)| format!("{name}'s {property}")),
    );
    Material {
        diffuse: diffuse
            .unwrap_or([0.8; 3])
            .map(|number| (number * factor(names::BASE_FACTOR)).clamp(0.0, 1.0)),
        opacity,
        reflectance: match metallic_roughness_map {
            Some(_) => Reflectance::MetallicRoughness {
                metallic: 1.0,
                roughness: 1.0,
            },
            None => Reflectance::MetallicRoughness {
                metallic: number(object, names::METALLIC).unwrap_or(0.0).clamp(0.0, 1.0),
                roughness: roughness(object, is_glossiness),
            },
        },
        layers: layers(object),
        metallic_roughness_map,
        alpha: match opacity < 1.0 || is_cut_by_own {
            true => AlphaMode::Blend,
            false => AlphaMode::Opaque,
        },
        emissive: emissive.map(|number| number.max(0.0) * emissive_factor),
        normal_map: map(names::NORMAL_MAP),
        occlusion_map: map(names::OCCLUSION_MAP),
        diffuse_map,
        emissive_map,
        name,
        ..Material::default()
    }
}

/// Of Blinn's and Phong's exponent: `α² = 2 / (n + 2)`, and roughness is the root of α (Walter 2007; glTF 2.0, appendix B).
fn roughness(object: &Object<'_, '_>, is_glossiness: bool) -> f32 {
    let given = number(object, names::ROUGHNESS).map(|given| if is_glossiness { 1.0 - given } else { given });
    let of_exponent = || {
        let exponent = number(object, &["ShininessExponent", "Shininess"]).filter(|_| !is_lambert(object))?;
        Some((2.0 / (exponent.max(0.0) + 2.0)).sqrt().sqrt())
    };
    given.or_else(of_exponent).unwrap_or(1.0).clamp(0.0, 1.0)
}

fn is_lambert(object: &Object<'_, '_>) -> bool {
    let model = object.record.find("ShadingModel").and_then(|model| model.text(0));
    model.is_some_and(|model| model.eq_ignore_ascii_case("lambert"))
}

/// Phong's specular colour: it scales the 4 % that a dielectric reflects face on; 1 leaves them.
fn layers(object: &Object<'_, '_>) -> Layers {
    let is_physical = || number(object, names::METALLIC).is_some() || number(object, names::ROUGHNESS).is_some();
    let color = color(object, &["SpecularColor", "Specular"]).filter(|_| !is_lambert(object) && !is_physical());
    let plain = Layers::default();
    Layers {
        specular_color: color.map_or(plain.specular_color, |color| color.map(|number| number.max(0.0))),
        specular: color
            .and_then(|_| number(object, &["SpecularFactor"]))
            .map_or(plain.specular, |factor| factor.clamp(0.0, 1.0)),
        ..plain
    }
}

/// How much is seen of it, 0…1. Some exporters say that nothing is, and mean all.
fn opacity(object: &Object<'_, '_>) -> f32 {
    let of_color = || {
        let color = color(object, &["TransparentColor"]).unwrap_or([1.0; 3]);
        let factor = number(object, &["TransparencyFactor"])?;
        Some(1.0 - factor * (color[0] + color[1] + color[2]) / 3.0)
    };
    let opacity = of_color().or_else(|| number(object, &["Opacity"])).unwrap_or(1.0);
    if opacity > 0.0 { opacity.min(1.0) } else { 1.0 }
}

/// A material has a map for each of its properties.
const MOST_TEXTURES: usize = 64;

/// Whether a map is switched off: `use_color_map` is of `TEX_color_map`, and `base_color_map_on` of `base_color_map`.
fn is_off(material: &Object<'_, '_>, property: &str) -> bool {
    let switches = [property.replace("TEX_", "use_"), format!("{property}_on")];
    let mut switches = switches.iter().filter(|switch| *switch != property);
    switches.any(|switch| material.number(switch) == Some(0.0))
}

/// The maps of a material by the properties on which they hang, without those that are switched off; those of its models without any by no name.
fn maps<'o>(
    objects: &'o Objects<'_, '_>,
    material: &'o Object<'_, '_>,
    images: &Images,
) -> Vec<(&'o str, MaterialMap)> {
    let textures = |object: &'o Object<'_, '_>| {
        let textures = ["Texture", "LayeredTexture"].into_iter();
        let textures = textures
            .flat_map(|class| objects.hanging(object, class))
            .take(MOST_TEXTURES);
        let textures = textures.filter_map(|child| Some((&*child.property, texture(objects, child.to)?)));
        textures
            .filter(|(property, _)| !is_off(material, property))
            .collect::<Vec<_>>()
    };
    let mut found = textures(material);
    if found.is_empty() {
        let mut models = material.parents.iter().map(|parent| objects.get(parent.to));
        found = models
            .find(|parent| parent.record.name == "Model")
            .map(textures)
            .unwrap_or_default();
    }
    let named = found.into_iter();
    named
        .filter_map(|(property, texture)| Some((property, images.map(texture)?)))
        .collect()
}

/// A texture, or the first of a layered one.
fn texture(objects: &Objects<'_, '_>, index: ObjectIndex) -> Option<ObjectIndex> {
    let object = objects.get(index);
    match &*object.record.name {
        "Texture" => Some(index),
        "LayeredTexture" => objects.children(object, "Texture").next().map(|(index, _)| index),
        _ => None,
    }
}
