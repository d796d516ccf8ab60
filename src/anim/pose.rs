//! A type for each space, so that poses cannot be swapped by mistake.

use glam::Affine3A;

use super::{local_to_model, palette, sample};
use crate::model::{Clip, LocalJoint, Skeleton};

/// Each joint relative to its parent: `parent_from_joint`, kept in parts.
#[derive(Clone, Debug, Default)]
pub struct LocalPose {
    /// One per joint.
    pub joints: Vec<LocalJoint>,
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

impl PoseBuffers {
    /// Buffers of the right size, in the bind pose: the skeleton at rest, and a palette of identities.
    pub fn for_skeleton(skeleton: &Skeleton) -> Self {
        let mut buffers = Self::default();
        buffers.set_bind_pose(skeleton);
        buffers
    }

    /// The pose of a clip of this skeleton at a time: `sample`, `local_to_model` and `palette` in turn. Allocates only when
    /// the buffers were sized for a smaller skeleton.
    pub fn evaluate(&mut self, skeleton: &Skeleton, clip: &Clip, time_secs: f32) {
        sample(clip, time_secs, &mut self.local);
        local_to_model(skeleton, &self.local, &mut self.model);
        palette(skeleton, &self.model, &mut self.palette);
    }

    /// The pose in which the mesh was skinned. Its palette is the identity by meaning, so it is set and not computed.
    pub fn set_bind_pose(&mut self, skeleton: &Skeleton) {
        self.local.joints.clear();
        self.local.joints.extend_from_slice(skeleton.rest());
        self.model.0.clear();
        self.model.0.extend_from_slice(skeleton.bind_model_from_joint());
        self.palette.0.clear();
        self.palette.0.resize(skeleton.joint_count(), Affine3A::IDENTITY);
    }
}
