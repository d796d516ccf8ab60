//! What a model does not take from a document, told: scenes and nodes that are not shown, objects that become one mesh, shape keys,
//! attributes that nothing takes, and `extras`.

use std::collections::BTreeSet;

use serde_json::Value;

use super::nodes::Nodes;
use super::skeleton::{MeshUse, Rig};
use crate::diagnostic::collect::{Diagnostics, Place, counted};
use crate::diagnostic::{Code, codes};
use crate::gltf::{Root, is_attribute};

/// More names than this are not listed in a message.
const MOST_NAMES: usize = 8;

/// Notes what is left out of a scene whose meshes are used so. `second_tex_coords`: a map takes them.
pub(super) fn note(
    root: &Root,
    nodes: &Nodes,
    uses: &[MeshUse],
    rig: &Rig,
    second_tex_coords: bool,
    diagnostics: &mut Diagnostics,
) {
    let mut told = |code: &Code, count: usize, pointer: &str, message: String| {
        if count > 0 {
            diagnostics.add(code, Place::pointer(pointer).counting(count), message);
        }
    };
    let scenes = root.scenes().len().saturating_sub(1);
    let outside = nodes.in_scene.iter().zip(root.nodes());
    let outside = outside.filter(|(is_in, node)| !**is_in && node.mesh.is_some()).count();
    let message = format!(
        "{} left out with all that is not in the one that is shown, {}.",
        counted(scenes, "other scene is", "other scenes are"),
        counted(outside, "object", "objects")
    );
    told(&codes::GLTF_SCENE_LEFT_OUT, scenes.max(outside), "/scenes", message);

    let name = |mesh: &MeshUse| {
        let of_node = root.nodes()[mesh.node as usize].name.as_ref();
        let name = of_node.or(root.meshes()[mesh.mesh].name.as_ref());
        name.cloned().unwrap_or_else(|| format!("node {}", mesh.node))
    };
    let merged = if uses.len() > 1 { uses.len() } else { 0 };
    let message = format!("{merged} objects become one mesh: {}.", listed(uses.iter().map(name)));
    told(&codes::GLTF_OBJECTS_MERGED, merged, "/nodes", message);

    let meshes: BTreeSet<usize> = uses.iter().map(|mesh| mesh.mesh).collect();
    let targets = |mesh: usize| {
        root.meshes()[mesh]
            .primitives
            .iter()
            .map(|part| part.targets.len())
            .max()
    };
    let of_meshes = meshes.iter().map(|&mesh| targets(mesh).unwrap_or_default());
    let shapes = of_meshes.sum();
    let names = meshes
        .iter()
        .filter_map(|&mesh| root.meshes()[mesh].extras.as_ref()?.get("targetNames")?.as_array());
    let names: Vec<&str> = names.flatten().filter_map(Value::as_str).collect();
    let message = format!(
        "{} still, as the file has them outside of clips{}{}.",
        counted(
            shapes,
            "shape key (morph target) stands",
            "shape keys (morph targets) stand"
        ),
        if names.is_empty() { "" } else { ": " },
        listed(names.into_iter())
    );
    told(&codes::GLTF_MORPH_TARGETS_LEFT_OUT, shapes, "/meshes", message);

    let attributes = meshes.iter().flat_map(|&mesh| &root.meshes()[mesh].primitives);
    let attributes = attributes.flat_map(|part| part.attributes.keys()).filter(|key| {
        let is_second = second_tex_coords && *key == "TEXCOORD_1";
        let is_further = |(name, set): (&str, &str)| matches!(name, "TEXCOORD" | "COLOR") && set != "0";
        is_attribute(key) && !is_second && (key.starts_with('_') || key.rsplit_once('_').is_some_and(is_further))
    });
    let attributes: BTreeSet<&String> = attributes.collect();
    let message = format!("Vertices have more than is read: {}.", listed(attributes.iter()));
    told(&codes::GLTF_ATTRIBUTE_LEFT_OUT, attributes.len(), "/meshes", message);

    let mut is_taken: Vec<bool> = rig.joint_of_node.iter().map(Option::is_some).collect();
    uses.iter().for_each(|mesh| is_taken[mesh.node as usize] = true);
    let has_model = is_taken.contains(&true);
    nodes.mark_above(&mut is_taken);
    let [mut cameras, mut lights, mut empty] = [0; 3];
    let of_scene = root.nodes().iter().zip(&nodes.in_scene).zip(is_taken);
    for ((node, _), is_taken) in of_scene.filter(|((_, is_in), _)| **is_in && has_model) {
        match (node.camera, node.extensions.light) {
            (Some(_), _) => cameras += 1,
            (_, Some(_)) => lights += 1,
            _ => empty += usize::from(!is_taken),
        }
    }
    let kinds = [
        (cameras, ["camera", "cameras"]),
        (lights, ["light", "lights"]),
        (empty, ["node on which nothing hangs", "nodes on which nothing hangs"]),
    ];
    let kinds = kinds.into_iter().filter(|(count, _)| *count > 0);
    let words = listed(kinds.map(|(count, [one, many])| counted(count, one, many)));
    told(
        &codes::GLTF_NODES_LEFT_OUT,
        cameras + lights + empty,
        "/nodes",
        format!("Left out: {words}."),
    );

    let extras = extras(root);
    let message = format!(
        "{} left out: {}.",
        counted(
            extras.len(),
            "part of the file has extras, which are",
            "parts of the file have extras, which are"
        ),
        listed(extras.iter())
    );
    told(
        &codes::GLTF_EXTRAS_LEFT_OUT,
        extras.len(),
        extras.first().map_or("", String::as_str),
        message,
    );
}

/// Where there are `extras` that are not read.
fn extras(root: &Root) -> Vec<String> {
    let asset = root.asset.as_ref().and_then(|asset| asset.extras.as_ref());
    let lone = [("", root.extras.as_ref()), ("/asset", asset)];
    let lone = lone.into_iter().map(|(at, extras)| (at.to_owned(), extras));
    macro_rules! of_lists {
        ($($list:ident),*) => {
            lone$(.chain(
                root.$list().iter().enumerate()
                    .map(|(index, part)| (format!(concat!("/", stringify!($list), "/{}"), index), part.extras.as_ref())),
            ))*
        };
    }
    let all = of_lists!(scenes, nodes, meshes, skins, animations, materials);
    let is_read = |extras: &Value| match extras {
        Value::Null => true,
        // Names of shape keys are told with these.
        Value::Object(keys) => keys.keys().all(|key| key == "bindpose" || key == "targetNames"),
        _ => false,
    };
    all.filter(|(_, extras)| extras.is_some_and(|extras| !is_read(extras)))
        .map(|(at, _)| format!("{at}/extras"))
        .collect()
}

/// `a, b and c`, or the first few of many.
fn listed<T: ToString>(names: impl Iterator<Item = T>) -> String {
    let mut names = names.map(|name| name.to_string());
    let first: Vec<String> = names.by_ref().take(MOST_NAMES).collect();
    match names.count() {
        0 => first.join(", "),
        more => format!("{} and {more} more", first.join(", ")),
    }
}
