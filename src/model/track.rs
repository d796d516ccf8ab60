//! The motion of one joint.

use std::sync::Arc;

use glam::{Quat, Vec3};

use super::LocalJoint;
use super::channel::{Channel, Way};
use crate::diagnostic::Fault;

/// The motion of one joint relative to its parent: three channels, each with times and ways of its own.
///
/// The keys of a track are the joint at each time at which a channel has a key; there is at least one.
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    translation: Channel<Vec3>,
    rotation: Channel<Quat>,
    scale: Channel<Vec3>,
    /// The times of all channels.
    times_secs: Arc<[f32]>,
}

/// At rest on its parent.
impl Default for Track {
    fn default() -> Self {
        Self::at_rest(LocalJoint::IDENTITY)
    }
}

impl Track {
    /// A track of rows: time in seconds and the joint relative to its parent, with straight ways between them. Rotations need not be of
    /// unit length. Channels share their times; one that keeps still beside another that moves has one key.
    ///
    /// # Errors
    /// When there is no key, a time is not after the one before, a number is not finite, or a rotation is zero.
    pub fn new(keys: impl IntoIterator<Item = (f32, LocalJoint)>) -> Result<Self, Fault> {
        let (times_secs, joints): (Vec<f32>, Vec<LocalJoint>) = keys.into_iter().unzip();
        let times_secs: Arc<[f32]> = times_secs.into();
        let translations = joints.iter().map(|joint| joint.translation).collect();
        let rotations = joints.iter().map(|joint| joint.rotation).collect();
        let scales = joints.iter().map(|joint| joint.scale).collect();
        let translation = Channel::new(times_secs.clone(), translations, Way::Straight)?;
        let rotation = Channel::new(times_secs.clone(), rotations, Way::Straight)?;
        let scale = Channel::new(times_secs.clone(), scales, Way::Straight)?;
        let is_still = [translation.is_still(), rotation.is_still(), scale.is_still()];
        // Each time stays in a channel.
        let shortened = is_still != [true; 3];
        Ok(Self {
            translation: if shortened && is_still[0] {
                translation.with_keys(&[0])
            } else {
                translation
            },
            rotation: if is_still[1] {
                rotation.with_keys(&[0])
            } else {
                rotation
            },
            scale: if is_still[2] { scale.with_keys(&[0]) } else { scale },
            times_secs,
        })
    }

    /// A track of channels. Those of equal times share them.
    pub fn of_channels(translation: Channel<Vec3>, rotation: Channel<Quat>, scale: Channel<Vec3>) -> Self {
        let lists = [
            translation.shared_times(),
            rotation.shared_times(),
            scale.shared_times(),
        ];
        let times_secs = all_times(lists);
        Self {
            translation: translation.sharing(&times_secs),
            rotation: rotation.sharing(&times_secs),
            scale: scale.sharing(&times_secs),
            times_secs,
        }
    }

    /// The track of a joint that a clip has no keys for: one at time 0 stands in, which holds at every time.
    pub fn at_rest(joint: LocalJoint) -> Self {
        Self::of_channels(
            Channel::at_rest(joint.translation),
            Channel::at_rest(joint.rotation),
            Channel::at_rest(joint.scale),
        )
    }

    /// The same keys of other values, by linear maps, since slopes go the same way.
    ///
    /// # Errors
    /// When a number is no longer finite, or a rotation is zero.
    pub(crate) fn mapped(
        &self,
        translation: impl Fn(Vec3) -> Vec3,
        rotation: impl Fn(Quat) -> Quat,
        scale: impl Fn(Vec3) -> Vec3,
    ) -> Result<Self, Fault> {
        Ok(Self {
            translation: self.translation.mapped(translation)?,
            rotation: self.rotation.mapped(rotation)?,
            scale: self.scale.mapped(scale)?,
            times_secs: self.times_secs.clone(),
        })
    }

    /// The same keys, `secs` earlier; a track at rest has no times.
    ///
    /// # Errors
    /// When a time is no longer finite.
    pub(crate) fn shifted_earlier(&self, secs: f32) -> Result<Self, Fault> {
        Ok(Self::of_channels(
            self.translation.shifted_earlier(secs)?,
            self.rotation.shifted_earlier(secs)?,
            self.scale.shifted_earlier(secs)?,
        ))
    }

    /// The translation over time.
    pub fn translation(&self) -> &Channel<Vec3> {
        &self.translation
    }

