//! Clips that stay in their place: `Idle` and `Wave`.

use std::f64::consts::TAU;

use glam::DVec3;

use super::curve::Curve;
use super::pose::{Arm, Footing, Pose, pitch, roll, set_leg, yaw};
use crate::rig::{CHEST, HEAD, HIPS, NECK, RIBS, Rig, Side, WAIST};

/// Length of [`idle`] in thirtieths of a second.
pub(crate) const IDLE_KEY_SPANS: usize = 120;

/// Where the head looks, degrees to the figure's right.
const LOOK: Curve<'_> = Curve::new(&[
    (0.0, -20.0),
    (0.16, -22.0),
    (0.3, 3.0),
    (0.42, 25.0),
    (0.66, 21.0),
    (0.82, -4.0),
    (0.94, -18.0),
]);
/// Weight on the left leg, −1…1.
const WEIGHT: Curve<'_> = Curve::new(&[(0.04, -0.9), (0.2, -1.0), (0.5, 1.0), (0.68, 0.9), (0.96, -0.8)]);
/// How full the lungs are, −1…1: in more quickly than out.
const BREATH: Curve<'_> = Curve::new(&[
    (0.0, -0.8),
    (0.2, 1.0),
    (0.26, 0.95),
    (0.48, -1.0),
    (0.54, -0.9),
    (0.72, 0.8),
    (0.78, 0.75),
    (0.96, -0.9),
]);

/// Standing at ease at a phase 0…1: two breaths, the weight goes from one leg to the other, the head turns and looks. The chest
/// follows the head, and the arms follow the chest.
pub(crate) fn idle(rig: &Rig, phase: f64) -> Pose {
    let mut pose = Pose::relaxed();
    let (breath, late_breath) = (BREATH.at(phase), BREATH.at(phase - 0.05));
    let (weight, late_weight, arms_weight) = (WEIGHT.at(phase), WEIGHT.at(phase - 0.04), WEIGHT.at(phase - 0.09));
    let (look, late_look) = (LOOK.at(phase), LOOK.at(phase - 0.06));

    pose.hips_offset = DVec3::new(0.032 * weight, -0.024 + 0.003 * breath, 0.006);
    pose.set(HIPS, roll(3.2 * weight) * yaw(2.0 * weight + 0.1 * late_look));
    let spine = roll(-1.5 * late_weight) * yaw(0.09 * late_look);
    pose.set(WAIST, spine * pitch(-0.5 + 0.5 * breath));
    pose.set(RIBS, spine * pitch(breath));
    pose.set(CHEST, spine * pitch(1.1 * breath));
    pose.set(NECK, yaw(0.3 * look) * roll(0.4 * late_weight) * pitch(-late_breath));
    pose.set(
        HEAD,
        yaw(0.6 * look) * roll(-0.12 * look) * pitch(-late_breath - 2.0 - 0.1 * look.abs()),
    );

    for side in Side::BOTH {
        let rest = Arm::default();
        let sign = side.sign();
        // The right arm hangs a little further forwards and is bent more.
        let arm = Arm {
            shrug_degrees: rest.shrug_degrees + 2.4 * breath + 0.8 * sign * late_weight,
            raise_degrees: rest.raise_degrees + 3.0 + 1.5 * late_breath + 2.0 * sign * arms_weight,
            swing_degrees: rest.swing_degrees + 2.0 - 2.0 * sign - 1.6 * late_breath + 2.0 * sign * arms_weight,
            elbow_degrees: rest.elbow_degrees + 5.0 - 4.0 * sign + 2.6 * late_breath,
            hand_to_palm_degrees: rest.hand_to_palm_degrees + 2.5 * arms_weight * sign,
            ..rest
        };
        pose.set_arm(side, arm);
        pose.curl_fingers(side, 22.0 - 3.0 * sign + 3.0 * late_breath);
        set_leg(
            &mut pose,
            rig,
            side,
            Footing {
                // Apart, the left foot a little ahead.
                offset: DVec3::new(0.032 * sign, 0.0, -0.03 * sign),
                splay_degrees: 12.0,
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
