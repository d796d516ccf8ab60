//! How far apart two poses of one joint are, in lengths that can be compared, and how much each joint moves in a clip.

use glam::Vec3A;

use super::lanes::turn_between;
use crate::model::{Clip, JointIndex, LocalJoint, Skeleton, Track};

/// A joint that moves its surface by less than this fraction of the model's size counts as still: files round their numbers
/// to about six digits.
const STILL_FRACTION: f32 = 1e-5;

/// What one joint does in a clip, relative to its parent.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct JointActivity {
    /// How far its surface moves in all, as a fraction of the joint that moves most: 0…1, 0 for constant joints.
    pub fraction: f32,
    /// How far the joint itself moves in all, in model units.
    pub path: f32,
    /// Sum of the angles that it turns by, degrees.
    pub turned_degrees: f32,
    /// Sum of its changes of scale, each as a fraction of the greater scale.
    pub scaled: f32,
    /// Whether all its keys are equal, or it has none.
    pub constant: bool,
}

/// The activity of each joint, in the skeleton's order; `size` is the length of the model's diagonal in its own units.
///
/// Between two keys a joint moves in a straight line and turns along one arc, so a sum over the keys is the length of the whole
/// path. Turns and scales count by how far they move a surface that reaches a tenth of the size from its joint.
pub fn activity(skeleton: &Skeleton, clip: &Clip, size: f32) -> Vec<JointActivity> {
    let mut ways = Vec::with_capacity(clip.tracks.len());
    let mut joints: Vec<JointActivity> = (0u32..)
        .map(JointIndex)
        .zip(&clip.tracks)
        .map(|(joint, track)| {
            let (activity, way) = of_track(skeleton, joint, track, size);
            ways.push(way);
            activity
        })
        .collect();
    let most = ways.iter().copied().fold(0.0, f32::max);
    if most > 0.0 {
        for (joint, way) in joints.iter_mut().zip(ways) {
            joint.fraction = way / most;
        }
    }
    joints
}

/// The activity of a joint without its fraction, and the length of its surface's path.
fn of_track(skeleton: &Skeleton, joint: JointIndex, track: &Track, size: f32) -> (JointActivity, f32) {
    let first = track.key(0);
    let mut before = first;
    let mut activity = JointActivity {
        constant: true,
        ..JointActivity::default()
    };
    let mut way = 0.0;
    for (_, key) in track.keys().skip(1) {
        let change = JointChange::between(skeleton, joint, &before, &key);
        activity.path += change.translation;
        activity.turned_degrees += change.rotation_radians.to_degrees();
        activity.scaled += change.scale;
        way += change.surface_way(size);
        let off = JointChange::between(skeleton, joint, &first, &key).surface_way(size);
        activity.constant &= off <= STILL_FRACTION * size;
        before = key;
    }
    if activity.constant {
        (activity, 0.0)
    } else {
        (activity, way)
    }
}

/// How far the part of a surface that follows one joint reaches from it, as a fraction of the model's size: a forearm, a head
/// or a foot is about a tenth of a figure. It turns angles and scales into lengths.
const REACH_FRACTION: f32 = 0.1;

/// The way from one pose of a joint to another, relative to its parent.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct JointChange {
    /// Distance of the joint's place in model units.
    pub(super) translation: f32,
    /// Angle of the turn, 0…π.
    pub(super) rotation_radians: f32,
    /// Greatest change along an axis, as a fraction of the greater scale.
    pub(super) scale: f32,
}

impl JointChange {
    /// From one pose of a joint to another. The parent's bind pose brings lengths into model space: its scale is often that of an
    /// exporter's units.
    pub(crate) fn between(skeleton: &Skeleton, joint: JointIndex, from: &LocalJoint, to: &LocalJoint) -> Self {
        let way: Vec3A = (to.translation - from.translation).into();
        let parent = skeleton.parents().get(joint.index()).copied().flatten();
        let way = parent.map_or(way, |parent| {
            skeleton.bind_model_from_joint()[parent.index()].matrix3 * way
        });
        let scale = |axis: usize| {
            let (from, to) = (from.scale[axis], to.scale[axis]);
            let greater = from.abs().max(to.abs());
            if greater > 0.0 {
                (to - from).abs() / greater
            } else {
                0.0
            }
        };
        let turn = turn_between(from.rotation.as_dquat(), to.rotation.as_dquat());
        Self {
            translation: way.length(),
            rotation_radians: turn as f32,
            scale: scale(0).max(scale(1)).max(scale(2)),
        }
    }

    /// How far the surface that follows the joint moves, in model units, for a model of a size in those units.
    pub(crate) fn surface_way(&self, size: f32) -> f32 {
        self.translation + (self.rotation_radians + self.scale) * REACH_FRACTION * size
    }
}
