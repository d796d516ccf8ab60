//! Standing at ease: two breaths, the weight goes from one leg to the other, the head looks about.

use std::f64::consts::TAU;

use glam::DVec3;

use super::curve::Curve;
use super::leg::{Footing, set_leg};
use super::pose::{Arm, Pose, pitch, roll, yaw};
use crate::sample::rig::{CHEST, HEAD, HIPS, NECK, RIBS, Rig, Side, WAIST};

/// Length of the clip in thirtieths of a second.
pub(super) const KEY_SPANS: usize = 108;

/// Degrees to the figure's right.
const LOOK: Curve<'_> = Curve::new(&[
    (0.0, 0.0),
    (0.1, 0.0),
    (0.2, 15.0),
    (0.4, 14.0),
    (0.56, -13.0),
    (0.78, -11.0),
    (0.92, 0.0),
]);
/// Weight on the left leg, −1…1.
const WEIGHT: Curve<'_> = Curve::new(&[(0.02, -0.7), (0.16, -0.8), (0.42, 1.0), (0.64, 0.9), (0.9, -0.7)]);

/// The pose at a phase 0…1.
pub(super) fn pose(rig: &Rig, phase: f64) -> Pose {
    let mut pose = Pose::relaxed();
    let breath = (2.0 * TAU * phase).sin();
    let late_breath = (2.0 * TAU * (phase - 0.04)).sin();
    let weight = WEIGHT.at(phase);
    let look = LOOK.at(phase);

    pose.hips_offset = DVec3::new(0.026 * weight, -0.02 + 0.003 * breath, 0.004);
    pose.set(HIPS, roll(2.6 * weight) * yaw(0.15 * look));
    let spine = roll(-1.1 * weight) * yaw(0.05 * look);
    pose.set(WAIST, spine * pitch(0.4 * breath));
    pose.set(RIBS, spine * pitch(0.7 * breath));
    pose.set(CHEST, spine * pitch(0.8 * breath));
    pose.set(NECK, yaw(0.35 * look) * pitch(-late_breath));
    pose.set(
        HEAD,
        yaw(0.5 * look) * roll(-0.1 * look) * pitch(-0.8 * late_breath - 1.5),
    );

    for side in Side::BOTH {
        let rest = Arm::default();
        let arm = Arm {
            shrug_degrees: rest.shrug_degrees + 1.6 * breath,
            raise_degrees: rest.raise_degrees + 1.0 * late_breath + 1.5 * side.sign() * weight,
            swing_degrees: rest.swing_degrees + 1.2 * late_breath,
            elbow_degrees: rest.elbow_degrees + 1.8 * late_breath,
            ..rest
        };
        pose.set_arm(side, arm);
        set_leg(
            &mut pose,
            rig,
            side,
            Footing {
                splay_degrees: 9.0,
                ..Footing::default()
            },
        );
    }
    pose
}
