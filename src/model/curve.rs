//! Values of one part of a joint over time, where they do not go straight from key to key.

use glam::{Vec3, Vec4};

use crate::diagnostic::{Fault, codes};

/// The values of one part of a joint: held from key to key, or along cubic splines. Times are in seconds and strictly increasing;
/// there is at least one, and all streams have one length. Outside its range it holds its first or last value.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve<T> {
    times_secs: Vec<f32>,
    values: Vec<T>,
    tangents: Option<Vec<[T; 2]>>,
}

/// What the parts of a curve's values are added and multiplied as.
pub trait CurveValue: Copy + std::ops::Add<Output = Self> + std::ops::Mul<f32, Output = Self> {
    /// Whether all its numbers are finite.
    fn is_finite(self) -> bool;
    /// The greatest of its numbers without their signs.
    fn greatest(self) -> f32;
}

impl CurveValue for Vec3 {
    fn is_finite(self) -> bool {
        Self::is_finite(self)
    }

    fn greatest(self) -> f32 {
        self.abs().max_element()
    }
}

impl CurveValue for Vec4 {
    fn is_finite(self) -> bool {
        Self::is_finite(self)
    }

    fn greatest(self) -> f32 {
        self.abs().max_element()
    }
}

pub(super) fn no_keys() -> Fault {
    codes::NO_KEYS.says(codes::NO_KEYS.sentence).into()
}

pub(super) fn key_not_after(key: usize) -> Fault {
    let message = format!("Key {key} is not after the key before it; key times must increase.");
    codes::KEY_NOT_AFTER.says(message).into()
}

pub(super) fn key_not_finite(key: usize) -> Fault {
    let message = format!("Key {key} holds a number that is not finite, or a rotation without a direction.");
    codes::KEY_NOT_FINITE.says(message).into()
}

impl<T: CurveValue> Curve<T> {
    /// Each value holds until the next key: time in seconds and value.
    ///
    /// # Errors
    /// When there is no key, a time is not after the one before, or a number is not finite.
    pub fn step(keys: impl IntoIterator<Item = (f32, T)>) -> Result<Self, Fault> {
        let (times_secs, values) = keys.into_iter().unzip();
        let curve = Self {
            times_secs,
            values,
            tangents: None,
        };
        curve.checked()
    }

    /// Cubic Hermite splines: time in seconds, value, and the slopes with which the curve comes in and goes out, in units a second.
    ///
    /// # Errors
    /// As [`Curve::step`], and when a number between two keys could overflow.
    pub fn cubic(keys: impl IntoIterator<Item = (f32, T, [T; 2])>) -> Result<Self, Fault> {
        let keys = keys
            .into_iter()
            .map(|(time_secs, value, tangents)| ((time_secs, value), tangents));
        let ((times_secs, values), tangents) = keys.unzip();
        let curve = Self {
            times_secs,
            values,
            tangents: Some(tangents),
        };
        curve.checked()
    }

    fn checked(self) -> Result<Self, Fault> {
        if self.times_secs.is_empty() {
            return Err(no_keys());
        }
        for (key, (time_secs, value)) in self.times_secs.iter().zip(&self.values).enumerate() {
            let mut slopes = self.tangents.iter().flat_map(|tangents| tangents[key]);
            if !time_secs.is_finite() || !value.is_finite() || !slopes.all(CurveValue::is_finite) {
                return Err(key_not_finite(key));
            }
            if key > 0 && *time_secs <= self.times_secs[key - 1] {
                return Err(key_not_after(key));
            }
            if key > 0 && !self.stays_finite(key - 1) {
                return Err(key_not_finite(key));
            }
        }
        Ok(self)
    }

    /// Whether all values from a key to the next can be written. The weights of [`Curve::value_at`] are 1 at most for values, and 4/27 of
    /// the time between for slopes.
    fn stays_finite(&self, from: usize) -> bool {
        let Some(tangents) = &self.tangents else { return true };
        let length_secs = f64::from(self.times_secs[from + 1]) - f64::from(self.times_secs[from]);
        let most = |value: T| f64::from(value.greatest());
        let of_slopes = length_secs * 4.0 / 27.0 * (most(tangents[from][1]) + most(tangents[from + 1][0]));
        // Half of the range leaves room for what adding them rounds.
        most(self.values[from]) + most(self.values[from + 1]) + of_slopes <= f64::from(f32::MAX / 2.0)
    }

