//! Curves of numbers over time: constant, straight or cubic between keys, evaluated exactly, in their own way before the first key and after the last.

mod reading;
mod slopes;

use std::ops::Range;

/// Ticks of a second, as Autodesk's `FbxTime` counts; [`Settings`](super::settings::Settings) knows of files that count otherwise.
pub(super) const TICKS_PER_SEC: f64 = 46_186_158_000.0;

/// Keys that repeating adds at most on each side.
const MOST_REPEATED: usize = 1000;

/// Times that are nearer to each other are the same: those of repeated keys are sums of others.
const SAME_SECS: f64 = 1e-9;

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
    /// What it does before and behind them, and how often it repeats itself there at most.
    beyond: [(Beyond, u32); 2],
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

impl Curve {
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
        let turns = |beyond: f64, (way, most): (Beyond, u32)| match way {
            Beyond::Constant | Beyond::Slope => 0,
            _ => ((beyond / length).ceil() as usize)
                .min(MOST_REPEATED / self.keys.len().max(1))
                .min(most as usize),
        };
        let [before, after] = [turns(before, self.beyond[0]), turns(after, self.beyond[1])];
        (0..=before + after).flat_map(move |turn| {
            let turn = turn as f64 - before as f64;
            // A mirrored turn has its keys the other way round.
            let is_back = turn.rem_euclid(2.0) == 1.0 && self.beyond[usize::from(turn > 0.0)].0 == Beyond::Mirror;
            let place = move |secs: f64| if is_back { ends[1] - secs } else { secs - ends[0] };
            self.times_secs().map(move |secs| ends[0] + turn * length + place(secs))
        })
    }

    /// The value at a time; just before it where the time is `is_before`. `None` without keys.
    pub(super) fn at(&self, secs: f64, is_before: bool) -> Option<f64> {
        let (first, last) = (self.keys.first()?, self.keys.last()?);
        let length = last.secs - first.secs;
        // At an end it may go on with another value.
        let is_past = |away: f64, is_this_side: bool| away > if is_this_side { SAME_SECS } else { -SAME_SECS };
        let is_behind = is_past(secs - last.secs, is_before);
        if !is_behind && !is_past(first.secs - secs, !is_before) {
            return Some(self.within(secs, is_before));
        }
        let (beyond, most) = self.beyond[usize::from(is_behind)];
        let end = if is_behind { last } else { first };
        if beyond == Beyond::Slope {
            // As it goes on from the one, or comes to the other.
            return Some(end.value + (secs - end.secs) * end.slopes[usize::from(!is_behind)]);
        }
        if beyond == Beyond::Constant || length <= 0.0 || most == 0 {
            return Some(end.value);
        }
        // Turns since the first key, downwards before it. At a seam one ends and the next begins.
        let turns = (secs - first.secs) / length;
        let seam = turns.round();
        let turn = match (turns - seam).abs() * length < SAME_SECS {
            true if is_before => seam - 1.0,
            true => seam,
            false => turns.floor(),
        };
        // Behind the last one it stays where that ends.
        let held = turn.clamp(-f64::from(most), f64::from(most));
        let into = (secs - first.secs - held * length).clamp(0.0, length);
        let is_back = beyond == Beyond::Mirror && held.rem_euclid(2.0) == 1.0;
        let place = first.secs + if is_back { length - into } else { into };
        let near = self.keys.partition_point(|key| key.secs < place - SAME_SECS);
        let key = self.keys.get(near).filter(|key| key.secs <= place + SAME_SECS);
        let value = self.within(key.map_or(place, |key| key.secs), turn == held && is_before != is_back);
        let jump = if beyond == Beyond::RepeatOnwards {
            last.value - first.value
        } else {
            0.0
        };
        Some(value + held * jump)
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
