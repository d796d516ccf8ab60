//! Keys of clips of any format: what is mended in them, and in which words that is told.

use glam::Quat;

use crate::diagnostic::collect::{Moments, counted};
use crate::diagnostic::{Code, Moment, codes};
use crate::model::unit_rotation;
use crate::sorting;

/// A rotation whose length is off by more than this was not meant to be rounded.
const UNIT_TOLERANCE: f64 = 1e-3;

/// Thirty years: a time beyond it is no time, and its next neighbour could not be told from it.
const MAX_TIME_SECS: f32 = 1e9;

/// Whether a key can be at this time.
pub(super) fn is_time(time_secs: f32) -> bool {
    time_secs.abs() <= MAX_TIME_SECS
}

/// What is mended in the keys of a clip, counted over its tracks.
#[derive(Default)]
pub(super) struct Mended {
    pub(super) not_finite: Moments,
    unsorted: Moments,
    equal_times: Moments,
    not_unit: Moments,
    zero_rotation: Moments,
}

/// Counts a key of a bone. Its time is known where it is one; `line` is asked of the first few only.
pub(super) fn add(moments: &mut Moments, bone: u32, time_secs: f32, line: impl FnOnce() -> Option<u32>) {
    let moment = Moment {
        time_secs: Some(time_secs).filter(|&time_secs| is_time(time_secs)),
        bone: Some(bone),
    };
    moments.add(moment, line);
}

/// `2 keys have WHAT (first: bone 3 at 0.5 s); DONE.`
pub(super) fn in_words(moments: &Moments, [one, many]: [&str; 2], what: &str, done: &str) -> String {
    let (counted, first) = (counted(moments.count, one, many), moments.first_in_words());
    format!("{counted} {what}{first}; {done}.")
}

impl Mended {
    /// The rotation at unit length; none for one of length 0. `add` counts the key.
    pub(super) fn rotation(&mut self, stored: Quat, add: impl FnOnce(&mut Moments)) -> Quat {
        let rotation = unit_rotation(stored);
        if rotation.is_none() {
            add(&mut self.zero_rotation);
        } else if (stored.as_dquat().length() - 1.0).abs() > UNIT_TOLERANCE {
            add(&mut self.not_unit);
        }
        rotation.unwrap_or(Quat::IDENTITY)
    }

    /// Keys in strictly increasing time; `add` counts one of them.
    ///
    /// Of keys at one time the first ends the motion before it and the last begins the motion after it; those between are never seen. The
    /// last is moved to the next time that a number can name, and so is a key whose time was taken so.
    pub(super) fn in_order<T: Copy>(
        &mut self,
        mut keys: Vec<(f32, T)>,
        add: impl Fn(&mut Moments, &(f32, T)),
    ) -> Vec<(f32, T)> {
        if keys.is_sorted_by(|a, b| a.0 < b.0) {
            return keys;
        }
        if let Some(early) = keys.windows(2).find(|two| two[0].0 > two[1].0) {
            add(&mut self.unsorted, &early[1]);
            sorting::sort_by(&mut keys, |a, b| a.0.total_cmp(&b.0));
        }
        let mut kept: Vec<(f32, T)> = Vec::with_capacity(keys.len());
        for group in keys.chunk_by(|a, b| a.0 == b.0) {
            group[1..].iter().for_each(|key| add(&mut self.equal_times, key));
            let last = group.last().filter(|_| group.len() > 1);
            for &(time_secs, key) in group.first().into_iter().chain(last) {
                let free_secs = kept.last().map_or(f32::NEG_INFINITY, |before| before.0.next_up());
                kept.push((time_secs.max(free_secs), key));
            }
        }
        kept
    }

    /// Tells what was mended, one by one. `sorted` are the words for one and many of what has its keys sorted.
    pub(super) fn tell(&self, sorted: [&str; 2], mut tell: impl FnMut(&Code, &Moments, String)) {
        let keys = ["key has", "keys have"];
        let not_finite = "a number that is not finite or a time beyond 10⁹ s";
        let jump = "the first and the last key of a time are kept as a jump";
        let not_unit = "a rotation that is not of unit length";
        for (code, moments, who, what, done) in [
            (&codes::KEYS_NOT_FINITE, &self.not_finite, keys, not_finite, "left out"),
            (
                &codes::KEYS_NOT_SORTED,
                &self.unsorted,
                sorted,
                "keys that are not in the order of time",
                "sorted",
            ),
            (
                &codes::KEYS_AT_EQUAL_TIMES,
                &self.equal_times,
                keys,
                "the time of the key before",
                jump,
            ),
            (&codes::ROTATION_NOT_UNIT, &self.not_unit, keys, not_unit, "normalised"),
            (
                &codes::ROTATION_ZERO,
                &self.zero_rotation,
                keys,
                "a rotation of length 0",
                "taken as no rotation",
            ),
        ] {
            if moments.count > 0 {
                tell(code, moments, in_words(moments, who, what, done));
            }
        }
    }
}
