//! Four tracks side by side, on one time line.

use glam::{DQuat, Vec3, Vec4};

use super::track::angle_between;
use super::{JointLanes, LocalJoint, Track};

/// The tracks of four neighbouring joints with their keys at the same times, so that one search and one blend serve all
/// four. A track that lacks a time of the others has there, as its key, what it says at that time: the motion is the same.
/// A group therefore has no more keys than its tracks together.
#[derive(Clone, Debug)]
pub(crate) struct TrackGroup {
    times_secs: Vec<f32>,
    keys: Vec<KeyLanes>,
}

/// One key of four tracks, and the way to the next.
#[derive(Clone, Copy, Debug)]
pub(crate) struct KeyLanes {
    /// The joints. Neighbouring keys have rotations on the same side.
    pub(crate) joints: JointLanes,
    /// Square of the angle between the quaternions of this key and the next, radians², 0…(π/2)².
    pub(crate) angle_squared: Vec4,
    /// angle / sin(angle), 1 for equal rotations.
    pub(crate) angle_over_sine: Vec4,
}

impl TrackGroup {
    /// Up to four tracks; the lanes of missing ones are identities.
    pub(super) fn new(tracks: &[Track]) -> Self {
        let times_secs = common_times(tracks);
        let still = KeyLanes {
            joints: JointLanes::IDENTITY,
            angle_squared: Vec4::ZERO,
            angle_over_sine: Vec4::ONE,
        };
        let mut keys = vec![still; times_secs.len()];
        for (lane, track) in tracks.iter().enumerate() {
            fill_lane(lane, track, &times_secs, &mut keys);
        }
        Self { times_secs, keys }
    }

    /// Key times in seconds, strictly increasing; at least one.
    pub(crate) fn times_secs(&self) -> &[f32] {
        &self.times_secs
    }

    /// One per time.
    pub(crate) fn keys(&self) -> &[KeyLanes] {
        &self.keys
    }
}

/// Every time at which a track has a key.
fn common_times(tracks: &[Track]) -> Vec<f32> {
    let mut times_secs: Vec<f32> = tracks.iter().flat_map(Track::times_secs).copied().collect();
    // A stable sort merges runs that are sorted, as these are.
    times_secs.sort_by(f32::total_cmp);
    times_secs.dedup();
    times_secs
}

fn fill_lane(lane: usize, track: &Track, times_secs: &[f32], keys: &mut [KeyLanes]) {
    let mut from = 0;
    let mut before: Option<(&mut KeyLanes, DQuat)> = None;
    for (key, &time_secs) in keys.iter_mut().zip(times_secs) {
        while track.times_secs().get(from + 1).is_some_and(|&next| next <= time_secs) {
            from += 1;
        }
        let joint = joint_at(track, from, time_secs);
        key.joints.set_joint(lane, joint);
        let rotation = joint.rotation.as_dquat();
        if let Some((key, start)) = before {
            let angle = angle_between(start, rotation);
            key.angle_squared[lane] = (angle * angle) as f32;
            key.angle_over_sine[lane] = angle_over_sine(angle) as f32;
        }
        before = Some((key, rotation));
    }
}

/// A track at a time, in f64, where `from` is the last key at or before that time, or the first.
pub(super) fn joint_at(track: &Track, from: usize, time_secs: f32) -> LocalJoint {
    let start_secs = track.times_secs()[from];
    let end_secs = match track.times_secs().get(from + 1) {
        Some(&end_secs) if start_secs < time_secs => end_secs,
        _ => return track.key(from),
    };
    let start_secs = f64::from(start_secs);
    let part = (f64::from(time_secs) - start_secs) / (f64::from(end_secs) - start_secs);
    let (from, to) = (track.key(from), track.key(from + 1));
    let blend = |from: Vec3, to: Vec3| (from.as_dvec3() * (1.0 - part) + to.as_dvec3() * part).as_vec3();
    let (start, end) = (from.rotation.as_dquat(), to.rotation.as_dquat());
    let angle = angle_between(start, end);
    // sin(part · angle) / sin(angle), which is the part itself when there is no angle.
    let weight = |part: f64| part * angle_over_sine(angle) / angle_over_sine(part * angle);
    LocalJoint {
        rotation: (start * weight(1.0 - part) + end * weight(part)).normalize().as_quat(),
        translation: blend(from.translation, to.translation),
        scale: blend(from.scale, to.scale),
    }
}

/// angle / sin(angle), for an angle of 0 too.
fn angle_over_sine(angle: f64) -> f64 {
    let sine = angle.sin();
    if sine > 0.0 { angle / sine } else { 1.0 }
}
