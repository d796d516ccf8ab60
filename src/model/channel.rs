//! The values of one part of a joint over time.

use std::sync::Arc;

use glam::{Quat, Vec3};

use crate::diagnostic::{Fault, codes};

/// The values of one part of a joint: translation, rotation or scale. Times are in seconds and strictly increasing, with a value for
/// each. Outside its times it holds its first or last value, and one without times rests at its only value.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel<T> {
    times_secs: Arc<[f32]>,
    values: Vec<T>,
    way: Way<T>,
}

/// How a channel comes from key to key.
#[derive(Clone, Debug, PartialEq)]
pub enum Way<T> {
    /// In a straight line; rotations at even speed along the shorter arc, with neighbours on the same side.
    Straight,
    /// Each value holds until the next key.
    Held,
    /// Along cubic Hermite splines, with the slopes in and out of each key, in units a second. Rotations are what comes of it at unit length.
    Spline(Vec<[T; 2]>),
}

/// A translation, a scale or a rotation.
pub trait ChannelValue:
    Copy + PartialEq + std::ops::Add<Output = Self> + std::ops::Sub<Output = Self> + std::ops::Mul<f32, Output = Self>
{
    /// Whether all its numbers are finite.
    fn is_finite(self) -> bool;
    /// The greatest of its numbers without their signs.
    fn greatest(self) -> f32;
    /// Its numbers to the bit.
    fn bits(self) -> [u32; 4];
    /// What lies at a part of the straight way. It is made in f64.
    fn between(ends: [Self; 2], part: f64) -> Self;
    /// The value for blending with another one: of the two numbers of a rotation the one nearer to the other's, at unit length. `None` for one without a direction.
    fn near(self, other: Self) -> Option<Self>;
}

impl ChannelValue for Vec3 {
    fn is_finite(self) -> bool {
        Self::is_finite(self)
    }

    fn greatest(self) -> f32 {
        self.abs().max_element()
    }

    fn bits(self) -> [u32; 4] {
        self.extend(0.0).to_array().map(f32::to_bits)
    }

    fn between([from, to]: [Self; 2], part: f64) -> Self {
        from.as_dvec3().lerp(to.as_dvec3(), part).as_vec3()
    }

    fn near(self, _: Self) -> Option<Self> {
        Some(self)
    }
}

impl ChannelValue for Quat {
    fn is_finite(self) -> bool {
        Self::is_finite(self)
    }

    fn greatest(self) -> f32 {
        glam::Vec4::from(self).abs().max_element()
    }

    fn bits(self) -> [u32; 4] {
        self.to_array().map(f32::to_bits)
    }

    fn between(ends: [Self; 2], part: f64) -> Self {
        let [from, to] = ends.map(|rotation| rotation.as_dquat().normalize());
        from.slerp(to, part).normalize().as_quat()
    }

    fn near(self, other: Self) -> Option<Self> {
        let rotation = unit(self)?;
        // q and −q are the same rotation, but blending across them spins the long way.
        Some(if rotation.dot(other) < 0.0 { -rotation } else { rotation })
    }
}

pub(super) fn no_keys() -> Fault {
    codes::NO_KEYS.says(codes::NO_KEYS.sentence).into()
}

fn key_not_after(key: usize) -> Fault {
    let message = format!("Key {key} is not after the key before it; key times must increase.");
    codes::KEY_NOT_AFTER.says(message).into()
}

fn key_not_finite(key: usize) -> Fault {
    let message = format!("Key {key} holds a number that is not finite, or a rotation without a direction.");
    codes::KEY_NOT_FINITE.says(message).into()
}

impl<T: ChannelValue> Channel<T> {
    /// One value at every time, without a key.
    pub fn at_rest(value: T) -> Self {
        Self {
            times_secs: Arc::default(),
            values: vec![value],
            way: Way::Straight,
        }
    }

    /// Keys with straight ways between them: time in seconds and value. Rotations need not be of unit length.
    ///
    /// # Errors
    /// When there is no key, a time is not after the one before, a number is not finite, or a rotation is zero.
    pub fn straight(keys: impl IntoIterator<Item = (f32, T)>) -> Result<Self, Fault> {
        let (times_secs, values): (Vec<_>, _) = keys.into_iter().unzip();
        Self::new(times_secs.into(), values, Way::Straight)
    }

