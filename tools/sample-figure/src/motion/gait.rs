//! Walking and running in place: one machine, two sets of numbers. While a foot is planted it moves backwards at one speed,
//! as the ground under a walker does.

use std::f64::consts::TAU;

use super::curve::{Curve, hermite};
use super::pose::{Arm, Footing, Pose, pitch, roll, set_leg, yaw};
use crate::rig::{CHEST, HEAD, HIPS, NECK, RIBS, Rig, Side, WAIST};
use glam::DVec3;

/// A way of going. A cycle starts as the left heel touches down; the right leg follows half a cycle later.
pub(crate) struct Gait {
    /// Length of the cycle in thirtieths of a second.
    pub(crate) key_spans: usize,
    /// Part of the cycle for which a foot is down.
    stance: f64,
    /// Where the foot touches down and lifts off, metres before and behind its bind place.
    reach: [f64; 2],
    /// Feet towards the middle line, metres.
    narrowing: f64,
    /// Roll over the sole, toes and height of the foot over one cycle of that foot: degrees, degrees, metres.
    foot_roll: Curve<'static>,
    toes: Curve<'static>,
    lift: Curve<'static>,
    /// Hips below their bind height on average, and half the way they go up and down, metres.
    hips_drop: f64,
    bob: f64,
    /// Phase at which the hips are lowest.
    lowest: f64,
    /// Half the way of the hips to the side, metres.
    sway: f64,
    /// Turn and tilt of the hips, counter-turn of the chest, lean forwards: degrees.
    hips_yaw: f64,
    hips_roll: f64,
    chest_yaw: f64,
    lean: f64,
    /// Arms: middle and half swing, middle and half bend of the elbow, how far they hang out, curl of the fingers: degrees.
    arm_swing: [f64; 2],
    elbow: [f64; 2],
    arm_raise: f64,
    finger_curl: f64,
}

/// A relaxed walk: 1.07 s for two steps.
pub(crate) const WALK: Gait = Gait {
    key_spans: 32,
    stance: 0.61,
    reach: [0.285, 0.345],
    narrowing: 0.03,
    foot_roll: Curve::new(&[
        (0.0, 17.0),
        (0.09, 0.0),
        (0.33, 0.0),
        (0.48, -17.0),
        (0.61, -50.0),
        (0.69, -52.0),
        (0.83, -8.0),
        (0.93, 17.0),
    ]),
    toes: Curve::new(&[
        (0.0, 8.0),
        (0.09, 0.0),
        (0.33, 0.0),
        (0.48, 17.0),
        (0.61, 50.0),
        (0.72, 12.0),
        (0.93, 8.0),
    ]),
    lift: Curve::new(&[(0.0, 0.0), (0.61, 0.0), (0.73, 0.052), (0.87, 0.03), (0.97, 0.004)]),
    hips_drop: 0.031,
    bob: 0.017,
    lowest: 0.07,
    sway: 0.024,
    hips_yaw: 7.0,
    hips_roll: 4.0,
    chest_yaw: 7.0,
    lean: 3.0,
    arm_swing: [2.0, 24.0],
    elbow: [24.0, 13.0],
    arm_raise: -41.0,
    finger_curl: 20.0,
};

/// A run: two strides in 0.67 s, with a flight after each.
pub(crate) const RUN: Gait = Gait {
    key_spans: 20,
    stance: 0.36,
    reach: [0.22, 0.36],
    narrowing: 0.055,
    foot_roll: Curve::new(&[
        (0.0, 7.0),
        (0.06, 0.0),
        (0.16, 0.0),
        (0.26, -22.0),
        (0.36, -55.0),
        (0.48, -88.0),
        (0.60, -78.0),
        (0.80, -12.0),
        (0.93, 10.0),
    ]),
    toes: Curve::new(&[
        (0.0, 6.0),
        (0.06, 0.0),
        (0.16, 0.0),
        (0.26, 22.0),
        (0.36, 50.0),
        (0.50, 8.0),
        (0.93, 6.0),
    ]),
    lift: Curve::new(&[
        (0.0, 0.0),
        (0.36, 0.0),
        (0.50, 0.20),
        (0.62, 0.27),
        (0.80, 0.16),
        (0.95, 0.015),
    ]),
    hips_drop: 0.045,
    bob: 0.034,
    lowest: 0.15,
    sway: 0.012,
    hips_yaw: 9.0,
    hips_roll: 4.5,
    chest_yaw: 11.0,
    lean: 13.0,
    arm_swing: [-4.0, 40.0],
    elbow: [88.0, 14.0],
    arm_raise: -14.0,
    finger_curl: 52.0,
};

