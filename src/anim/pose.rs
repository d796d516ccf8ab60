//! A type for each space, so that poses cannot be swapped by mistake.

use glam::Affine3A;

use super::lanes::JointLanes;
use crate::model::LocalJoint;

/// Each joint relative to its parent: `parent_from_joint`, kept in parts, four joints side by side.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LocalPose {
    /// Joints 0 to 3, joints 4 to 7 and so on. The contents of the lanes behind the last joint are unspecified.
    pub groups: Vec<JointLanes>,
    joint_count: usize,
}

impl LocalPose {
    /// Number of joints, at most four for each group.
    pub fn joint_count(&self) -> usize {
        self.joint_count.min(self.groups.len() * JointLanes::COUNT)
    }

    /// Each joint on its own, in the skeleton's order.
    pub fn joints(&self) -> impl Iterator<Item = LocalJoint> {
        let lanes = self
            .groups
            .iter()
            .flat_map(|group| (0..JointLanes::COUNT).map(|lane| group.joint(lane)));
        lanes.take(self.joint_count())
    }

    /// Sets the number of joints. The contents of new joints are unspecified.
    pub fn resize(&mut self, joint_count: usize) {
        self.groups
            .resize(joint_count.div_ceil(JointLanes::COUNT), JointLanes::IDENTITY);
        self.joint_count = joint_count;
    }

    /// Becomes the pose of these joints.
    pub fn set_joints(&mut self, joints: &[LocalJoint]) {
        self.groups.clear();
        self.groups
            .extend(joints.chunks(JointLanes::COUNT).map(JointLanes::from_joints));
        self.joint_count = joints.len();
    }
}

/// Each joint relative to the model: `model_from_joint`.
#[derive(Clone, Debug, Default)]
pub struct ModelPose(pub Vec<Affine3A>);

/// What moves a vertex: `model_from_bind = model_from_joint * joint_from_bind`, one per joint in the skeleton's order.
#[derive(Clone, Debug, Default)]
pub struct Palette(pub Vec<Affine3A>);
