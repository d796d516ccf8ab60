//! Keeps a part of a clip, with keys at the cuts.

use glam::Vec4;

use super::edited::{Change, Edited, with_tracks};
use super::error::EditError;
use crate::anim::straight;
use crate::diagnostic::Fault;
use crate::model::{Clip, Curve, CurveValue, Curves, Track};

/// A quaternion is of unit length within this: what rounding leaves.
const UNIT_TOLERANCE: f32 = 1e-5;

/// Cuts the only clip to a range of its own time. What is left begins at 0 s, so that no player waits for it.
pub(super) fn cut(edited: &mut Edited, range_secs: [f32; 2]) -> Result<(), EditError> {
    let [clip] = &mut edited.model.clips[..] else {
        let count = edited.model.clips.len();
        return Err(EditError::Refused(format!(
            "A range is of one clip, and there are {count}; choose one."
        )));
    };
    let [from, to] = range_secs;
    if !(clip.start_secs <= from && from < to && to <= clip.end_secs) {
        return Err(EditError::Refused(format!(
            "The range from {from} s to {to} s is not inside \"{}\", which goes from {} s to {} s.",
            clip.name, clip.start_secs, clip.end_secs
        )));
    }
    if from == clip.start_secs && to == clip.end_secs {
        return Ok(());
    }
    *clip = part(clip, range_secs)?;
    let begins = if from == 0.0 { "" } else { ", which begins at 0 s now" };
    edited.changes.push(Change::new(
        "range-cut",
        format!("\"{}\" is cut to {from} s … {to} s{begins}.", clip.name),
    ));
    Ok(())
}

fn part(clip: &Clip, range_secs: [f32; 2]) -> Result<Clip, Fault> {
    let mut tracks = clip
        .tracks
        .iter()
        .map(|track| part_of_track(track, range_secs))
        .collect::<Result<Vec<Track>, _>>()?;
    // Where all keep still, one of them says how long.
    if tracks.iter().all(|track| track.key_count() == 1)
        && let Some(keyed) = tracks.iter_mut().find(|track| track.has_keys())
    {
        *keyed = Track::new(range_secs.map(|secs| (secs, keyed.key(0))))?;
    }
    let from_zero = tracks.iter().map(|track| track.sooner(range_secs[0]));
    let tracks = from_zero.collect::<Result<_, _>>()?;
    Ok(with_tracks(clip, tracks))
}

fn part_of_track(track: &Track, range_secs: [f32; 2]) -> Result<Track, Fault> {
    if !track.has_keys() {
        return Ok(track.clone());
    }
    let [from, to] = range_secs;
    // A spline of rotations has unit length at its keys alone, as files want it of keys: cut between them it goes on straight.
    let off_unit = |curve: &Curve<Vec4>| range_secs.map(|secs| (curve.value_at(secs).length() - 1.0).abs());
    let cuts_spline = |curve: &Curve<Vec4>| off_unit(curve).iter().any(|&off| off > UNIT_TOLERANCE);
    let track = match track.curves() {
        Some(curves) if curves.rotation.as_ref().is_some_and(cuts_spline) => {
            let curves = Curves {
                rotation: None,
                ..curves.clone()
            };
            &straight(track).into_owned().with_curves(curves)
        }
        _ => track,
    };
    let times_secs = track.times_secs();
    if track.curves().is_none() && (track.end_secs() <= from || to <= track.start_secs()) {
        return Track::new([(from, track.at(from))]);
    }
    let inner = inside(times_secs, range_secs).map(|key| (times_secs[key], track.key(key)));
    let ends = [(from, track.at(from)), (to, track.at(to))];
    let cut = Track::new(ends[..1].iter().copied().chain(inner).chain(ends[1..].iter().copied()))?;
    let Some(curves) = track.curves() else {
        return Ok(cut);
    };
    let of = |curve: &Option<Curve<_>>| curve.as_ref().map(|curve| part_of_curve(curve, range_secs)).transpose();
    let rotation = curves.rotation.as_ref();
    Ok(cut.with_curves(Curves {
        translation: of(&curves.translation)?,
        rotation: rotation.map(|curve| part_of_curve(curve, range_secs)).transpose()?,
        scale: of(&curves.scale)?,
    }))
}

/// The keys that lie between two times.
fn inside(times_secs: &[f32], [from, to]: [f32; 2]) -> std::ops::Range<usize> {
    let first = times_secs.partition_point(|&secs| secs <= from);
    first..times_secs.partition_point(|&secs| secs < to).max(first)
}

fn part_of_curve<T: CurveValue>(curve: &Curve<T>, range_secs: [f32; 2]) -> Result<Curve<T>, Fault> {
    let [from, to] = range_secs;
    let inner = inside(curve.times_secs(), range_secs).map(|key| curve.times_secs()[key]);
    let times_secs = [from].into_iter().chain(inner).chain([to]);
    if curve.tangents().is_none() {
        return Curve::step(times_secs.map(|secs| (secs, curve.value_at(secs))));
    }
    // A piece of a cubic is the cubic with its own slopes at the ends.
    Curve::cubic(times_secs.map(|secs| (secs, curve.value_at(secs), slopes_at(curve, secs))))
}

/// How steeply a cubic curve comes to a time and goes on from it, a second. Outside its keys it keeps still.
fn slopes_at<T: CurveValue>(curve: &Curve<T>, secs: f32) -> [T; 2] {
    let (times_secs, values) = (curve.times_secs(), curve.values());
    let still = values[0] * 0.0;
    let Some(tangents) = curve.tangents() else {
        return [still; 2];
    };
    let next = times_secs.partition_point(|&key_secs| key_secs <= secs);
    let last = times_secs.len() - 1;
    if let Some(key) = next.checked_sub(1).filter(|&key| times_secs[key] == secs) {
        let [slope_in, slope_out] = tangents[key];
        return [
            if key == 0 { still } else { slope_in },
            if key == last { still } else { slope_out },
        ];
    }
    if next == 0 || next > last {
        return [still; 2];
    }
    let length_secs = f64::from(times_secs[next]) - f64::from(times_secs[next - 1]);
    let t = (f64::from(secs) - f64::from(times_secs[next - 1])) / length_secs;
    let slope = values[next - 1] * (6.0 * (t * t - t) / length_secs) as f32
        + tangents[next - 1][1] * (3.0 * t * t - 4.0 * t + 1.0) as f32
        + values[next] * (6.0 * (t - t * t) / length_secs) as f32
        + tangents[next][0] * (3.0 * t * t - 2.0 * t) as f32;
    [slope; 2]
}