    /// The same curve of other values. Values and slopes are mapped alike, so `map` is linear.
    ///
    /// # Errors
    /// As [`Curve::step`].
    pub(crate) fn mapped(&self, map: impl Fn(T) -> T) -> Result<Self, Fault> {
        let tangents = self.tangents.as_ref();
        let curve = Self {
            times_secs: self.times_secs.clone(),
            values: self.values.iter().map(|&value| map(value)).collect(),
            tangents: tangents.map(|tangents| tangents.iter().map(|slopes| slopes.map(&map)).collect()),
        };
        curve.checked()
    }

    /// The same values and slopes at other times, as many as there are.
    ///
    /// # Errors
    /// As [`Curve::step`].
    pub(crate) fn with_times(&self, times_secs: Vec<f32>) -> Result<Self, Fault> {
        let curve = Self {
            times_secs,
            values: self.values.clone(),
            tangents: self.tangents.clone(),
        };
        curve.checked()
    }

    /// Key times in seconds, strictly increasing.
    pub fn times_secs(&self) -> &[f32] {
        &self.times_secs
    }

    /// The value of each key.
    pub fn values(&self) -> &[T] {
        &self.values
    }

    /// The slopes in and out of each key, units a second; `None` for a curve that holds its values.
    pub fn tangents(&self) -> Option<&[[T; 2]]> {
        self.tangents.as_deref()
    }

    /// The value at a time.
    ///
    /// Between keys k and k + 1, which are d seconds apart, at the part t of the way, with values v, slopes out b and in a:
    /// (2t³ − 3t² + 1) vₖ + d (t³ − 2t² + t) bₖ + (−2t³ + 3t²) vₖ₊₁ + d (t³ − t²) aₖ₊₁ (glTF 2.0, appendix C.5).
    pub fn value_at(&self, time_secs: f32) -> T {
        let next = self.times_secs.partition_point(|&key_secs| key_secs <= time_secs);
        let from = next.saturating_sub(1);
        let (Some(tangents), true) = (&self.tangents, next > 0 && next < self.values.len()) else {
            return self.values[from];
        };
        let length_secs = f64::from(self.times_secs[next]) - f64::from(self.times_secs[from]);
        let t = (f64::from(time_secs) - f64::from(self.times_secs[from])) / length_secs;
        let (t2, t3) = (t * t, t * t * t);
        self.values[from] * (2.0 * t3 - 3.0 * t2 + 1.0) as f32
            + tangents[from][1] * (length_secs * (t3 - 2.0 * t2 + t)) as f32
            + self.values[next] * (3.0 * t2 - 2.0 * t3) as f32
            + tangents[next][0] * (length_secs * (t3 - t2)) as f32
    }
}

/// The parts of a joint that do not go straight from key to key. Quaternions are x, y, z, w and need not be of unit length between
/// their keys: rotations are what they come to at unit length.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Curves {
    /// Of the translation.
    pub translation: Option<Curve<Vec3>>,
    /// Of the rotation.
    pub rotation: Option<Curve<Vec4>>,
    /// Of the scale.
    pub scale: Option<Curve<Vec3>>,
}

impl Curves {
    /// Whether each part that has a curve is held from key to key, or follows a spline.
    fn are_splines(&self) -> [Option<bool>; 3] {
        [
            self.translation.as_ref().map(|curve| curve.tangents.is_some()),
            self.rotation.as_ref().map(|curve| curve.tangents.is_some()),
            self.scale.as_ref().map(|curve| curve.tangents.is_some()),
        ]
    }

    /// Whether a part is held from key to key.
    pub fn holds(&self) -> bool {
        self.are_splines().contains(&Some(false))
    }

    /// Whether a part follows a spline.
    pub fn bends(&self) -> bool {
        self.are_splines().contains(&Some(true))
    }

    /// Whether all parts go straight.
    pub fn is_empty(&self) -> bool {
        self.translation.is_none() && self.rotation.is_none() && self.scale.is_none()
    }
}
