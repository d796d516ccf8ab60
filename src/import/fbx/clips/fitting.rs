//! From what is asked at any time to the keys of a channel.

use std::cell::Cell;

use glam::{DQuat, DVec4};

use crate::diagnostic::Fault;
use crate::model::{Channel, ChannelValue};

/// So often an interval between two keys is halved at most: into 128 pieces.
pub(super) const MOST_HALVINGS: u32 = 7;

/// Of so many keys in a line one is kept at least.
const MOST_IN_LINE: usize = 32;

/// A value over time. Vectors have 0 as their fourth number.
pub(super) struct Source<'a> {
    /// The value at a time, or just before it.
    pub(super) at: &'a dyn Fn(f64, bool) -> DVec4,
    pub(super) is_rotation: bool,
    /// How far keys may be off.
    pub(super) tolerance: f64,
    /// How often it may still be asked.
    pub(super) evaluations_left: &'a Cell<u64>,
    /// Set where keys are off by more.
    pub(super) is_off: &'a Cell<bool>,
}

/// Keys with times in seconds.
pub(super) enum Fitted {
    /// It does not move, since a time; `None` where nothing says how it is.
    Rest(Option<(f32, DVec4)>),
    Straight(Vec<(f32, DVec4)>),
    Held(Vec<(f32, DVec4)>),
    Spline(Vec<Knot>),
}

/// A key of a spline, with the slopes with which it is reached and left.
#[derive(Clone, Copy)]
pub(super) struct Knot {
    secs: f32,
    value: DVec4,
    slopes: [DVec4; 2],
}

/// A way between two times, with the values at both ends and their slopes.
#[derive(Clone, Copy)]
struct Way {
    secs: [f64; 2],
    values: [DVec4; 2],
    slopes: [DVec4; 2],
}

impl Source<'_> {
    fn at(&self, secs: f64, is_before: bool) -> DVec4 {
        (self.at)(secs, is_before)
    }

    pub(super) fn fitted(&self, times: &[f64]) -> Fitted {
        let Some(&first) = times.first() else {
            return Fitted::Rest(None);
        };
        let start = self.at(first, false);
        if !start.is_finite() {
            return Fitted::Rest(None);
        }
        let ways: Vec<[f64; 2]> = times.array_windows().copied().collect();
        let is_near = |a: DVec4, b: DVec4, part: f64| self.distance(a, b) <= part * self.tolerance;
        // The three places that are looked at between two keys, and what is there.
        let probes =
            |[from, to]: [f64; 2]| [0.25, 0.5, 0.75].map(|part| (part, self.at(from + (to - from) * part, false)));
        let ends = |[from, to]: [f64; 2]| [self.at(from, false), self.at(to, true)];
        let stays = |&way: &[f64; 2]| {
            let [from, to] = ends(way);
            is_near(from, to, 0.1) && probes(way).iter().all(|(_, value)| is_near(from, *value, 0.1))
        };
        let end = times[times.len() - 1];
        // At the end it stays where it came to.
        let values = || times.iter().map(|&secs| (secs as f32, self.at(secs, secs == end)));
        if ways.iter().all(stays) {
            let moves = values().any(|(_, value)| !is_near(start, value, 0.1));
            return if moves {
                Fitted::Held(values().collect())
            } else {
                Fitted::Rest(Some((first as f32, start)))
            };
        }
        // How far a straight line is off.
        let off = |&way: &[f64; 2]| {
            let [from, to] = ends(way);
            let jump = if way[1] == end {
                0.0
            } else {
                self.distance(to, self.at(way[1], false))
            };
            let off = probes(way).map(|(part, value)| self.distance(self.between(from, to, part), value));
            off.into_iter().fold(jump, f64::max)
        };
        let mut most = 0f64;
        let mut offs = ways.iter().map(off);
        if offs.all(|off| {
            most = most.max(off);
            off <= self.tolerance
        }) {
            return Fitted::Straight(self.without_needless(
                &values().collect::<Vec<_>>(),
                (self.tolerance - most).min(0.1 * self.tolerance),
            ));
        }
        let mut knots = Vec::with_capacity(2 * times.len());
        for way in ways {
            self.add(way, MOST_HALVINGS, &mut knots);
        }
        Fitted::Spline(knots)
    }

    /// Leaves out keys that the line between those before and behind them gives, as near as a tolerance.
    fn without_needless(&self, keys: &[(f32, DVec4)], tolerance: f64) -> Vec<(f32, DVec4)> {
        let mut kept = 0;
        let mut needed = Vec::new();
        for (place, &key) in keys.iter().enumerate() {
            let is_end = place == 0 || place + 1 == keys.len();
            let next = keys[(place + 1).min(keys.len() - 1)];
            let is_in_line = |&(secs, value): &(f32, DVec4)| {
                let [start, end, secs] = [keys[kept].0, next.0, secs].map(f64::from);
                let part = (secs - start) / (end - start);
                self.distance(self.between(keys[kept].1, next.1, part), value) <= tolerance
            };
            if is_end || place - kept == MOST_IN_LINE || !keys[kept + 1..=place].iter().all(is_in_line) {
                needed.push(key);
                kept = place;
            }
        }
        needed
    }

    /// Adds the knots of a way: its start, where the one before does not end there, and its end.
    fn add(&self, way: [f64; 2], halves: u32, knots: &mut Vec<Knot>) {
        let spline = self.way(way);
        let is_near = |part: f64| {
            let wanted = self.at(way[0] + (way[1] - way[0]) * part, false);
            self.distance(self.unit(spline.at(part)), wanted) <= self.tolerance
        };
        let middle = 0.5 * (way[0] + way[1]);
        let has_middle = way[0] as f32 <= (middle as f32).next_down() && middle as f32 <= (way[1] as f32).next_down();
        if has_middle && self.evaluations_left.get() > 0 && ![0.25, 0.5, 0.75].into_iter().all(is_near) {
            if let Some(halves) = halves.checked_sub(1) {
                self.add([way[0], middle], halves, knots);
                self.add([middle, way[1]], halves, knots);
                return;
            }
            self.is_off.set(true);
        }
        let [from, to] = spline.values;
        let [left, reached] = spline.slopes;
        let start = spline.secs[0] as f32;
        match knots.last_mut() {
            Some(knot) if self.distance(self.near(knot.value, from), from) <= 0.1 * self.tolerance => {
                // Rotations have two signs: that of the key before goes on.
                let sign = if self.is_rotation && knot.value.dot(from) < 0.0 {
                    -1.0
                } else {
                    1.0
                };
                knot.slopes[1] = left * sign;
                knots.push(Knot {
                    secs: spline.secs[1] as f32,
                    value: to * sign,
                    slopes: [reached * sign; 2],
                });
            }
            last => {
                // At once another value: what was there until now ends just before.
                if let Some(knot) = last {
                    knot.secs = knot.secs.next_down();
                    knot.slopes[1] = DVec4::ZERO;
                }
                knots.push(Knot {
                    secs: start,
                    value: from,
                    slopes: [DVec4::ZERO, left],
                });
                knots.push(Knot {
                    secs: spline.secs[1] as f32,
                    value: to,
                    slopes: [reached; 2],
                });
            }
        }
    }

    /// The spline of a way by values and slopes at both ends.
    fn way(&self, [from, to]: [f64; 2]) -> Way {
        let step = (to - from) * 1e-3;
        let start = self.at(from, false);
        let at = |secs: f64, is_before| self.near(self.at(secs, is_before), start);
        let end = at(to, true);
        // One-sided differences of four places.
        let slope = |end: DVec4, step: f64| {
            let [a, b, c] = [1.0, 2.0, 3.0].map(|steps| {
                let origin = if step > 0.0 { from } else { to };
                at(origin + steps * step, false)
            });
            (end * -11.0 + a * 18.0 - b * 9.0 + c * 2.0) / (6.0 * step)
        };
        Way {
            secs: [from, to],
            values: [start, end],
            slopes: [slope(start, step), slope(end, -step)],
        }
    }

    /// A rotation with the sign that is nearer to another one.
    fn near(&self, value: DVec4, other: DVec4) -> DVec4 {
        if self.is_rotation && value.dot(other) < 0.0 {
            -value
        } else {
            value
        }
    }

    fn unit(&self, value: DVec4) -> DVec4 {
        if self.is_rotation {
            value.normalize_or(DVec4::W)
        } else {
            value
        }
    }

    /// How far two values are apart; rotations by their angle.
    fn distance(&self, a: DVec4, b: DVec4) -> f64 {
        if self.is_rotation {
            2.0 * self.near(a, b).distance(b)
        } else {
            a.distance(b)
        }
    }

    fn between(&self, from: DVec4, to: DVec4, part: f64) -> DVec4 {
        match self.is_rotation {
            true => DQuat::from_vec4(from)
                .slerp(DQuat::from_vec4(self.near(to, from)), part)
                .into(),
            false => from.lerp(to, part),
        }
    }
}

