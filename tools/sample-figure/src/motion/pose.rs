//! A pose as an animator sets it: turns away from the bind pose, about the bind pose's model axes, parents first.
//! Legs are set from the feet: a two-bone chain between hip and ankle, so that a planted foot stays planted.

use glam::{DMat3, DQuat, DVec3};

use crate::rig::{ARM, FORWARD, HIPS, JOINT_COUNT, Joint, Limb, PALM, Rig, Side, joint};

/// Turns of all joints and the place of the hips.
#[derive(Clone)]
pub(crate) struct Pose {
    /// Turn of each joint relative to its parent's turn, about model axes as they lie in the bind pose.
    pub(crate) turns: [DQuat; JOINT_COUNT],
    /// Hips away from their bind place, metres in model space.
    pub(crate) hips_offset: DVec3,
}

/// A joint relative to its parent: `parent_from_joint`.
#[derive(Clone, Copy)]
pub(crate) struct LocalKey {
    pub(crate) translation: DVec3,
    pub(crate) rotation: DQuat,
}

/// A turn about x, in degrees: positive swings a hanging limb forwards and leans a standing trunk backwards.
pub(crate) fn pitch(degrees: f64) -> DQuat {
    DQuat::from_rotation_x(degrees.to_radians())
}

/// A turn about y, in degrees: positive turns to the figure's right.
pub(crate) fn yaw(degrees: f64) -> DQuat {
    DQuat::from_rotation_y(degrees.to_radians())
}

/// A turn about z, in degrees: positive raises the left side.
pub(crate) fn roll(degrees: f64) -> DQuat {
    DQuat::from_rotation_z(degrees.to_radians())
}

impl Pose {
    /// The bind pose.
    pub(crate) fn bind() -> Pose {
        Pose {
            turns: [DQuat::IDENTITY; JOINT_COUNT],
            hips_offset: DVec3::ZERO,
        }
    }

    /// The bind pose with arms at the sides and fingers at ease.
    pub(crate) fn relaxed() -> Pose {
        let mut pose = Pose::bind();
        for side in Side::BOTH {
            pose.set_arm(side, Arm::default());
            pose.curl_fingers(side, 16.0);
        }
        pose
    }

    /// Sets a turn in the middle of the body.
    pub(crate) fn set(&mut self, joint: usize, turn: DQuat) {
        self.turns[joint] = turn;
    }

    /// Sets clavicle, shoulder, elbow and wrist.
    pub(crate) fn set_arm(&mut self, side: Side, arm: Arm) {
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
    pub(crate) fn curl_fingers(&mut self, side: Side, degrees: f64) {
        let along = side.mirror(ARM);
        let to_palm = along.cross(side.mirror(PALM));
        let turn = |axis: DVec3, degrees: f64| DQuat::from_axis_angle(axis, degrees.to_radians());
        for (limb, part) in [
            (Limb::Index, 0.9),
            (Limb::IndexTip, 1.1),
            (Limb::Middle, 1.0),
            (Limb::MiddleTip, 1.2),
            (Limb::Outer, 1.15),
            (Limb::OuterTip, 1.3),
            (Limb::Thumb, 0.3),
            (Limb::ThumbTip, 0.7),
        ] {
            self.turns[joint(side, limb)] = turn(to_palm, degrees * part);
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
    pub(crate) fn model_turn(&self, rig: &Rig, joint: usize) -> DQuat {
        let own = self.turns[joint];
        rig.joints[joint]
            .parent
            .map_or(own, |parent| self.model_turn(rig, parent) * own)
    }

    /// Origin of a joint in model space.
    pub(crate) fn model_origin(&self, rig: &Rig, joint: usize) -> DVec3 {
        let bind = rig.joints[joint].origin;
        let offset = if joint == HIPS { self.hips_offset } else { DVec3::ZERO };
        rig.joints[joint].parent.map_or(bind, |parent| {
            let reach = self.model_turn(rig, parent) * (bind - rig.joints[parent].origin);
            self.model_origin(rig, parent) + reach + offset
        })
    }

    /// Each joint relative to its parent, as keys want it.
    pub(crate) fn local_keys(&self, rig: &Rig) -> Vec<LocalKey> {
        let local = |(index, joint): (usize, &Joint)| {
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
pub(crate) struct Arm {
    /// Shoulder up.
    pub(crate) shrug_degrees: f64,
    /// Upper arm sideways up from the bind pose; negative lowers it.
    pub(crate) raise_degrees: f64,
    /// Upper arm forwards, after raising.
    pub(crate) swing_degrees: f64,
    /// Upper arm about itself: positive turns the elbow's bend upwards.
    pub(crate) twist_degrees: f64,
    /// Forearm towards the front of the arm.
    pub(crate) elbow_degrees: f64,
    /// Hand towards the thumb.
    pub(crate) hand_forward_degrees: f64,
    /// Hand towards the palm.
    pub(crate) hand_to_palm_degrees: f64,
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

/// Where a foot is and how it stands.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Footing {
    /// The foot away from its bind place, metres in model space, before it rolls.
    pub(crate) offset: DVec3,
    /// Roll over the sole: positive lifts the toes about the heel, negative lifts the heel about the ball.
    pub(crate) roll_degrees: f64,
    /// Toes up against the foot: with the heel lifted, this much keeps them flat.
    pub(crate) toe_degrees: f64,
    /// Toes outwards.
    pub(crate) splay_degrees: f64,
}

/// Back end of the sole in the bind pose, where a foot rolls with its toes up.
const HEEL: f64 = 0.06;
/// A knee never opens past this fraction of the straight leg, where it would snap.
const LONGEST: f64 = 0.998;

/// Sets hip, knee, ankle and toes of one leg; the hips must be set before.
pub(crate) fn set_leg(pose: &mut Pose, rig: &Rig, side: Side, footing: Footing) {
    let [thigh, shin, foot, toe] = [Limb::Thigh, Limb::Shin, Limb::Foot, Limb::Toe].map(|limb| joint(side, limb));
    let [hip, knee, ankle, ball] = [thigh, shin, foot, toe].map(|joint| rig.joints[joint].origin);

    let splay = yaw(-side.sign() * footing.splay_degrees);
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
    let hips_forward = pose.model_turn(rig, HIPS) * FORWARD;
    let ahead = (splay * FORWARD + hips_forward).normalize();
    let bend = (ahead - along * ahead.dot(along)).normalize();
    let middle = (reach * reach + upper * upper - lower * lower) / (2.0 * reach);
    let bent_knee = start + along * middle + bend * (upper * upper - middle * middle).max(0.0).sqrt();
    let end = start + along * reach;

    // Both bones turn about one axis across the leg; in the bind pose that axis is x.
    let across = bend.cross(along).normalize();
    let thigh_turn = frame(bent_knee - start, across) * frame(knee - hip, bind_across()).inverse();
    let shin_turn = frame(end - bent_knee, across) * frame(ankle - knee, bind_across()).inverse();
    let parent_turn = pose.model_turn(rig, HIPS);
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
