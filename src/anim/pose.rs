//! A type for each space, so that poses cannot be swapped by mistake, and the functions from one to the next.

use glam::Affine3A;

use super::lanes::{JointLanes, MatrixLanes};
use crate::model::{JointIndex, LocalJoint, Skeleton};

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

/// `model_from_joint` of each joint: a forward pass, since parents come first. Joints that `local` lacks are at rest.
pub fn local_to_model(skeleton: &Skeleton, local: &LocalPose, model: &mut ModelPose) {
    model.0.resize(skeleton.joint_count(), Affine3A::IDENTITY);
    let model_from_joint = model.0.as_mut_slice();
    let posed = local.joint_count().min(skeleton.joint_count());
    let (posed_parents, unposed_parents) = skeleton.parents().split_at(posed);
    let (fours, rest) = posed_parents.as_chunks::<{ JointLanes::COUNT }>();
    for (group, (parents, joints)) in fours.iter().zip(&local.groups).enumerate() {
        let parent_from_joint = joints.parent_from_joint();
        // Written out, so that each lane is known.
        place(model_from_joint, group, 0, parents[0], &parent_from_joint);
        place(model_from_joint, group, 1, parents[1], &parent_from_joint);
        place(model_from_joint, group, 2, parents[2], &parent_from_joint);
        place(model_from_joint, group, 3, parents[3], &parent_from_joint);
    }
    if let Some(joints) = local.groups.get(fours.len()) {
        let parent_from_joint = joints.parent_from_joint();
        for (lane, parent) in rest.iter().enumerate() {
            place(model_from_joint, fours.len(), lane, *parent, &parent_from_joint);
        }
    }
    for (joint, (parent, rest)) in (posed..).zip(unposed_parents.iter().zip(&skeleton.rest()[posed..])) {
        model_from_joint[joint] = *placed(model_from_joint, *parent) * rest.parent_from_joint();
    }
}

/// Places the joint of one lane of a group on its parent, which is placed.
#[inline(always)]
fn place(
    model_from_joint: &mut [Affine3A],
    group: usize,
    lane: usize,
    parent: Option<JointIndex>,
    parent_from_joint: &MatrixLanes,
) {
    let joint = parent_from_joint.after(placed(model_from_joint, parent), lane);
    model_from_joint[group * JointLanes::COUNT + lane] = joint;
}

/// The parent's transform; the identity for a root.
#[inline]
fn placed(model_from_joint: &[Affine3A], parent: Option<JointIndex>) -> &Affine3A {
    parent.map_or(&Affine3A::IDENTITY, |parent| &model_from_joint[parent.index()])
}

/// `model_from_bind` of each joint; the books write it offset · toRoot, with row vectors.
pub fn palette(skeleton: &Skeleton, model: &ModelPose, palette: &mut Palette) {
    let count = model.0.len().min(skeleton.joint_count());
    // What is there is written over, so it is not cleared.
    palette.0.resize(count, Affine3A::IDENTITY);
    for (place, matrix) in palette.0.iter_mut().zip(palette_matrices(skeleton, model)) {
        *place = matrix;
    }
}

/// The matrices of [`palette`], in the skeleton's order.
#[inline]
pub(super) fn palette_matrices(skeleton: &Skeleton, model: &ModelPose) -> impl Iterator<Item = Affine3A> {
    let joints = model.0.iter().zip(skeleton.joint_from_bind());
    joints.map(|(&model_from_joint, &joint_from_bind)| model_from_joint * joint_from_bind)
}