    /// Each value holds until the next key: time in seconds and value.
    ///
    /// # Errors
    /// When there is no key, a time is not after the one before, or a number is not finite.
    pub fn held(keys: impl IntoIterator<Item = (f32, T)>) -> Result<Self, Fault> {
        let (times_secs, values): (Vec<_>, _) = keys.into_iter().unzip();
        Self::new(times_secs.into(), values, Way::Held)
    }

    /// Cubic Hermite splines: time in seconds, value, and the slopes with which the curve comes in and goes out, in units a second.
    ///
    /// # Errors
    /// As [`Channel::held`], and when a number between two keys could overflow.
    pub fn spline(keys: impl IntoIterator<Item = (f32, T, [T; 2])>) -> Result<Self, Fault> {
        let keys = keys.into_iter().map(|(secs, value, slopes)| ((secs, value), slopes));
        let ((times_secs, values), slopes): ((Vec<_>, _), _) = keys.unzip();
        Self::new(times_secs.into(), values, Way::Spline(slopes))
    }

    /// A value for each time, and two slopes where it is a spline.
    pub(super) fn new(times_secs: Arc<[f32]>, mut values: Vec<T>, way: Way<T>) -> Result<Self, Fault> {
        if times_secs.is_empty() {
            return Err(no_keys());
        }
        for key in 0..values.len() {
            if key > 0 && times_secs[key] <= times_secs[key - 1] {
                return Err(key_not_after(key));
            }
            let value = match way {
                Way::Straight => values[key].near(values[key.saturating_sub(1)]),
                Way::Held | Way::Spline(_) => Some(values[key]),
            };
            let slopes = match &way {
                Way::Spline(slopes) => slopes[key].as_slice(),
                _ => &[],
            };
            let is_finite = times_secs[key].is_finite() && slopes.iter().all(|slope| slope.is_finite());
            values[key] = value
                .filter(|value| is_finite && value.is_finite())
                .ok_or_else(|| key_not_finite(key))?;
        }
        let channel = Self {
            times_secs,
            values,
            way,
        };
        match (1..channel.values.len()).find(|&key| !channel.stays_finite(key - 1)) {
            Some(key) => Err(key_not_finite(key)),
            None => Ok(channel),
        }
    }

    /// Whether all values from a key to the next can be written. The weights of [`Channel::value_at`] are 1 at most for values, and 4/27 of
    /// the time between for slopes.
    fn stays_finite(&self, from: usize) -> bool {
        let Way::Spline(slopes) = &self.way else { return true };
        let length_secs = f64::from(self.times_secs[from + 1]) - f64::from(self.times_secs[from]);
        let most = |value: T| f64::from(value.greatest());
        let of_slopes = length_secs * 4.0 / 27.0 * (most(slopes[from][1]) + most(slopes[from + 1][0]));
        // Half of the range leaves room for what adding them rounds.
        most(self.values[from]) + most(self.values[from + 1]) + of_slopes <= f64::from(f32::MAX / 2.0)
    }

    /// The same channel of other values. Values and slopes are mapped alike, so `map` is linear.
    ///
    /// # Errors
    /// When a number is no longer finite, or a rotation is zero.
    pub(crate) fn mapped(&self, map: impl Fn(T) -> T) -> Result<Self, Fault> {
        let values = self.values.iter().map(|&value| map(value)).collect();
        let way = match &self.way {
            Way::Spline(slopes) => Way::Spline(slopes.iter().map(|slopes| slopes.map(&map)).collect()),
            way => way.clone(),
        };
        match self.has_keys() {
            true => Self::new(self.times_secs.clone(), values, way),
            false => Ok(Self { values, ..self.clone() }),
        }
    }

