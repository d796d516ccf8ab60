//! A pose as an animator sets it: turns away from the bind pose, about the bind pose's model axes, parents first.

use glam::{DQuat, DVec3};

use crate::sample::rig::{ARM, FORWARD, HIPS, JOINT_COUNT, Limb, PALM, Rig, Side, joint};

/// Turns of all joints and the place of the hips.
#[derive(Clone)]
pub(super) struct Pose {
    /// Turn of each joint relative to its parent's turn, about model axes as they lie in the bind pose.
    pub(super) turns: [DQuat; JOINT_COUNT],
    /// Hips away from their bind place, metres in model space.
    pub(super) hips_offset: DVec3,
}

/// A joint relative to its parent: `parent_from_joint`.
#[derive(Clone, Copy)]
pub(super) struct LocalKey {
    pub(super) translation: DVec3,
    pub(super) rotation: DQuat,
}

/// A turn about x, in degrees: positive swings a hanging limb forwards and leans a standing trunk backwards.
pub(super) fn pitch(degrees: f64) -> DQuat {
    DQuat::from_rotation_x(degrees.to_radians())
}

/// A turn about y, in degrees: positive turns to the figure's right.
pub(super) fn yaw(degrees: f64) -> DQuat {
    DQuat::from_rotation_y(degrees.to_radians())
}

/// A turn about z, in degrees: positive raises the left side.
pub(super) fn roll(degrees: f64) -> DQuat {
    DQuat::from_rotation_z(degrees.to_radians())
}

impl Pose {
    /// The bind pose.
    pub(super) fn bind() -> Pose {
        Pose {
            turns: [DQuat::IDENTITY; JOINT_COUNT],
            hips_offset: DVec3::ZERO,
        }
    }

    /// The bind pose with arms at the sides and fingers at ease.
    pub(super) fn relaxed() -> Pose {
        let mut pose = Pose::bind();
        for side in Side::BOTH {
            pose.set_arm(side, Arm::default());
            pose.curl_fingers(side, 16.0);
        }
        pose
    }

    /// Sets a turn in the middle of the body.
    pub(super) fn set(&mut self, joint: usize, turn: DQuat) {
        self.turns[joint] = turn;
    }

    /// Sets clavicle, shoulder, elbow and wrist.
    pub(super) fn set_arm(&mut self, side: Side, arm: Arm) {
        let sign = side.sign();
        let along = side.mirror(ARM);
        // Axes are cross products of where the limb is and where it goes, so both sides bend alike.
        let forwards = along.cross(FORWARD);
        let to_palm = along.cross(side.mirror(PALM));
        let degrees = |axis: DVec3, degrees: f64| DQuat::from_axis_angle(axis, degrees.to_radians());
        self.turns[joint(side, Limb::Clavicle)] = roll(sign * arm.shrug_degrees);
        self.turns[joint(side, Limb::UpperArm)] =
            pitch(arm.swing_degrees) * roll(sign * arm.raise_degrees) * degrees(along, sign * arm.twist_degrees);
        self.turns[joint(side, Limb::Forearm)] = degrees(forwards, arm.elbow_degrees);
        self.turns[joint(side, Limb::Hand)] =
            degrees(forwards, arm.hand_forward_degrees) * degrees(to_palm, arm.hand_to_palm_degrees);
    }

    /// Curls all fingers towards the palm, the thumb a little less, and gathers what the bind pose spreads.
    pub(super) fn curl_fingers(&mut self, side: Side, degrees: f64) {
        let along = side.mirror(ARM);
        let to_palm = along.cross(side.mirror(PALM));
        let turn = |axis: DVec3, degrees: f64| DQuat::from_axis_angle(axis, degrees.to_radians());
        for (limb, share) in [
            (Limb::Index, 0.9),
            (Limb::IndexTip, 1.1),
            (Limb::Middle, 1.0),
            (Limb::MiddleTip, 1.2),
            (Limb::Outer, 1.15),
            (Limb::OuterTip, 1.3),
            (Limb::Thumb, 0.3),
            (Limb::ThumbTip, 0.7),
        ] {
            self.turns[joint(side, limb)] = turn(to_palm, degrees * share);
        }
        let to_thumb = along.cross(FORWARD);
        let gathered = (0.6 * degrees).clamp(0.0, 9.0);
        for (limb, degrees) in [
            (Limb::Index, -gathered),
            (Limb::Outer, gathered),
            (Limb::Thumb, -gathered),
        ] {
            let curl = self.turns[joint(side, limb)];
            self.turns[joint(side, limb)] = turn(to_thumb, degrees) * curl;
        }
    }

    /// Turn of a joint away from the bind pose in model space.
    pub(super) fn model_turn(&self, rig: &Rig, joint: usize) -> DQuat {
        let own = self.turns[joint];
        rig.joints[joint]
            .parent
            .map_or(own, |parent| self.model_turn(rig, parent) * own)
    }

    /// Origin of a joint in model space.
    pub(super) fn model_origin(&self, rig: &Rig, joint: usize) -> DVec3 {
        let bind = rig.joints[joint].origin;
        let offset = if joint == HIPS { self.hips_offset } else { DVec3::ZERO };
        rig.joints[joint].parent.map_or(bind, |parent| {
            let reach = self.model_turn(rig, parent) * (bind - rig.joints[parent].origin);
            self.model_origin(rig, parent) + reach + offset
        })
    }

    /// Each joint relative to its parent, as keys want it.
    pub(super) fn local_keys(&self, rig: &Rig) -> Vec<LocalKey> {
        let local = |(index, joint): (usize, &crate::sample::rig::Joint)| {
            let offset = if index == HIPS { self.hips_offset } else { DVec3::ZERO };
            let (origin, to_parent) = match joint.parent.map(|parent| rig.joints[parent]) {
                Some(parent) => (parent.origin, parent.rotation.inverse()),
                None => (DVec3::ZERO, DQuat::IDENTITY),
            };
            LocalKey {
                translation: to_parent * (joint.origin - origin + offset),
                rotation: (to_parent * self.turns[index] * joint.rotation).normalize(),
            }
        };
        rig.joints.iter().enumerate().map(local).collect()
    }
}

/// How an arm is held; all in degrees, alike on both sides.
#[derive(Clone, Copy, Debug)]
pub(super) struct Arm {
    /// Shoulder up.
    pub(super) shrug_degrees: f64,
    /// Upper arm sideways up from the bind pose; negative lowers it.
    pub(super) raise_degrees: f64,
    /// Upper arm forwards, after raising.
    pub(super) swing_degrees: f64,
    /// Upper arm about itself: positive turns the elbow's bend upwards.
    pub(super) twist_degrees: f64,
    /// Forearm towards the front of the arm.
    pub(super) elbow_degrees: f64,
    /// Hand towards the thumb.
    pub(super) hand_forward_degrees: f64,
    /// Hand towards the palm.
    pub(super) hand_to_palm_degrees: f64,
}

impl Default for Arm {
    /// At the side, a little bent.
    fn default() -> Arm {
        Arm {
            shrug_degrees: -3.0,
            raise_degrees: -38.0,
            swing_degrees: -2.0,
            twist_degrees: 0.0,
            elbow_degrees: 16.0,
            hand_forward_degrees: 0.0,
            hand_to_palm_degrees: 4.0,
        }
    }
}
