//! How much each joint moves in a clip.

use super::joint_change::JointChange;
use crate::model::{Clip, JointIndex, Skeleton, Track};

/// A joint that moves its surface by less than this share of the model's size does not move: files round their numbers to
/// about six digits.
const STILL_SHARE: f32 = 1e-5;

/// What one joint does in a clip, relative to its parent.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct JointActivity {
    /// Length of the way of its surface, as a share of that of the joint that moves most: 0…1, 0 for constant ones.
    pub share: f32,
    /// Length of the way of the joint itself, in model units.
    pub path: f32,
    /// Sum of the angles that it turns by, degrees.
    pub turned_degrees: f32,
    /// Sum of its changes of scale, each as a share of the greater scale.
    pub scaled: f32,
    /// Whether all its keys say the same, or it has none.
    pub constant: bool,
}

/// The activity of each joint, in the skeleton's order; `size` is the length of the model's diagonal in its own units.
///
/// Between two keys a joint goes straight and turns along one arc, so the sums over the keys are the lengths of the whole
/// ways. A turn and a scale count by what they move a surface that reaches a tenth of the size from its joint.
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
            joint.share = way / most;
        }
    }
    joints
}

/// The activity of a joint but for its share, and the length of its surface's way.
fn of_track(skeleton: &Skeleton, joint: JointIndex, track: &Track, size: f32) -> (JointActivity, f32) {
    let first = track.key(0);
    let mut before = first;
    let mut activity = JointActivity {
        constant: true,
        ..JointActivity::default()
    };
    let mut way = 0.0;
    for key in (1..track.key_count()).map(|index| track.key(index)) {
        let change = JointChange::between(skeleton, joint, &before, &key);
        activity.path += change.translation;
        activity.turned_degrees += change.rotation_radians.to_degrees();
        activity.scaled += change.scale;
        way += change.surface_way(size);
        let off = JointChange::between(skeleton, joint, &first, &key).surface_way(size);
        activity.constant &= off <= STILL_SHARE * size;
        before = key;
    }
    if activity.constant {
        (activity, 0.0)
    } else {
        (activity, way)
    }
}
