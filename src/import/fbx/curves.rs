//! Curves of numbers over time: constant, straight or cubic between keys, evaluated exactly, in their own way before the first key and after the last.

use std::ops::Range;

use crate::diagnostic::Fault;
use crate::fbx::{Budget, Document, Record, Value};

/// Ticks of a second, as Autodesk's `FbxTime` counts.
pub(super) const TICKS_PER_SEC: f64 = 46_186_158_000.0;

/// Keys that repeating adds at most on each side.
const MOST_REPEATED: usize = 1000;

/// Of a tangent without a weight of its own: a third of the way to the next key.
const PLAIN_WEIGHT: f64 = 1.0 / 3.0;

/// How a curve goes from a key to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Way {
    /// It stays, or at once has the next value.
    Constant {
        is_next: bool,
    },
    Straight,
    Cubic,
}

/// What sets the slopes of a key.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Slopes {
    Given,
    /// By the keys around. A bias of −100…100 leads to the way before or after, one beyond 500 is steeper.
    Auto {
        bias: f64,
        flags: i64,
    },
    /// By tension, continuity and bias: Kochanek and Bartels.
    Tcb([f64; 3]),
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Key {
    secs: f64,
    value: f64,
    way: Way,
    /// With which it is reached and left, a second.
    slopes: [f64; 2],
    /// Of both tangents, as parts of the time to the key on that side.
    weights: [f64; 2],
}

/// What a curve does beyond an end.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Beyond {
    #[default]
    Constant,
    Slope,
    Repeat,
    /// Each time from where it came to.
    RepeatOnwards,
    Mirror,
}

/// Keys in strictly increasing time.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Curve {
    keys: Vec<Key>,
    beyond: [Beyond; 2],
}

/// Bits of `KeyAttrFlags`.
mod flags {
    pub(super) const CONSTANT: i64 = 0x2;
    pub(super) const CUBIC: i64 = 0x8;
    pub(super) const CONSTANT_NEXT: i64 = 0x100;
    pub(super) const TCB: i64 = 0x200;
    pub(super) const USER: i64 = 0x400;
    pub(super) const CLAMP: i64 = 0x1000;
    pub(super) const TIME_INDEPENDENT: i64 = 0x2000;
    pub(super) const CLAMP_PROGRESSIVE: i64 = 0x4000;
    pub(super) const WEIGHT_HERE: i64 = 0x100_0000;
    pub(super) const WEIGHT_NEXT: i64 = 0x200_0000;
}

/// Since this version text has `KeyAttrDataFloat` as the bits of an `f32`.
const BITS_SINCE: u32 = 7200;

/// Keys while they are read.
#[derive(Default)]
struct Growing {
    keys: Vec<Key>,
    slopes: Vec<Slopes>,
    /// With what the next key is reached: slope and weight.
    next: [f64; 2],
}

impl Growing {
    /// Adds a key; `right` and `next` are slope and weight with which it is left, and the next one reached. Those without a number, and those that are not
    /// later than the one before, are left out.
    fn add(&mut self, ticks: f64, value: f64, way: Way, set: Slopes, right: [f64; 2], next: [f64; 2]) {
        let secs = ticks / TICKS_PER_SEC;
        let is_later = self.keys.last().is_none_or(|before| before.secs < secs);
        if !(value.is_finite() && secs.is_finite() && is_later) {
            return;
        }
        let finite = |[slope, weight]: [f64; 2]| [if slope.is_finite() { slope } else { 0.0 }, weight.clamp(0.0, 1.0)];
        let [reached, left] = [finite(self.next), finite(right)];
        self.keys.push(Key {
            secs,
            value,
            way,
            slopes: [reached[0], left[0]],
            weights: [reached[1], left[1]],
        });
        self.slopes.push(set);
        self.next = next;
    }