impl Way {
    /// Hermite's cubic at a part of the way.
    fn at(&self, t: f64) -> DVec4 {
        let length = self.secs[1] - self.secs[0];
        let (t2, t3) = (t * t, t * t * t);
        self.values[0] * (2.0 * t3 - 3.0 * t2 + 1.0)
            + self.slopes[0] * (length * (t3 - 2.0 * t2 + t))
            + self.values[1] * (3.0 * t2 - 2.0 * t3)
            + self.slopes[1] * (length * (t3 - t2))
    }
}

impl Fitted {
    /// The channel of it.
    ///
    /// # Errors
    /// When a number is too great for one.
    pub(super) fn channel<T: ChannelValue>(self, value: impl Fn(DVec4) -> T, rest: T) -> Result<Channel<T>, Fault> {
        let keys = |keys: Vec<(f32, DVec4)>| {
            keys.into_iter()
                .map(|(secs, key)| (secs, value(key)))
                .collect::<Vec<_>>()
        };
        match self {
            Self::Rest(None) => Ok(Channel::at_rest(rest)),
            Self::Rest(Some((secs, still))) => Ok(Channel::at_rest(value(still)).resting_at(rest, secs)),
            Self::Straight(found) => Channel::straight(keys(found)),
            Self::Held(found) => Channel::held(keys(found)),
            Self::Spline(mut knots) => {
                // Keys that are nearer to each other than numbers for them stand side by side.
                let mut free_secs = f32::NEG_INFINITY;
                for knot in &mut knots {
                    knot.secs = knot.secs.max(free_secs);
                    free_secs = knot.secs.next_up();
                }
                let keys = knots.into_iter();
                Channel::spline(keys.map(|knot| (knot.secs, value(knot.value), knot.slopes.map(&value))))
            }
        }
    }
}
