//! When there are keys: for rows of marks, and for steps from key to key.

use crate::model::{Clip, JointIndex, Track};

/// Which way along the time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Direction {
    /// To later times.
    Forward,
    /// To earlier times.
    Backward,
}

/// Keys this close together, in frames, are one: what files and f32 lose of a time is less, and no eye tells them apart.
const ONE_KEY: f32 = 0.05;

/// Key times of one joint, seconds, in order: a slice of the clip. Empty for a joint that has no keys or is not there.
pub fn key_times(clip: &Clip, joint: JointIndex) -> &[f32] {
    clip.tracks
        .get(joint.index())
        .filter(|track| track.has_keys())
        .map(Track::times_secs)
        .unwrap_or_default()
}

/// Times at which any joint has a key, seconds, in order. Of times closer than a twentieth of a frame the first is kept.
pub fn merged_key_times(clip: &Clip) -> Vec<f32> {
    merged(clip, clip.tracks.iter())
}

/// The same of some joints. Those that are not there have none.
pub fn merged_key_times_of(clip: &Clip, joints: &[JointIndex]) -> Vec<f32> {
    merged(clip, joints.iter().filter_map(|joint| clip.tracks.get(joint.index())))
}

fn merged<'a>(clip: &Clip, tracks: impl Iterator<Item = &'a Track>) -> Vec<f32> {
    let keyed = tracks.filter(|track| track.has_keys());
    let mut times_secs: Vec<f32> = keyed.flat_map(Track::times_secs).copied().collect();
    // A stable sort merges runs that are sorted, as these are.
    times_secs.sort_by(f32::total_cmp);
    let same_secs = ONE_KEY / clip.keys_per_sec;
    times_secs.dedup_by(|later, kept| *later - *kept < same_secs);
    times_secs
}

/// The first of `key_times` after a time, and not merely a rounding after it; `key_times` are of the clip, in order.
pub fn next_key(clip: &Clip, key_times: &[f32], time_secs: f32) -> Option<f32> {
    let after_secs = time_secs + ONE_KEY / clip.keys_per_sec;
    let next = key_times.partition_point(|&key_secs| key_secs <= after_secs);
    key_times.get(next).copied()
}

/// The last of `key_times` before a time, and not merely a rounding before it.
pub fn previous_key(clip: &Clip, key_times: &[f32], time_secs: f32) -> Option<f32> {
    let before_secs = time_secs - ONE_KEY / clip.keys_per_sec;
    let next = key_times.partition_point(|&key_secs| key_secs < before_secs);
    key_times[..next].last().copied()
}