    fn curve(mut self, beyond: [Beyond; 2]) -> Curve {
        for at in 0..self.keys.len() {
            if self.keys[at].way == Way::Cubic {
                let around = [at.checked_sub(1), Some(at), Some(at + 1)].map(|at| self.keys.get(at?).copied());
                if let Some(slopes) = solved_slopes(around, self.slopes[at]) {
                    self.keys[at].slopes = slopes;
                }
            }
        }
        Curve {
            keys: self.keys,
            beyond,
        }
    }
}

impl Curve {
    /// An `AnimationCurve` of 7.x.
    pub(super) fn read(record: &Record<'_>, document: &Document<'_>, budget: &Budget) -> Result<Self, Fault> {
        let integers = |name| record.integers_of(name, budget);
        let numbers = |name| record.numbers_of(name, budget);
        let (times, values) = (integers("KeyTime")?, numbers("KeyValueFloat")?);
        let (flags, counts) = (integers("KeyAttrFlags")?, integers("KeyAttrRefCount")?);
        let are_bits = !document.is_binary && document.version >= BITS_SINCE;
        let data: Vec<f32> = numbers("KeyAttrDataFloat")?
            .into_iter()
            .map(|number| {
                if are_bits {
                    f32::from_bits(number as i64 as u32)
                } else {
                    number as f32
                }
            })
            .collect();
        // Runs of keys have the same attributes.
        let mut run = 0;
        let mut left = counts.first().copied().unwrap_or_default();
        let mut growing = Growing::default();
        for (&ticks, &value) in times.iter().zip(&values) {
            while left <= 0 && run + 1 < counts.len() {
                run += 1;
                left = counts[run];
            }
            left = left.saturating_sub(1);
            let flags = flags.get(run).copied().unwrap_or_default();
            let data = data
                .get(4 * run..4 * run + 4)
                .and_then(|data| data.first_chunk())
                .copied()
                .unwrap_or_default();
            let (way, set) = way(flags, data);
            let [right, next] = tangents(flags, data);
            let still = [0.0, PLAIN_WEIGHT];
            match way {
                Way::Cubic => growing.add(ticks as f64, value, way, set, right, next),
                _ => growing.add(ticks as f64, value, way, set, still, still),
            }
        }
        Ok(growing.curve(beyond(record)))
    }

    /// A channel of a `Take` of 6.1, where words stand between the numbers of a key.
    pub(super) fn read_take(record: &Record<'_>) -> Self {
        let mut growing = Growing::default();
        let Some(keys) = record.find("Key") else {
            return Self::default();
        };
        let version = record
            .find("KeyVer")
            .and_then(|version| version.integer(0))
            .unwrap_or(4005);
        let mut values = TakeValues { keys, at: 0 };
        while let Some((ticks, value)) = values.number().zip(values.number()) {
            let still = [0.0, PLAIN_WEIGHT];
            let given = match values.word() {
                Some(b'L') => Some((Way::Straight, Slopes::Given, still, still)),
                Some(b'C') => {
                    let is_next = version >= 4004 && values.word() == Some(b'n');
                    Some((Way::Constant { is_next }, Slopes::Given, still, still))
                }
                Some(b'U') => values
                    .cubic(version)
                    .map(|(set, right, next)| (Way::Cubic, set, right, next)),
                _ => None,
            };
            let Some((way, set, right, next)) = given else { break };
            growing.add(ticks, value, way, set, right, next);
        }
        growing.curve(beyond(record))
    }