    /// The same channel with something added to all its values.
    ///
    /// # Errors
    /// When a number is no longer finite.
    pub(crate) fn moved(&self, by: T) -> Result<Self, Fault> {
        let values = self.values.iter().map(|&value| value + by).collect();
        match self.has_keys() {
            true => Self::new(self.times_secs.clone(), values, self.way.clone()),
            false => Ok(Self { values, ..self.clone() }),
        }
    }

    /// Of a joint that rests at `rest`: a channel that stays elsewhere has a key at `secs`, and one that stays there has none.
    pub(crate) fn resting_at(self, rest: T, secs: f32) -> Self {
        if self.has_keys() {
            return self;
        }
        let value = self.values[0].near(rest);
        let stays = value.is_some_and(|value| (value - rest).greatest() <= 1e-6 * rest.greatest());
        match stays {
            true => Self::at_rest(rest),
            false => Self {
                times_secs: [secs].into(),
                ..self
            },
        }
    }

    /// The same keys, `secs` earlier. Two keys make a jump: where rounding would bring their times together, the second has the next time
    /// that a number can name.
    ///
    /// # Errors
    /// When a time is no longer finite.
    pub(crate) fn shifted_earlier(&self, secs: f32) -> Result<Self, Fault> {
        let mut times_secs: Vec<f32> = Vec::with_capacity(self.times_secs.len());
        for time_secs in self.times_secs.iter().map(|time_secs| time_secs - secs) {
            let free_secs = times_secs.last().map_or(time_secs, |before| before.next_up());
            times_secs.push(time_secs.max(free_secs));
        }
        match times_secs.iter().position(|time_secs| !time_secs.is_finite()) {
            Some(key) => Err(key_not_finite(key)),
            None => Ok(Self {
                times_secs: times_secs.into(),
                ..self.clone()
            }),
        }
    }

    /// The keys with these numbers alone, in order; at least one.
    pub(crate) fn with_keys(&self, keys: &[usize]) -> Self {
        let times_secs = keys.iter().map(|&key| self.times_secs[key]).collect();
        let values = keys.iter().map(|&key| self.values[key]).collect();
        let way = match &self.way {
            Way::Spline(slopes) => Way::Spline(keys.iter().map(|&key| slopes[key]).collect()),
            way => way.clone(),
        };
        // Keys of a channel make a channel, unless a longer spline overflows.
        Self::new(times_secs, values, way).unwrap_or_else(|_| self.clone())
    }

    /// The same times in one place, where they are the same.
    pub(super) fn sharing(mut self, times_secs: &Arc<[f32]>) -> Self {
        if self.times_secs == *times_secs {
            self.times_secs = times_secs.clone();
        }
        self
    }

    /// Whether it has keys; otherwise it rests.
    pub fn has_keys(&self) -> bool {
        !self.times_secs.is_empty()
    }

    /// Key times in seconds, strictly increasing; none for a channel at rest.
    pub fn times_secs(&self) -> &[f32] {
        &self.times_secs
    }

    pub(super) fn shared_times(&self) -> &Arc<[f32]> {
        &self.times_secs
    }

    /// The value of each key, or that at rest.
    pub fn values(&self) -> &[T] {
        &self.values
    }

    /// How it comes from key to key.
    pub fn way(&self) -> &Way<T> {
        &self.way
    }

    /// Whether all its values are the same to the bit.
    pub(crate) fn is_still(&self) -> bool {
        self.values.iter().all(|value| value.bits() == self.values[0].bits())
    }

    /// The value at a time. That of a rotation's spline has the length that comes of it.
    ///
    /// Between keys k and k + 1, which are d seconds apart, a spline is at the part t of the way, with values v, slopes out b and in a:
    /// (2t³ − 3t² + 1) vₖ + d (t³ − 2t² + t) bₖ + (−2t³ + 3t²) vₖ₊₁ + d (t³ − t²) aₖ₊₁ (glTF 2.0, appendix C.5).
    pub fn value_at(&self, time_secs: f32) -> T {
        let next = self.times_secs.partition_point(|&key_secs| key_secs <= time_secs);
        self.between(next.saturating_sub(1), time_secs)
    }

