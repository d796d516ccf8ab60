//! A model in glTF's binary form.
//!
//! ```text
//! meshes     one for each object, one where there are none; a primitive for each submesh; corners against the clock, as glTF has them
//! skeleton   a node for each bone, in the file's order; one above them where there are several roots, since a skin wants one
//! clips      an animation each; the model's keys but those that a reader finds between others, held values as STEP, splines as CUBICSPLINE
//! materials  metallic-roughness, with what the books say in `extras.bindpose`; maps as PNG, each picture once; green of normal maps up
//! ```

mod animation;
mod binary;
mod geometry;
mod losses;
mod material;
mod number;
mod pictures;
mod skeleton;
mod space;

use std::collections::BTreeSet;

use serde_json::{Value, json};

use super::{ExportError, Exported, MapImages, MapSources};
use crate::model::{Front, Green, JointNames, MapSlot, Model, Skeleton, Tag};
use crate::slices::{Slices, at_once};
use binary::Binary;
use pictures::Pictures;
use space::Space;

pub use losses::glb_losses;

const MAGIC: u32 = 0x4654_6c67;
const JSON_CHUNK: u32 = 0x4e4f_534a;
const BINARY_CHUNK: u32 = 0x004e_4942;

/// Writes a model as a `.glb` file, right-handed and y up, facing +z; lengths stay. `names` are names that a person gave to bones.
///
/// # Errors
/// When a picture cannot be written, a number overflows, there are more joints than a vertex can name, or the file would have more than 4 GiB.
pub fn glb(model: &Model, names: &JointNames, maps: &MapImages<'_>) -> Result<Exported, ExportError> {
    at_once(glb_in(model, names, maps, &MapSources::new(), &Slices::ENDLESS))
}

/// The same, in slices. A map is written as the file that it was read from, where that is known and its texels are those that glTF has.
///
/// # Errors
/// As [`glb`].
pub async fn glb_in(
    model: &Model,
    names: &JointNames,
    maps: &MapImages<'_>,
    sources: &MapSources,
    slices: &Slices,
) -> Result<Exported, ExportError> {
    let space = Space::of(model);
    let mut binary = Binary::default();
    let mut root = json!({
        "asset": { "version": "2.0", "generator": concat!("Bindpose ", env!("CARGO_PKG_VERSION")) },
        "scene": 0,
    });
    if let Some(copyright) = &model.copyright {
        root["asset"]["copyright"] = json!(copyright);
    }
    let bones = skeleton::bones(model, names, &space, &mut binary);
    let joint_count = model.skeleton.joint_count() + usize::from(bones.unmoving.is_some());
    if joint_count > Skeleton::MOST_NAMED {
        return Err(ExportError::TooManyJoints(joint_count));
    }
    let mut nodes = bones.nodes;
    let mut scene_nodes = bones.roots;
    slices.pause().await;
    let turned = turned_materials(model, maps);
    let objects = geometry::meshes(model, &space, (&turned, !maps.is_empty()), bones.unmoving, &mut binary);
    if let Some(skin) = bones.skin.filter(|_| !objects.is_empty()) {
        root["skins"] = json!([skin]);
    }
    let mut meshes = Vec::with_capacity(objects.len());
    for (object, mut mesh) in objects {
        let mut node = json!({ "mesh": meshes.len() });
        if root.get("skins").is_some() {
            node["skin"] = json!(0);
        }
        if let Some(object) = object {
            write_tag(&mut node, &object.node);
            write_tag(&mut mesh, &object.mesh);
        }
        meshes.push(mesh);
        scene_nodes.push(nodes.len());
        nodes.push(node);
    }
    let mut scene = json!({});
    if !scene_nodes.is_empty() {
        scene["nodes"] = json!(scene_nodes);
    }
    if !space.is_same() {
        scene["extras"] = json!({ "bindpose": {
            "handedness": model.handedness.name(), "up": model.up_axis.name(),
        }});
    }
    root["scenes"] = json!([scene]);
    let animations = animation::animations(model, &space, &mut binary, slices).await;
    let pictures = Pictures::new(maps, sources);
    let written = material::materials(model, (maps, &turned), pictures, &mut binary, slices).await?;
    for (key, list) in [
        ("meshes", meshes),
        ("nodes", nodes),
        ("animations", animations),
        ("materials", written.materials),
        ("textures", written.textures),
        ("samplers", written.samplers),
        ("images", written.images),
        (
            "extensionsUsed",
            written.extensions.iter().map(|name| json!(name)).collect(),
        ),
        ("accessors", std::mem::take(&mut binary.accessors)),
        ("bufferViews", std::mem::take(&mut binary.views)),
    ] {
        if !list.is_empty() {
            root[key] = Value::Array(list);
        }
    }
    if !binary.bytes.is_empty() {
        root["buffers"] = json!([{ "byteLength": binary.bytes.len() }]);
    }
    if let Some(place) = no_number(&root) {
        return Err(ExportError::NotFinite { place });
    }
    Ok(Exported {
        bytes: container(&root, binary.bytes)?,
        losses: glb_losses(model, maps, &BTreeSet::new()),
    })
}