    /// Its keys' times, in seconds.
    pub(super) fn times_secs(&self) -> impl Iterator<Item = f64> + '_ {
        self.keys.iter().map(|key| key.secs)
    }

    /// The same, and those at which it repeats them within a span, up to [`MOST_REPEATED`].
    pub(super) fn times_within(&self, span: Option<[f64; 2]>) -> impl Iterator<Item = f64> + '_ {
        let ends = self
            .keys
            .first()
            .zip(self.keys.last())
            .map_or([0.0; 2], |(first, last)| [first.secs, last.secs]);
        let length = ends[1] - ends[0];
        let [before, after] = match span {
            Some([start, end]) if length > 0.0 => [ends[0] - start, end - ends[1]].map(|beyond| beyond.max(0.0)),
            _ => [0.0; 2],
        };
        let turns = |beyond: f64, way: Beyond| match way {
            Beyond::Constant | Beyond::Slope => 0,
            _ => ((beyond / length).ceil() as usize).min(MOST_REPEATED / self.keys.len().max(1)),
        };
        let [before, after] = [turns(before, self.beyond[0]), turns(after, self.beyond[1])];
        (0..=before + after).flat_map(move |turn| {
            let turn = turn as f64 - before as f64;
            // A mirrored turn has its keys the other way round.
            let is_back = turn.rem_euclid(2.0) == 1.0 && self.beyond[usize::from(turn > 0.0)] == Beyond::Mirror;
            let place = move |secs: f64| if is_back { ends[1] - secs } else { secs - ends[0] };
            self.times_secs().map(move |secs| ends[0] + turn * length + place(secs))
        })
    }

    /// The value at a time; just before it where the time is `is_before`. `None` without keys.
    pub(super) fn at(&self, secs: f64, is_before: bool) -> Option<f64> {
        let (first, last) = (self.keys.first()?, self.keys.last()?);
        let length = last.secs - first.secs;
        let (beyond, away) = match secs {
            _ if secs < first.secs => (self.beyond[0], secs - first.secs),
            _ if secs > last.secs => (self.beyond[1], secs - last.secs),
            _ => return Some(self.within(secs, is_before)),
        };
        let end = if away < 0.0 { first } else { last };
        // Turns since the first key, downwards before it.
        let turns = ((secs - first.secs) / length).floor();
        let into = (secs - first.secs) - turns * length;
        Some(match beyond {
            Beyond::Slope => end.value + away * end.slopes[usize::from(away > 0.0)],
            Beyond::Repeat if length > 0.0 => self.within(first.secs + into, is_before),
            Beyond::RepeatOnwards if length > 0.0 => {
                self.within(first.secs + into, is_before) + turns * (last.value - first.value)
            }
            Beyond::Mirror if length > 0.0 => {
                let into = if turns.rem_euclid(2.0) == 0.0 {
                    into
                } else {
                    length - into
                };
                self.within(first.secs + into, is_before)
            }
            _ => end.value,
        })
    }

    /// Between the first key and the last.
    fn within(&self, secs: f64, is_before: bool) -> f64 {
        let next = self
            .keys
            .partition_point(|key| key.secs < secs || (key.secs == secs && !is_before));
        let Range { start, end } = next.saturating_sub(1)..next.min(self.keys.len() - 1);
        let [key, end] = [self.keys[start], self.keys[end]];
        let length = end.secs - key.secs;
        if length <= 0.0 {
            return key.value;
        }
        let part = ((secs - key.secs) / length).clamp(0.0, 1.0);
        match key.way {
            Way::Constant { is_next } if is_next && part > 0.0 => end.value,
            Way::Constant { .. } => key.value,
            Way::Straight => key.value + (end.value - key.value) * part,
            Way::Cubic => {
                let [here, there] = [key.weights[1], end.weights[0]];
                let inner = [
                    key.value + key.slopes[1] * here * length,
                    end.value - end.slopes[0] * there * length,
                ];
                bezier(
                    [key.value, inner[0], inner[1], end.value],
                    solved([here, 1.0 - there], part),
                )
            }
        }
    }
}

/// The words and numbers of a take's keys.
struct TakeValues<'a> {
    keys: &'a Record<'a>,
    at: usize,
}

