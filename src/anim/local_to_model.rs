//! From joints relative to their parents to joints relative to the model, and on to what moves a vertex.

use glam::Affine3A;

use super::lanes::JointLanes;
use super::pose::{LocalPose, ModelPose, Palette};
use crate::model::{JointIndex, Skeleton};

/// `model_from_joint` of each joint: a forward pass, since parents come first. Joints that `local` lacks are at rest.
pub fn local_to_model(skeleton: &Skeleton, local: &LocalPose, model: &mut ModelPose) {
    model.0.resize(skeleton.joint_count(), Affine3A::IDENTITY);
    let model_from_joint = model.0.as_mut_slice();
    let posed = local.joint_count().min(skeleton.joint_count());
    let (posed_parents, unposed_parents) = skeleton.parents().split_at(posed);
    for (group, (parents, joints)) in posed_parents.chunks(JointLanes::COUNT).zip(&local.groups).enumerate() {
        let parent_from_joint = joints.parent_from_joint();
        for (lane, parent) in parents.iter().enumerate() {
            let model_from_parent = placed(model_from_joint, *parent);
            model_from_joint[group * JointLanes::COUNT + lane] = parent_from_joint.after(model_from_parent, lane);
        }
    }
    for (joint, (parent, rest)) in (posed..).zip(unposed_parents.iter().zip(&skeleton.rest()[posed..])) {
        model_from_joint[joint] = *placed(model_from_joint, *parent) * rest.parent_from_joint();
    }
}

/// Where the parent stands; a root stands on the model itself.
#[inline]
fn placed(model_from_joint: &[Affine3A], parent: Option<JointIndex>) -> &Affine3A {
    parent.map_or(&Affine3A::IDENTITY, |parent| &model_from_joint[parent.index()])
}

/// `model_from_bind` of each joint; the books write it offset · toRoot, with row vectors.
pub fn palette(skeleton: &Skeleton, model: &ModelPose, palette: &mut Palette) {
    palette.0.clear();
    let joints = model.0.iter().zip(skeleton.joint_from_bind());
    palette
        .0
        .extend(joints.map(|(&model_from_joint, &joint_from_bind)| model_from_joint * joint_from_bind));
}
