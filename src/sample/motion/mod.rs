//! The clips. Each is a function from phase to pose, sampled at 30 keys a second.

mod bake;
mod curve;
mod gait;
mod idle;
mod leg;
mod pose;
mod wave;

use super::rig::Rig;
use crate::format::AnimationClip;

/// All clips, the one to greet with first.
pub(super) fn clips(rig: &Rig) -> Vec<AnimationClip> {
    vec![
        bake::clip(rig, "Walk", gait::WALK.key_spans, |phase| gait::WALK.pose(rig, phase)),
        bake::clip(rig, "Run", gait::RUN.key_spans, |phase| gait::RUN.pose(rig, phase)),
        bake::clip(rig, "Wave", wave::KEY_SPANS, |phase| wave::pose(rig, phase)),
        bake::clip(rig, "Idle", idle::KEY_SPANS, |phase| idle::pose(rig, phase)),
    ]
}
