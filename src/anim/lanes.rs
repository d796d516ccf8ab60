//! Four joints side by side, and the blend between four and four.
//!
//! Loops over lanes and `map` of an array are written out: where the compiler keeps the program small it leaves them as they are.

use glam::{Affine3A, DQuat, Mat3A, Quat, Vec3, Vec4};

use crate::model::LocalJoint;

/// Four joints relative to their parents ([`LocalJoint`]), one in each lane: a vector holds the same number of all four,
/// so that one instruction works on four joints.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointLanes {
    /// Unit rotations: x, y, z and w of the four.
    pub rotation: [Vec4; 4],
    /// Translations: x, y and z of the four.
    pub translation: [Vec4; 3],
    /// Scales: x, y and z of the four.
    pub scale: [Vec4; 3],
}

impl JointLanes {
    /// Joints in a group.
    pub const COUNT: usize = 4;

    /// Four joints that coincide with their parents.
    pub const IDENTITY: Self = Self {
        rotation: [Vec4::ZERO, Vec4::ZERO, Vec4::ZERO, Vec4::ONE],
        translation: [Vec4::ZERO; 3],
        scale: [Vec4::ONE; 3],
    };

    /// Up to four joints; the lanes of missing ones are identities.
    pub(super) fn from_joints(joints: &[LocalJoint]) -> Self {
        let mut lanes = Self::IDENTITY;
        for (lane, &joint) in joints.iter().take(Self::COUNT).enumerate() {
            lanes.set_joint(lane, joint);
        }
        lanes
    }

    /// The joint of one lane, below 4.
    pub fn joint(&self, lane: usize) -> LocalJoint {
        LocalJoint {
            rotation: Quat::from_array(self.rotation.map(|lanes| lanes[lane])),
            translation: Vec3::from_array(self.translation.map(|lanes| lanes[lane])),
            scale: Vec3::from_array(self.scale.map(|lanes| lanes[lane])),
        }
    }

    /// Puts a joint into one lane, below 4.
    pub fn set_joint(&mut self, lane: usize, joint: LocalJoint) {
        let set = |lanes: &mut [Vec4], values: &[f32]| {
            for (lanes, &value) in lanes.iter_mut().zip(values) {
                lanes[lane] = value;
            }
        };
        set(&mut self.rotation, &joint.rotation.to_array());
        set(&mut self.translation, &joint.translation.to_array());
        set(&mut self.scale, &joint.scale.to_array());
    }

    /// Four joints between these and others: translation and scale in a straight line, rotation along the arc between the
    /// two, which must lie on one side ([`ArcLanes::to_same_side`]). `fraction` is 0…1.
    #[inline]
    pub(super) fn toward(&self, other: &Self, arc: &ArcLanes, fraction: f32) -> Self {
        let part = Vec4::ONE * fraction;
        let mut between = Self::IDENTITY;
        set_straight_between(&mut between.translation, &self.translation, &other.translation, part);
        set_straight_between(&mut between.scale, &self.scale, &other.scale, part);
        between.set_rotation_between(&self.rotation, &other.rotation, arc, part);
        between
    }

    /// Takes rotations on the arc between four and four others on the same side.
    #[inline(always)]
    pub(super) fn set_rotation_between(&mut self, from: &[Vec4; 4], to: &[Vec4; 4], arc: &ArcLanes, part: Vec4) {
        let [from_weight, to_weight] = arc.weights(part);
        let turned = |i: usize| from[i] * from_weight + to[i] * to_weight;
        self.rotation = [turned(0), turned(1), turned(2), turned(3)];
    }

    /// The parts of each joint as one matrix: [`LocalJoint::parent_from_joint`] of all four.
    #[inline]
    pub fn parent_from_joint(&self) -> MatrixLanes {
        let [x, y, z, w] = self.rotation;
        let (x2, y2, z2) = (x + x, y + y, z + z);
        let (xx, xy, xz) = (x * x2, x * y2, x * z2);
        let (yy, yz, zz) = (y * y2, y * z2, z * z2);
        let (wx, wy, wz) = (w * x2, w * y2, w * z2);
        let [scale_x, scale_y, scale_z] = self.scale;
        let one = Vec4::ONE;
        MatrixLanes {
            x_axis: numbers([(one - (yy + zz)) * scale_x, (xy + wz) * scale_x, (xz - wy) * scale_x]),
            y_axis: numbers([(xy - wz) * scale_y, (one - (xx + zz)) * scale_y, (yz + wx) * scale_y]),
            z_axis: numbers([(xz + wy) * scale_z, (yz - wx) * scale_z, (one - (xx + yy)) * scale_z]),
            translation: numbers(self.translation),
        }
    }
}

/// Four affine matrices side by side: each column as x, y and z, each of these for the four lanes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MatrixLanes {
    /// First columns.
    pub x_axis: [[f32; 4]; 3],
    /// Second columns.
    pub y_axis: [[f32; 4]; 3],
    /// Third columns.
    pub z_axis: [[f32; 4]; 3],
    /// Fourth columns.
    pub translation: [[f32; 4]; 3],
}

