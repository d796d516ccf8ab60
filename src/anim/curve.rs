//! The motion of one joint as curves over time.

use std::f64::consts::PI;

use glam::{DAffine3, DQuat, DVec3, Quat, Vec3};

use super::compile::CompiledClip;
use super::lanes::turn_between;
use super::sample::sample_joint;
use crate::model::{JointIndex, LocalJoint, Skeleton};

/// A joint turns by at most this from mark to mark: far less than the half turn, at which either way round is as short.
const MARK_RADIANS: f64 = PI / 6.0;
/// The most marks between two keys. No eye follows a chain of joints that turns farther from key to key.
const MOST_STEPS: f64 = 64.0;
/// How often the distance between marks is halved near the poles of y.
const MOST_HALVINGS: u32 = 8;

/// What the values of a curve are relative to.
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
    /// Unit rotation, on the same side as those of times nearby.
    pub rotation: Quat,
    /// The same as turns about the fixed axes x, then y, then z, in degrees: R = Rz · Ry · Rx. They go on beyond ±180°
    /// where the motion does, so that the curves have no jumps that the motion lacks.
    pub euler_degrees: Vec3,
    /// Scale along the joint's own axes. In model space, shear is dropped.
    pub scale: Vec3,
}

/// The curves of one joint in one clip.
///
/// A rotation has two quaternions and any number of Euler angles. Marks from the clip's start to its end settle which of them
/// the curve shows, so that its value at a time does not depend on the stretch of time that is drawn.
#[derive(Clone, Debug)]
pub struct Curve {
    joint: JointIndex,
    space: CurveSpace,
    /// In the order of time, the first at the clip's start.
    marks: Vec<Mark>,
}

/// The rotation that a curve shows at a time. Times up to the next mark follow it.
#[derive(Clone, Copy, Debug)]
struct Mark {
    time_secs: f32,
    rotation: Quat,
    /// Turns about x, y, z, radians.
    euler: DVec3,
}

impl Mark {
    /// What follows a mark at a later time; the principal angles without one.
    fn after(before: Option<&Self>, time_secs: f32, mut rotation: Quat) -> Self {
        if before.is_some_and(|before| before.rotation.dot(rotation) < 0.0) {
            rotation = -rotation;
        }
        let euler = euler_radians(rotation.as_dquat(), before.map(|before| before.euler));
        Self {
            time_secs,
            rotation,
            euler,
        }
    }
}

impl Curve {
    /// The curves of a joint, relative to its parent or to the model. A joint that the skeleton lacks is the identity.
    pub fn new(skeleton: &Skeleton, clip: &CompiledClip, joint: JointIndex, space: CurveSpace) -> Self {
        let mut curve = Self {
            joint,
            space,
            marks: Vec::new(),
        };
        let rotation = curve.pose(skeleton, clip, clip.start_secs()).rotation;
        curve.marks.push(Mark::after(None, clip.start_secs(), rotation));
        let chain = curve.chain(skeleton);
        let times_secs = clip.key_times_of(&chain);
        let turns_at = |secs: f32| -> Vec<DQuat> {
            let rotation = |&joint| sample_joint(skeleton, clip, joint, secs).rotation.as_dquat();
            chain.iter().map(rotation).collect()
        };
        let (mut start_secs, mut turns) = (clip.start_secs(), turns_at(clip.start_secs()));
        for end_secs in times_secs {
            if end_secs <= start_secs {
                continue;
            }
            let next_turns = turns_at(end_secs);
            // Together the joints of a chain turn by no more than each by itself.
            let angle: f64 = turns.iter().zip(&next_turns).map(|(a, b)| turn_between(*a, *b)).sum();
            let steps = (angle / MARK_RADIANS).ceil().clamp(1.0, MOST_STEPS) as u32;
            for step in 1..=steps {
                let part = f64::from(step) / f64::from(steps);
                curve.mark_to(skeleton, clip, between(start_secs, end_secs, part), MOST_HALVINGS);
            }
            (start_secs, turns) = (end_secs, next_turns);
        }
        curve
    }

