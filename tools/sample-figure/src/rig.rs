//! The skeleton in its bind pose: left-handed, y up, metres, facing −z, so +x is the figure's left. Arms hang at 37° below
//! the horizontal, legs straight down.

use glam::{DMat3, DQuat, DVec3};

/// Joint 0, the root, is the place on the ground under the figure: it moves no vertex itself. The hips hang from it.
pub(crate) const HIPS: usize = 1;
pub(crate) const WAIST: usize = 2;
pub(crate) const RIBS: usize = 3;
pub(crate) const CHEST: usize = 4;
pub(crate) const NECK: usize = 5;
pub(crate) const HEAD: usize = 6;
pub(crate) const CENTRE_COUNT: usize = 7;

/// Left is +x.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Side {
    Left,
    Right,
}

impl Side {
    pub(crate) const BOTH: [Side; 2] = [Side::Left, Side::Right];

    /// +1 on the left, −1 on the right.
    pub(crate) fn sign(self) -> f64 {
        match self {
            Side::Left => 1.0,
            Side::Right => -1.0,
        }
    }

    /// A vector of the left side on this side.
    pub(crate) fn mirror(self, left: DVec3) -> DVec3 {
        DVec3::new(left.x * self.sign(), left.y, left.z)
    }
}

/// A joint that both sides have, in the order of the file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Limb {
    Clavicle,
    UpperArm,
    Forearm,
    Hand,
    Thumb,
    ThumbTip,
    Index,
    IndexTip,
    Middle,
    MiddleTip,
    Outer,
    OuterTip,
    Thigh,
    Shin,
    Foot,
    Toe,
}

const LIMB_COUNT: usize = 16;

/// Number of joints.
pub(crate) const JOINT_COUNT: usize = CENTRE_COUNT + 2 * LIMB_COUNT;

/// Index of a joint of one side.
pub(crate) fn joint(side: Side, limb: Limb) -> usize {
    CENTRE_COUNT + (side as usize) * LIMB_COUNT + limb as usize
}

/// The same joint of the other side; the middle has its own.
pub(crate) fn mirrored_joint(joint: usize) -> usize {
    match joint.checked_sub(CENTRE_COUNT) {
        None => joint,
        Some(left) if left < LIMB_COUNT => joint + LIMB_COUNT,
        Some(_) => joint - LIMB_COUNT,
    }
}

/// Along the left arm from shoulder to fingers, palm down and inwards, thumb forwards.
pub(crate) const ARM: DVec3 = DVec3::new(0.8, -0.6, 0.0);
/// Out of the left palm.
pub(crate) const PALM: DVec3 = DVec3::new(-0.6, -0.8, 0.0);
/// Where the figure looks.
pub(crate) const FORWARD: DVec3 = DVec3::NEG_Z;

/// A joint in the bind pose.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Joint {
    pub(crate) parent: Option<usize>,
    /// Model space.
    pub(crate) origin: DVec3,
    /// Where the bone ends, model space.
    pub(crate) tip: DVec3,
    /// Model from joint: +y runs along the bone, +z as far backwards as that allows.
    pub(crate) rotation: DQuat,
}

/// All joints, parents first.
pub(crate) struct Rig {
    pub(crate) joints: Vec<Joint>,
}

impl Rig {
    /// The figure's rig.
    pub(crate) fn new() -> Rig {
        let mut joints = Vec::with_capacity(JOINT_COUNT);
        let mut add = |parent: Option<usize>, origin: DVec3, tip: DVec3, along: DVec3| {
            joints.push(Joint {
                parent,
                origin,
                tip,
                rotation: orientation(along),
            });
        };
        let spine = [0.0, 0.93, 1.03, 1.13, 1.24, 1.41, 1.46, 1.795].map(|y| DVec3::new(0.0, y, 0.0));
        for index in 0..CENTRE_COUNT {
            add(index.checked_sub(1), spine[index], spine[index + 1], DVec3::Y);
        }
        for side in Side::BOTH {
            for bone in left_limbs() {
                let parent = match bone.parent {
                    Parent::Centre(index) => index,
                    Parent::Limb(limb) => joint(side, limb),
                };
                let (origin, tip) = (side.mirror(bone.origin), side.mirror(bone.tip));
                add(Some(parent), origin, tip, (tip - origin).normalize());
            }
        }
        Rig { joints }
    }