    /// What a joint has at a time: [`Channel::value_at`], with rotations at unit length.
    pub fn at(&self, time_secs: f32) -> T {
        let next = self.times_secs.partition_point(|&key_secs| key_secs <= time_secs);
        self.place_between(next.saturating_sub(1), time_secs)
    }

    /// [`Channel::at`] of some times, in order.
    pub(crate) fn at_times<'a>(&'a self, times_secs: &'a [f32]) -> impl ExactSizeIterator<Item = T> + 'a {
        let mut from = 0;
        times_secs.iter().map(move |&time_secs| {
            while self
                .times_secs
                .get(from + 1)
                .is_some_and(|&next_secs| next_secs <= time_secs)
            {
                from += 1;
            }
            self.place_between(from, time_secs)
        })
    }

    /// `from` is the last key at or before the time, or the first.
    fn place_between(&self, from: usize, time_secs: f32) -> T {
        let value = self.between(from, time_secs);
        match self.way {
            Way::Straight => value,
            Way::Held | Way::Spline(_) => value.near(self.values[from]).unwrap_or(self.values[from]),
        }
    }

    fn between(&self, from: usize, time_secs: f32) -> T {
        let Some([start_secs, end_secs]) = self.span(from).filter(|[start_secs, _]| *start_secs < time_secs) else {
            return self.values[from];
        };
        let ends = [self.values[from], self.values[from + 1]];
        let [start_secs, end_secs] = [start_secs, end_secs].map(f64::from);
        let length_secs = end_secs - start_secs;
        let t = (f64::from(time_secs) - start_secs) / length_secs;
        match &self.way {
            Way::Straight => T::between(ends, t),
            Way::Held => ends[0],
            Way::Spline(slopes) => {
                let (t2, t3) = (t * t, t * t * t);
                ends[0] * (2.0 * t3 - 3.0 * t2 + 1.0) as f32
                    + slopes[from][1] * (length_secs * (t3 - 2.0 * t2 + t)) as f32
                    + ends[1] * (3.0 * t2 - 2.0 * t3) as f32
                    + slopes[from + 1][0] * (length_secs * (t3 - t2)) as f32
            }
        }
    }

    /// The times of a key and the next.
    fn span(&self, from: usize) -> Option<[f32; 2]> {
        self.times_secs.get(from..)?.first_chunk().copied()
    }

    /// How steeply a spline comes to a time and goes on from it, a second. Outside its keys it keeps still, and so do others.
    pub(crate) fn slopes_at(&self, time_secs: f32) -> [T; 2] {
        let still = self.values[0] * 0.0;
        let Way::Spline(slopes) = &self.way else {
            return [still; 2];
        };
        let next = self.times_secs.partition_point(|&key_secs| key_secs <= time_secs);
        let last = self.times_secs.len() - 1;
        if let Some(key) = next.checked_sub(1).filter(|&key| self.times_secs[key] == time_secs) {
            let [slope_in, slope_out] = slopes[key];
            return [
                if key == 0 { still } else { slope_in },
                if key == last { still } else { slope_out },
            ];
        }
        if next == 0 || next > last {
            return [still; 2];
        }
        let length_secs = f64::from(self.times_secs[next]) - f64::from(self.times_secs[next - 1]);
        let t = (f64::from(time_secs) - f64::from(self.times_secs[next - 1])) / length_secs;
        let slope = self.values[next - 1] * (6.0 * (t * t - t) / length_secs) as f32
            + slopes[next - 1][1] * (3.0 * t * t - 4.0 * t + 1.0) as f32
            + self.values[next] * (6.0 * (t - t * t) / length_secs) as f32
            + slopes[next][0] * (3.0 * t * t - 2.0 * t) as f32;
        [slope; 2]
    }
}

/// The rotation at unit length; `None` when it has no direction. One that is as near to it as numbers are stays, so that a second
/// time changes nothing.
#[inline]
pub(crate) fn unit(rotation: Quat) -> Option<Quat> {
    let exact = rotation.as_dquat();
    let length = exact.length();
    if (length - 1.0).abs() <= f64::from(f32::EPSILON) {
        return Some(rotation);
    }
    (length.is_finite() && length > 1e-12).then(|| (exact / length).as_quat())
}
