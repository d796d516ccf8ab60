//! Legs from feet: a two-bone chain between hip and ankle, so that a planted foot stays planted.

use glam::{DMat3, DQuat, DVec3};

use super::pose::{Pose, pitch};
use crate::sample::rig::{FORWARD, Limb, Rig, Side, joint};

/// Where a foot is and how it stands.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Footing {
    /// The foot away from its bind place, metres in model space, before it rolls.
    pub(super) offset: DVec3,
    /// Roll over the sole: positive lifts the toes about the heel, negative lifts the heel about the ball.
    pub(super) roll_degrees: f64,
    /// Toes up against the foot: with the heel lifted, this much keeps them flat.
    pub(super) toe_degrees: f64,
    /// Toes outwards.
    pub(super) splay_degrees: f64,
}

/// Back end of the sole in the bind pose, where a foot rolls with its toes up.
const HEEL: f64 = 0.06;
/// A knee never opens past this share of the straight leg: beyond it a knee snaps.
const LONGEST: f64 = 0.998;

/// Sets hip, knee, ankle and toes of one leg; the hips must be set before.
pub(super) fn set_leg(pose: &mut Pose, rig: &Rig, side: Side, footing: Footing) {
    let [thigh, shin, foot, toe] = [Limb::Thigh, Limb::Shin, Limb::Foot, Limb::Toe].map(|limb| joint(side, limb));
    let [hip, knee, ankle, ball] = [thigh, shin, foot, toe].map(|joint| rig.joints[joint].origin);

    let splay = super::pose::yaw(-side.sign() * footing.splay_degrees);
    let foot_turn = splay * pitch(footing.roll_degrees);
    let pivot = if footing.roll_degrees < 0.0 {
        ball
    } else {
        DVec3::new(ankle.x, 0.0, HEEL)
    };
    // Splayed about the ankle, rolled about the pivot, then moved.
    let target = footing.offset + ankle + splay * (pivot - ankle) + foot_turn * (ankle - pivot);

    let start = pose.model_origin(rig, thigh);
    let (upper, lower) = (hip.distance(knee), knee.distance(ankle));
    let reach = (target - start).length().min((upper + lower) * LONGEST);
    let along = (target - start).normalize();
    // Knees bend between where the foot and where the hips point.
    let hips_forward = pose.model_turn(rig, crate::sample::rig::HIPS) * FORWARD;
    let ahead = (splay * FORWARD + hips_forward).normalize();
    let bend = (ahead - along * ahead.dot(along)).normalize();
    let middle = (reach * reach + upper * upper - lower * lower) / (2.0 * reach);
    let bent_knee = start + along * middle + bend * (upper * upper - middle * middle).max(0.0).sqrt();
    let end = start + along * reach;

    // Both bones turn about one axis across the leg; in the bind pose that axis is x.
    let across = bend.cross(along).normalize();
    let thigh_turn = frame(bent_knee - start, across) * frame(knee - hip, bind_across()).inverse();
    let shin_turn = frame(end - bent_knee, across) * frame(ankle - knee, bind_across()).inverse();
    let parent_turn = pose.model_turn(rig, crate::sample::rig::HIPS);
    pose.turns[thigh] = parent_turn.inverse() * thigh_turn;
    pose.turns[shin] = thigh_turn.inverse() * shin_turn;
    pose.turns[foot] = shin_turn.inverse() * foot_turn;
    pose.turns[toe] = pitch(footing.toe_degrees);
}

/// bend × along in the bind pose: forwards × down.
fn bind_across() -> DVec3 {
    FORWARD.cross(DVec3::NEG_Y)
}

/// A frame with y along the bone and x across it.
fn frame(along: DVec3, across: DVec3) -> DQuat {
    let y = along.normalize();
    let x = (across - y * across.dot(y)).normalize();
    DQuat::from_mat3(&DMat3::from_cols(x, y, x.cross(y)))
}
