//! Which keys a channel needs. A model has all channels of a joint in one list of keys; a file has a list for each channel, and who reads
//! it finds what is between. Keys are left out where what is found there is the same number, so a file that was read has no more keys than
//! it had, and each time of a track stays in one channel at least.

use glam::{Quat, Vec3, Vec4};

use crate::model::{Curves, LocalJoint, Track, part_of_way, rotation_between, vector_between};

/// Keys this far apart are tried as neighbours, beside those that prolong what was found.
const SPAN: usize = 32;

/// Keys this near to the end of what was found may be the file's own key, where what was found reaches too far by chance.
const NEAR: usize = 4;

/// Values that are tried, for each key of a channel.
const TRIALS: usize = 64;

/// What is found may be off by this part of the values for rounding alone.
const ROUNDING: f32 = 2.0 * f32::EPSILON;

/// The keys that the channels of a track are written with, if they go straight: rotation, translation and scale. None are left where a
/// channel says no more than the node `rest` does. All is in glTF's space and time.
pub(super) fn needed(track: &Track, rest: &LocalJoint) -> [Vec<usize>; 3] {
    let times_secs = track.times_secs();
    let fewest_of = |channel: usize, must: &[bool]| match channel {
        0 => fewest(times_secs, track.rotations(), must),
        1 => fewest(times_secs, track.translations(), must),
        _ => fewest(times_secs, track.scales(), must),
    };
    let curves = track.curves();
    let is_straight = [
        curves.is_none_or(|curves| curves.rotation.is_none()),
        curves.is_none_or(|curves| curves.translation.is_none()),
        curves.is_none_or(|curves| curves.scale.is_none()),
    ];
    let none = vec![false; times_secs.len()];
    let first = track.key(0);
    let is_at_rest = [
        first.rotation == rest.rotation,
        first.translation == rest.translation,
        first.scale == rest.scale,
    ];
    let mut kept: [Vec<usize>; 3] = std::array::from_fn(|channel| match is_straight[channel] {
        true => fewest_of(channel, &none),
        false => Vec::new(),
    });
    for (keys, is_at_rest) in kept.iter_mut().zip(is_at_rest) {
        if is_at_rest && **keys == [0] {
            keys.clear();
        }
    }
    // How many channels have each time.
    let mut holders = vec![0_u8; times_secs.len()];
    let of_curves = curves.map(|curves| of_curves(curves, times_secs)).unwrap_or_default();
    for &key in kept.iter().flatten().chain(&of_curves) {
        holders[key] += 1;
    }
    if holders.contains(&0) {
        // One channel keeps the times that no other has: the one that grows least.
        let grown = (0..3).filter(|&channel| is_straight[channel]).map(|channel| {
            let mut must: Vec<bool> = holders.iter().map(|&holders| holders == 0).collect();
            for &key in &kept[channel] {
                must[key] = holders[key] == 1;
            }
            let keys = fewest_of(channel, &must);
            (keys.len().saturating_sub(kept[channel].len()), channel, keys)
        });
        if let Some((_, channel, keys)) = grown.min_by_key(|&(more, ..)| more) {
            kept[channel] = keys;
        }
    }
    kept
}

/// The keys of a track that its curves have.
fn of_curves(curves: &Curves, times_secs: &[f32]) -> Vec<usize> {
    let all = [
        curves.rotation.as_ref().map(|curve| curve.times_secs()),
        curves.translation.as_ref().map(|curve| curve.times_secs()),
        curves.scale.as_ref().map(|curve| curve.times_secs()),
    ];
    let key_at = |secs: &f32| {
        let key = times_secs.partition_point(|time_secs| time_secs < secs);
        (times_secs.get(key) == Some(secs)).then_some(key)
    };
    all.into_iter().flatten().flatten().filter_map(key_at).collect()
}

/// A value that goes straight from key to key.
trait Value: Copy + PartialEq {
    fn between(ends: [Self; 2], part: f64) -> Self;
    /// Whether a value between two ends is off by no more than their rounding can do.
    fn is_rounded(self, other: Self, ends: [Self; 2]) -> bool;
}

impl Value for Vec3 {
    fn between(ends: [Self; 2], part: f64) -> Self {
        vector_between(ends, part)
    }

