//! Joints, parents before children.

use glam::Affine3A;

/// Index of a joint in its skeleton (parents-first order).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct JointIndex(pub u32);

impl JointIndex {
    /// For indexing slices.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// A hierarchy of joints: every parent has a lower index than its children. Several roots are fine.
#[derive(Clone, Debug, Default)]
pub struct Skeleton {
    pub(super) parents: Vec<Option<JointIndex>>,
    pub(super) joint_from_bind: Vec<Affine3A>,
    pub(super) file_bones: Vec<u32>,
}

impl Skeleton {
    /// Number of joints.
    pub fn joint_count(&self) -> usize {
        self.parents.len()
    }

    /// Parent of each joint.
    pub fn parents(&self) -> &[Option<JointIndex>] {
        &self.parents
    }

    /// Inverse bind matrix of each joint: bind space -> joint space.
    pub fn joint_from_bind(&self) -> &[Affine3A] {
        &self.joint_from_bind
    }

    /// The file's bone number of each joint, for display and for outputs in the file's order.
    pub fn file_bones(&self) -> &[u32] {
        &self.file_bones
    }
}
