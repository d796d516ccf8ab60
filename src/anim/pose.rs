//! A type for each space, so that poses cannot be swapped by mistake.

use glam::{Affine3A, Quat, Vec3};

/// Each joint relative to its parent: `parent_from_joint`, kept in parts.
#[derive(Clone, Debug, Default)]
pub struct LocalPose {
    /// One per joint.
    pub joints: Vec<LocalJoint>,
}

/// One joint relative to its parent: scale, then rotate, then translate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LocalJoint {
    /// Unit rotation.
    pub rotation: Quat,
    /// Translation in the parent's space.
    pub translation: Vec3,
    /// Scale along the joint's own axes.
    pub scale: Vec3,
}

/// Each joint relative to the model: `model_from_joint`.
#[derive(Clone, Debug, Default)]
pub struct ModelPose(pub Vec<Affine3A>);

/// What moves a vertex: `model_from_bind = model_from_joint * joint_from_bind`, one per joint in the skeleton's order.
#[derive(Clone, Debug, Default)]
pub struct Palette(pub Vec<Affine3A>);

/// All three, sized once for a skeleton.
#[derive(Clone, Debug, Default)]
pub struct PoseBuffers {
    /// Output of `sample`.
    pub local: LocalPose,
    /// Output of `local_to_model`.
    pub model: ModelPose,
    /// Output of `palette`.
    pub palette: Palette,
}
