//! Nodes as trees: who is whose parent, where each is at rest, and which are in the scene.

use std::sync::Arc;

use glam::{DAffine3, DMat4, DVec4, Mat4, Quat, Vec3};
use serde_json::Value;

use super::left_out::{is_foreign, is_read};
use crate::diagnostic::codes;
use crate::diagnostic::collect::{Diagnostics, Place};
use crate::gltf::{Fault, Node, Path, Root, fault, out_of_range};
use crate::import::scene::{self, Scene, mark_below};
use crate::model::{LocalJoint, Tag, unit_rotation};

/// A rotation whose length is off by more than this was not meant to be rounded.
const UNIT_TOLERANCE: f32 = 1e-3;

/// The nodes of a document, still without skins and meshes.
///
/// # Errors
/// When a child or a scene's node is not there, or nodes are no trees.
pub(super) fn scene(root: &Root, diagnostics: &mut Diagnostics) -> Result<Scene, Fault> {
    let parents = parents(root.nodes())?;
    let order = parents_first(&parents)?;
    let transforms = root.nodes().iter().enumerate();
    let transforms = transforms.map(|(index, node)| transform(index, node, diagnostics));
    let (local, mut model_from_node): (Vec<LocalJoint>, Vec<DAffine3>) = transforms.unzip();
    for &node in &order {
        if let Some(parent) = parents[node as usize] {
            model_from_node[node as usize] = model_from_node[parent as usize] * model_from_node[node as usize];
        }
    }
    let in_scene = in_scene(root, &parents, &order, diagnostics)?;
    let moved = moved_nodes(root);
    let nodes = root.nodes().iter().enumerate().map(|(index, node)| scene::Node {
        tag: tag(node.name.as_ref(), node.extras.as_ref()),
        local: local[index],
        model_from_node: model_from_node[index],
        in_scene: in_scene[index],
        is_moved: moved[index],
        bone: bone_number(node),
    });
    let meshes = root.meshes().iter();
    let meshes = meshes.map(|mesh| Arc::new(tag(mesh.name.as_ref(), mesh.extras.as_ref())));
    Ok(Scene {
        nodes: nodes.collect(),
        meshes: meshes.collect(),
        parents,
        order,
        ..Scene::default()
    })
}

/// Name and `extras` as they are written again: without what means something here.
fn tag(name: Option<&String>, extras: Option<&Value>) -> Tag {
    let mut extras = extras.filter(|extras| is_foreign(extras)).cloned();
    if let Some(Value::Object(keys)) = &mut extras {
        keys.retain(|key, _| !is_read(key));
    }
    Tag {
        name: name.cloned().unwrap_or_default(),
        extras,
    }
}

/// The number that the document gives a bone.
fn bone_number(node: &Node) -> Option<u32> {
    let bone = node.extras.as_ref()?.get("bindpose")?.get("bone")?.as_u64()?;
    u32::try_from(bone).ok()
}

fn moved_nodes(root: &Root) -> Vec<bool> {
    let mut moved = vec![false; root.nodes().len()];
    let channels = root.animations().iter().flat_map(|animation| &animation.channels);
    for channel in
        channels.filter(|channel| matches!(channel.target.path, Path::Translation | Path::Rotation | Path::Scale))
    {
        let node = channel.target.node.and_then(|node| usize::try_from(node.0).ok());
        if let Some(moved) = node.and_then(|node| moved.get_mut(node)) {
            *moved = true;
        }
    }
    moved
}

fn parents(nodes: &[Node]) -> Result<Vec<Option<u32>>, Fault> {
    let mut parents = vec![None; nodes.len()];
    for (parent, node) in (0u32..).zip(nodes) {
        for (place, child) in node.children().enumerate() {
            let pointer = || format!("/nodes/{parent}/children/{place}");
            let slot = usize::try_from(child).ok().and_then(|child| parents.get_mut(child));
            match slot {
                None => return Err(out_of_range(&pointer(), "node", child, nodes.len())),
                Some(Some(before)) => {
                    let message = format!("Node {child} is the child of node {before} and of node {parent}.");
                    return Err(fault(&codes::GLTF_NODES_TANGLED, pointer(), message));
                }
                Some(slot) => *slot = Some(parent),
            }
        }
    }
    Ok(parents)
}

