//! From nodes and skins to one skeleton.
//!
//! Joints are the nodes that skins name, those that carry meshes of their own, and all nodes above them. A node that two skins
//! bind in two ways has one inverse bind matrix all the same where the skins differ by one transform of all their joints, which
//! then goes into the vertices; otherwise a joint on the node stands in for it.

use std::cmp::Reverse;
use std::collections::{BTreeSet, BinaryHeap};

use glam::{DAffine3, DMat4, DVec4, Mat4};

use super::binding::{Binding, BoundSkin, is_invertible};
use super::nodes::Nodes;
use crate::diagnostic::Code;
use crate::diagnostic::codes;
use crate::diagnostic::collect::{Diagnostics, Place, Tally, counted};
use crate::gltf::{Fault, Path, Reader, Root, Wanted, fault, out_of_range};
use crate::model::Skeleton;

/// A mesh on a node of the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct MeshUse {
    pub(super) mesh: usize,
    pub(super) node: u32,
    pub(super) skin: Option<usize>,
}

/// The skeleton, and how meshes hang on it.
pub(super) struct Rig {
    pub(super) skeleton: Skeleton,
    pub(super) joint_of_node: Vec<Option<u32>>,
    /// Of each skin that is used: the joint of each of its slots, and what its vertices are moved by.
    pub(super) skins: Vec<Option<BoundSkin>>,
    /// Of each node that carries a mesh without a skin: its joint, and what the vertices are moved by.
    on_nodes: Vec<Option<(u32, DAffine3)>>,
}

impl Rig {
    /// The joint of a mesh without a skin, `None` in a model without joints; and what brings its vertices into bind space.
    pub(super) fn on_node(&self, node: u32, nodes: &Nodes) -> (Option<u32>, DAffine3) {
        match self.on_nodes.get(node as usize) {
            Some(&Some((joint, bind_from_mesh))) => (Some(joint), bind_from_mesh),
            _ => {
                let model_from_node = nodes.model_from_node[node as usize];
                (
                    None,
                    if model_from_node.is_finite() {
                        model_from_node
                    } else {
                        DAffine3::IDENTITY
                    },
                )
            }
        }
    }
}

