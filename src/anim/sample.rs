//! A clip at a time.

use glam::{Quat, Vec3, Vec4};

use super::{LocalJoint, LocalPose};
use crate::model::{Arc, Clip, Track};

/// Each track of a clip at `time_secs`: translation and scale blended in a straight line, rotation along the shorter arc
/// at even speed. Before its first and after its last key a track holds that key. A time that is no number is the start.
///
/// The result does not depend on earlier calls, so scrubbing costs the same as playing.
pub fn sample(clip: &Clip, time_secs: f32, local: &mut LocalPose) {
    local.joints.resize(clip.tracks.len(), LocalJoint::IDENTITY);
    // Tracks of a clip mostly share their key times: the place found for one is where the next looks first.
    let mut guess = 0;
    for (joint, track) in local.joints.iter_mut().zip(&clip.tracks) {
        *joint = sample_track(track, time_secs, &mut guess);
    }
}

#[inline]
fn sample_track(track: &Track, time_secs: f32, guess: &mut usize) -> LocalJoint {
    let times_secs = track.times_secs();
    let last = times_secs.len() - 1;
    if time_secs >= times_secs[last] {
        return track.key(last);
    }
    if time_secs.is_nan() || time_secs <= times_secs[0] {
        return track.key(0);
    }
    let from = span_at(times_secs, time_secs, *guess);
    *guess = from;
    let to = from + 1;
    // In f64 neither the least nor the greatest step between two f32 can overflow or vanish.
    let start_secs = f64::from(times_secs[from]);
    let fraction = (f64::from(time_secs) - start_secs) / (f64::from(times_secs[to]) - start_secs);
    let (rotations, translations, scales) = (track.rotations(), track.translations(), track.scales());
    let fraction = fraction as f32;
    LocalJoint {
        rotation: slerp(rotations[from], rotations[to], track.arcs()[from], fraction),
        translation: blend(translations[from], translations[to], fraction),
        scale: blend(scales[from], scales[to], fraction),
    }
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

/// Exact at both ends, which `from + (to - from) * fraction` is not.
#[inline]
fn blend(from: Vec3, to: Vec3, fraction: f32) -> Vec3 {
    from * (1.0 - fraction) + to * fraction
}

/// Along the arc at even speed: the weight of each end is sin(part · angle) / sin(angle). Written with
/// [`sine_over_angle`], it holds for an angle of 0 too.
#[inline]
fn slerp(from: Quat, to: Quat, arc: Arc, fraction: f32) -> Quat {
    let rest = 1.0 - fraction;
    let from_weight = rest * sine_over_angle(arc.angle_squared * rest * rest) * arc.angle_over_sine;
    let to_weight = fraction * sine_over_angle(arc.angle_squared * fraction * fraction) * arc.angle_over_sine;
    Quat::from_vec4(Vec4::from(from) * from_weight + Vec4::from(to) * to_weight)
}

/// sin(x) / x of x², for x in 0…π/2: the Taylor polynomial whose first left-out term is below 4e-8 there.
#[inline]
fn sine_over_angle(angle_squared: f32) -> f32 {
    const TERMS: [f32; 6] = [
        1.0,
        -1.0 / 6.0,
        1.0 / 120.0,
        -1.0 / 5_040.0,
        1.0 / 362_880.0,
        -1.0 / 39_916_800.0,
    ];
    TERMS.iter().rev().fold(0.0, |sum, term| sum * angle_squared + term)
}
