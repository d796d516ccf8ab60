//! A clip at a time.

use super::compile::{CompiledClip, TrackGroup};
use super::lanes::JointLanes;
use super::pose::LocalPose;
use crate::model::{JointIndex, LocalJoint, Skeleton};

/// Each joint of a clip at `time_secs`: translation and scale blended in a straight line, rotation along the shorter arc
/// at even speed. Before its first and after its last key a track holds that key. NaN is the start.
///
/// The result does not depend on earlier calls, so scrubbing costs the same as playing.
pub fn sample(clip: &CompiledClip, time_secs: f32, local: &mut LocalPose) {
    local.resize(clip.joint_count());
    // Tracks of a clip mostly share their key times, so each group begins its search where the one before found its key.
    let mut guess = 0;
    for (joints, group) in local.groups.iter_mut().zip(clip.groups()) {
        sample_group(group, time_secs, &mut guess, joints);
    }
}

/// One joint of a clip at `time_secs`, as [`sample`] has it; at rest where the clip lacks it.
pub fn sample_joint(skeleton: &Skeleton, clip: &CompiledClip, joint: JointIndex, time_secs: f32) -> LocalJoint {
    match clip.lane_of(joint) {
        Some((group, lane)) => {
            let mut joints = JointLanes::IDENTITY;
            sample_group(group, time_secs, &mut 0, &mut joints);
            joints.joint(lane)
        }
        None => skeleton.rest().get(joint.index()).copied().unwrap_or_default(),
    }
}

#[inline(always)]
fn sample_group(group: &TrackGroup, time_secs: f32, guess: &mut usize, joints: &mut JointLanes) {
    let times_secs = group.times_secs();
    let last = times_secs.len() - 1;
    if time_secs >= times_secs[last] {
        *joints = group.joints_at(last);
        return;
    }
    if time_secs.is_nan() || time_secs <= times_secs[0] {
        *joints = group.joints_at(0);
        return;
    }
    let from = span_at(times_secs, time_secs, *guess);
    *guess = from;
    let to = from + 1;
    // In f64 neither the least nor the greatest step between two f32 can overflow or vanish.
    let start_secs = f64::from(times_secs[from]);
    let fraction = (f64::from(time_secs) - start_secs) / (f64::from(times_secs[to]) - start_secs);
    group.set_between(from, fraction as f32, joints);
}

/// The key at or before a time that lies between the first and the last key: the guess where it holds, else a binary
/// search.
#[inline]
fn span_at(times_secs: &[f32], time_secs: f32, guess: usize) -> usize {
    if let (Some(&from), Some(&to)) = (times_secs.get(guess), times_secs.get(guess + 1))
        && from <= time_secs
        && time_secs < to
    {
        return guess;
    }
    // The first key is before the time, so at least one is counted.
    times_secs.partition_point(|&key_secs| key_secs <= time_secs) - 1
}
