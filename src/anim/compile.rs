//! A clip made ready for sampling: four tracks side by side, on one time line.

use std::borrow::Cow;
use std::cell::Cell;
use std::sync::Arc;

use glam::{DQuat, Quat, Vec3, Vec4};

use super::lanes::{ArcLanes, JointLanes, angle_between, set_straight_between};
use super::straight::{MOST_PIECES, unbent};
use crate::model::{Channel, ChannelValue, Clip, JointIndex, Track, Way};
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
///
/// What stays is there once, and so are the times of neighbouring groups with the same ones. Besides these, a key takes of each joint
/// 24 bytes for a rotation, 12 for a translation and 12 for a scale, as far as one of the four has it move.
#[derive(Clone, Debug)]
pub(super) struct TrackGroup {
    times_secs: Arc<[f32]>,
    rotations: Values<RotationLanes>,
    translations: Values<[Vec4; 3]>,
    scales: Values<[Vec4; 3]>,
    /// Of rotations, translations and scales: 0 in lanes that hold a value up to the next key, else 1. `None` where none holds.
    goes: Option<Box<[Vec4; 3]>>,
}

/// One value at each key, or a single one that stays.
#[derive(Clone, Debug)]
struct Values<T>(Vec<T>);

/// Rotations of four joints at a key, and the way to the next one. Neighbouring keys have rotations on the same side.
#[derive(Clone, Copy, Debug, PartialEq)]
struct RotationLanes {
    rotation: [Vec4; 4],
    arc: ArcLanes,
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
        let pieces_left = Cell::new(MOST_PIECES);
        for (done, clip) in clips.iter().enumerate() {
            let mut groups = Vec::with_capacity(clip.tracks.len().div_ceil(JointLanes::COUNT));
            let mut times_secs = Arc::default();
            for tracks in clip.tracks.chunks(JointLanes::COUNT) {
                slices.pause_at(Stage::Compiling, done, clips.len()).await;
                let group = TrackGroup::new(tracks, &times_secs, &pieces_left, slices).await;
                times_secs = Arc::clone(&group.times_secs);
                groups.push(group);
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

    /// Bytes that its keys take: of each key and joint 24 for a rotation, 12 for a translation and 12 for a scale, as far as these move in
    /// one of four joints, and 4 for each time that a group of four does not share with the one before.
    pub fn byte_count(&self) -> usize {
        let mut lists: Vec<&Arc<[f32]>> = self.groups.iter().map(|group| &group.times_secs).collect();
        lists.dedup_by(|list, other| Arc::ptr_eq(list, other));
        let times: usize = lists.iter().map(|times_secs| size_of_val(&***times_secs)).sum();
        times + self.groups.iter().map(TrackGroup::byte_count).sum::<usize>()
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
        let times_secs = groups.flat_map(TrackGroup::corner_times_secs).chain([self.end_secs]);
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
        let times_secs = self.groups.iter().flat_map(TrackGroup::corner_times_secs);
        // The key of a joint at rest may lie outside.
        let inside = times_secs.filter(|time_secs| (self.start_secs..=self.end_secs).contains(time_secs));
        let mut times_secs: Vec<f32> = inside.chain([self.start_secs]).collect();
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
    /// Up to four tracks; the lanes of missing ones are identities. `times_before` are those of another group, to share.
    async fn new(tracks: &[Track], times_before: &Arc<[f32]>, pieces_left: &Cell<usize>, slices: &Slices) -> Self {
        let tracks: Vec<_> = tracks.iter().map(|track| unbent(track, pieces_left)).collect();
        let times_secs = match common_times(&tracks) {
            same if same[..] == times_before[..] => Arc::clone(times_before),
            other => other.into(),
        };
        let JointLanes {
            rotation,
            translation,
            scale,
        } = JointLanes::IDENTITY;
        let still = RotationLanes {
            rotation,
            arc: ArcLanes::NONE,
        };
        let mut goes = [Vec4::ONE; 3];
        for (lane, track) in tracks.iter().enumerate() {
            let holds = [
                *track.rotation().way() == Way::Held,
                *track.translation().way() == Way::Held,
                *track.scale().way() == Way::Held,
            ];
            for (goes, holds) in goes.iter_mut().zip(holds) {
                goes[lane] = if holds { 0.0 } else { 1.0 };
            }
        }
        let channels = tracks.iter().map(|track| track.rotation());
        let mut rotations = vec![still; key_count(channels.clone(), &times_secs)];
        for (lane, channel) in channels.enumerate() {
            fill_rotations(lane, &mut rotations, (channel, &times_secs), slices).await;
        }
        let channels = tracks.iter().map(|track| track.translation());
        let mut translations = vec![translation; key_count(channels.clone(), &times_secs)];
        for (lane, channel) in channels.enumerate() {
            fill_vectors(lane, &mut translations, (channel, &times_secs), slices).await;
        }
        let channels = tracks.iter().map(|track| track.scale());
        let mut scales = vec![scale; key_count(channels.clone(), &times_secs)];
        for (lane, channel) in channels.enumerate() {
            fill_vectors(lane, &mut scales, (channel, &times_secs), slices).await;
        }
        Self {
            times_secs,
            rotations: Values::new(rotations),
            translations: Values::new(translations),
            scales: Values::new(scales),
            goes: (goes != [Vec4::ONE; 3]).then(|| Box::new(goes)),
        }
    }

    /// Key times in seconds, strictly increasing; at least one.
    pub(super) fn times_secs(&self) -> &[f32] {
        &self.times_secs
    }

    /// The times between which all goes straight: key times, and the last moment before each where something is held up to it.
    fn corner_times_secs(&self) -> impl Iterator<Item = f32> {
        let before_key = |&time_secs: &f32| self.goes.is_some().then_some(time_secs.next_down());
        let times_secs = self.times_secs.iter();
        times_secs.flat_map(move |time_secs| before_key(time_secs).into_iter().chain([*time_secs]))
    }

    /// The joints at a key.
    #[inline]
    pub(super) fn joints_at(&self, key: usize) -> JointLanes {
        JointLanes {
            rotation: self.rotations.at(key).rotation,
            translation: *self.translations.at(key),
            scale: *self.scales.at(key),
        }
    }

    /// Joints between a key and the next one. `fraction` is 0…1.
    #[inline(always)]
    pub(super) fn set_between(&self, key: usize, fraction: f32, joints: &mut JointLanes) {
        // Where the compiler keeps the program small, `splat` is a loop.
        let part = Vec4::ONE * fraction;
        // Two copies of the same: in the first all parts are one.
        match &self.goes {
            None => self.set_at_parts(key, [part; 3], joints),
            Some(goes) => self.set_at_parts(key, [part * goes[0], part * goes[1], part * goes[2]], joints),
        }
    }

    #[inline(always)]
    fn set_at_parts(&self, key: usize, [turned, moved, scaled]: [Vec4; 3], joints: &mut JointLanes) {
        match self.rotations.span(key) {
            Some([from, to]) => joints.set_rotation_between(&from.rotation, &to.rotation, &from.arc, turned),
            None => joints.rotation = self.rotations.0[0].rotation,
        }
        match self.translations.span(key) {
            Some([from, to]) => set_straight_between(&mut joints.translation, from, to, moved),
            None => joints.translation = self.translations.0[0],
        }
        match self.scales.span(key) {
            Some([from, to]) => set_straight_between(&mut joints.scale, from, to, scaled),
            None => joints.scale = self.scales.0[0],
        }
    }

    /// Bytes of its values.
    fn byte_count(&self) -> usize {
        size_of_val(&*self.rotations.0) + size_of_val(&*self.translations.0) + size_of_val(&*self.scales.0)
    }
}

impl<T: PartialEq> Values<T> {
    fn new(mut values: Vec<T>) -> Self {
        if let Some((first, rest)) = values.split_first()
            && rest.iter().all(|value| value == first)
        {
            values.truncate(1);
            values.shrink_to_fit();
        }
        Self(values)
    }
}

impl<T> Values<T> {
    #[inline]
    fn at(&self, key: usize) -> &T {
        &self.0[key.min(self.0.len() - 1)]
    }

    /// The values of a key and of the next one; `None` of one that stays.
    #[inline(always)]
    fn span(&self, key: usize) -> Option<[&T; 2]> {
        Some([self.0.get(key)?, self.0.get(key + 1)?])
    }
}

/// How many values four channels take: one where all stay, else one at each time. What stays is not even laid out at each time while it is made: of a
/// joint that only scales, that would be most.
fn key_count<'a, T: ChannelValue + 'a>(
    mut channels: impl Iterator<Item = &'a Channel<T>>,
    times_secs: &[f32],
) -> usize {
    if channels.all(Channel::is_still) {
        1
    } else {
        times_secs.len()
    }
}

/// Puts a channel into one lane at each key. No arc leads to the next one where rotations hold.
async fn fill_rotations(
    lane: usize,
    keys: &mut [RotationLanes],
    (channel, times_secs): (&Channel<Quat>, &[f32]),
    slices: &Slices,
) {
    let holds = *channel.way() == Way::Held;
    let mut before: Option<(&mut RotationLanes, DQuat)> = None;
    let fill = |(key, rotation): (_, Quat)| {
        let key: &mut RotationLanes = key;
        set_lane(&mut key.rotation, lane, rotation.to_array());
        let rotation = rotation.as_dquat();
        if let Some((key, start)) = before.take().filter(|_| !holds) {
            key.arc.set(lane, angle_between(start, rotation));
        }
        before = Some((key, rotation));
    };
    slices
        .for_each(keys.iter_mut().zip(channel.at_times(times_secs)), fill)
        .await;
}

/// Puts a channel into one lane at each key.
async fn fill_vectors(
    lane: usize,
    keys: &mut [[Vec4; 3]],
    (channel, times_secs): (&Channel<Vec3>, &[f32]),
    slices: &Slices,
) {
    let fill = |(key, value): (&mut [Vec4; 3], Vec3)| set_lane(key, lane, value.to_array());
    slices
        .for_each(keys.iter_mut().zip(channel.at_times(times_secs)), fill)
        .await;
}

fn set_lane<const N: usize>(lanes: &mut [Vec4; N], lane: usize, values: [f32; N]) {
    for (lanes, value) in lanes.iter_mut().zip(values) {
        lanes[lane] = value;
    }
}

/// Every time at which a track has a key.
fn common_times(tracks: &[Cow<'_, Track>]) -> Vec<f32> {
    let mut times_secs: Vec<f32> = tracks.iter().flat_map(|track| track.times_secs()).copied().collect();
    // A stable sort merges runs that are sorted, as these are.
    times_secs.sort_by(f32::total_cmp);
    times_secs.dedup();
    times_secs
}
