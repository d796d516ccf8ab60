//! The keys of one joint.

use glam::{Quat, Vec3};

use super::{LocalJoint, ModelError};

/// Keys of one joint relative to its parent. Times are in seconds and strictly increasing; there is at least one key, and
/// all streams have one length. Outside its range a track holds its first or last value, since the tracks of a clip may
/// end at different times. Rotations are unit quaternions, neighbours on the same side.
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    times_secs: Vec<f32>,
    translations: Vec<Vec3>,
    rotations: Vec<Quat>,
    scales: Vec<Vec3>,
    at_rest: bool,
}

/// One key at rest on its parent at time 0.
impl Default for Track {
    fn default() -> Self {
        Self::at_rest(LocalJoint::IDENTITY)
    }
}

impl Track {
    /// A track of keys: time in seconds and the joint relative to its parent. Rotations need not be of unit length.
    ///
    /// # Errors
    /// When there is no key, a time is not after the one before, a number is not finite, or a rotation is zero.
    pub fn new(keys: impl IntoIterator<Item = (f32, LocalJoint)>) -> Result<Self, ModelError> {
        let keys = keys.into_iter();
        let mut track = Self::with_capacity(keys.size_hint().0);
        for (key, (time_secs, joint)) in keys.enumerate() {
            if track.times_secs.last().is_some_and(|&before| time_secs <= before) {
                return Err(ModelError::KeyNotAfter { key });
            }
            let Some(rotation) = unit(joint.rotation) else {
                return Err(ModelError::KeyNotFinite { key });
            };
            if !time_secs.is_finite() || !joint.is_finite() {
                return Err(ModelError::KeyNotFinite { key });
            }
            track.push(time_secs, LocalJoint { rotation, ..joint });
        }
        if track.times_secs.is_empty() {
            return Err(ModelError::NoKeys);
        }
        Ok(track)
    }

    /// The track of a joint that a clip has no keys for: one key at time 0 stands in, which holds at every time.
    pub fn at_rest(joint: LocalJoint) -> Self {
        let mut track = Self::with_capacity(1);
        track.push(0.0, joint);
        track.at_rest = true;
        track
    }

    fn with_capacity(keys: usize) -> Self {
        Self {
            times_secs: Vec::with_capacity(keys),
            translations: Vec::with_capacity(keys),
            rotations: Vec::with_capacity(keys),
            scales: Vec::with_capacity(keys),
            at_rest: false,
        }
    }

    /// A key after all others, of unit rotation.
    fn push(&mut self, time_secs: f32, joint: LocalJoint) {
        let mut rotation = joint.rotation;
        // q and −q are the same rotation, but blending across them spins the long way.
        if self.rotations.last().is_some_and(|&before| rotation.dot(before) < 0.0) {
            rotation = -rotation;
        }
        self.times_secs.push(time_secs);
        self.translations.push(joint.translation);
        self.rotations.push(rotation);
        self.scales.push(joint.scale);
    }

    /// Whether its keys were given; the one key of a joint that a clip leaves at rest was not.
    pub fn has_keys(&self) -> bool {
        !self.at_rest
    }

    /// Number of keys, 1 or more.
    pub fn key_count(&self) -> usize {
        self.times_secs.len()
    }

    /// Time of the first key.
    pub fn start_secs(&self) -> f32 {
        self.times_secs.first().copied().unwrap_or_default()
    }

    /// Time of the last key.
    pub fn end_secs(&self) -> f32 {
        self.times_secs.last().copied().unwrap_or_default()
    }

    /// Key times in seconds, strictly increasing.
    pub fn times_secs(&self) -> &[f32] {
        &self.times_secs
    }

    /// Translation of each key.
    pub fn translations(&self) -> &[Vec3] {
        &self.translations
    }

    /// Unit rotation of each key.
    pub fn rotations(&self) -> &[Quat] {
        &self.rotations
    }

    /// Scale of each key.
    pub fn scales(&self) -> &[Vec3] {
        &self.scales
    }

    /// One key as a joint.
    pub fn key(&self, index: usize) -> LocalJoint {
        LocalJoint {
            rotation: self.rotations[index],
            translation: self.translations[index],
            scale: self.scales[index],
        }
    }
}

/// The rotation at unit length; `None` when it has no direction.
pub(crate) fn unit(rotation: Quat) -> Option<Quat> {
    let exact = rotation.as_dquat();
    let length = exact.length();
    (length.is_finite() && length > 1e-12).then(|| (exact / length).as_quat())
}
