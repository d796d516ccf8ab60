//! Materials, textures and samplers.

use std::collections::{BTreeSet, HashMap};

use serde_json::{Value, json};

use super::binary::Binary;
use super::number::{number, numbers};
use super::pictures::{Pictures, Use};
use crate::export::{ExportError, MapImages};
use crate::model::{
    AlphaMode, Layers, MapSlot, Material, MaterialMap, MetallicSurface, Model, Reflectance, Sampling, Wrap,
};
use crate::slices::{Slices, Stage};

const UNLIT: &str = "KHR_materials_unlit";
const EMISSIVE_STRENGTH: &str = "KHR_materials_emissive_strength";
const SPECULAR: &str = "KHR_materials_specular";
const CLEARCOAT: &str = "KHR_materials_clearcoat";
const SHEEN: &str = "KHR_materials_sheen";
const TEXTURE_TRANSFORM: &str = "KHR_texture_transform";

/// What stands for the materials of a model.
#[derive(Default)]
pub(super) struct Materials {
    pub(super) materials: Vec<Value>,
    pub(super) textures: Vec<Value>,
    pub(super) samplers: Vec<Value>,
    pub(super) images: Vec<Value>,
    pub(super) extensions: BTreeSet<&'static str>,
}

/// What a map is used for. Of a normal map the green may be turned.
fn purpose(slot: MapSlot, is_turned: bool) -> Use {
    match slot {
        MapSlot::Normal | MapSlot::ClearcoatNormal => Use::Directions { is_turned },
        MapSlot::Diffuse | MapSlot::MetallicRoughness | MapSlot::Occlusion | MapSlot::Emissive => Use::AsIs,
        MapSlot::Specular | MapSlot::Clearcoat | MapSlot::Sheen => Use::AsIs,
    }
}

/// The roughness that the gloss of a normal map makes, where no map of roughness is; the DirectX 12 book alone reads it.
fn gloss(index: usize, material: &Material, maps: &MapImages<'_>) -> Option<Use> {
    let of_normal_map = maps
        .get(&(index, MapSlot::Normal))
        .filter(|image| image.channels().count() == 4);
    let has_own =
        material.map(MapSlot::MetallicRoughness).is_some() && maps.contains_key(&(index, MapSlot::MetallicRoughness));
    match (material.reflectance, &material.normal_map, of_normal_map) {
        (Reflectance::Fresnel { roughness, .. }, Some(_), Some(_)) if !has_own => Some(Use::Roughness {
            roughness: roughness.clamp(0.0, 1.0).to_bits(),
            metal: material.metallic_surface().metallic > 0.0,
        }),
        _ => None,
    }
}

/// Writes all materials, and the maps that have pictures. `turned` says which materials' normal maps are turned.
pub(super) async fn materials(
    model: &Model,
    (maps, turned): (&MapImages<'_>, &[bool]),
    pictures: Pictures,
    binary: &mut Binary,
    slices: &Slices,
) -> Result<Materials, ExportError> {
    let mut writer = Writer {
        written: Materials::default(),
        pictures,
        maps,
        turned,
        samplers: Places::default(),
        textures: Places::default(),
        has_second: !model.mesh.second_tex_coords.is_empty(),
        double_sided: model.needs_both_sides(&model.turned_submeshes()),
        binary,
        slices,
    };
    for (index, material) in model.materials.iter().enumerate() {
        slices.pause_at(Stage::Writing, index, model.materials.len()).await;
        let material = writer.material(index, material).await?;
        writer.written.materials.push(material);
    }
    Ok(Materials {
        images: writer.pictures.images,
        ..writer.written
    })
}

struct Writer<'a> {
    written: Materials,
    pictures: Pictures,
    maps: &'a MapImages<'a>,
    turned: &'a [bool],
    samplers: Places,
    textures: Places,
    has_second: bool,
    /// Of each material.
    double_sided: Vec<bool>,
    binary: &'a mut Binary,
    slices: &'a Slices,
}

