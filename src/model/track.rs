//! The keys of one joint.

use glam::{Quat, Vec3};

use super::{LocalJoint, ModelError, ModelErrorKind};

/// Keys of one joint relative to its parent. Times are in seconds and strictly increasing; there is at least one key, and
/// all streams have one length. Outside its range a track holds its first or last value, since the tracks of a clip may
/// end at different times. Rotations are unit quaternions, neighbours on the same side.
#[derive(Clone, Debug)]
pub struct Track {
    times_secs: Vec<f32>,
    translations: Vec<Vec3>,
    rotations: Vec<Quat>,
    scales: Vec<Vec3>,
    arcs: Vec<Arc>,
}

/// What blending the rotations of two neighbouring keys needs and does not change with time.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Arc {
    /// Square of the angle between the two quaternions, radians², 0…(π/2)².
    pub(crate) angle_squared: f32,
    /// angle / sin(angle), 1 for equal rotations.
    pub(crate) angle_over_sine: f32,
}

/// One key at rest on its parent at time 0.
impl Default for Track {
    fn default() -> Self {
        Self::constant(0.0, LocalJoint::IDENTITY)
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
                return Err(ModelErrorKind::KeyNotAfter { key }.into());
            }
            let Some(rotation) = unit(joint.rotation) else {
                return Err(ModelErrorKind::KeyNotFinite { key }.into());
            };
            if !time_secs.is_finite() || !joint.is_finite() {
                return Err(ModelErrorKind::KeyNotFinite { key }.into());
            }
            track.push(time_secs, LocalJoint { rotation, ..joint });
        }
        if track.times_secs.is_empty() {
            return Err(ModelErrorKind::NoKeys.into());
        }
        Ok(track)
    }

    /// A track of one key, which holds at every time.
    pub(super) fn constant(time_secs: f32, joint: LocalJoint) -> Self {
        let mut track = Self::with_capacity(1);
        track.push(time_secs, joint);
        track
    }

    fn with_capacity(keys: usize) -> Self {
        Self {
            times_secs: Vec::with_capacity(keys),
            translations: Vec::with_capacity(keys),
            rotations: Vec::with_capacity(keys),
            scales: Vec::with_capacity(keys),
            arcs: Vec::with_capacity(keys),
        }
    }

    /// A key after all others, of unit rotation.
    fn push(&mut self, time_secs: f32, joint: LocalJoint) {
        let mut rotation = joint.rotation;
        if let Some(&before) = self.rotations.last() {
            // q and −q are the same rotation, but blending across them spins the long way.
            if rotation.dot(before) < 0.0 {
                rotation = -rotation;
            }
            self.arcs.push(Arc::between(before, rotation));
        }
        self.times_secs.push(time_secs);
        self.translations.push(joint.translation);
        self.rotations.push(rotation);
        self.scales.push(joint.scale);
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

    /// From each key to the next: one fewer than there are keys.
    pub(crate) fn arcs(&self) -> &[Arc] {
        &self.arcs
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

impl Arc {
    /// Between two unit quaternions of one side.
    fn between(from: Quat, to: Quat) -> Self {
        let (from, to) = (from.as_dquat(), to.as_dquat());
        // Twice the half angle by its tangent: exact for small angles, where the cosine tells nothing.
        let angle = 2.0 * (to - from).length().atan2((to + from).length());
        let sine = angle.sin();
        Self {
            angle_squared: (angle * angle) as f32,
            angle_over_sine: if sine > 0.0 { (angle / sine) as f32 } else { 1.0 },
        }
    }
}

/// The rotation at unit length; `None` when it has no direction.
pub(super) fn unit(rotation: Quat) -> Option<Quat> {
    let exact = rotation.as_dquat();
    let length = exact.length();
    (length.is_finite() && length > 1e-12).then(|| (exact / length).as_quat())
}
