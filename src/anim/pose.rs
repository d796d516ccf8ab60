//! A type for each space, so that poses cannot be swapped by mistake.

use glam::Affine3A;

use super::{blend_to_rest, local_to_model, palette, sample};
use crate::model::{Clip, JointLanes, LocalJoint, Skeleton};

/// Each joint relative to its parent: `parent_from_joint`, kept in parts, four joints side by side.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LocalPose {
    /// Joints 0 to 3, joints 4 to 7 and so on. What the lanes behind the last joint hold means nothing.
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

    /// Sets the number of joints. What new ones are is not told until they are written.
    pub fn resize(&mut self, joint_count: usize) {
        self.groups
            .resize(joint_count.div_ceil(JointLanes::COUNT), JointLanes::IDENTITY);
        self.joint_count = joint_count;
    }

    /// Takes on these joints.
    pub fn set_joints(&mut self, joints: &[LocalJoint]) {
        self.resize(joints.len());
        for (group, joints) in self.groups.iter_mut().zip(joints.chunks(JointLanes::COUNT)) {
            for (lane, &joint) in joints.iter().enumerate() {
                group.set_joint(lane, joint);
            }
        }
    }
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
        self.place(skeleton);
    }

    /// Model pose and palette of the local pose: `local_to_model` and `palette` in turn.
    pub fn place(&mut self, skeleton: &Skeleton) {
        local_to_model(skeleton, &self.local, &mut self.model);
        palette(skeleton, &self.model, &mut self.palette);
    }

    /// The pose of a clip at a time, brought `bind_share` of the way to the bind pose; see
    /// [`PoseBuffers::bring_toward_bind`].
    pub fn evaluate_toward_bind(&mut self, skeleton: &Skeleton, clip: &Clip, time_secs: f32, bind_share: f32) {
        self.evaluate(skeleton, clip, time_secs);
        self.bring_toward_bind(skeleton, bind_share);
    }

    /// Brings the pose `bind_share` of the way to the bind pose; see [`blend_to_rest`]. From 1 on it is
    /// the bind pose of [`PoseBuffers::set_bind_pose`], with the shear that rest has no part for.
    pub fn bring_toward_bind(&mut self, skeleton: &Skeleton, bind_share: f32) {
        if bind_share >= 1.0 {
            self.set_bind_pose(skeleton);
        } else if bind_share > 0.0 {
            blend_to_rest(skeleton, bind_share, &mut self.local);
            self.place(skeleton);
        }
    }

    /// The pose in which the mesh was skinned. Its palette is the identity by meaning, so it is set and not computed.
    pub fn set_bind_pose(&mut self, skeleton: &Skeleton) {
        self.local.set_joints(skeleton.rest());
        self.model.0.clear();
        self.model.0.extend_from_slice(skeleton.bind_model_from_joint());
        self.palette.0.clear();
        self.palette.0.resize(skeleton.joint_count(), Affine3A::IDENTITY);
    }
}