    fn is_rounded(self, other: Self, [from, to]: [Self; 2]) -> bool {
        let rounding = (from.abs() + to.abs()) * ROUNDING;
        (self - other).abs().cmple(rounding).all()
    }
}

impl Value for Quat {
    fn between(ends: [Self; 2], part: f64) -> Self {
        rotation_between(ends, part)
    }

    fn is_rounded(self, other: Self, _: [Self; 2]) -> bool {
        // All are of unit length.
        Vec4::from(self - other).abs().max_element() <= 2.0 * ROUNDING
    }
}

/// What comes of leaving out all keys between two.
#[derive(PartialEq, Eq)]
enum Found {
    Same,
    /// Off by what rounding can do.
    Rounded,
    Other,
}

/// Tries what a reader finds between two keys. `trials` are those that are left.
fn found<T: Value>(times_secs: &[f32], values: &[T], [from, to]: [usize; 2], trials: &mut usize) -> Found {
    let ends = [values[from], values[to]];
    let span_secs = [times_secs[from], times_secs[to]];
    // In the middle a bend shows most.
    for key in [from.midpoint(to)].into_iter().chain(from + 1..to) {
        *trials = trials.saturating_sub(1);
        let value = T::between(ends, part_of_way(span_secs, times_secs[key]));
        if value != values[key] {
            let is_rounded = value.is_rounded(values[key], ends);
            return if is_rounded { Found::Rounded } else { Found::Other };
        }
    }
    Found::Same
}

/// The fewest keys that give all values, with those that must stay. It is the shortest path over the keys, where a step leads from a key to
/// a later one if they give all values between them.
fn fewest<T: Value>(times_secs: &[f32], values: &[T], must: &[bool]) -> Vec<usize> {
    let count = values.len();
    if count == 0 {
        return Vec::new();
    }
    // Before the first kept key its value holds, and after the last.
    let is_told_by_next = |key: usize| !must[key] && values[key] == values[key + 1];
    let head = (0..count - 1).find(|&key| !is_told_by_next(key)).unwrap_or(count - 1);
    let is_told_by_last = |key: usize| !must[key] && values[key] == values[key - 1];
    let tail = (1..count).rev().find(|&key| !is_told_by_last(key)).unwrap_or(0);
    if tail <= head {
        return vec![tail];
    }
    // Within a run of one value no step begins or ends.
    let is_within_run =
        |key: usize| key > 0 && key + 1 < count && is_told_by_next(key) && values[key - 1] == values[key];

    // How many keys there are up to each, at best, and the key before it.
    let mut best: Vec<(usize, usize)> = vec![(usize::MAX, 0); count];
    for (key, best) in best.iter_mut().enumerate().take(head + 1) {
        *best = (1, key);
    }
    let mut reach = 0;
    let mut trials = TRIALS * count;
    for from in 0..count - 1 {
        let keys = best[from].0 + 1;
        let mut step = |to: usize| {
            if keys < best[to].0 {
                best[to] = (keys, from);
            }
        };
        step(from + 1);
        if is_within_run(from) {
            continue;
        }
        let mut run_end = from + 1;
        while run_end + 1 < count && values[from] == values[run_end] && is_told_by_next(run_end) {
            run_end += 1;
        }
        if run_end > from + 1 && found(times_secs, values, [from, run_end], &mut trials) == Found::Same {
            step(run_end);
        }
        let is_inner = from + NEAR < reach;
        for to in from + 2..count {
            let is_far = to > from + SPAN && (trials == 0 || is_inner);
            if must[to - 1] || is_far {
                break;
            }
            if is_within_run(to) {
                trials = trials.saturating_sub(1);
                continue;
            }
            match found(times_secs, values, [from, to], &mut trials) {
                Found::Same => {
                    step(to);
                    reach = reach.max(to);
                }
                Found::Rounded => {}
                Found::Other => break,
            }
        }
    }
    let last = (tail..count).min_by_key(|&key| best[key].0);
    let mut kept: Vec<usize> = last.into_iter().collect();
    while let Some(&key) = kept.last()
        && best[key].1 != key
    {
        kept.push(best[key].1);
    }
    kept.reverse();
    kept
}
