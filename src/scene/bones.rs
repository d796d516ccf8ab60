//! The skeleton as bones in the world: from each joint to its children, and a stub where it has none.

use glam::{Affine3A, Vec3};

use crate::anim::ModelPose;
use crate::model::{JointIndex, Skeleton};

/// Length of a stub, as a fraction of the bone before it.
const STUB_LENGTH: f32 = 0.5;
/// Longest stub, as a fraction of the scene's radius: a long bone before a leaf must not reach out of the model.
const LONGEST_STUB: f32 = 0.06;
/// Bones shorter than this fraction of the scene's radius have no direction to show.
const LEAST_LENGTH: f32 = 1e-6;

/// One bone, world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bone {
    /// The joint that it turns with.
    pub joint: JointIndex,
    /// Where that joint is.
    pub from: Vec3,
    /// Where a child is, or the end of a stub.
    pub to: Vec3,
}

/// All bones of a pose, in buffers that are used again.
#[derive(Clone, Debug, Default)]
pub struct Bones {
    bones: Vec<Bone>,
    world_from_joint: Vec<Affine3A>,
    has_bone: Vec<bool>,
    parents: Vec<Option<JointIndex>>,
    scene_radius: f32,
}

impl Bones {
    /// Updates the bones to a pose of a skeleton. `scene_radius`, in world units, sets the size of stubs that no bone
    /// gives a length.
    pub fn place(&mut self, skeleton: &Skeleton, pose: &ModelPose, world_from_model: Affine3A, scene_radius: f32) {
        self.scene_radius = scene_radius.max(f32::MIN_POSITIVE);
        self.parents.clear();
        self.parents.extend_from_slice(skeleton.parents());
        self.world_from_joint.clear();
        let posed = pose.0.iter().take(skeleton.joint_count());
        self.world_from_joint
            .extend(posed.map(|&model_from_joint| world_from_model * model_from_joint));
        self.has_bone.clear();
        self.has_bone.resize(self.world_from_joint.len(), false);
        self.bones.clear();
        for (joint, parent) in self.parents.iter().enumerate().take(self.world_from_joint.len()) {
            let Some(parent) = *parent else { continue };
            let bone = Bone {
                joint: parent,
                from: self.world_from_joint[parent.index()].translation.into(),
                to: self.world_from_joint[joint].translation.into(),
            };
            if self.has_length(bone.from, bone.to) {
                self.bones.push(bone);
                self.has_bone[parent.index()] = true;
            }
        }
        for joint in (0..self.world_from_joint.len() as u32).map(JointIndex) {
            if !self.has_bone[joint.index()] {
                self.bones.push(self.stub(joint));
            }
        }
    }

    /// Each bone.
    pub fn bones(&self) -> &[Bone] {
        &self.bones
    }

    /// Joint space -> world, for each joint.
    pub fn world_from_joint(&self) -> &[Affine3A] {
        &self.world_from_joint
    }

    /// Where a joint is, world space.
    pub fn position(&self, joint: JointIndex) -> Option<Vec3> {
        let world_from_joint = self.world_from_joint.get(joint.index())?;
        Some(world_from_joint.translation.into())
    }

    /// Parent of each joint.
    pub fn parents(&self) -> &[Option<JointIndex>] {
        &self.parents
    }

    /// The scene's radius as given to [`place`](Self::place), above 0.
    pub fn scene_radius(&self) -> f32 {
        self.scene_radius
    }

    /// A stub in the direction from the nearest ancestor at another place; along the joint's own y where there is none.
    fn stub(&self, joint: JointIndex) -> Bone {
        let world_from_joint = &self.world_from_joint[joint.index()];
        let from = Vec3::from(world_from_joint.translation);
        let longest = self.scene_radius * LONGEST_STUB;
        let before = std::iter::successors(self.parents[joint.index()], |at| self.parents[at.index()]);
        let before = before.map(|before| Vec3::from(self.world_from_joint[before.index()].translation));
        let way = match before.into_iter().find(|&before| self.has_length(before, from)) {
            Some(before) => ((from - before) * STUB_LENGTH).clamp_length_max(longest),
            None => Vec3::from(world_from_joint.matrix3.y_axis).normalize_or(Vec3::Y) * longest,
        };
        Bone {
            joint,
            from,
            to: from + way,
        }
    }

    fn has_length(&self, from: Vec3, to: Vec3) -> bool {
        from.distance(to) > self.scene_radius * LEAST_LENGTH
    }
}
