//! What stands between a format and the model: nodes, skins and uses of meshes, in the file's numbering. A format fills it; from it one code
//! makes skeleton, bindings and the mesh, whatever the format.

mod binding;
mod mesh;
mod skeleton;

use std::cmp::Reverse;
use std::collections::{BTreeSet, BinaryHeap};
use std::sync::Arc;

use glam::DAffine3;

pub(super) use binding::is_invertible;
pub(super) use mesh::{MeshBuilder, Vertices};
pub(super) use skeleton::Rig;

use crate::model::{LocalJoint, Tag};

/// A node of a scene.
#[derive(Clone, Debug)]
pub(super) struct Node {
    pub(super) tag: Tag,
    /// Relative to the parent, in parts.
    pub(super) local: LocalJoint,
    /// Relative to the model, with all that matrices say.
    pub(super) model_from_node: DAffine3,
    pub(super) in_scene: bool,
    /// Whether a clip moves it.
    pub(super) is_moved: bool,
    /// The number that it shall have among the bones. It counts where the numbers that all joints ask for are an order of them.
    pub(super) bone: Option<u32>,
}

/// Joints that move a mesh.
#[derive(Clone, Debug)]
pub(super) struct Skin {
    /// The node of each of its slots.
    pub(super) joints: Vec<u32>,
    /// The inverse bind matrix of each slot: the mesh's space -> the joint's. None are needed where no mesh uses the skin.
    pub(super) joint_from_mesh: Vec<DAffine3>,
}

/// A mesh on a node of the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct MeshUse {
    pub(super) mesh: usize,
    pub(super) node: u32,
    pub(super) skin: Option<usize>,
    /// Whether parts of it follow the node instead of a skin.
    pub(super) is_on_node: bool,
}

/// Nodes with what hangs on them. Every index is proved.
#[derive(Debug, Default)]
pub(super) struct Scene {
    pub(super) nodes: Vec<Node>,
    /// Of each node.
    pub(super) parents: Vec<Option<u32>>,
    /// All nodes, parents before children.
    pub(super) order: Vec<u32>,
    /// Of each mesh of the file.
    pub(super) meshes: Vec<Arc<Tag>>,
    /// In the order of the file's skins; `None` for one that no mesh uses, unless there are no meshes.
    pub(super) skins: Vec<Option<Skin>>,
    /// In the order of the file's meshes, then of its nodes.
    pub(super) uses: Vec<MeshUse>,
}

/// Numbers in an order in which parents come first: of those that may stand next, always the one with the lowest rank. What has no rank is
/// left out with all below it, and so is what no root reaches.
pub(super) fn parents_first(parents: &[Option<u32>], rank: impl Fn(u32) -> Option<u32>) -> Vec<u32> {
    let mut children = vec![Vec::new(); parents.len()];
    let mut ready = BinaryHeap::new();
    for (number, parent) in (0u32..).zip(parents) {
        let Some(rank) = rank(number) else { continue };
        match parent {
            Some(parent) => children[*parent as usize].push(Reverse((rank, number))),
            None => ready.push(Reverse((rank, number))),
        }
    }
    let mut order = Vec::new();
    while let Some(Reverse((_, number))) = ready.pop() {
        order.push(number);
        ready.extend(children[number as usize].drain(..));
    }
    order
}

/// Marks all that is below a marked node. `order` has parents before their children.
pub(super) fn mark_below(parents: &[Option<u32>], order: &[u32], marked: &mut [bool]) {
    for &node in order {
        if let Some(parent) = parents[node as usize] {
            marked[node as usize] |= marked[parent as usize];
        }
    }
}

impl Scene {
    /// Marks all that is above a marked node.
    pub(super) fn mark_above(&self, marked: &mut [bool]) {
        for &node in self.order.iter().rev() {
            if let (true, Some(parent)) = (marked[node as usize], self.parents[node as usize]) {
                marked[parent as usize] = true;
            }
        }
    }

    /// The skins that are used, each once.
    pub(super) fn used_skins(&self) -> BTreeSet<usize> {
        self.uses.iter().filter_map(|mesh| mesh.skin).collect()
    }

    /// Which nodes are joints: those that skins name, those that carry meshes of their own, and all nodes above them. None where nothing is
    /// skinned and nothing moves; without a mesh all that skins name or clips move.
    fn joint_nodes(&self) -> Vec<bool> {
        let mut is_joint = vec![false; self.nodes.len()];
        let moved: Vec<bool> = self.nodes.iter().map(|node| node.is_moved).collect();
        let mut in_motion = moved.clone();
        mark_below(&self.parents, &self.order, &mut in_motion);
        let moves = |mesh: &MeshUse| mesh.skin.is_some() || in_motion[mesh.node as usize];
        if !self.uses.is_empty() && !self.uses.iter().any(moves) {
            return is_joint;
        }
        for &node in self.skins.iter().flatten().flat_map(|skin| &skin.joints) {
            is_joint[node as usize] = true;
        }
        for mesh in self.uses.iter().filter(|mesh| mesh.is_on_node) {
            is_joint[mesh.node as usize] = true;
        }
        if self.uses.is_empty() {
            for (joint, moved) in is_joint.iter_mut().zip(&moved) {
                *joint |= moved;
            }
        }
        self.mark_above(&mut is_joint);
        is_joint
    }

    /// The number of each joint's node: those that the nodes ask for where all do, else their order.
    fn bone_numbers(&self, is_joint: &[bool]) -> Vec<Option<u32>> {
        let joints: Vec<usize> = (0..is_joint.len()).filter(|&node| is_joint[node]).collect();
        let mut node_of_bone = vec![None; joints.len()];
        let mut all_given = true;
        for &node in &joints {
            let place = self.nodes[node]
                .bone
                .and_then(|bone| node_of_bone.get_mut(bone as usize));
            match place {
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
}