    /// Sets marks up to a time. Near the poles of y small turns are great angles: there marks stand closer.
    fn mark_to(&mut self, skeleton: &Skeleton, clip: &CompiledClip, time_secs: f32, halvings: u32) {
        let before = self.marks[self.marks.len() - 1];
        let rotation = self.pose(skeleton, clip, time_secs).rotation;
        let mark = Mark::after(Some(&before), time_secs, rotation);
        let middle_secs = between(before.time_secs, time_secs, 0.5);
        let is_far = (mark.euler - before.euler).abs().max_element() > 1.5 * MARK_RADIANS;
        if is_far && halvings > 0 && before.time_secs < middle_secs && middle_secs < time_secs {
            self.mark_to(skeleton, clip, middle_secs, halvings - 1);
            self.mark_to(skeleton, clip, time_secs, halvings - 1);
        } else {
            self.marks.push(mark);
        }
    }

    /// The joints that turn it.
    fn chain(&self, skeleton: &Skeleton) -> Vec<JointIndex> {
        let above = |joint: &JointIndex| skeleton.parents().get(joint.index()).copied().flatten();
        match self.space {
            CurveSpace::Local => vec![self.joint],
            CurveSpace::Model => std::iter::successors(Some(self.joint), above).collect(),
        }
    }

    fn pose(&self, skeleton: &Skeleton, clip: &CompiledClip, time_secs: f32) -> LocalJoint {
        match self.space {
            CurveSpace::Local => sample_joint(skeleton, clip, self.joint, time_secs),
            CurveSpace::Model => model_joint(skeleton, clip, self.joint, time_secs),
        }
    }

    /// The curves at one time, seconds in the clip's own time; `skeleton` and `clip` are those that it was made of.
    pub fn at(&self, skeleton: &Skeleton, clip: &CompiledClip, time_secs: f32) -> CurvePoint {
        let LocalJoint {
            rotation,
            translation,
            scale,
        } = self.pose(skeleton, clip, time_secs);
        let next = self.marks.partition_point(|mark| mark.time_secs <= time_secs);
        let Mark { rotation, euler, .. } = Mark::after(self.marks.get(next.saturating_sub(1)), time_secs, rotation);
        CurvePoint {
            time_secs,
            translation,
            rotation,
            euler_degrees: (euler * (180.0 / PI)).as_vec3(),
            scale,
        }
    }

    /// The curves over a stretch of time, at as many points as `out` holds: evenly spaced, both ends among them; a single point
    /// is at the start. Allocates nothing.
    pub fn sample(
        &self,
        skeleton: &Skeleton,
        clip: &CompiledClip,
        [start_secs, end_secs]: [f32; 2],
        out: &mut [CurvePoint],
    ) {
        let steps = out.len().saturating_sub(1).max(1) as f64;
        for (index, point) in out.iter_mut().enumerate() {
            *point = self.at(skeleton, clip, between(start_secs, end_secs, index as f64 / steps));
        }
    }
}

/// A time between two, exact at both ends.
fn between(start_secs: f32, end_secs: f32, part: f64) -> f32 {
    (f64::from(start_secs) * (1.0 - part) + f64::from(end_secs) * part) as f32
}

/// A joint relative to the model: its own pose, then that of each ancestor.
fn model_joint(skeleton: &Skeleton, clip: &CompiledClip, joint: JointIndex, time_secs: f32) -> LocalJoint {
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

/// Where the cosine of the turn about y is less, x and z turn about nearly one axis. Only their sum or difference is known then:
/// the rounding of an f32 quaternion would be visible in either.
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

/// Adds whole turns to each angle, to bring it nearest to what it was.
fn unwrapped(euler: DVec3, before: DVec3) -> DVec3 {
    let turns = ((before - euler) / (2.0 * PI)).round();
    euler + turns * (2.0 * PI)
}