    /// Bind origin of a joint of one side.
    pub(crate) fn origin(&self, side: Side, limb: Limb) -> DVec3 {
        self.joints[joint(side, limb)].origin
    }
}

enum Parent {
    Centre(usize),
    Limb(Limb),
}

struct LeftLimb {
    parent: Parent,
    origin: DVec3,
    tip: DVec3,
}

/// Joints of the left side in the order of [`Limb`].
fn left_limbs() -> [LeftLimb; LIMB_COUNT] {
    let clavicle = DVec3::new(0.05, 1.35, 0.005);
    let shoulder = DVec3::new(0.205, 1.345, 0.005);
    let elbow = shoulder + ARM * 0.25;
    let wrist = elbow + ARM * 0.235;
    let bone = |parent, origin, tip| LeftLimb { parent, origin, tip };
    let finger = |z: f64, fan: f64, length: f64| {
        let along = (ARM + DVec3::Z * fan + PALM * 0.06).normalize();
        let knuckle = wrist + ARM * (0.1 - 6.0 * z * z) + DVec3::Z * z;
        (knuckle, knuckle + along * (0.52 * length), knuckle + along * length)
    };
    let index = finger(-0.042, -0.16, 0.092);
    let middle = finger(-0.014, -0.04, 0.1);
    let outer = finger(0.028, 0.12, 0.09);
    let thumb_along = (ARM * 0.62 + FORWARD * 0.75 + PALM * 0.22).normalize();
    let thumb = wrist + ARM * 0.022 + FORWARD * 0.026;
    let (thumb_middle, thumb_end) = (thumb + thumb_along * 0.055, thumb + thumb_along * 0.1);
    let hip = DVec3::new(0.104, 0.875, 0.0);
    let knee = DVec3::new(0.106, 0.49, -0.006);
    let ankle = DVec3::new(0.108, 0.11, 0.012);
    let ball = DVec3::new(0.11, 0.034, -0.115);
    [
        bone(Parent::Centre(CHEST), clavicle, shoulder),
        bone(Parent::Limb(Limb::Clavicle), shoulder, elbow),
        bone(Parent::Limb(Limb::UpperArm), elbow, wrist),
        bone(Parent::Limb(Limb::Forearm), wrist, wrist + ARM * 0.098),
        bone(Parent::Limb(Limb::Hand), thumb, thumb_middle),
        bone(Parent::Limb(Limb::Thumb), thumb_middle, thumb_end),
        bone(Parent::Limb(Limb::Hand), index.0, index.1),
        bone(Parent::Limb(Limb::Index), index.1, index.2),
        bone(Parent::Limb(Limb::Hand), middle.0, middle.1),
        bone(Parent::Limb(Limb::Middle), middle.1, middle.2),
        bone(Parent::Limb(Limb::Hand), outer.0, outer.1),
        bone(Parent::Limb(Limb::Outer), outer.1, outer.2),
        bone(Parent::Centre(HIPS), hip, knee),
        bone(Parent::Limb(Limb::Thigh), knee, ankle),
        bone(Parent::Limb(Limb::Shin), ankle, ball),
        bone(Parent::Limb(Limb::Foot), ball, ball + DVec3::new(0.0, 0.0, -0.1)),
    ]
}

/// The rotation that brings +y to `along` (unit) and +z as near to model +z as that allows; for a bone that runs along z
/// itself, +z goes up.
fn orientation(along: DVec3) -> DQuat {
    let reference = if along.z.abs() > 0.9 { DVec3::Y } else { DVec3::Z };
    let x = along.cross(reference).normalize();
    DQuat::from_mat3(&DMat3::from_cols(x, along, x.cross(along)))
}
