//! From nodes and skins to one skeleton.
//!
//! A node that two skins bind in two ways has one inverse bind matrix all the same where the skins differ by one transform of all their
//! joints, which then goes into the vertices; otherwise a joint on the node stands in for it.

use glam::DAffine3;

use super::binding::{Binding, BoundSkin};
use super::{MeshUse, Scene, parents_first};
use crate::diagnostic::Fault;
use crate::model::{Influences, Skeleton};

/// The skeleton, and how meshes hang on it.
pub(in crate::import) struct Rig {
    pub(in crate::import) skeleton: Skeleton,
    pub(in crate::import) joint_of_node: Vec<Option<u32>>,
    /// A joint that stands in for another has its node.
    pub(in crate::import) node_of_joint: Vec<u32>,
    /// Of each skin that is used: the joint of each of its slots, and what its vertices are moved by.
    skins: Vec<Option<BoundSkin>>,
    /// Of each node that carries a mesh without a skin: its joint, `None` in a model without joints, and what the vertices are moved by.
    on_nodes: Vec<(Option<u32>, DAffine3)>,
}

impl Rig {
    /// The skeleton of a scene.
    ///
    /// # Errors
    /// When the joints are no skeleton.
    pub(in crate::import) fn new(scene: &Scene) -> Result<Self, Fault> {
        let bones = scene.bone_numbers(&scene.joint_nodes());
        let order = parents_first(&scene.parents, |node| bones[node as usize]);
        let mut joint_of_node = vec![None; scene.nodes.len()];
        for (joint, &node) in (0u32..).zip(&order) {
            joint_of_node[node as usize] = Some(joint);
        }
        let parent_of = |node: u32| scene.parents[node as usize].and_then(|parent| joint_of_node[parent as usize]);
        let mut model_at_rest: Vec<DAffine3> = Vec::with_capacity(order.len());
        for &node in &order {
            let model_from_parent = parent_of(node).map_or(DAffine3::IDENTITY, |parent| model_at_rest[parent as usize]);
            let local = scene.nodes[node as usize].local;
            model_at_rest.push(model_from_parent * local.parent_from_joint().as_daffine3());
        }
        let mut binding = Binding {
            model_at_rest,
            parents: order.iter().map(|&node| parent_of(node)).collect(),
            rest: order.iter().map(|&node| scene.nodes[node as usize].local).collect(),
            joint_from_bind: vec![None; order.len()],
        };
        let mut skins = vec![None; scene.skins.len()];
        for index in scene.uses.iter().filter_map(|mesh| mesh.skin) {
            if let (None, Some(skin)) = (&skins[index], &scene.skins[index]) {
                let joints = skin.joints.iter().filter_map(|&node| joint_of_node[node as usize]);
                let joints: Vec<u32> = joints.collect();
                skins[index] = Some(binding.bind(&joints, &skin.joint_from_mesh));
            }
        }
        binding.place_others(order.len());
        let mut on_nodes: Vec<(Option<u32>, DAffine3)> = Vec::new();
        on_nodes.resize(scene.nodes.len(), (None, DAffine3::IDENTITY));
        for mesh in scene.uses.iter().filter(|mesh| mesh.is_on_node) {
            let node = mesh.node as usize;
            let model_from_node = scene.nodes[node].model_from_node;
            on_nodes[node] = match joint_of_node[node] {
                Some(joint) => binding.bind_on(joint),
                None if model_from_node.is_finite() => (None, model_from_node),
                None => (None, DAffine3::IDENTITY),
            };
        }
        let extra = binding.parents[order.len()..].iter().flatten();
        let node_of = order.iter().chain(extra.map(|&joint| &order[joint as usize]));
        let node_of_joint: Vec<u32> = node_of.copied().collect();
        let names = node_of_joint
            .iter()
            .map(|&node| scene.nodes[node as usize].tag.name.clone());
        let names = names.collect();
        let mut file_bones: Vec<u32> = order.iter().filter_map(|&node| bones[node as usize]).collect();
        file_bones.extend(order.len() as u32..binding.parents.len() as u32);
        Ok(Self {
            skeleton: binding.skeleton(file_bones, names)?,
            joint_of_node,
            node_of_joint,
            skins,
            on_nodes,
        })
    }

    /// The joint of each slot of the skin of a mesh, where its skin moves it.
    pub(in crate::import) fn slots(&self, mesh: &MeshUse, is_skinned: bool) -> Option<&[u32]> {
        Some(&self.skin(mesh, is_skinned)?.joints)
    }

    /// What brings the vertices of a mesh into bind space: of those parts that its skin moves, or of the others.
    pub(in crate::import) fn placement(&self, mesh: &MeshUse, is_skinned: bool) -> DAffine3 {
        let skin = self.skin(mesh, is_skinned);
        skin.map_or(self.on_nodes[mesh.node as usize].1, |skin| skin.bind_from_mesh)
    }

    /// The influences of a vertex that follows the node of its mesh; `None` in a model without joints.
    pub(in crate::import) fn influences_on(&self, node: u32) -> Option<Influences> {
        let joint = self.on_nodes[node as usize].0?;
        Some(Influences {
            joints: [joint, 0, 0, 0],
            weights: [1.0, 0.0, 0.0, 0.0],
        })
    }

    fn skin(&self, mesh: &MeshUse, is_skinned: bool) -> Option<&BoundSkin> {
        self.skins[mesh.skin.filter(|_| is_skinned)?].as_ref()
    }
}