/// The meshes of the scene, in the order of the file's meshes, then of its nodes.
///
/// # Errors
/// When a node names a mesh or a skin that is not there.
pub(super) fn meshes_in_scene(
    root: &Root,
    nodes: &Nodes,
    diagnostics: &mut Diagnostics,
) -> Result<Vec<MeshUse>, Fault> {
    let mut uses = Vec::new();
    for (node, of_file) in (0u32..).zip(root.nodes()) {
        let pointer = |key: &str| format!("/nodes/{node}/{key}");
        let mut broken = |key: &str, message: String| {
            diagnostics.add(&codes::GLTF_RULE_BROKEN, Place::pointer(pointer(key)), message);
        };
        let skin = match of_file.skin {
            None => None,
            Some(skin) => match usize::try_from(skin.0)
                .ok()
                .and_then(|index| Some((index, root.skins().get(index)?)))
            {
                None => return Err(out_of_range(&pointer("skin"), "skin", skin.0, root.skins().len())),
                Some((_, skin)) if skin.joints.is_empty() => {
                    broken(
                        "skin",
                        format!("The skin of node {node} has no joints; the mesh follows its node."),
                    );
                    None
                }
                Some((index, _)) => Some(index),
            },
        };
        let Some(mesh) = of_file.mesh else {
            if skin.is_some() {
                broken("skin", format!("Node {node} has a skin, but no mesh."));
            }
            continue;
        };
        let index = usize::try_from(mesh.0)
            .ok()
            .filter(|&index| index < root.meshes().len());
        let Some(mesh) = index else {
            return Err(out_of_range(&pointer("mesh"), "mesh", mesh.0, root.meshes().len()));
        };
        if !nodes.in_scene[node as usize] {
            continue;
        }
        let is_weighted = root.meshes()[mesh]
            .primitives
            .iter()
            .any(|part| part.attributes.contains_key("JOINTS_0"));
        if skin.is_some() && !is_weighted {
            broken(
                "skin",
                format!("Node {node} has a skin, but its mesh has no weights; the mesh follows its node."),
            );
        }
        uses.push(MeshUse {
            mesh,
            node,
            skin: skin.filter(|_| is_weighted),
        });
    }
    uses.sort();
    Ok(uses)
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

/// Which nodes are joints; none where nothing is skinned and nothing moves.
fn joint_nodes(root: &Root, nodes: &Nodes, uses: &[MeshUse]) -> Result<Vec<bool>, Fault> {
    let mut is_joint = vec![false; nodes.parents.len()];
    let moved = moved_nodes(root);
    let mut in_motion = moved.clone();
    nodes.mark_below(&mut in_motion);
    let moves = |mesh: &MeshUse| mesh.skin.is_some() || in_motion[mesh.node as usize];
    if !uses.is_empty() && !uses.iter().any(moves) {
        return Ok(is_joint);
    }
    let skins = if uses.is_empty() {
        (0..root.skins().len()).collect()
    } else {
        skins_of(uses)
    };
    for skin in skins {
        for (slot, node) in root.skins()[skin].joints.iter().enumerate() {
            let joint = usize::try_from(node.0).ok().and_then(|node| is_joint.get_mut(node));
            let Some(joint) = joint else {
                return Err(out_of_range(
                    &format!("/skins/{skin}/joints/{slot}"),
                    "node",
                    node.0,
                    nodes.parents.len(),
                ));
            };
            *joint = true;
        }
    }
    for mesh in uses.iter().filter(|mesh| is_on_node(root, mesh)) {
        is_joint[mesh.node as usize] = true;
    }
    if uses.is_empty() {
        for (joint, moved) in is_joint.iter_mut().zip(&moved) {
            *joint |= moved;
        }
    }
    nodes.mark_above(&mut is_joint);
    Ok(is_joint)
}

/// The skins that are used, each once.
fn skins_of(uses: &[MeshUse]) -> BTreeSet<usize> {
    uses.iter().filter_map(|mesh| mesh.skin).collect()
}

/// Whether parts of a mesh follow its node instead of a skin.
fn is_on_node(root: &Root, mesh: &MeshUse) -> bool {
    let parts = &root.meshes()[mesh.mesh].primitives;
    mesh.skin.is_none() || parts.iter().any(|part| !part.attributes.contains_key("JOINTS_0"))
}

/// The file's number of each joint's node: the numbers that the document gives them where it gives all, else their order.
fn bone_numbers(root: &Root, is_joint: &[bool]) -> Vec<Option<u32>> {
    let given = |node: usize| {
        let bone = root.nodes()[node]
            .extras
            .as_ref()?
            .get("bindpose")?
            .get("bone")?
            .as_u64()?;
        usize::try_from(bone).ok()
    };
    let joints: Vec<usize> = (0..is_joint.len()).filter(|&node| is_joint[node]).collect();
    let mut node_of_bone = vec![None; joints.len()];
    let mut all_given = true;
    for &node in &joints {
        match given(node).and_then(|bone| node_of_bone.get_mut(bone)) {
            Some(place @ None) => *place = Some(node),
            _ => all_given = false,
        }
    }
    let nodes: Vec<usize> = if all_given {
        node_of_bone.into_iter().flatten().collect()
    } else {
        joints
    };
    let mut numbers = vec![None; is_joint.len()];
    for (bone, node) in (0u32..).zip(nodes) {
        numbers[node] = Some(bone);
    }
    numbers
}

/// The joints' nodes with parents first: of those that may stand next, always the one with the lowest number.
fn joints_in_order(nodes: &Nodes, bones: &[Option<u32>]) -> Vec<u32> {
    let mut children = vec![Vec::new(); bones.len()];
    let mut ready = BinaryHeap::new();
    for (node, bone) in (0u32..).zip(bones) {
        let Some(bone) = *bone else { continue };
        match nodes.parents[node as usize] {
            Some(parent) => children[parent as usize].push(Reverse((bone, node))),
            None => ready.push(Reverse((bone, node))),
        }
    }
    let mut order = Vec::new();
    while let Some(Reverse((_, node))) = ready.pop() {
        order.push(node);
        ready.extend(children[node as usize].drain(..));
    }
    order
}

/// The skeleton of a scene.
///
/// # Errors
/// When a skin names what is not there, or its matrices cannot be read.
pub(super) fn rig(
    root: &Root,
    reader: &Reader<'_>,
    nodes: &Nodes,
    uses: &[MeshUse],
    diagnostics: &mut Diagnostics,
) -> Result<Rig, Fault> {
    let is_joint = joint_nodes(root, nodes, uses)?;
    let bones = bone_numbers(root, &is_joint);
    let order = joints_in_order(nodes, &bones);
    check_count(order.len(), "/nodes")?;
    let mut joint_of_node = vec![None; nodes.parents.len()];
    for (joint, &node) in (0u32..).zip(&order) {
        joint_of_node[node as usize] = Some(joint);
    }
    let parent_of = |node: u32| nodes.parents[node as usize].and_then(|parent| joint_of_node[parent as usize]);
    let mut model_at_rest: Vec<DAffine3> = Vec::with_capacity(order.len());
    for &node in &order {
        let model_from_parent = parent_of(node).map_or(DAffine3::IDENTITY, |parent| model_at_rest[parent as usize]);
        model_at_rest.push(model_from_parent * nodes.local[node as usize].parent_from_joint().as_daffine3());
    }
    let mut binding = Binding {
        model_at_rest,
        parents: order.iter().map(|&node| parent_of(node)).collect(),
        rest: order.iter().map(|&node| nodes.local[node as usize]).collect(),
        joint_from_bind: vec![None; order.len()],
    };
    let mut skins = vec![None; root.skins().len()];
    for skin in uses.iter().filter_map(|mesh| mesh.skin) {
        if skins[skin].is_none() {
            let matrices = inverse_bind_matrices(root, reader, skin, diagnostics)?;
            let joints = root.skins()[skin].joints.iter();
            // `joint_nodes` proved that they are nodes, and joints.
            let joints: Vec<u32> = joints.filter_map(|node| joint_of_node[node.0 as usize]).collect();
            skins[skin] = Some(binding.bind(&joints, &matrices));
        }
    }
    binding.place_others(order.len());
    let mut on_nodes = vec![None; nodes.parents.len()];
    for mesh in uses.iter().filter(|mesh| is_on_node(root, mesh)) {
        if let Some(joint) = joint_of_node[mesh.node as usize]
            && on_nodes[mesh.node as usize].is_none()
        {
            on_nodes[mesh.node as usize] = Some(binding.bind_on(joint));
        }
    }
    check_count(binding.parents.len(), "/skins")?;
    note(root, nodes, uses, diagnostics);
    let extra = binding.parents[order.len()..].iter().flatten();
    let node_of = order.iter().chain(extra.map(|&joint| &order[joint as usize]));
    let names = node_of.map(|&node| root.nodes()[node as usize].name.clone().unwrap_or_default());
    let names = names.collect();
    let mut file_bones: Vec<u32> = order.iter().filter_map(|&node| bones[node as usize]).collect();
    file_bones.extend(order.len() as u32..binding.parents.len() as u32);
    Ok(Rig {
        skeleton: binding.skeleton(file_bones, names)?,
        joint_of_node,
        skins,
        on_nodes,
    })
}

/// Refuses more joints than a vertex can name.
fn check_count(joints: usize, pointer: &str) -> Result<(), Fault> {
    if joints <= Skeleton::MOST_NAMED {
        return Ok(());
    }
    let most = Skeleton::MOST_NAMED;
    let message = format!("The skeleton has {joints} joints; vertices of glTF can name {most} at most.");
    Err(fault(&codes::GLTF_TOO_LARGE, pointer, message))
}

fn note(root: &Root, nodes: &Nodes, uses: &[MeshUse], diagnostics: &mut Diagnostics) {
    for skin in skins_of(uses) {
        let mut joints = root.skins()[skin].joints.iter();
        if let Some(outside) = joints.find(|node| !nodes.in_scene[node.0 as usize]) {
            let message = format!(
                "Joint node {} of skin {skin} is not in the scene; it is taken all the same.",
                outside.0
            );
            diagnostics.add(
                &codes::GLTF_RULE_BROKEN,
                Place::pointer(format!("/skins/{skin}/joints")),
                message,
            );
        }
    }
}

/// The matrices of a skin, one for each of its joints; identities where it has none.
fn inverse_bind_matrices(
    root: &Root,
    reader: &Reader<'_>,
    skin: usize,
    diagnostics: &mut Diagnostics,
) -> Result<Vec<DAffine3>, Fault> {
    let of_file = &root.skins()[skin];
    let pointer = format!("/skins/{skin}/inverseBindMatrices");
    let Some(accessor) = of_file.inverse_bind_matrices else {
        return Ok(vec![DAffine3::IDENTITY; of_file.joints.len()]);
    };
    let rows = reader.floats::<16>(accessor, Wanted::Floats, &pointer)?;
    if rows.len() < of_file.joints.len() {
        let message = format!(
            "Skin {skin} has {} joints, but {} inverse bind matrices.",
            of_file.joints.len(),
            rows.len()
        );
        return Err(fault(&codes::GLTF_ACCESSOR_OUT_OF_RANGE, pointer, message));
    }
    let (mut not_finite, mut not_affine, mut singular) = (Tally::default(), Tally::default(), Tally::default());
    let matrices = (0u32..).zip(&rows).take(of_file.joints.len()).map(|(slot, row)| {
        let matrix = Mat4::from_cols_array(row);
        if !matrix.is_finite() {
            not_finite.add(slot);
            return DAffine3::IDENTITY;
        }
        let matrix: DMat4 = matrix.as_dmat4();
        if !matrix.row(3).abs_diff_eq(DVec4::W, 1e-6) {
            not_affine.add(slot);
        }
        let matrix = DAffine3::from_mat4(matrix);
        if !is_invertible(&matrix) {
            singular.add(slot);
        }
        matrix
    });
    let matrices = matrices.collect();
    let mut warn = |code: &Code, tally: Tally, rule: &str| {
        if tally.count > 0 {
            let have = counted(tally.count, "inverse bind matrix has", "inverse bind matrices have");
            diagnostics.add(code, Place::pointer(pointer.clone()), format!("{have} {rule}"));
        }
    };
    warn(
        &codes::OFFSET_NOT_FINITE,
        not_finite,
        "a number that is not finite; the identity stands in.",
    );
    warn(
        &codes::OFFSET_NOT_AFFINE,
        not_affine,
        "a fourth row that is not 0 0 0 1; it was left out.",
    );
    warn(
        &codes::OFFSET_SINGULAR,
        singular,
        "no inverse; the joint's place in the bind pose is unknown.",
    );
    Ok(matrices)
}