impl Writer<'_> {
    async fn material(&mut self, index: usize, material: &Material) -> Result<Value, ExportError> {
        let MetallicSurface {
            base_color,
            metallic,
            roughness,
        } = material.metallic_surface();
        let unit = |value: f32| value.clamp(0.0, 1.0);
        let [red, green, blue] = base_color.map(unit);
        let mut surface = json!({
            "baseColorFactor": numbers([red, green, blue, unit(material.opacity)]),
            "metallicFactor": number(unit(metallic)),
            "roughnessFactor": number(unit(roughness)),
        });
        let mut written = json!({ "name": material.name });
        if let Some(info) = self.info(index, material, MapSlot::Diffuse).await? {
            surface["baseColorTexture"] = info;
        }
        if let Some(info) = self.info(index, material, MapSlot::MetallicRoughness).await? {
            surface["metallicRoughnessTexture"] = info;
        } else if let Some(info) = self.gloss(index, material).await? {
            surface["metallicRoughnessTexture"] = info;
            surface["roughnessFactor"] = json!(1.0);
        }
        written["pbrMetallicRoughness"] = surface;
        if let Some(mut info) = self.info(index, material, MapSlot::Normal).await? {
            if material.normal_scale != 1.0 {
                info["scale"] = number(material.normal_scale);
            }
            written["normalTexture"] = info;
        }
        if let Some(mut info) = self.info(index, material, MapSlot::Occlusion).await? {
            if material.occlusion_strength != 1.0 {
                info["strength"] = number(unit(material.occlusion_strength));
            }
            written["occlusionTexture"] = info;
        }
        if let Some(info) = self.info(index, material, MapSlot::Emissive).await? {
            written["emissiveTexture"] = info;
        }
        self.light(material, &mut written);
        self.layers(material, &mut written);
        if !material.unlit {
            self.layer_maps(index, material, &mut written).await?;
        }
        match material.alpha {
            AlphaMode::Opaque => {}
            AlphaMode::Mask { cutoff } => {
                written["alphaMode"] = json!("MASK");
                written["alphaCutoff"] = number(cutoff.max(0.0));
            }
            AlphaMode::Blend => written["alphaMode"] = json!("BLEND"),
        }
        if self.double_sided[index] {
            written["doubleSided"] = json!(true);
        }
        if let Some(values) = of_book(material) {
            written["extras"] = json!({ "bindpose": values });
        }
        Ok(written)
    }

    /// What it shines with by itself, and whether it is lit.
    fn light(&mut self, material: &Material, written: &mut Value) {
        let strongest = material.emissive.into_iter().fold(0.0, f32::max);
        // What is unlit is shown in its colour alone, and goes with no other extension.
        if strongest > 1.0 && !material.unlit {
            self.written.extensions.insert(EMISSIVE_STRENGTH);
            written["extensions"][EMISSIVE_STRENGTH] = json!({ "emissiveStrength": number(strongest) });
        }
        if strongest > 0.0 {
            let factor = material.emissive.map(|channel| channel.max(0.0) / strongest.max(1.0));
            written["emissiveFactor"] = numbers(factor);
        }
        if material.unlit {
            self.written.extensions.insert(UNLIT);
            written["extensions"][UNLIT] = json!({});
        }
    }

    /// The extensions of which a number is another than where there is none. What is unlit goes with no other.
    fn layers(&mut self, material: &Material, written: &mut Value) {
        let (layers, none) = (&material.layers, Layers::default());
        let is_metallic = matches!(material.reflectance, Reflectance::MetallicRoughness { .. });
        let extensions = [
            (
                "KHR_materials_ior",
                is_metallic && layers.ior != none.ior,
                json!({ "ior": number(layers.ior) }),
            ),
            (
                SPECULAR,
                is_metallic && (layers.specular, layers.specular_color) != (none.specular, none.specular_color),
                json!({
                    "specularFactor": number(layers.specular),
                    "specularColorFactor": numbers(layers.specular_color),
                }),
            ),
            (
                CLEARCOAT,
                layers.clearcoat != none.clearcoat,
                json!({
                    "clearcoatFactor": number(layers.clearcoat),
                    "clearcoatRoughnessFactor": number(layers.clearcoat_roughness),
                }),
            ),
            (
                SHEEN,
                layers.sheen_color != none.sheen_color,
                json!({
                    "sheenColorFactor": numbers(layers.sheen_color),
                    "sheenRoughnessFactor": number(layers.sheen_roughness),
                }),
            ),
            (
                "KHR_materials_transmission",
                layers.transmission != none.transmission,
                json!({ "transmissionFactor": number(layers.transmission) }),
            ),
        ];
        for (name, _, values) in extensions.into_iter().filter(|(_, says, _)| *says && !material.unlit) {
            self.written.extensions.insert(name);
            written["extensions"][name] = values;
        }
    }

    /// The maps of the layers, each under the names that its channels have.
    async fn layer_maps(&mut self, index: usize, material: &Material, written: &mut Value) -> Result<(), ExportError> {
        let [red, green, _, alpha] = [0, 1, 2, 3].map(Some);
        let is_metallic = matches!(material.reflectance, Reflectance::MetallicRoughness { .. });
        // With the channel that has to be in use; any where there is `None`.
        let names = [
            (MapSlot::Specular, SPECULAR, "specularColorTexture", red),
            (MapSlot::Specular, SPECULAR, "specularTexture", alpha),
            (MapSlot::Clearcoat, CLEARCOAT, "clearcoatTexture", red),
            (MapSlot::Clearcoat, CLEARCOAT, "clearcoatRoughnessTexture", green),
            (MapSlot::ClearcoatNormal, CLEARCOAT, "clearcoatNormalTexture", None),
            (MapSlot::Sheen, SHEEN, "sheenColorTexture", red),
            (MapSlot::Sheen, SHEEN, "sheenRoughnessTexture", alpha),
        ];
        for (slot, extension, name, channel) in names {
            let has = |map: &MaterialMap| channel.is_none_or(|channel: usize| map.sampling.channels[channel]);
            // As its number: the books' materials reflect in their own way.
            if !material.map(slot).is_some_and(has) || (slot == MapSlot::Specular && !is_metallic) {
                continue;
            }
            if let Some(mut info) = self.info(index, material, slot).await? {
                let scale = material.layers.clearcoat_normal_scale;
                if slot == MapSlot::ClearcoatNormal && scale != 1.0 {
                    info["scale"] = number(scale);
                }
                self.written.extensions.insert(extension);
                written["extensions"][extension][name] = info;
            }
        }
        Ok(())
    }

    /// The texture of a map that has a picture.
    async fn info(&mut self, index: usize, material: &Material, slot: MapSlot) -> Result<Option<Value>, ExportError> {
        match material.map(slot) {
            Some(map) => {
                let purpose = purpose(slot, self.turned[index]);
                self.texture((index, slot), map, purpose, &map.name).await
            }
            None => Ok(None),
        }
    }

    async fn gloss(&mut self, index: usize, material: &Material) -> Result<Option<Value>, ExportError> {
        match (gloss(index, material, self.maps), &material.normal_map) {
            (Some(purpose), Some(map)) => {
                let name = format!("{} (roughness)", map.name);
                self.texture((index, MapSlot::Normal), map, purpose, &name).await
            }
            _ => Ok(None),
        }
    }

    async fn texture(
        &mut self,
        place: (usize, MapSlot),
        map: &MaterialMap,
        purpose: Use,
        name: &str,
    ) -> Result<Option<Value>, ExportError> {
        let Some(image) = self.maps.get(&place) else {
            return Ok(None);
        };
        self.slices.pause().await;
        let source = self.pictures.picture(image, purpose, name, self.binary)?;
        let sampler = self.samplers.place(&mut self.written.samplers, sampler(&map.sampling));
        let texture = json!({ "source": source, "sampler": sampler });
        let mut info = json!({ "index": self.textures.place(&mut self.written.textures, texture) });
        if map.sampling.second_tex_coords && self.has_second {
            info["texCoord"] = json!(1);
        }
        if let Some(transform) = transform(&map.sampling) {
            self.written.extensions.insert(TEXTURE_TRANSFORM);
            info["extensions"] = json!({ TEXTURE_TRANSFORM: transform });
        }
        Ok(Some(info))
    }
}

