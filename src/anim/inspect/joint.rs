//! One joint in a pose: numbers, and the same as text to copy.

use super::parts::TransformParts;
use super::table::RowMatrix;
use crate::anim::buffers::PoseBuffers;
use crate::model::{JointIndex, JointTree, Skeleton};

/// A joint in a pose.
#[derive(Clone, Debug, PartialEq)]
pub struct JointReadout {
    /// Which.
    pub joint: JointIndex,
    /// Its number in the file.
    pub bone: u32,
    /// Its parent's number in the file.
    pub parent_bone: Option<u32>,
    /// Its children's numbers in the file, in the skeleton's order.
    pub child_bones: Vec<u32>,
    /// Relative to its parent.
    pub local: TransformParts,
    /// Relative to the model.
    pub model: TransformParts,
    /// The file's offset: bind space -> joint.
    pub offset: RowMatrix,
    /// Joint -> parent.
    pub to_parent: RowMatrix,
    /// Joint -> model.
    pub to_root: RowMatrix,
    /// What moves a vertex: offset · toRoot.
    pub final_transform: RowMatrix,
}

impl JointReadout {
    /// A joint of a skeleton in a pose of that skeleton. None where there is no such joint or the pose is of a smaller one.
    pub fn of(skeleton: &Skeleton, tree: &JointTree, pose: &PoseBuffers, joint: JointIndex) -> Option<Self> {
        let index = joint.index();
        let bone_of = |joint: JointIndex| skeleton.file_bones().get(joint.index()).copied();
        let local = pose.local.joints().nth(index)?;
        let model_from_joint = pose.model.0.get(index)?;
        Some(Self {
            joint,
            bone: bone_of(joint)?,
            parent_bone: skeleton.parents()[index].and_then(bone_of),
            child_bones: tree.children(joint).filter_map(bone_of).collect(),
            local: TransformParts::of_joint(&local),
            model: TransformParts::of_matrix(model_from_joint),
            offset: RowMatrix::from(skeleton.joint_from_bind()[index]),
            to_parent: RowMatrix::from(local.parent_from_joint()),
            to_root: RowMatrix::from(*model_from_joint),
            final_transform: RowMatrix::from(*pose.palette.0.get(index)?),
        })
    }

    /// All of it as lines to copy, the matrices by the books' names.
    pub fn to_text(&self) -> String {
        let parent = match self.parent_bone {
            Some(parent) => format!("parent {parent}"),
            None => "root".to_owned(),
        };
        let children = match self.child_bones.as_slice() {
            [] => "no children".to_owned(),
            bones => {
                let bones: Vec<_> = bones.iter().map(u32::to_string).collect();
                format!("children {}", bones.join(", "))
            }
        };
        let Self {
            bone,
            local,
            model,
            offset,
            to_parent,
            to_root,
            final_transform,
            ..
        } = self;
        format!(
            "bone {bone}; {parent}; {children}\n\nrelative to the parent\n{}\nrelative to the model\n{}\n{}\n{}\n{}\n{}",
            local.to_text(),
            model.to_text(),
            offset.to_text("offset"),
            to_parent.to_text("toParent"),
            to_root.to_text("toRoot"),
            final_transform.to_text("finalTransform = offset · toRoot"),
        )
    }
}