/// Writes a part's name and what its author said of it.
fn write_tag(part: &mut Value, tag: &Tag) {
    if !tag.name.is_empty() {
        part["name"] = json!(tag.name);
    }
    if let Some(extras) = &tag.extras {
        part["extras"] = extras.clone();
    }
}

/// Whether the green of each material's normal map is turned to point up, and the bitangents with it. The books' points down; what reads
/// glTF and computes tangents by itself takes it to point up, whatever bitangents say. Where no picture is written nothing is turned, since
/// the name that stays is of a picture with green down.
pub fn turned_materials(model: &Model, maps: &MapImages<'_>) -> Vec<bool> {
    let has_picture = |material: usize| {
        model.materials[material].normal_map.is_some() && maps.contains_key(&(material, MapSlot::Normal))
    };
    if model.front != Front::Negative || !(0..model.materials.len()).any(has_picture) {
        return vec![false; model.materials.len()];
    }
    let greens = model.greens().into_iter().enumerate();
    greens
        .map(|(material, green)| green == Some(Green::Down) && has_picture(material))
        .collect()
}

/// A JSON pointer to what is no number, if anything is. Among extras are values that are none on purpose.
fn no_number(value: &Value) -> Option<String> {
    let inner = |(key, value): (String, &Value)| Some(format!("/{key}{}", no_number(value)?));
    match value {
        Value::Null => Some(String::new()),
        Value::Array(values) => values
            .iter()
            .enumerate()
            .find_map(|(index, value)| inner((index.to_string(), value))),
        Value::Object(values) => {
            let mut values = values.iter().filter(|(key, _)| *key != "extras");
            values.find_map(|(key, value)| inner((key.clone(), value)))
        }
        _ => None,
    }
}

/// The chunks of a `.glb` file.
fn container(root: &Value, mut binary: Vec<u8>) -> Result<Vec<u8>, ExportError> {
    let mut text = root.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    binary.resize(binary.len().next_multiple_of(4), 0);
    let chunks = [(JSON_CHUNK, text), (BINARY_CHUNK, binary)];
    let chunks = || chunks.iter().filter(|(_, bytes)| !bytes.is_empty());
    let length = 12 + chunks().map(|(_, bytes)| 8 + bytes.len()).sum::<usize>();
    let length = u32::try_from(length).map_err(|_| ExportError::TooLarge)?;
    let mut file = Vec::with_capacity(length as usize);
    let mut whole = |numbers: &[u32], bytes: &[u8]| {
        numbers.iter().for_each(|number| file.extend(number.to_le_bytes()));
        file.extend_from_slice(bytes);
    };
    whole(&[MAGIC, 2, length], &[]);
    for (kind, bytes) in chunks() {
        // No chunk is longer than the file.
        whole(&[bytes.len() as u32, *kind], bytes);
    }
    Ok(file)
}