impl TakeValues<'_> {
    fn number(&mut self) -> Option<f64> {
        self.at += 1;
        self.keys.number(self.at - 1)
    }

    fn word(&mut self) -> Option<u8> {
        self.at += 1;
        match self.keys.values.get(self.at - 1)? {
            Value::Text(word) => word.first().copied(),
            // Binary files have the letter's number.
            Value::Integer(word) => u8::try_from(*word).ok(),
            _ => None,
        }
    }

    /// What stands behind a `U`: how slopes are set, slopes, and weights, as far as they are known.
    fn cubic(&mut self, version: i64) -> Option<(Slopes, [f64; 2], [f64; 2])> {
        let auto = Slopes::Auto {
            bias: 0.0,
            flags: flags::CLAMP_PROGRESSIVE | flags::TIME_INDEPENDENT,
        };
        let is_old = version <= 4004;
        let (set, slopes, weights) = match self.word()? {
            b's' | b'b' => (
                Slopes::Given,
                [self.number()?, self.number()?],
                u8::from(version != 4003),
            ),
            b'a' => (auto, [0.0; 2], u8::from(!is_old)),
            b'p' | b'q' => {
                self.at += 2;
                (auto, [0.0; 2], if is_old { 1 } else { 2 })
            }
            b't' => {
                self.at += 3;
                (auto, [0.0; 2], 0)
            }
            b'd' => {
                self.at += 1;
                (auto, [0.0; 2], 1)
            }
            _ => return None,
        };
        let mut of_slopes = slopes.map(|slope| [slope, PLAIN_WEIGHT]);
        for _ in 0..weights {
            match self.word()? {
                b'n' | b'c' => (),
                b'a' => {
                    of_slopes[0][1] = self.number()?;
                    of_slopes[1][1] = self.number()?;
                }
                b'l' => of_slopes[1][1] = self.number()?,
                b'r' => of_slopes[0][1] = self.number()?,
                _ => return None,
            }
        }
        Some((set, of_slopes[0], of_slopes[1]))
    }
}

/// What a curve does before its first key and after its last.
fn beyond(record: &Record<'_>) -> [Beyond; 2] {
    ["Pre-Extrapolation", "Post-Extrapolation"].map(|name| {
        let kind = record.find(name).and_then(|record| record.find("Type"));
        let kind = kind.and_then(|kind| match kind.values.first()? {
            Value::Text(word) => word.first().copied(),
            Value::Integer(word) => u8::try_from(*word).ok(),
            _ => None,
        });
        match kind {
            Some(b'K') => Beyond::Slope,
            Some(b'R') => Beyond::Repeat,
            Some(b'A') => Beyond::RepeatOnwards,
            Some(b'M') => Beyond::Mirror,
            _ => Beyond::Constant,
        }
    })
}

fn way(flags: i64, data: [f32; 4]) -> (Way, Slopes) {
    let has = |flag: i64| flags & flag != 0;
    let way = match () {
        () if has(flags::CONSTANT) => Way::Constant {
            is_next: has(flags::CONSTANT_NEXT),
        },
        () if has(flags::CUBIC) => Way::Cubic,
        () => Way::Straight,
    };
    let set = match () {
        () if has(flags::TCB) => Slopes::Tcb([data[0], data[1], data[2]].map(f64::from)),
        () if has(flags::USER) => Slopes::Given,
        () => Slopes::Auto {
            bias: f64::from(data[0]),
            flags,
        },
    };
    (way, set)
}

/// Slope and weight with which a key is left, and the next one is reached.
fn tangents(flags: i64, [here, next, packed, _]: [f32; 4]) -> [[f64; 2]; 2] {
    // Two weights of 16 bits lie in the bits of a number, in ten-thousandths.
    let bits = packed.to_bits();
    let weight = |flag: i64, bits: u32| match flags & flag {
        0 => PLAIN_WEIGHT,
        _ => f64::from(bits & 0xFFFF) / 10_000.0,
    };
    let slopes = if flags & flags::TCB == 0 {
        [here, next].map(f64::from)
    } else {
        [0.0; 2]
    };
    [
        [slopes[0], weight(flags::WEIGHT_HERE, bits)],
        [slopes[1], weight(flags::WEIGHT_NEXT, bits >> 16)],
    ]
}

