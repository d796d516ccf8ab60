//! The motion of one joint as curves over time.

use std::f64::consts::PI;

use glam::{DAffine3, DQuat, DVec3, Quat, Vec3};

use super::sample_joint;
use crate::model::{Clip, JointIndex, LocalJoint, Skeleton};

/// Relative to what a curve shows a joint.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum CurveSpace {
    /// Its parent.
    #[default]
    Local,
    /// The model.
    Model,
}

/// One point of a joint's curves.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CurvePoint {
    /// Seconds in the clip's own time.
    pub time_secs: f32,
    /// Translation.
    pub translation: Vec3,
    /// Unit rotation, on the same side as that of the point before.
    pub rotation: Quat,
    /// The same as turns about the fixed axes x, then y, then z, in degrees: R = Rz · Ry · Rx. They go on beyond ±180°
    /// where the motion does, so that the curves have no jumps that the motion lacks.
    pub euler_degrees: Vec3,
    /// Scale along the joint's own axes. In model space, shear has no part and is left out.
    pub scale: Vec3,
}

/// The curves of a joint over a stretch of time, at as many points as `out` holds: evenly spaced, both ends among them; a
/// single point is at the start. Allocates nothing. A joint that the skeleton lacks is the identity.
pub fn curve(
    skeleton: &Skeleton,
    clip: &Clip,
    joint: JointIndex,
    space: CurveSpace,
    [start_secs, end_secs]: [f32; 2],
    out: &mut [CurvePoint],
) {
    let steps = out.len().saturating_sub(1).max(1) as f64;
    let (start, end) = (f64::from(start_secs), f64::from(end_secs));
    let mut before: Option<(Quat, DVec3)> = None;
    for (index, point) in out.iter_mut().enumerate() {
        let part = index as f64 / steps;
        let time_secs = (start * (1.0 - part) + end * part) as f32;
        let LocalJoint {
            mut rotation,
            translation,
            scale,
        } = match space {
            CurveSpace::Local => sample_joint(skeleton, clip, joint, time_secs),
            CurveSpace::Model => model_joint(skeleton, clip, joint, time_secs),
        };
        if before.is_some_and(|(before, _)| before.dot(rotation) < 0.0) {
            rotation = -rotation;
        }
        let euler = euler_radians(rotation.as_dquat(), before.map(|(_, euler)| euler));
        before = Some((rotation, euler));
        *point = CurvePoint {
            time_secs,
            translation,
            rotation,
            euler_degrees: (euler * (180.0 / PI)).as_vec3(),
            scale,
        };
    }
}

/// A joint relative to the model: its own pose, then that of each ancestor.
fn model_joint(skeleton: &Skeleton, clip: &Clip, joint: JointIndex, time_secs: f32) -> LocalJoint {
    let mut model_from_joint = DAffine3::IDENTITY;
    let mut next = Some(joint);
    while let Some(joint) = next {
        let local = sample_joint(skeleton, clip, joint, time_secs);
        let parent_from_joint = DAffine3::from_scale_rotation_translation(
            local.scale.as_dvec3(),
            local.rotation.as_dquat(),
            local.translation.as_dvec3(),
        );
        model_from_joint = parent_from_joint * model_from_joint;
        next = skeleton.parents().get(joint.index()).copied().flatten();
    }
    LocalJoint::from_matrix(&model_from_joint)
}

/// Where the cosine of the turn about y is less, x and z turn about one axis and only their sum or difference is told: what
/// f32 loses of a quaternion would be a visible part of either.
const GIMBAL_COSINE: f64 = 1e-4;

/// Turns about the fixed axes x, y, z of a unit rotation, radians: of all triples that give it the nearest to the one
/// before, or that of x and z in ±π, y in ±π/2.
fn euler_radians(rotation: DQuat, before: Option<DVec3>) -> DVec3 {
    let DQuat { x, y, z, w } = rotation.normalize();
    // The third row and the first column of the rotation's matrix: −sin y stands where they meet.
    let sine = (2.0 * (w * y - x * z)).clamp(-1.0, 1.0);
    let (row_y, row_z) = (2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y));
    let (column_x, column_y) = (1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z));
    let about_y = sine.atan2(row_y.hypot(row_z));
    if row_y.hypot(row_z) < GIMBAL_COSINE {
        // With y at ±π/2 the second column holds −sin and cos of z ∓ x: the turn about x stays what it was.
        let about_x = before.map_or(0.0, |before| before.x);
        let difference = (2.0 * (w * z - x * y)).atan2(1.0 - 2.0 * (x * x + z * z));
        let about_z = if sine > 0.0 {
            difference + about_x
        } else {
            difference - about_x
        };
        let euler = DVec3::new(about_x, about_y, about_z);
        return before.map_or(euler, |before| unwrapped(euler, before));
    }
    let euler = DVec3::new(row_y.atan2(row_z), about_y, column_y.atan2(column_x));
    let Some(before) = before else { return euler };
    // The same rotation by the other way about y.
    let other = DVec3::new(euler.x + PI, PI - euler.y, euler.z + PI);
    let [euler, other] = [euler, other].map(|euler| unwrapped(euler, before));
    if other.distance_squared(before) < euler.distance_squared(before) {
        other
    } else {
        euler
    }
}

/// Each angle by whole turns nearest to what it was.
fn unwrapped(euler: DVec3, before: DVec3) -> DVec3 {
    let turns = ((before - euler) / (2.0 * PI)).round();
    euler + turns * (2.0 * PI)
}
