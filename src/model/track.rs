//! The keys of one joint.

use glam::{Quat, Vec3, Vec4};

use super::LocalJoint;
use super::between::{part_of_way, rotation_between, vector_between};
use super::curve::{Curve, Curves};
use super::curve::{key_not_after, key_not_finite, no_keys};
use crate::diagnostic::Fault;

/// Keys of one joint relative to its parent. Times are in seconds and strictly increasing; there is at least one key, and
/// all streams have one length. Outside its range a track holds its first or last value, since the tracks of a clip may
/// end at different times. Rotations are unit quaternions, neighbours on the same side.
///
/// Between keys translation and scale go straight, and rotations along the shorter arc, but where the track has [`Curves`].
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    times_secs: Vec<f32>,
    translations: Vec<Vec3>,
    rotations: Vec<Quat>,
    scales: Vec<Vec3>,
    at_rest: bool,
    curves: Option<Box<Curves>>,
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
    pub fn new(keys: impl IntoIterator<Item = (f32, LocalJoint)>) -> Result<Self, Fault> {
        let keys = keys.into_iter();
        let mut track = Self::with_capacity(keys.size_hint().0);
        for (key, (time_secs, joint)) in keys.enumerate() {
            if track.times_secs.last().is_some_and(|&before| time_secs <= before) {
                return Err(key_not_after(key));
            }
            let Some(rotation) = unit(joint.rotation) else {
                return Err(key_not_finite(key));
            };
            if !time_secs.is_finite() || !joint.is_finite() {
                return Err(key_not_finite(key));
            }
            track.push(time_secs, LocalJoint { rotation, ..joint });
        }
        if track.times_secs.is_empty() {
            return Err(no_keys());
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
            curves: None,
        }
    }

    /// The same keys with other ways between them. The keys of the curves are to be among the track's, with the same values.
    #[must_use]
    pub fn with_curves(mut self, curves: Curves) -> Self {
        self.curves = (!curves.is_empty()).then(|| Box::new(curves));
        self
    }

    /// The ways between keys that are not straight; `None` where all are.
    pub fn curves(&self) -> Option<&Curves> {
        self.curves.as_deref()
    }

    /// The same keys and curves of other values. Rotations are x, y, z, w. All maps are linear, since slopes go the same way.
    ///
    /// # Errors
    /// When a number is no longer finite, or a rotation is zero.
    pub(crate) fn mapped(
        &self,
        translation: impl Fn(Vec3) -> Vec3,
        rotation: impl Fn(Vec4) -> Vec4,
        scale: impl Fn(Vec3) -> Vec3,
    ) -> Result<Self, Fault> {
        let joint = |key: usize| LocalJoint {
            rotation: Quat::from_vec4(rotation(self.rotations[key].into())),
            translation: translation(self.translations[key]),
            scale: scale(self.scales[key]),
        };
        if self.at_rest {
            return Ok(Self::at_rest(joint(0)));
        }
        let mapped = Self::new((0..self.key_count()).map(|key| (self.times_secs[key], joint(key))))?;
        let Some(curves) = self.curves() else {
            return Ok(mapped);
        };
        Ok(mapped.with_curves(Curves {
            translation: (curves.translation.as_ref().map(|curve| curve.mapped(translation))).transpose()?,
            rotation: (curves.rotation.as_ref().map(|curve| curve.mapped(rotation))).transpose()?,
            scale: (curves.scale.as_ref().map(|curve| curve.mapped(scale))).transpose()?,
        }))
    }

    /// The same keys and curves, `secs` sooner; a track at rest has no times. Two keys make a jump: where rounding would bring their
    /// times together, the second has the next time that a number can name.
    ///
    /// # Errors
    /// When a time is no longer finite.
    pub(crate) fn sooner(&self, secs: f32) -> Result<Self, Fault> {
        if self.at_rest {
            return Ok(self.clone());
        }
        let times_secs = increasing(self.times_secs.iter().map(|time_secs| time_secs - secs));
        if let Some(key) = times_secs.iter().position(|time_secs| !time_secs.is_finite()) {
            return Err(key_not_finite(key));
        }
        // A curve's keys stay among the track's.
        let of_curve = |curve_secs: &[f32]| {
            increasing(curve_secs.iter().map(|&time_secs| {
                let key = self.times_secs.partition_point(|&key_secs| key_secs < time_secs);
                match self.times_secs.get(key) {
                    Some(&key_secs) if key_secs == time_secs => times_secs[key],
                    _ => time_secs - secs,
                }
            }))
        };
        let vectors = |curve: &Option<Curve<Vec3>>| {
            let moved = curve
                .as_ref()
                .map(|curve| curve.with_times(of_curve(curve.times_secs())));
            moved.transpose()
        };
        let curves = match self.curves() {
            None => None,
            Some(Curves {
                translation,
                rotation,
                scale,
            }) => {
                let rotation = rotation.as_ref();
                Some(Box::new(Curves {
                    translation: vectors(translation)?,
                    rotation: rotation
                        .map(|curve| curve.with_times(of_curve(curve.times_secs())))
                        .transpose()?,
                    scale: vectors(scale)?,
                }))
            }
        };
        Ok(Self {
            times_secs,
            curves,
            ..self.clone()
        })
    }

    /// The joint at a time, relative to its parent. Blends are made in f64.
    pub fn at(&self, time_secs: f32) -> LocalJoint {
        let next = self.times_secs.partition_point(|&key_secs| key_secs <= time_secs);
        self.between(next.saturating_sub(1), time_secs)
    }

    /// [`Track::at`], where `from` is the last key at or before the time, or the first.
    pub(crate) fn between(&self, from: usize, time_secs: f32) -> LocalJoint {
        let mut joint = self.straight_between(from, time_secs);
        if let Some(curves) = &self.curves {
            if let Some(curve) = &curves.translation {
                joint.translation = curve.value_at(time_secs);
            }
            if let Some(curve) = &curves.rotation {
                let rotation = unit(Quat::from_vec4(curve.value_at(time_secs))).unwrap_or(joint.rotation);
                joint.rotation = if rotation.dot(joint.rotation) < 0.0 {
                    -rotation
                } else {
                    rotation
                };
            }
            if let Some(curve) = &curves.scale {
                joint.scale = curve.value_at(time_secs);
            }
        }
        joint
    }

    fn straight_between(&self, from: usize, time_secs: f32) -> LocalJoint {
        let start_secs = self.times_secs[from];
        let end_secs = match self.times_secs.get(from + 1) {
            Some(&end_secs) if start_secs < time_secs => end_secs,
            _ => return self.key(from),
        };
        let part = part_of_way([start_secs, end_secs], time_secs);
        let (from, to) = (self.key(from), self.key(from + 1));
        LocalJoint {
            rotation: rotation_between([from.rotation, to.rotation], part),
            translation: vector_between([from.translation, to.translation], part),
            scale: vector_between([from.scale, to.scale], part),
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

/// Times, each after the one before.
fn increasing(times_secs: impl Iterator<Item = f32>) -> Vec<f32> {
    let mut increasing: Vec<f32> = Vec::with_capacity(times_secs.size_hint().0);
    for time_secs in times_secs {
        let before = increasing.last();
        increasing.push(before.map_or(time_secs, |before| time_secs.max(before.next_up())));
    }
    increasing
}

/// The rotation at unit length; `None` when it has no direction. One that is as near to it as numbers are stays, so that a second
/// time changes nothing.
pub(crate) fn unit(rotation: Quat) -> Option<Quat> {
    let exact = rotation.as_dquat();
    let length = exact.length();
    if (length - 1.0).abs() <= f64::from(f32::EPSILON) {
        return Some(rotation);
    }
    (length.is_finite() && length > 1e-12).then(|| (exact / length).as_quat())
}
