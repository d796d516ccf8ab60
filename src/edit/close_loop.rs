//! Brings the end of a clip back to its first pose.
//!
//! The way from each bone's last pose to its first is added to the clip's end in parts: nothing where the easing begins, all of it at the
//! end, and between them 3u² − 2u³ of it, u from 0 to 1. So the motion goes on below it, and is as fast at both ends as before.
//! Translations and scales are added up; rotations are turned on along the shorter arc.

use glam::Quat;

use super::edited::{Change, Edited, counted, with_tracks};
use super::error::EditError;
use crate::anim::straight;
use crate::model::{Clip, LocalJoint, Track};

/// Steps of the easing, at least and at most: its curve is made of straight pieces.
const STEPS: [u32; 2] = [8, 256];

/// Closes the loops of all clips that have a length.
pub(super) fn close_loops(edited: &mut Edited, secs: f32) -> Result<(), EditError> {
    for clip in &mut edited.model.clips {
        let duration_secs = clip.duration_secs();
        let too_short = |secs: f32| !(secs > 0.0 && secs <= duration_secs);
        if duration_secs == 0.0 && secs > 0.0 {
            continue;
        }
        if too_short(secs) {
            return Err(EditError::Refused(format!(
                "\"{}\" is {duration_secs} s long; its end cannot be eased over {secs} s.",
                clip.name
            )));
        }
        let (closed, joints) = close(clip, secs)
            .ok_or_else(|| EditError::Overflows(format!("\"{}\" has keys that are too far apart.", clip.name)))?;
        *clip = closed;
        if joints > 0 {
            let bones = counted(joints, "bone", "bones");
            edited.changes.push(Change::new(
                "loop-closed",
                format!(
                    "The last {secs} s of \"{}\" lead {bones} back to the first pose.",
                    clip.name
                ),
            ));
        }
    }
    Ok(())
}

/// The clip with its end brought back, and how many joints that moves. None where numbers overflow.
fn close(clip: &Clip, secs: f32) -> Option<(Clip, usize)> {
    let from_secs = (clip.end_secs - secs).clamp(clip.start_secs, clip.end_secs.next_down());
    let steps = steps(clip, from_secs);
    let mut joints = 0;
    let mut tracks = Vec::with_capacity(clip.tracks.len());
    for track in &clip.tracks {
        let [first, last] = [clip.start_secs, clip.end_secs].map(|secs| track.at(secs));
        if first == last {
            tracks.push(track.clone());
            continue;
        }
        joints += 1;
        let track = straight(track);
        let times_secs = track.times_secs();
        let kept = times_secs.partition_point(|&secs| secs < from_secs);
        let own = &times_secs[kept..];
        // A step beside a key would be a second key for one time.
        let near_secs = secs / (4 * steps.len()) as f32;
        let is_far = |secs: &f32| own.iter().all(|own| (own - secs).abs() > near_secs);
        let mut eased: Vec<f32> = own.iter().copied().filter(|secs| *secs < clip.end_secs).collect();
        eased.extend(steps.iter().filter(|secs| is_far(secs)));
        eased.push(from_secs);
        eased.sort_by(f32::total_cmp);
        eased.dedup();
        let before = track.keys().take(kept);
        let after = eased.into_iter().map(|secs| {
            let u = (secs - from_secs) / (clip.end_secs - from_secs);
            let part = u * u * (3.0 - 2.0 * u);
            (secs, brought_on(&track.at(secs), &last, &first, part))
        });
        tracks.push(Track::new(before.chain(after).chain([(clip.end_secs, first)])).ok()?);
    }
    Some((with_tracks(clip, tracks), joints))
}

/// Times between a time and the end: the clip's frames, where they are neither few nor very many.
fn steps(clip: &Clip, from_secs: f32) -> Vec<f32> {
    let frames = clip.frame_at(from_secs) + 1..clip.last_frame();
    let [least, most] = STEPS;
    if (least..=most).contains(&(frames.len() as u32)) {
        return frames.map(|frame| clip.time_of_frame(frame)).collect();
    }
    let count = (frames.len() as u32).clamp(least, most);
    let length_secs = clip.end_secs - from_secs;
    let steps = (1..count).map(|step| from_secs + length_secs * step as f32 / count as f32);
    steps.filter(|&secs| from_secs < secs && secs < clip.end_secs).collect()
}

/// A joint with a part of the way from one pose to another added.
fn brought_on(joint: &LocalJoint, from: &LocalJoint, to: &LocalJoint, part: f32) -> LocalJoint {
    let way = from.rotation.inverse() * to.rotation;
    let shorter = if way.w < 0.0 { -way } else { way };
    LocalJoint {
        rotation: (joint.rotation * Quat::IDENTITY.slerp(shorter, part)).normalize(),
        translation: joint.translation + (to.translation - from.translation) * part,
        scale: joint.scale + (to.scale - from.scale) * part,
    }
}