impl Gait {
    /// The pose at a phase 0…1.
    pub(crate) fn pose(&self, rig: &Rig, phase: f64) -> Pose {
        let mut pose = Pose::bind();
        self.set_trunk(&mut pose, phase);
        for side in Side::BOTH {
            let own_phase = match side {
                Side::Left => phase,
                Side::Right => phase + 0.5,
            };
            self.set_arm(&mut pose, side, own_phase);
            set_leg(&mut pose, rig, side, self.footing(side, own_phase.rem_euclid(1.0)));
        }
        pose
    }

    fn set_trunk(&self, pose: &mut Pose, phase: f64) {
        let step = (TAU * phase).cos();
        // Over the standing leg: towards the left in the first half.
        let over = (TAU * (phase - self.stance / 2.0 + 0.25)).sin();
        let height = -self.hips_drop - self.bob * (2.0 * TAU * (phase - self.lowest)).cos();
        pose.hips_offset = DVec3::new(self.sway * over, height, 0.0);
        pose.set(
            HIPS,
            yaw(self.hips_yaw * step) * roll(self.hips_roll * over) * pitch(-0.35 * self.lean),
        );

        // The spine takes the hips' turn back and turns the chest against it, a third in each joint.
        let third = |amount: f64| amount / 3.0;
        let spine = yaw(third(-(self.hips_yaw + self.chest_yaw) * step))
            * roll(third(-1.15 * self.hips_roll * over))
            * pitch(third(-0.65 * self.lean));
        for joint in [WAIST, RIBS, CHEST] {
            pose.set(joint, spine);
        }
        // The head keeps looking ahead, and nods a little after each step.
        let nod = 0.9 * (2.0 * TAU * (phase - self.lowest - 0.08)).cos();
        let head = yaw(0.5 * self.chest_yaw * step) * pitch(0.45 * self.lean - nod);
        pose.set(NECK, head);
        pose.set(HEAD, head);
    }

    /// An arm goes with the other side's leg, a little late; its elbow closes as it comes forwards.
    fn set_arm(&self, pose: &mut Pose, side: Side, own_phase: f64) {
        let forwards = -(TAU * (own_phase - 0.03)).cos();
        let forearm = -(TAU * (own_phase - 0.07)).cos();
        let arm = Arm {
            raise_degrees: self.arm_raise,
            swing_degrees: self.arm_swing[0] + self.arm_swing[1] * forwards,
            elbow_degrees: self.elbow[0] + self.elbow[1] * forearm,
            twist_degrees: -0.12 * self.elbow[0],
            hand_to_palm_degrees: 6.0 - 5.0 * forearm,
            ..Arm::default()
        };
        pose.set_arm(side, arm);
        pose.curl_fingers(side, self.finger_curl);
    }

    fn footing(&self, side: Side, phase: f64) -> Footing {
        let [front, back] = self.reach;
        let travel = front + back;
        let z = if phase < self.stance {
            travel * phase / self.stance - front
        } else {
            // The foot leaves and meets the ground at the ground's own speed.
            let t = (phase - self.stance) / (1.0 - self.stance);
            let ground = travel / self.stance * (1.0 - self.stance);
            hermite(t, back, ground, -front, ground)
        };
        Footing {
            offset: DVec3::new(-side.sign() * self.narrowing, self.lift.at(phase), z),
            roll_degrees: self.foot_roll.at(phase),
            toe_degrees: self.toes.at(phase),
            splay_degrees: 5.0,
        }
    }
}
