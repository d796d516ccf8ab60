//! Two poses as one.

use std::array::from_fn;

use glam::Vec4;

use super::LocalPose;
use super::sample::sine_over_angle;
use crate::model::JointLanes;

/// Each joint between two poses of one skeleton, relative to its parent: translation and scale in a straight line, rotation
/// along the shorter arc at even speed, whatever the signs of the quaternions. `share` is that of `to`, clamped to 0…1; at
/// its ends `out` is one of the poses. NaN is 0. Joints that one pose lacks are left out.
pub fn blend(from: &LocalPose, to: &LocalPose, share: f32, out: &mut LocalPose) {
    let share = if share.is_nan() { 0.0 } else { share.clamp(0.0, 1.0) };
    out.resize(from.joint_count().min(to.joint_count()));
    for (out, (from, to)) in out.groups.iter_mut().zip(from.groups.iter().zip(&to.groups)) {
        *out = blend_lanes(from, to, share);
    }
}

/// The weights of both ends are sin(part · angle) / sin(angle), written with [`sine_over_angle`] so that they hold for an
/// angle of 0 too.
fn blend_lanes(from: &JointLanes, to: &JointLanes, share: f32) -> JointLanes {
    let cosine = (0..4).fold(Vec4::ZERO, |sum, i| sum + from.rotation[i] * to.rotation[i]);
    // q and −q are the same rotation, but the way between them is the long one.
    let side = Vec4::select(cosine.cmplt(Vec4::ZERO), Vec4::NEG_ONE, Vec4::ONE);
    let (mut apart_squared, mut together_squared) = (Vec4::ZERO, Vec4::ZERO);
    for i in 0..4 {
        let to = to.rotation[i] * side;
        let (apart, together) = (to - from.rotation[i], to + from.rotation[i]);
        apart_squared += apart * apart;
        together_squared += together * together;
    }
    // Twice the half angle by its tangent: exact for small angles, where the cosine tells nothing.
    let angle = Vec4::from_array(from_fn(|lane| {
        2.0 * apart_squared[lane].sqrt().atan2(together_squared[lane].sqrt())
    }));
    let angle_squared = angle * angle;
    let whole = sine_over_angle(angle_squared);
    let part = Vec4::splat(share);
    let rest = Vec4::ONE - part;
    let from_weight = rest * sine_over_angle(angle_squared * rest * rest) / whole;
    let to_weight = part * sine_over_angle(angle_squared * part * part) / whole * side;
    JointLanes {
        rotation: from_fn(|i| from.rotation[i] * from_weight + to.rotation[i] * to_weight),
        translation: from_fn(|i| from.translation[i] * rest + to.translation[i] * part),
        scale: from_fn(|i| from.scale[i] * rest + to.scale[i] * part),
    }
}
