//! A clip made ready for sampling: four tracks side by side, on one time line.

use glam::DQuat;

use super::lanes::{ArcLanes, JointLanes, angle_between};
use super::straight::straight;
use crate::model::{Clip, JointIndex, LocalJoint, Track};
use crate::slices::{Slices, Stage, at_once};

/// Probe times of a clip at most.
const MOST_PROBE_TIMES: usize = 1_000;

/// A clip as [`sample`](super::sample()) wants it: its joints in groups of four, with the arcs between their keys.
///
/// It has the same motion as its [`Clip`], which has the tracks as the file has them. A clip is compiled once, when its model is
/// made ready, and kept beside the model: compiling reads every key, sampling reads two.
#[derive(Clone, Debug, Default)]
pub struct CompiledClip {
    start_secs: f32,
    end_secs: f32,
    joint_count: usize,
    groups: Vec<TrackGroup>,
}

/// The tracks of four neighbouring joints with their keys at the same times, so that one search and one blend serve all
/// four. Where a track lacks a time of the others, its value at that time becomes a key: the motion is the same.
/// A group therefore has no more keys than its tracks together.
#[derive(Clone, Debug)]
pub(super) struct TrackGroup {
    times_secs: Vec<f32>,
    keys: Vec<KeyLanes>,
}

/// One key of four tracks, and the way to the next.
#[derive(Clone, Copy, Debug)]
pub(super) struct KeyLanes {
    /// The joints. Neighbouring keys have rotations on the same side.
    pub(super) joints: JointLanes,
    /// From this key to the next.
    pub(super) arc: ArcLanes,
}

impl CompiledClip {
    /// Compiles a clip.
    pub fn new(clip: &Clip) -> Self {
        Self::all(std::slice::from_ref(clip)).pop().unwrap_or_default()
    }

    /// Compiles some clips, in their order.
    pub fn all(clips: &[Clip]) -> Vec<Self> {
        at_once(Self::all_in(clips, &Slices::ENDLESS))
    }

    /// [`CompiledClip::all`] in slices.
    pub async fn all_in(clips: &[Clip], slices: &Slices) -> Vec<Self> {
        let mut all = Vec::with_capacity(clips.len());
        for (done, clip) in clips.iter().enumerate() {
            let mut groups = Vec::with_capacity(clip.tracks.len().div_ceil(JointLanes::COUNT));
            for tracks in clip.tracks.chunks(JointLanes::COUNT) {
                slices.pause_at(Stage::Compiling, done, clips.len()).await;
                groups.push(TrackGroup::new(tracks, slices).await);
            }
            all.push(Self {
                start_secs: clip.start_secs,
                end_secs: clip.end_secs,
                joint_count: clip.tracks.len(),
                groups,
            });
        }
        all
    }

    /// The clip's start: the least key time.
    pub fn start_secs(&self) -> f32 {
        self.start_secs
    }

    /// The clip's end: the greatest key time.
    pub fn end_secs(&self) -> f32 {
        self.end_secs
    }

    pub(super) fn joint_count(&self) -> usize {
        self.joint_count
    }

    /// Joints 0 to 3, joints 4 to 7 and so on.
    pub(super) fn groups(&self) -> &[TrackGroup] {
        &self.groups
    }

    /// The group of a joint and its lane; `None` for a joint that the clip lacks.
    pub(super) fn lane_of(&self, joint: JointIndex) -> Option<(&TrackGroup, usize)> {
        let (group, lane) = (joint.index() / JointLanes::COUNT, joint.index() % JointLanes::COUNT);
        let group = self.groups.get(group)?;
        (joint.index() < self.joint_count).then_some((group, lane))
    }

    /// Times after the start at which one of some joints has a key, in order, the end among them. A joint has a key where the
    /// others of its group have one, too.
    pub(super) fn key_times_of(&self, joints: &[JointIndex]) -> Vec<f32> {
        let groups = joints.iter().filter_map(|&joint| Some(self.lane_of(joint)?.0));
        let times_secs = groups.flat_map(TrackGroup::times_secs).copied().chain([self.end_secs]);
        let mut times_secs: Vec<f32> = times_secs
            .filter(|&time_secs| self.start_secs < time_secs && time_secs <= self.end_secs)
            .collect();
        times_secs.sort_by(f32::total_cmp);
        times_secs.dedup();
        times_secs
    }

    /// Times inside the clip at which to pose it to learn all that it reaches: the distinct key times, in order; at least
    /// the start. A clip with more than 1 000 of them has as many times, evenly spread over its length, instead.
    pub(crate) fn probe_times_secs(&self) -> Vec<f32> {
        let times_secs = self.groups.iter().flat_map(TrackGroup::times_secs);
        // The key of a joint at rest may lie outside.
        let inside = times_secs.filter(|&&time_secs| (self.start_secs..=self.end_secs).contains(&time_secs));
        let mut times_secs: Vec<f32> = inside.copied().chain([self.start_secs]).collect();
        times_secs.sort_unstable_by(f32::total_cmp);
        times_secs.dedup();
        if times_secs.len() > MOST_PROBE_TIMES {
            let step_secs = (self.end_secs - self.start_secs) / (MOST_PROBE_TIMES - 1) as f32;
            times_secs = (0..MOST_PROBE_TIMES)
                .map(|step| self.start_secs + step as f32 * step_secs)
                .collect();
        }
        times_secs
    }
}

impl TrackGroup {
    /// Up to four tracks; the lanes of missing ones are identities.
    async fn new(tracks: &[Track], slices: &Slices) -> Self {
        let tracks: Vec<_> = tracks.iter().map(straight).collect();
        let tracks: Vec<&Track> = tracks.iter().map(AsRef::as_ref).collect();
        let times_secs = common_times(&tracks);
        let still = KeyLanes {
            joints: JointLanes::IDENTITY,
            arc: ArcLanes::NONE,
        };
        let mut keys = vec![still; times_secs.len()];
        for (lane, track) in tracks.iter().enumerate() {
            fill_lane(lane, track, &times_secs, &mut keys, slices).await;
        }
        Self { times_secs, keys }
    }

    /// Key times in seconds, strictly increasing; at least one.
    pub(super) fn times_secs(&self) -> &[f32] {
        &self.times_secs
    }

    /// One per time.
    pub(super) fn keys(&self) -> &[KeyLanes] {
        &self.keys
    }
}

/// Every time at which a track has a key.
fn common_times(tracks: &[&Track]) -> Vec<f32> {
    let mut times_secs: Vec<f32> = tracks.iter().flat_map(|track| track.times_secs()).copied().collect();
    // A stable sort merges runs that are sorted, as these are.
    times_secs.sort_by(f32::total_cmp);
    times_secs.dedup();
    times_secs
}

async fn fill_lane<'a>(lane: usize, track: &Track, times_secs: &[f32], keys: &'a mut [KeyLanes], slices: &Slices) {
    let mut before: Option<(&'a mut KeyLanes, DQuat)> = None;
    let keyed = keys.iter_mut().zip(track.at_times(times_secs));
    let fill = |(key, joint): (&'a mut KeyLanes, LocalJoint)| {
        key.joints.set_joint(lane, joint);
        let rotation = joint.rotation.as_dquat();
        if let Some((key, start)) = before.take() {
            key.arc.set(lane, angle_between(start, rotation));
        }
        before = Some((key, rotation));
    };
    slices.for_each(keyed, fill).await;
}