/// Places of values in a list, by their text.
#[derive(Default)]
struct Places(HashMap<String, usize>);

impl Places {
    /// The place of a value, which is put at the end of the list if it is not there.
    fn place(&mut self, list: &mut Vec<Value>, value: Value) -> usize {
        *self.0.entry(value.to_string()).or_insert_with(|| {
            list.push(value);
            list.len() - 1
        })
    }
}

fn sampler(sampling: &Sampling) -> Value {
    let [wrap_s, wrap_t] = sampling.wrap.map(|wrap| match wrap {
        Wrap::Repeat => 10_497,
        Wrap::Mirror => 33_648,
        Wrap::Clamp => 33_071,
    });
    let (magnified, minified) = if sampling.nearest { (9728, 9986) } else { (9729, 9987) };
    json!({ "wrapS": wrap_s, "wrapT": wrap_t, "magFilter": magnified, "minFilter": minified })
}

/// The parts of a transform of texture coordinates: scale, then a turn against the clock as v points down, then an offset.
pub(super) fn transform(sampling: &Sampling) -> Option<Value> {
    let matrix = sampling.map_from_mesh;
    if matrix == glam::Affine2::IDENTITY {
        return None;
    }
    let [x, y] = [matrix.matrix2.x_axis, matrix.matrix2.y_axis];
    let mut transform = json!({});
    let width = x.length();
    let rotation = if width > 0.0 { -x.y.atan2(x.x) } else { y.x.atan2(y.y) };
    let height = glam::Vec2::new(rotation.sin(), rotation.cos()).dot(y);
    if matrix.translation != glam::Vec2::ZERO {
        transform["offset"] = numbers(matrix.translation.to_array());
    }
    if rotation != 0.0 {
        transform["rotation"] = number(rotation);
    }
    transform["scale"] = numbers([width, height]);
    Some(transform)
}

/// What the books say of a material; none of one that has glTF's own words.
fn of_book(material: &Material) -> Option<Value> {
    let map = |slot| material.map(slot).map(|map| map.name.clone());
    let mut values = json!({
        "diffuse": numbers(material.diffuse),
        "alphaClip": material.is_cut(),
        "diffuseMap": map(MapSlot::Diffuse),
        "normalMap": map(MapSlot::Normal),
    });
    match material.reflectance {
        Reflectance::MetallicRoughness { .. } => return None,
        Reflectance::Fresnel { fresnel0, roughness } => {
            values["reflectance"] = json!("fresnel");
            values["fresnel0"] = numbers(fresnel0);
            values["roughness"] = number(roughness);
        }
        Reflectance::Phong {
            ambient,
            specular,
            spec_power,
            reflectivity,
        } => {
            values["reflectance"] = json!("phong");
            values["ambient"] = numbers(ambient);
            values["specular"] = numbers(specular);
            values["specPower"] = number(spec_power);
            values["reflectivity"] = numbers(reflectivity);
        }
    }
    Some(values)
}
