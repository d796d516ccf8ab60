//! From joints relative to the model to what moves a vertex.

use super::{ModelPose, Palette};
use crate::model::Skeleton;

/// `model_from_bind` of each joint; the books write it offset · toRoot, with row vectors.
pub fn palette(skeleton: &Skeleton, model: &ModelPose, palette: &mut Palette) {
    palette.0.clear();
    let joints = model.0.iter().zip(skeleton.joint_from_bind());
    palette
        .0
        .extend(joints.map(|(&model_from_joint, &joint_from_bind)| model_from_joint * joint_from_bind));
}
