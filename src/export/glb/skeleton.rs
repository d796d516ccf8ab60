//! Bones as nodes, and the skin.

use serde_json::{Value, json};

use super::binary::{Binary, Target};
use super::number::numbers;
use super::space::Space;
use crate::model::{Influences, JointNames, LocalJoint, Model};

pub(super) struct Bones {
    pub(super) nodes: Vec<Value>,
    pub(super) roots: Vec<usize>,
    /// None without bones.
    pub(super) skin: Option<Value>,
    /// The joint that holds vertices without any weight, where there are such: glTF wants weights that sum to 1.
    pub(super) unmoving: Option<usize>,
}

/// Whether no joint moves a vertex.
pub(super) fn is_unweighted(influences: &Influences) -> bool {
    influences.weights == [0.0; 4]
}

pub(super) fn bones(model: &Model, names: &JointNames, space: &Space, binary: &mut Binary) -> Bones {
    let skeleton = &model.skeleton;
    let (mut nodes, mut matrices, mut roots) = (Vec::new(), Vec::new(), Vec::new());
    let mut children = vec![Vec::new(); skeleton.joint_count()];
    for (bone, joint) in skeleton.joint_of_bone().iter().enumerate() {
        match skeleton.parents()[joint.index()] {
            Some(parent) => children[skeleton.file_bones()[parent.index()] as usize].push(bone),
            None => roots.push(bone),
        }
    }
    for ((bone, &joint), children) in (0u32..).zip(skeleton.joint_of_bone()).zip(children) {
        let mut node = placed(&space.joint(&skeleton.rest()[joint.index()]));
        if let Some(name) = names.get(bone).or(skeleton.name(joint)) {
            node["name"] = json!(name);
        }
        if !children.is_empty() {
            node["children"] = json!(children);
        }
        node["extras"] = json!({ "bindpose": { "bone": bone } });
        nodes.push(node);
        let matrix = space.matrix(&skeleton.joint_from_bind()[joint.index()]);
        matrices.push(glam::Mat4::from(matrix).to_cols_array());
    }
    if nodes.is_empty() {
        return Bones {
            nodes,
            roots,
            skin: None,
            unmoving: None,
        };
    }
    let unmoving = model.mesh.influences.iter().any(is_unweighted).then(|| {
        roots.push(nodes.len());
        nodes.push(json!({ "name": "unmoving" }));
        matrices.push(glam::Mat4::IDENTITY.to_cols_array());
        nodes.len() - 1
    });
    let joints: Vec<usize> = (0..nodes.len()).collect();
    if roots.len() > 1 {
        nodes.push(json!({ "name": "skeleton", "children": roots }));
        roots = vec![nodes.len() - 1];
    }
    let matrices = binary.floats(&matrices, Target::Other, false);
    Bones {
        skin: Some(json!({ "joints": joints, "inverseBindMatrices": matrices })),
        nodes,
        roots,
        unmoving,
    }
}

fn placed(joint: &LocalJoint) -> Value {
    let mut node = json!({});
    let still = LocalJoint::IDENTITY;
    if joint.translation != still.translation {
        node["translation"] = numbers(joint.translation.to_array());
    }
    if joint.rotation != still.rotation {
        node["rotation"] = numbers(joint.rotation.to_array());
    }
    if joint.scale != still.scale {
        node["scale"] = numbers(joint.scale.to_array());
    }
    node
}