    /// The rotation over time.
    pub fn rotation(&self) -> &Channel<Quat> {
        &self.rotation
    }

    /// The scale over time.
    pub fn scale(&self) -> &Channel<Vec3> {
        &self.scale
    }

    /// The joint at a time, relative to its parent. Blends are made in f64.
    pub fn at(&self, time_secs: f32) -> LocalJoint {
        LocalJoint {
            rotation: self.rotation.at(time_secs),
            translation: self.translation.at(time_secs),
            scale: self.scale.at(time_secs),
        }
    }

    /// [`Track::at`] of some times, in order.
    pub(crate) fn at_times<'a>(&'a self, times_secs: &'a [f32]) -> impl ExactSizeIterator<Item = LocalJoint> + 'a {
        let rotations = self.rotation.at_times(times_secs);
        let vectors = self
            .translation
            .at_times(times_secs)
            .zip(self.scale.at_times(times_secs));
        rotations
            .zip(vectors)
            .map(|(rotation, (translation, scale))| LocalJoint {
                rotation,
                translation,
                scale,
            })
    }

    /// Whether a channel has keys in the file. A track without any still counts one key: the rest pose.
    pub fn has_keys(&self) -> bool {
        self.translation.has_keys() || self.rotation.has_keys() || self.scale.has_keys()
    }

    pub(super) fn is_still(&self) -> bool {
        // A spline may swing out between keys that are the same.
        !self.bends() && self.translation.is_still() && self.rotation.is_still() && self.scale.is_still()
    }

    /// Whether a channel holds its values from key to key.
    pub fn holds(&self) -> bool {
        *self.translation.way() == Way::Held || *self.rotation.way() == Way::Held || *self.scale.way() == Way::Held
    }

    /// Whether a channel follows a spline.
    pub fn bends(&self) -> bool {
        matches!(self.translation.way(), Way::Spline(_))
            || matches!(self.rotation.way(), Way::Spline(_))
            || matches!(self.scale.way(), Way::Spline(_))
    }

    /// Whether each of its channels has a key at all its times, or one at most: nothing is to be found between the keys of a row.
    pub(crate) fn has_rows(&self) -> bool {
        let is_row = |times_secs: &[f32]| times_secs.len() <= 1 || times_secs.len() == self.key_count();
        is_row(self.translation.times_secs()) && is_row(self.rotation.times_secs()) && is_row(self.scale.times_secs())
    }

    /// Number of keys, 1 or more.
    pub fn key_count(&self) -> usize {
        self.times_secs.len()
    }

    /// Number of keys of its channels together.
    pub(crate) fn channel_key_count(&self) -> usize {
        self.translation.times_secs().len() + self.rotation.times_secs().len() + self.scale.times_secs().len()
    }

    /// Time of the first key.
    pub fn start_secs(&self) -> f32 {
        self.times_secs.first().copied().unwrap_or_default()
    }

    /// Time of the last key.
    pub fn end_secs(&self) -> f32 {
        self.times_secs.last().copied().unwrap_or_default()
    }

    /// The times at which a channel has a key, in seconds, strictly increasing.
    pub fn times_secs(&self) -> &[f32] {
        &self.times_secs
    }

    /// The joint at each of these times, with the time.
    pub fn keys(&self) -> impl ExactSizeIterator<Item = (f32, LocalJoint)> + '_ {
        self.times_secs.iter().copied().zip(self.at_times(&self.times_secs))
    }

    /// One key as a joint.
    pub fn key(&self, index: usize) -> LocalJoint {
        self.at(self.times_secs[index])
    }
}

/// All times of some lists, in order; 0 alone where there is none.
fn all_times(lists: [&Arc<[f32]>; 3]) -> Arc<[f32]> {
    let lists = lists.into_iter().filter(|times_secs| !times_secs.is_empty());
    let Some(longest) = lists.clone().max_by_key(|times_secs| times_secs.len()) else {
        return Arc::new([0.0]);
    };
    if lists.clone().all(|times_secs| times_secs == longest) {
        return longest.clone();
    }
    let mut times_secs = longest.to_vec();
    let mut others: Vec<_> = lists.filter(|times_secs| *times_secs != longest).collect();
    others.dedup();
    others.iter().for_each(|other| times_secs.extend_from_slice(other));
    // A stable sort merges runs that are sorted, as these are.
    times_secs.sort_by(f32::total_cmp);
    times_secs.dedup();
    times_secs.into()
}
