//! From joints relative to their parents to joints relative to the model.

use super::{LocalPose, ModelPose};
use crate::model::Skeleton;

/// `model_from_joint` of each joint: a forward pass, since parents come first. Joints that `local` lacks are at rest.
pub fn local_to_model(skeleton: &Skeleton, local: &LocalPose, model: &mut ModelPose) {
    let model_from_joint = &mut model.0;
    model_from_joint.clear();
    for (index, (parent, rest)) in skeleton.parents().iter().zip(skeleton.rest()).enumerate() {
        let parent_from_joint = local.joints.get(index).unwrap_or(rest).parent_from_joint();
        model_from_joint.push(match parent {
            Some(parent) => model_from_joint[parent.index()] * parent_from_joint,
            None => parent_from_joint,
        });
    }
}
