//! A clip at a time.

use std::array::from_fn;

use glam::Vec4;

use super::LocalPose;
use crate::model::{Clip, JointIndex, JointLanes, KeyLanes, LocalJoint, Skeleton, TrackGroup};

/// Each track of a clip at `time_secs`: translation and scale blended in a straight line, rotation along the shorter arc
/// at even speed. Before its first and after its last key a track holds that key. A time that is no number is the start.
///
/// The result does not depend on earlier calls, so scrubbing costs the same as playing.
pub fn sample(clip: &Clip, time_secs: f32, local: &mut LocalPose) {
    local.resize(clip.tracks.len());
    // Tracks of a clip mostly share their key times: the place found for one group is where the next looks first.
    let mut guess = 0;
    for (joints, group) in local.groups.iter_mut().zip(clip.tracks.groups()) {
        *joints = sample_group(group, time_secs, &mut guess);
    }
}

/// One joint of a clip at `time_secs`, as [`sample`] has it; at rest where the clip lacks it.
pub fn sample_joint(skeleton: &Skeleton, clip: &Clip, joint: JointIndex, time_secs: f32) -> LocalJoint {
    let (group, lane) = (joint.index() / JointLanes::COUNT, joint.index() % JointLanes::COUNT);
    match clip.tracks.groups().get(group) {
        Some(group) if joint.index() < clip.tracks.len() => sample_group(group, time_secs, &mut 0).joint(lane),
        _ => skeleton.rest().get(joint.index()).copied().unwrap_or_default(),
    }
}

#[inline]
fn sample_group(group: &TrackGroup, time_secs: f32, guess: &mut usize) -> JointLanes {
    let (times_secs, keys) = (group.times_secs(), group.keys());
    let last = times_secs.len() - 1;
    if time_secs >= times_secs[last] {
        return keys[last].joints;
    }
    if time_secs.is_nan() || time_secs <= times_secs[0] {
        return keys[0].joints;
    }
    let from = span_at(times_secs, time_secs, *guess);
    *guess = from;
    let to = from + 1;
    // In f64 neither the least nor the greatest step between two f32 can overflow or vanish.
    let start_secs = f64::from(times_secs[from]);
    let fraction = (f64::from(time_secs) - start_secs) / (f64::from(times_secs[to]) - start_secs);
    blend(&keys[from], &keys[to].joints, fraction as f32)
}

/// The key at or before a time that lies between the first and the last key: the guess where it holds, else a binary
/// search.
#[inline]
fn span_at(times_secs: &[f32], time_secs: f32, guess: usize) -> usize {
    if let Some(&[from, to]) = times_secs.get(guess..).and_then(|rest| rest.first_chunk())
        && from <= time_secs
        && time_secs < to
    {
        return guess;
    }
    // The first key is before the time, so at least one is counted.
    times_secs.partition_point(|&key_secs| key_secs <= time_secs) - 1
}

/// Four joints between a key and the next, exact at both ends. The rotation goes along the arc at even speed: the weight
/// of each end is sin(part · angle) / sin(angle), written with [`sine_over_angle`] so that it holds for an angle of 0 too.
#[inline]
fn blend(key: &KeyLanes, to: &JointLanes, fraction: f32) -> JointLanes {
    let from = &key.joints;
    let part = Vec4::splat(fraction);
    let rest = Vec4::ONE - part;
    let from_weight = rest * sine_over_angle(key.angle_squared * rest * rest) * key.angle_over_sine;
    let to_weight = part * sine_over_angle(key.angle_squared * part * part) * key.angle_over_sine;
    JointLanes {
        rotation: from_fn(|i| from.rotation[i] * from_weight + to.rotation[i] * to_weight),
        translation: from_fn(|i| from.translation[i] * rest + to.translation[i] * part),
        scale: from_fn(|i| from.scale[i] * rest + to.scale[i] * part),
    }
}

/// sin(x) / x of x², for x in 0…π/2: the Taylor polynomial whose first left-out term is below 4e-8 there.
#[inline]
pub(super) fn sine_over_angle(angle_squared: Vec4) -> Vec4 {
    // From the highest power down.
    const TERMS: [f32; 6] = [
        -1.0 / 39_916_800.0,
        1.0 / 362_880.0,
        -1.0 / 5_040.0,
        1.0 / 120.0,
        -1.0 / 6.0,
        1.0,
    ];
    let [highest, lower @ ..] = TERMS.map(Vec4::splat);
    lower.into_iter().fold(highest, |sum, term| sum * angle_squared + term)
}
