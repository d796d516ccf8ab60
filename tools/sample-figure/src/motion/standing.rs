//! Clips that stay in their place: `Idle` and `Wave`.

use std::f64::consts::TAU;

use glam::DVec3;

use super::curve::Curve;
use super::pose::{Arm, Footing, Pose, pitch, roll, set_leg, yaw};
use crate::rig::{CHEST, HEAD, HIPS, NECK, RIBS, Rig, Side, WAIST};

/// Length of [`idle`] in thirtieths of a second.
pub(crate) const IDLE_KEY_SPANS: usize = 120;

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

/// Standing at ease at a phase 0…1: two breaths, the weight goes from one leg to the other, the head looks about.
pub(crate) fn idle(rig: &Rig, phase: f64) -> Pose {
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

/// Length of [`wave`] in thirtieths of a second.
pub(crate) const WAVE_KEY_SPANS: usize = 90;

/// How far the arm is raised, 0…1; the elbow leads, the hand follows.
const RAISED: Curve<'_> = Curve::new(&[
    (0.0, 0.0),
    (0.04, -0.03),
    (0.2, 1.04),
    (0.25, 1.0),
    (0.78, 1.0),
    (0.96, 0.0),
]);
const HAND_RAISED: Curve<'_> = Curve::new(&[(0.0, 0.0), (0.06, 0.0), (0.24, 1.0), (0.8, 1.0), (0.985, 0.0)]);
/// How wide the hand waves.
const WAVING: Curve<'_> = Curve::new(&[(0.0, 0.0), (0.2, 0.0), (0.32, 1.0), (0.66, 1.0), (0.8, 0.0)]);
/// Waves in the whole clip's time.
const WAVES: f64 = 5.0;

/// A greeting at a phase 0…1: the right arm goes up, waves three times and comes down again.
pub(crate) fn wave(rig: &Rig, phase: f64) -> Pose {
    let mut pose = Pose::relaxed();
    let raised = RAISED.at(phase);
    let hand = HAND_RAISED.at(phase);
    let wave = WAVING.at(phase) * (TAU * WAVES * (phase - 0.24)).sin();
    let late_wave = WAVING.at(phase) * (TAU * WAVES * (phase - 0.264)).sin();
    let breath = (TAU * phase).sin();

    // Weight on the left leg while the right arm is up.
    pose.hips_offset = DVec3::new(0.004 + 0.022 * raised, -0.014 - 0.004 * raised, 0.0);
    pose.set(HIPS, roll(2.0 * raised) * yaw(-3.0 * raised));
    let spine = roll(0.7 * raised + 0.5 * wave) * yaw(-0.5 * raised) * pitch(0.6 * raised + 0.3 * breath);
    for joint in [WAIST, RIBS, CHEST] {
        pose.set(joint, spine);
    }
    pose.set(NECK, roll(-2.5 * raised) * yaw(2.5 * raised));
    pose.set(
        HEAD,
        roll(-4.5 * raised - 1.2 * late_wave) * yaw(3.0 * raised) * pitch(1.5 * raised),
    );

    let rest = Arm::default();
    let between = |rest: f64, up: f64, raised: f64| rest + (up - rest) * raised;
    pose.set_arm(
        Side::Right,
        Arm {
            shrug_degrees: between(rest.shrug_degrees, 10.0, raised),
            raise_degrees: between(rest.raise_degrees, 34.0, raised),
            swing_degrees: between(rest.swing_degrees, 4.0, raised),
            twist_degrees: between(rest.twist_degrees, 76.0, raised),
            elbow_degrees: between(rest.elbow_degrees, 78.0, hand) + 21.0 * wave,
            hand_forward_degrees: between(rest.hand_forward_degrees, -4.0, hand) + 14.0 * late_wave,
            hand_to_palm_degrees: between(rest.hand_to_palm_degrees, -6.0, hand),
        },
    );
    pose.curl_fingers(Side::Right, between(16.0, -2.0, hand));
    pose.set_arm(
        Side::Left,
        Arm {
            raise_degrees: rest.raise_degrees + 3.0 * raised - 0.8 * wave,
            ..rest
        },
    );
    for side in Side::BOTH {
        set_leg(
            &mut pose,
            rig,
            side,
            Footing {
                splay_degrees: 8.0,
                ..Footing::default()
            },
        );
    }
    pose
}
