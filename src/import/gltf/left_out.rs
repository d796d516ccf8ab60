//! What a model does not take from a document, told: scenes and nodes that are not shown, objects that become one mesh, shape keys,
//! attributes that nothing takes, and `extras`.

use std::collections::{BTreeSet, HashSet};

use serde_json::Value;

use super::skeleton::Rig;
use crate::diagnostic::collect::{Diagnostics, Place, counted, few};
use crate::diagnostic::{Code, codes};
use crate::gltf::{Node, Root, is_attribute};
use crate::import::scene::{MeshUse, Scene};
use crate::model::Object;

/// Notes what of a document is not in its scene and the skeleton of it. `second_tex_coords`: a map takes them.
pub(super) fn note(
    root: &Root,
    scene: &Scene,
    rig: &Rig,
    objects: &[(MeshUse, Object)],
    second_tex_coords: bool,
    diagnostics: &mut Diagnostics,
) {
    let mut tell = |code: &Code, count: usize, pointer: &str, [one, many]: [&str; 2], names: Vec<String>| {
        if count > 0 {
            let listed = if names.is_empty() { "" } else { ": " };
            let message = format!("{}{listed}{}.", counted(count, one, many), few(&names));
            diagnostics.add(code, Place::pointer(pointer).counting(count), message);
        }
    };
    let uses = &scene.uses;
    let in_scene = |node: &(usize, &Node)| scene.nodes[node.0].in_scene;
    let all = || root.nodes().iter().enumerate();
    let name = |(index, node): (usize, &Node)| node.name.clone().unwrap_or_else(|| format!("node {index}"));
    let scenes = root.scenes().len().saturating_sub(1);
    let outside = all().filter(|node| !in_scene(node) && node.1.mesh.is_some());
    let outside: Vec<String> = outside.map(name).collect();
    let (count, what) = match scenes {
        0 => (
            outside.len(),
            ["object is in no scene; left out", "objects are in no scene; left out"],
        ),
        _ => (scenes, ["other scene is left out", "other scenes are left out"]),
    };
    tell(&codes::GLTF_SCENE_LEFT_OUT, count, "/scenes", what, outside);

    let merged = uses
        .iter()
        .map(|mesh| (mesh.node as usize, &root.nodes()[mesh.node as usize]));
    let merged: Vec<String> = merged.map(name).filter(|_| uses.len() > 1).collect();
    let what = ["object becomes one mesh", "objects become one mesh"];
    tell(&codes::GLTF_OBJECTS_MERGED, merged.len(), "/nodes", what, merged);

    let used: BTreeSet<usize> = uses.iter().map(|mesh| mesh.mesh).collect();
    let meshes = || used.iter().map(|&mesh| &root.meshes()[mesh]);
    let shapes = meshes().filter_map(|mesh| mesh.primitives.iter().map(|part| part.targets.len()).max());
    let names = meshes().filter_map(|mesh| mesh.extras.as_ref()?.get("targetNames")?.as_array());
    let names = names.flatten().filter_map(|name| Some(name.as_str()?.to_owned()));
    let what = [
        "shape key (morph target) stands still",
        "shape keys (morph targets) stand still",
    ];
    tell(
        &codes::GLTF_MORPH_TARGETS_LEFT_OUT,
        shapes.sum(),
        "/meshes",
        what,
        names.collect(),
    );

    let is_left = |key: &&String| {
        let is_further = |(name, set): (&str, &str)| matches!(name, "TEXCOORD" | "COLOR") && set != "0";
        let is_taken = second_tex_coords && *key == "TEXCOORD_1";
        is_attribute(key) && !is_taken && (key.starts_with('_') || key.rsplit_once('_').is_some_and(is_further))
    };
    let parts = meshes().flat_map(|mesh| &mesh.primitives);
    let left: BTreeSet<&String> = parts.flat_map(|part| part.attributes.keys()).filter(is_left).collect();
    let what = [
        "attribute of vertices is not read",
        "attributes of vertices are not read",
    ];
    let names = left.iter().map(|key| (*key).clone()).collect();
    tell(&codes::GLTF_ATTRIBUTE_LEFT_OUT, left.len(), "/meshes", what, names);

    let mut is_taken: Vec<bool> = rig.joint_of_node.iter().map(Option::is_some).collect();
    uses.iter().for_each(|mesh| is_taken[mesh.node as usize] = true);
    let has_model = is_taken.contains(&true);
    scene.mark_above(&mut is_taken);
    let mut counts = [0; 3];
    for (index, node) in all().filter(|node| in_scene(node) && has_model) {
        match (node.camera, node.extensions.light) {
            (Some(_), _) => counts[0] += 1,
            (_, Some(_)) => counts[1] += 1,
            _ => counts[2] += usize::from(!is_taken[index]),
        }
    }
    let kinds = [
        ["camera", "cameras"],
        ["light", "lights"],
        ["without anything on it", "without anything on them"],
    ];
    let kinds = counts.into_iter().zip(kinds).filter(|(count, _)| *count > 0);
    let names = kinds.map(|(count, [one, many])| counted(count, one, many)).collect();
    let what = ["node is left out", "nodes are left out"];
    tell(&codes::GLTF_NODES_LEFT_OUT, counts.iter().sum(), "/nodes", what, names);

    let extras = extras(root, objects);
    let what = [
        "part of the file has extras (custom properties), which are left out",
        "parts of the file have extras (custom properties), which are left out",
    ];
    let first = extras.first().cloned().unwrap_or_default();
    tell(&codes::GLTF_EXTRAS_LEFT_OUT, extras.len(), &first, what, extras);
}

/// Whether a key of `extras` means something here. Names of shape keys are told with these.
pub(super) fn is_read(key: &str) -> bool {
    key == "bindpose" || key == "targetNames"
}

/// Whether there is more in `extras` than what means something here.
pub(super) fn is_foreign(extras: &Value) -> bool {
    match extras {
        Value::Object(keys) => !keys.keys().all(|key| is_read(key)),
        extras => !extras.is_null(),
    }
}

/// Where there are `extras` that are not read. Those of objects come through.
fn extras(root: &Root, objects: &[(MeshUse, Object)]) -> Vec<String> {
    let kept = objects.iter();
    let kept = kept.flat_map(|(of, _)| [format!("/nodes/{}", of.node), format!("/meshes/{}", of.mesh)]);
    let kept: HashSet<String> = kept.collect();
    let mut found = Vec::new();
    let mut look = |extras: &Option<Value>, at: &dyn Fn() -> String| {
        if extras.as_ref().is_some_and(is_foreign) {
            found.extend(Some(at()).filter(|at| !kept.contains(at)).map(|at| at + "/extras"));
        }
    };
    look(&root.extras, &String::new);
    if let Some(asset) = &root.asset {
        look(&asset.extras, &|| "/asset".to_owned());
    }
    macro_rules! look_into {
        ($($list:ident),*) => {$(
            for (index, part) in root.$list().iter().enumerate() {
                look(&part.extras, &|| format!(concat!("/", stringify!($list), "/{}"), index));
            }
        )*};
    }
    look_into!(scenes, nodes, meshes, skins, animations, materials);
    found
}
