//! Curves of numbers over time: constant, straight or cubic between keys, evaluated exactly.

use crate::diagnostic::Fault;
use crate::fbx::{Budget, Record};

/// Ticks of a second, as Autodesk's `FbxTime` counts.
pub(super) const TICKS_PER_SEC: f64 = 46_186_158_000.0;

/// Of a tangent without a weight of its own: a third of the way to the next key.
const PLAIN_WEIGHT: f64 = 1.0 / 3.0;

/// How a curve goes from a key to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Way {
    /// It stays, or at once has the next value.
    Constant { is_next: bool },
    Straight,
    /// Slopes per second, and weights as parts of the time between both keys: at this key and at the next.
    Cubic { slopes: [f64; 2], weights: [f64; 2] },
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Key {
    pub(super) time_secs: f64,
    pub(super) value: f64,
    pub(super) way: Way,
}

/// Keys in strictly increasing time.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Curve {
    pub(super) keys: Vec<Key>,
}

/// Bits of `KeyAttrFlags`.
mod flags {
    pub(super) const CONSTANT: i64 = 0x2;
    pub(super) const STRAIGHT: i64 = 0x4;
    pub(super) const CONSTANT_NEXT: i64 = 0x100;
    pub(super) const WEIGHT_HERE: i64 = 0x100_0000;
    pub(super) const WEIGHT_NEXT: i64 = 0x200_0000;
}

impl Curve {
    /// An `AnimationCurve` of 7.x. Keys whose numbers are missing or not finite are left out.
    pub(super) fn read(record: &Record<'_>, budget: &Budget) -> Result<Self, Fault> {
        let integers = |name: &str| record.find(name).map_or_else(|| Ok(Vec::new()), |found| found.integers(budget));
        let numbers = |name: &str| record.find(name).map_or_else(|| Ok(Vec::new()), |found| found.numbers(budget));
        let (times, values) = (integers("KeyTime")?, numbers("KeyValueFloat")?);
        let (flags, counts) = (integers("KeyAttrFlags")?, integers("KeyAttrRefCount")?);
        let data = numbers("KeyAttrDataFloat")?;
        // Runs of keys have the same attributes.
        let mut run = 0;
        let mut left = counts.first().copied().unwrap_or_default();
        let mut keys: Vec<Key> = Vec::with_capacity(times.len().min(values.len()));
        for (&ticks, &value) in times.iter().zip(&values) {
            while left <= 0 && run + 1 < counts.len() {
                run += 1;
                left = counts[run];
            }
            left -= 1;
            let way = way(flags.get(run).copied().unwrap_or(flags::STRAIGHT), data.get(4 * run..4 * run + 4));
            let time_secs = ticks as f64 / TICKS_PER_SEC;
            let is_later = keys.last().is_none_or(|before| before.time_secs < time_secs);
            if value.is_finite() && is_later {
                keys.push(Key { time_secs, value, way });
            }
        }
        Ok(Self { keys })
    }

    /// The value at a time: beyond both ends that of the end.
    pub(super) fn at(&self, time_secs: f64) -> Option<f64> {
        let next = self.keys.partition_point(|key| key.time_secs <= time_secs);
        let Some(key) = next.checked_sub(1).map(|index| &self.keys[index]) else {
            return Some(self.keys.first()?.value);
        };
        let Some(end) = self.keys.get(next) else {
            return Some(key.value);
        };
        let secs = end.time_secs - key.time_secs;
        let part = (time_secs - key.time_secs) / secs;
        Some(match key.way {
            Way::Constant { .. } if part == 0.0 => key.value,
            Way::Constant { is_next } => if is_next { end.value } else { key.value },
            Way::Straight => key.value + (end.value - key.value) * part,
            Way::Cubic { slopes, weights } => {
                let [here, there] = weights;
                let u = solved([here, 1.0 - there], part);
                let values = [key.value, key.value + slopes[0] * here * secs, end.value - slopes[1] * there * secs, end.value];
                bezier(values, u)
            }
        })
    }
}

fn way(flags: i64, data: Option<&[f64]>) -> Way {
    if flags & flags::CONSTANT != 0 {
        let is_next = flags & flags::CONSTANT_NEXT != 0;
        return Way::Constant { is_next };
    }
    let Some(&[here, next, packed, _]) = data.filter(|_| flags & flags::STRAIGHT == 0) else {
        return Way::Straight;
    };
    if !here.is_finite() || !next.is_finite() {
        return Way::Straight;
    }
    // Two weights of 16 bits lie in the bits of a number, in ten-thousandths.
    let bits = (packed as f32).to_bits();
    let weight = |flag: i64, bits: u32| match flags & flag {
        0 => PLAIN_WEIGHT,
        _ => f64::from(bits & 0xFFFF) / 10_000.0,
    };
    Way::Cubic {
        slopes: [here, next],
        weights: [weight(flags::WEIGHT_HERE, bits), weight(flags::WEIGHT_NEXT, bits >> 16)].map(|weight| weight.clamp(0.0, 1.0)),
    }
}

fn bezier([a, b, c, d]: [f64; 4], u: f64) -> f64 {
    let v = 1.0 - u;
    a * v * v * v + 3.0 * b * v * v * u + 3.0 * c * v * u * u + d * u * u * u
}

/// Where on a Bézier curve from 0 to 1 by two inner points the x is `part`. It grows with u, as both points are in 0…1.
fn solved([b, c]: [f64; 2], part: f64) -> f64 {
    if [b, c] == [PLAIN_WEIGHT, 1.0 - PLAIN_WEIGHT] {
        return part;
    }
    let [mut low, mut high] = [0.0, 1.0];
    // Halving 60 times reaches the last bit.
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if bezier([0.0, b, c, 1.0], middle) < part {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}