fn parents_first(parents: &[Option<u32>]) -> Result<Vec<u32>, Fault> {
    let order = scene::parents_first(parents, Some);
    if order.len() == parents.len() {
        return Ok(order);
    }
    let mut reached = vec![false; parents.len()];
    for &node in &order {
        reached[node as usize] = true;
    }
    let node = reached.iter().position(|reached| !reached).unwrap_or_default();
    let message = format!("Node {node} is below itself, or below nodes that are.");
    Err(fault(&codes::GLTF_NODES_TANGLED, format!("/nodes/{node}"), message))
}

/// The parts of a node's transform, and the transform itself.
fn transform(index: usize, node: &Node, diagnostics: &mut Diagnostics) -> (LocalJoint, DAffine3) {
    let mut broken = |key: &str, message: String| {
        let place = Place::pointer(format!("/nodes/{index}/{key}"));
        diagnostics.add(&codes::GLTF_RULE_BROKEN, place, message);
    };
    if let Some(numbers) = &node.matrix {
        if node.translation.is_some() || node.rotation.is_some() || node.scale.is_some() {
            broken(
                "matrix",
                format!("Node {index} has a matrix and its parts; the matrix is taken."),
            );
        }
        let matrix = Mat4::from_cols_array(numbers);
        if !matrix.is_finite() {
            broken(
                "matrix",
                format!("The matrix of node {index} is not finite; taken as none."),
            );
            return (LocalJoint::IDENTITY, DAffine3::IDENTITY);
        }
        let matrix: DMat4 = matrix.as_dmat4();
        if matrix.row(3) != DVec4::W {
            broken(
                "matrix",
                format!("The matrix of node {index} has a fourth row other than 0 0 0 1; left out."),
            );
        }
        let matrix = DAffine3::from_mat4(matrix);
        return (LocalJoint::from_matrix(&matrix), matrix);
    }
    let mut vector = |key: &str, numbers: Option<[f32; 3]>, default: Vec3| {
        let vector = numbers.map_or(default, Vec3::from_array);
        if vector.is_finite() {
            return vector;
        }
        broken(key, format!("The {key} of node {index} is not finite; taken as none."));
        default
    };
    let translation = vector("translation", node.translation, Vec3::ZERO);
    let scale = vector("scale", node.scale, Vec3::ONE);
    let stored = node.rotation.map_or(Quat::IDENTITY, Quat::from_array);
    let rotation = unit_rotation(stored).unwrap_or(Quat::IDENTITY);
    if !stored.is_finite() || (stored.length() - 1.0).abs() > UNIT_TOLERANCE {
        broken(
            "rotation",
            format!("The rotation of node {index} is not of unit length; brought to it."),
        );
    }
    let local = LocalJoint {
        rotation,
        translation,
        scale,
    };
    (local, local.parent_from_joint().as_daffine3())
}

/// Which nodes are below those that the default scene names: the one that the document says, or the first, or all there is.
fn in_scene(
    root: &Root,
    parents: &[Option<u32>],
    order: &[u32],
    diagnostics: &mut Diagnostics,
) -> Result<Vec<bool>, Fault> {
    let scenes = root.scenes();
    let index = match root.scene {
        Some(scene) => usize::try_from(scene.0).ok().filter(|&index| index < scenes.len()),
        None => Some(0),
    };
    let Some(index) = index else {
        let scene = root.scene.unwrap_or_default().0;
        return Err(out_of_range("/scene", "scene", scene, scenes.len()));
    };
    let Some(scene) = scenes.get(index) else {
        return Ok(vec![true; parents.len()]);
    };
    let mut in_scene = vec![false; parents.len()];
    for (place, node) in scene.nodes.iter().flatten().enumerate() {
        let pointer = format!("/scenes/{index}/nodes/{place}");
        let slot = usize::try_from(node.0).ok().and_then(|node| in_scene.get_mut(node));
        let Some(slot) = slot else {
            return Err(out_of_range(&pointer, "node", node.0, parents.len()));
        };
        *slot = true;
        if parents[node.0 as usize].is_some() {
            let message = format!(
                "Node {} of the scene is below another node; it is shown where that one has it.",
                node.0
            );
            diagnostics.add(&codes::GLTF_RULE_BROKEN, Place::pointer(pointer), message);
        }
    }
    mark_below(parents, order, &mut in_scene);
    Ok(in_scene)
}