impl MatrixLanes {
    /// `left · m`, where m is the matrix of one lane, below 4. The numbers of m are taken from their lanes as they are
    /// needed, which saves turning the four into matrices of their own.
    #[inline]
    pub fn after(&self, left: &Affine3A, lane: usize) -> Affine3A {
        let Mat3A { x_axis, y_axis, z_axis } = left.matrix3;
        let column = |[x, y, z]: &[[f32; 4]; 3]| x_axis * x[lane] + y_axis * y[lane] + z_axis * z[lane];
        Affine3A {
            matrix3: Mat3A::from_cols(column(&self.x_axis), column(&self.y_axis), column(&self.z_axis)),
            translation: column(&self.translation) + left.translation,
        }
    }
}

/// Takes vectors in a straight line between four and four others, each lane at its own part of the way, 0…1.
#[inline(always)]
pub(super) fn set_straight_between(vectors: &mut [Vec4; 3], from: &[Vec4; 3], to: &[Vec4; 3], part: Vec4) {
    let rest = Vec4::ONE - part;
    vectors[0] = from[0] * rest + to[0] * part;
    vectors[1] = from[1] * rest + to[1] * part;
    vectors[2] = from[2] * rest + to[2] * part;
}

/// The arcs between four unit quaternions and four others on the same side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ArcLanes {
    /// Square of the angle between the quaternions, radians², 0…(π/2)².
    angle_squared: Vec4,
    /// angle / sin(angle), 1 for equal rotations. From the square it could be had in fewer bits alone.
    angle_over_sine: Vec4,
}

impl ArcLanes {
    /// Arcs without length.
    pub(super) const NONE: Self = Self {
        angle_squared: Vec4::ZERO,
        angle_over_sine: Vec4::ONE,
    };

    /// Sets the arc of one lane, below 4, by the [`angle_between`] its quaternions.
    pub(super) fn set(&mut self, lane: usize, angle: f64) {
        self.angle_squared[lane] = (angle * angle) as f32;
        let sine = angle.sin();
        self.angle_over_sine[lane] = if sine > 0.0 { (angle / sine) as f32 } else { 1.0 };
    }

    /// Turns the quaternions of `to` to the side of those of `from`, and gives the arcs between them. q and −q are the same
    /// rotation, but the arc between them is the long one.
    pub(super) fn to_same_side(from: &JointLanes, to: &mut JointLanes) -> Self {
        let cosine = (0..4).fold(Vec4::ZERO, |sum, i| sum + from.rotation[i] * to.rotation[i]);
        let side = Vec4::select(cosine.cmplt(Vec4::ZERO), Vec4::NEG_ONE, Vec4::ONE);
        to.rotation = to.rotation.map(|lanes| lanes * side);
        let mut arc = Self::NONE;
        for lane in 0..JointLanes::COUNT {
            let [from, to] = [from, to].map(|joints| joints.joint(lane).rotation.as_dquat());
            arc.set(lane, angle_between(from, to));
        }
        arc
    }

    /// The weights of both ends at a fraction of the way, for even speed: sin(rest · angle) / sin(angle) and
    /// sin(part · angle) / sin(angle), written with [`sine_over_angle`] so that they hold for an angle of 0 too.
    #[inline]
    fn weights(&self, part: Vec4) -> [Vec4; 2] {
        let weight = |part| part * sine_over_angle(self.angle_squared * part * part) * self.angle_over_sine;
        [weight(Vec4::ONE - part), weight(part)]
    }
}

/// The angle between two unit quaternions, 0…π: half the angle of the turn from one rotation to the other, or half of what
/// is left of a full turn where they are on different sides.
pub(super) fn angle_between(from: DQuat, to: DQuat) -> f64 {
    // Twice the half angle, by its tangent: exact for small angles, where the cosine is nearly constant.
    2.0 * (to - from).length().atan2((to + from).length())
}

/// The angle of the turn from one unit rotation to another, the shorter way round, 0…π.
pub(super) fn turn_between(from: DQuat, to: DQuat) -> f64 {
    let to = if from.dot(to) < 0.0 { -to } else { to };
    2.0 * angle_between(from, to)
}

#[inline]
fn numbers([x, y, z]: [Vec4; 3]) -> [[f32; 4]; 3] {
    [x.to_array(), y.to_array(), z.to_array()]
}

/// sin(x) / x of x², for x in 0…π/2: the Taylor polynomial whose first left-out term is below 4e-8 there.
#[inline]
fn sine_over_angle(angle_squared: Vec4) -> Vec4 {
    let x = angle_squared;
    // From the highest power down.
    let sum = (x * (-1.0 / 39_916_800.0) + 1.0 / 362_880.0) * x - 1.0 / 5_040.0;
    ((sum * x + 1.0 / 120.0) * x - 1.0 / 6.0) * x + 1.0
}
