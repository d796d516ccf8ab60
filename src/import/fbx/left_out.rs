//! What a model does not take from a file, told: one note for each kind.

use std::collections::BTreeMap;

use super::file::File;
use super::nodes::Nodes;
use super::objects::{Object, Objects};
use crate::diagnostic::codes;
use crate::diagnostic::collect::{Few, counted};
use crate::fbx::Place;

/// Kinds of objects by how they are told of, for one and for many.
fn kind(object: &Object<'_, '_>) -> Option<[&'static str; 2]> {
    let smoothness = object.record.find("Smoothness").and_then(|record| record.integer(0));
    // 1 shows the cage alone.
    if smoothness.is_some_and(|smoothness| smoothness > 1) {
        return Some(["subdivision: its cage is shown", "subdivisions: their cages are shown"]);
    }
    Some(match (&*object.record.name, &*object.kind) {
        ("Geometry", "Shape") | ("Deformer", "BlendShapeChannel") => {
            ["blend shape, which stands still", "blend shapes, which stand still"]
        }
        ("Geometry", "NurbsCurve" | "NurbsSurface" | "Nurb" | "TrimNurbsSurface" | "Line" | "Patch" | "Boundary") => {
            ["NURBS surface, patch or line", "NURBS surfaces, patches or lines"]
        }
        ("Model", "Camera" | "CameraSwitcher") | ("NodeAttribute", "Camera") => ["camera", "cameras"],
        ("Model" | "NodeAttribute", "Light") => ["light", "lights"],
        ("Constraint" | "Character" | "ControlSetPlug", _) | ("Model", "IKEffector" | "FKEffector") => {
            ["constraint or rig of a program", "constraints or rigs of a program"]
        }
        ("Deformer", "VertexCacheDeformer") | ("Cache", _) => ["cache of vertices", "caches of vertices"],
        ("NodeAttribute", "LodGroup") => [
            "choice between levels of detail, which are all shown",
            "choices between levels of detail, which are all shown",
        ],
        ("LayeredTexture", _) => ["further layer of a texture", "further layers of textures"],
        ("Audio" | "AudioLayer", _) => ["sound", "sounds"],
        _ => return None,
    })
}

/// Notes what of a file is not in the model.
pub(super) fn note(file: &mut File<'_, '_>, objects: &Objects<'_, '_>, nodes: &Nodes) {
    let mut kinds: BTreeMap<[&str; 2], (Place, Few)> = BTreeMap::new();
    for object in &objects.all {
        // Nodes have an attribute besides: each is told of once.
        let is_attribute = object.record.name == "NodeAttribute" || object.kind == "BlendShapeChannel";
        if let Some(kind) = kind(object) {
            let (_, names) = kinds
                .entry(kind)
                .or_insert_with(|| (object.record.place, Few::default()));
            if (!is_attribute || object.kind == "LodGroup") && !object.name.is_empty() {
                names.extend([object.name.to_string()]);
            }
        }
    }
    for ([one, many], (place, names)) in kinds {
        let listed = if names.count == 0 { "" } else { ": " };
        let message = format!("Not taken: {}{listed}{names}.", counted(names.count.max(1), one, many));
        file.note_of(place, &codes::FBX_LEFT_OUT, message);
    }
    if !file.disagreeing.is_empty() {
        let mut names = Few::default();
        names.extend(file.disagreeing.iter().map(|&bone| objects.get(bone).name.to_string()));
        let message = format!(
            "{} bound in another way than the bind pose says; the skin is believed: {names}.",
            counted(names.count, "bone is", "bones are"),
        );
        file.note(&codes::FBX_LEFT_OUT, message);
    }
    let uses = &nodes.scene.uses;
    if uses.len() > 1 {
        let mut names = Few::default();
        names.extend(
            uses.iter()
                .map(|mesh| nodes.scene.nodes[mesh.node as usize].tag.name.clone()),
        );
        let message = format!("{} objects become one mesh: {names}.", names.count);
        file.note(&codes::FBX_OBJECTS_MERGED, message);
    }
    for (places, what) in [
        (
            &objects.doubled,
            [
                "record has an id that another one has",
                "records have ids that others have",
            ],
        ),
        (
            &objects.missing,
            [
                "record names an object that is not there",
                "records name objects that are not there",
            ],
        ),
    ] {
        if let Some(&place) = places.first() {
            let message = format!("{}; left out.", counted(places.len(), what[0], what[1]));
            file.note_of(place, &codes::FBX_RULE_BROKEN, message);
        }
    }
    if let Some(&first) = nodes.tangled.first() {
        let object = objects.get(first);
        let message = format!("\"{}\" lies below itself; it hangs on the scene now.", object.name);
        file.note_of(object.record.place, &codes::FBX_RULE_BROKEN, message);
    }
}
