//! The three stages in turn.

use super::{PoseBuffers, local_to_model, palette, sample};
use crate::model::{Clip, Model};

/// The pose of a clip of this model at a time: `sample`, `local_to_model` and `palette`. Allocates only when the buffers
/// were sized for a smaller skeleton.
pub fn evaluate(model: &Model, clip: &Clip, time_secs: f32, buffers: &mut PoseBuffers) {
    sample(clip, time_secs, &mut buffers.local);
    local_to_model(&model.skeleton, &buffers.local, &mut buffers.model);
    palette(&model.skeleton, &buffers.model, &mut buffers.palette);
}

/// The pose in which the model was skinned: every matrix of the palette is the identity.
pub fn evaluate_bind_pose(model: &Model, buffers: &mut PoseBuffers) {
    buffers.set_bind_pose(&model.skeleton);
}