/// The slopes of a key that the keys around set. Autodesk does not document them; the formulas fit the curves that its programs draw.
fn solved_slopes([before, key, after]: [Option<Key>; 3], set: Slopes) -> Option<[f64; 2]> {
    let key = key?;
    let slope = |from: Key, to: Key| (to.value - from.value) / (to.secs - from.secs);
    let [left, right] = [
        before.map(|before| slope(before, key)),
        after.map(|after| slope(key, after)),
    ];
    match set {
        Slopes::Given => None,
        Slopes::Tcb([tension, continuity, bias]) => {
            let half = if left.is_some() && right.is_some() { 0.5 } else { 1.0 };
            let [left, right] = [left, right].map(Option::unwrap_or_default);
            let part =
                |of_bias: f64, of_continuity: f64| half * (1.0 - tension) * (1.0 + of_bias) * (1.0 + of_continuity);
            Some([
                part(bias, -continuity) * left + part(-bias, continuity) * right,
                part(bias, continuity) * left + part(-bias, -continuity) * right,
            ])
        }
        Slopes::Auto { bias, flags } => Some(match (before, after) {
            (Some(before), Some(after)) => {
                // Until it is solved, this slope is what the key before has stored for it: minus its bias.
                let in_bias = -key.slopes[0];
                let between = |bias| auto_slope([before, key, after], bias, flags);
                if (key.slopes[0] + bias).abs() <= 1e-4 {
                    [between(bias); 2]
                } else {
                    [between(in_bias), between(bias)]
                }
            }
            (Some(other), None) => [end_slope(slope(other, key), [other.value, key.value], -key.slopes[0], flags); 2],
            (None, Some(other)) => [end_slope(slope(key, other), [other.value, key.value], bias, flags); 2],
            (None, None) => [0.0; 2],
        }),
    }
}

/// Values that differ by less are the same to a slope that is clamped.
const CLAMPED: f64 = 0.001;

fn auto_slope([before, key, after]: [Key; 3], bias: f64, flags: i64) -> f64 {
    let near = |other: Key| (other.value - key.value).abs() <= CLAMPED;
    if flags & flags::CLAMP != 0 && (near(before) || near(after)) {
        return 0.0;
    }
    let slope = |from: Key, to: Key| (to.value - from.value) / (to.secs - from.secs);
    let [whole, left, right] = [slope(before, after), slope(before, key), slope(key, after)];
    let mut steep = whole;
    if flags & flags::TIME_INDEPENDENT == 0 {
        let part = (key.secs - before.secs) / (after.secs - before.secs);
        steep = 0.5 * whole + 0.5 * (left * (1.0 - part) + right * part);
        let weight = bias.abs() / 100.0;
        if weight > 1e-4 {
            let aim = if bias > 0.0 { right } else { left };
            let turn = aim - steep;
            steep += turn * weight;
            let sign = if turn.abs() > 1e-5 { turn } else { bias }.signum();
            steep += steeper(weight) * sign;
        }
    }
    if flags & flags::CLAMP_PROGRESSIVE == 0 {
        return steep;
    }
    // It goes beyond neither key's value.
    let most = |to: Key, weight: f64| {
        let reach = weight * (to.secs - key.secs);
        let most = if reach == 0.0 {
            0.0
        } else {
            steep.signum() * (to.value - key.value) / reach
        };
        if most > 0.0 { most } else { 0.0 }
    };
    steep.signum()
        * steep
            .abs()
            .min(most(before, key.weights[0]))
            .min(most(after, key.weights[1]))
}

/// What a bias beyond 500 adds; `weight` is a hundredth of it.
fn steeper(weight: f64) -> f64 {
    let beyond = (weight - 5.0).max(0.0);
    beyond * beyond * 40.0
}

fn end_slope(slope: f64, [a, b]: [f64; 2], bias: f64, flags: i64) -> f64 {
    if flags & flags::CLAMP_PROGRESSIVE != 0 || (flags & flags::CLAMP != 0 && (a - b).abs() <= CLAMPED) {
        return 0.0;
    }
    match flags & flags::TIME_INDEPENDENT {
        0 => slope + steeper(bias.abs() / 100.0) * bias.signum(),
        _ => slope,
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
    // Halving so often reaches the last bit.
    for _ in 0..54 {
        let middle = 0.5 * (low + high);
        if bezier([0.0, b, c, 1.0], middle) < part {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}
