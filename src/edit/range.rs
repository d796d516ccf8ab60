//! Keeps a part of a clip, with keys at the cuts.

use super::edited::{Change, Edited, with_tracks};
use super::error::EditError;
use crate::anim::straight;
use crate::diagnostic::Fault;
use crate::model::{Channel, ChannelValue, Clip, Track, Way};

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
    let from_zero = tracks.iter().map(|track| track.shifted_earlier(range_secs[0]));
    let tracks = from_zero.collect::<Result<_, _>>()?;
    Ok(with_tracks(clip, tracks))
}

fn part_of_track(track: &Track, range_secs: [f32; 2]) -> Result<Track, Fault> {
    // Files want unit quaternions at keys. A spline is not of unit length between its keys, so a cut there makes the rotation go straight.
    let rotation = track.rotation();
    let cuts_spline = range_secs
        .iter()
        .any(|&secs| (rotation.value_at(secs).length() - 1.0).abs() > UNIT_TOLERANCE);
    let rotation = match cuts_spline {
        true => part_of_channel(straight(track).rotation(), range_secs),
        false => part_of_channel(rotation, range_secs),
    };
    Ok(Track::of_channels(
        part_of_channel(track.translation(), range_secs)?,
        rotation?,
        part_of_channel(track.scale(), range_secs)?,
    ))
}

/// A channel from a time to another. One that keeps still between them has one key, or none where it rests.
fn part_of_channel<T: ChannelValue>(channel: &Channel<T>, [from, to]: [f32; 2]) -> Result<Channel<T>, Fault> {
    let times_secs = channel.times_secs();
    let ([first, .., last] | [first @ last]) = times_secs else {
        return Ok(channel.clone());
    };
    let inner = times_secs.iter().copied().filter(|&secs| from < secs && secs < to);
    let times_secs = [from].into_iter().chain(inner).chain([to]);
    let values = times_secs.clone().map(|secs| (secs, channel.value_at(secs)));
    match channel.way() {
        Way::Straight if *last <= from || to <= *first || first == last => Channel::straight(values.take(1)),
        Way::Straight => Channel::straight(values),
        Way::Held => Channel::held(values),
        // A piece of a cubic is the cubic with its own slopes at the ends.
        Way::Spline(_) => Channel::spline(values.map(|(secs, value)| (secs, value, channel.slopes_at(secs)))),
    }
}
