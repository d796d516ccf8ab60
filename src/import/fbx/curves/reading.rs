//! Curves as files have them: `AnimationCurve` of 7.x, and the channels of a `Take` of 6.1.

use super::slopes::{self, Slopes};
use super::{Beyond, Curve, Key, PLAIN_WEIGHT, TICKS_PER_SEC, Way, flags};
use crate::diagnostic::collect::counted;
use crate::diagnostic::{Fault, codes};
use crate::fbx::{Record, Value};
use crate::import::fbx::file::{File, in_object};

/// Since this version text has `KeyAttrDataFloat` as the bits of an `f32`.
const BITS_SINCE: u32 = 7200;

/// Keys while they are read.
#[derive(Default)]
struct Growing {
    ticks_per_sec: f64,
    keys: Vec<Key>,
    slopes: Vec<Slopes>,
    /// With what the next key is reached: slope and weight.
    next: [f64; 2],
    /// How many keys are left out.
    left_out: usize,
}

impl Growing {
    /// Adds a key; `right` and `next` are slope and weight with which it is left, and the next one reached. Those without a number, and those that are not
    /// later than the one before, are left out.
    fn add(&mut self, ticks: f64, value: f64, way: Way, set: Slopes, right: [f64; 2], next: [f64; 2]) {
        let secs = ticks / self.ticks_per_sec;
        let is_later = self.keys.last().is_none_or(|before| before.secs < secs);
        if !(value.is_finite() && secs.is_finite() && is_later) {
            self.left_out += 1;
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

    /// The curve that a record says; `of` names what it moves, and is asked where something is told of it: names can be long.
    fn curve(mut self, record: &Record<'_>, file: &mut File<'_, '_>, of: &dyn Fn() -> String) -> Curve {
        if self.left_out > 0 {
            let kind = "Curves with keys that are left out";
            file.note_each(record.place, &codes::FBX_RULE_BROKEN, kind, || {
                let keys = counted(self.left_out, "key", "keys");
                format!(
                    "The curve of \"{}\" has {keys} without a number, or no later than one before; left out.",
                    of()
                )
            });
        }
        for at in 0..self.keys.len() {
            if self.keys[at].way == Way::Cubic {
                let around = [at.checked_sub(1), Some(at), Some(at + 1)].map(|at| self.keys.get(at?).copied());
                if let Some(slopes) = slopes::solved(around, self.slopes[at]) {
                    self.keys[at].slopes = slopes;
                }
            }
        }
        // After all are solved: until then an automatic key has another number for its first slope.
        for at in 0..self.keys.len() {
            if let (Way::Straight, Some(&next)) = (self.keys[at].way, self.keys.get(at + 1)) {
                let slope = (next.value - self.keys[at].value) / (next.secs - self.keys[at].secs);
                self.keys[at].slopes[1] = slope;
                self.keys[at + 1].slopes[0] = slope;
            }
        }
        Curve {
            keys: self.keys,
            beyond: beyond(record),
        }
    }
}

impl Curve {
    /// An `AnimationCurve` of 7.x; `of` names what it moves.
    ///
    /// # Errors
    /// When an array is damaged, or the budget has no room for its keys.
    pub(in crate::import::fbx) fn read(
        record: &Record<'_>,
        file: &mut File<'_, '_>,
        of: &dyn Fn() -> String,
    ) -> Result<Self, Fault> {
        let (document, budget) = (file.document, &file.budget);
        let named = |fault| in_object(&of())(fault);
        let integers = |name| record.integers_of(name, budget).map_err(named);
        let numbers = |name| record.numbers_of(name, budget).map_err(named);
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
        budget.keep((size_of::<Key>() * times.len().min(values.len())) as u64, record.place)?;
        if times.len() != values.len() {
            let kind = "Curves with more times than values, or fewer";
            file.note_each(record.place, &codes::FBX_RULE_BROKEN, kind, || {
                format!(
                    "The curve of \"{}\" has {}, but {}; what has no other half is left out.",
                    of(),
                    counted(times.len(), "time", "times"),
                    counted(values.len(), "value", "values"),
                )
            });
        }
        // Runs of keys have the same attributes.
        let mut run = 0;
        let mut left = counts.first().copied().unwrap_or_default();
        let mut growing = Growing {
            ticks_per_sec: file.settings.ticks_per_sec,
            ..Growing::default()
        };
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
        Ok(growing.curve(record, file, of))
    }

    /// A channel of a `Take` of 6.1, where words stand between the numbers of a key; `of` names what it moves.
    pub(in crate::import::fbx) fn read_take(
        record: &Record<'_>,
        file: &mut File<'_, '_>,
        of: &dyn Fn() -> String,
    ) -> Self {
        let mut growing = Growing {
            ticks_per_sec: TICKS_PER_SEC,
            ..Growing::default()
        };
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
        growing.curve(record, file, of)
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

/// What a curve does before its first key and after its last, and how often.
fn beyond(record: &Record<'_>) -> [(Beyond, u32); 2] {
    ["Pre-Extrapolation", "Post-Extrapolation"].map(|name| {
        let record = record.find(name);
        let most = record.and_then(|record| record.find("Repetition")?.integer(0));
        // A negative count, or none, repeats without end.
        let most = most.and_then(|most| u32::try_from(most).ok()).unwrap_or(u32::MAX);
        let kind = record.and_then(|record| record.find("Type"));
        let kind = kind.and_then(|kind| match kind.values.first()? {
            Value::Text(word) => word.first().copied(),
            Value::Integer(word) => u8::try_from(*word).ok(),
            _ => None,
        });
        let beyond = match kind {
            Some(b'K') => Beyond::Slope,
            Some(b'R') => Beyond::Repeat,
            Some(b'A') => Beyond::RepeatOnwards,
            Some(b'M') => Beyond::Mirror,
            _ => Beyond::Constant,
        };
        (beyond, most)
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
