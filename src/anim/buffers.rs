//! From a clip and a time to a palette: all stages in turn.

use glam::Affine3A;

use super::blend::blend_to_bind;
use super::compile::CompiledClip;
use super::pose::{LocalPose, ModelPose, Palette, local_to_model, palette};
use super::sample::sample;
use crate::model::Skeleton;

/// A pose in all three spaces, sized once for a skeleton.
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
    /// Buffers of the right size, at rest.
    pub fn for_skeleton(skeleton: &Skeleton) -> Self {
        let mut buffers = Self::default();
        buffers.set_rest_pose(skeleton);
        buffers
    }

    /// The pose of a clip of this skeleton at a time: `sample`, `local_to_model` and `palette` in turn. Allocates only when
    /// the buffers were sized for a smaller skeleton.
    pub fn evaluate(&mut self, skeleton: &Skeleton, clip: &CompiledClip, time_secs: f32) {
        sample(clip, time_secs, &mut self.local);
        self.place(skeleton);
    }

    /// Model pose and palette of the local pose: `local_to_model` and `palette` in turn.
    pub fn place(&mut self, skeleton: &Skeleton) {
        local_to_model(skeleton, &self.local, &mut self.model);
        palette(skeleton, &self.model, &mut self.palette);
    }

    /// Brings the pose toward the bind pose, whose `weight` is 0 to 1; see [`blend_to_bind`]. From 1 on it is
    /// the bind pose of [`PoseBuffers::set_bind_pose`], with the shear that joints have no part for.
    pub fn bring_toward_bind(&mut self, skeleton: &Skeleton, weight: f32) {
        if weight >= 1.0 {
            self.set_bind_pose(skeleton);
        } else if weight > 0.0 {
            blend_to_bind(skeleton, weight, &mut self.local);
            self.place(skeleton);
        }
    }

    /// The pose of a model without a clip: [`Skeleton::rest`]. Where that is the bind pose, [`PoseBuffers::set_bind_pose`].
    pub fn set_rest_pose(&mut self, skeleton: &Skeleton) {
        if skeleton.rests_in_bind_pose() {
            self.set_bind_pose(skeleton);
        } else {
            self.local.set_joints(skeleton.rest());
            self.place(skeleton);
        }
    }

    /// The pose in which the mesh was skinned. Its palette is the identity by meaning, so it is set and not computed.
    pub fn set_bind_pose(&mut self, skeleton: &Skeleton) {
        self.local.set_joints(skeleton.bind());
        self.model.0.clear();
        self.model.0.extend_from_slice(skeleton.bind_model_from_joint());
        self.palette.0.clear();
        self.palette.0.resize(skeleton.joint_count(), Affine3A::IDENTITY);
    }
}
