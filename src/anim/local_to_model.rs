//! From joints relative to their parents to joints relative to the model.

use glam::Affine3A;

use super::{LocalPose, ModelPose};
use crate::model::Skeleton;

/// `model_from_joint` of each joint: a forward pass, since parents come first. Joints that `local` lacks are at rest.
pub fn local_to_model(skeleton: &Skeleton, local: &LocalPose, model: &mut ModelPose) {
    model.0.resize(skeleton.joint_count(), Affine3A::IDENTITY);
    for (index, (parent, rest)) in skeleton.parents().iter().zip(skeleton.rest()).enumerate() {
        let parent_from_joint = local.joints.get(index).unwrap_or(rest).parent_from_joint();
        model.0[index] = match parent {
            Some(parent) => model.0[parent.index()] * parent_from_joint,
            None => parent_from_joint,
        };
    }
}
