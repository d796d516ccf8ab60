//! Keeps a clip over where it starts: what walks away walks on the spot.
//!
//! The topmost joint that goes over the ground has its way there taken out, in the model's space; up and down it goes as before. Joints above it are taken as
//! they are at the start.

use std::collections::HashSet;

use glam::{DMat3, DVec3, Vec3};

use super::edited::{Change, Edited, with_tracks};
use super::error::EditError;
use crate::model::{Clip, JointIndex, Model, Track, UpAxis};

/// A way over the ground that is less than this part of the model's reach, which is all its bones in a row, is none: hips sway so far on the spot.
/// How far a root stands from the origin does not count.
const LEAST_WAY: f64 = 0.02;

/// Keeps the clips of these names in place, each once.
pub(super) fn keep_in_place(edited: &mut Edited, names: &[String]) -> Result<(), EditError> {
    let clips = &edited.model.clips;
    let known: HashSet<&str> = clips.iter().map(|clip| clip.name.as_str()).collect();
    if let Some(name) = names.iter().find(|name| !known.contains(name.as_str())) {
        return Err(EditError::no_clip(name, clips));
    }
    let mut asked: HashSet<&String> = names.iter().collect();
    for index in 0..edited.model.clips.len() {
        let clip = &edited.model.clips[index];
        if asked.remove(&clip.name)
            && let Some((clip, change)) = in_place(&edited.model, clip)
        {
            edited.model.clips[index] = clip;
            edited.changes.push(change);
        }
    }
    Ok(())
}

/// The topmost joint of a clip that goes over the ground.
struct Walker {
    root: JointIndex,
    /// The joint's parent -> the model, without its place.
    above: DMat3,
    up: DVec3,
    start: Vec3,
    /// How far it goes at most.
    way: f64,
}

/// Whether a clip leads away from where it starts.
pub fn leads_away(model: &Model, clip: &Clip) -> bool {
    walker(model, clip).is_some()
}

/// Of several the one with most joints below. One that leaves most others behind, such as a jaw or an arm, leads nothing away.
fn walker(model: &Model, clip: &Clip) -> Option<Walker> {
    let (parents, rest) = (model.skeleton.parents(), model.skeleton.rest());
    let up = match model.up_axis {
        UpAxis::Y => DVec3::Y,
        UpAxis::Z => DVec3::Z,
    };
    // Of each joint: from its parent to the model, without its place, and how many are above it.
    let mut above: Vec<(DMat3, usize)> = Vec::with_capacity(parents.len());
    for parent in parents {
        let of_parent = parent.map(|parent| (above[parent.index()], &clip.tracks[parent.index()]));
        above.push(of_parent.map_or((DMat3::IDENTITY, 0), |((above, count), track)| {
            let placed = track.at(clip.start_secs).parent_from_joint().as_daffine3();
            (above * placed.matrix3, count + 1)
        }));
    }
    let mut below = vec![1; parents.len()];
    for (joint, parent) in parents.iter().enumerate().rev() {
        if let Some(parent) = parent {
            below[parent.index()] += below[joint];
        }
    }
    let bones = above
        .iter()
        .zip(rest)
        .zip(parents)
        .filter(|(_, parent)| parent.is_some());
    let reach: f64 = bones
        .map(|(((above, _), rest), _)| (*above * rest.translation.as_dvec3()).length())
        .sum();
    let mut is_led = vec![false; parents.len()];
    let mut found: Option<Walker> = None;
    for (joint, (above, above_count)) in above.into_iter().enumerate() {
        is_led[joint] = parents[joint].is_some_and(|parent| is_led[parent.index()]);
        // An arm has less than a third of a character. Few joints pass this, and only their keys are looked at.
        let has_most = 3 * below[joint] >= parents.len() - above_count;
        let most = found.as_ref().map_or(0, |found| below[found.root.index()]);
        if is_led[joint] || !has_most || above.determinant() == 0.0 {
            continue;
        }
        let channel = clip.tracks[joint].translation();
        let start = channel.at(clip.start_secs);
        let over_ground = |&place: &Vec3| {
            let way = above * (place - start).as_dvec3();
            (way - up * way.dot(up)).length()
        };
        let way = channel.values().iter().map(over_ground).fold(0.0, f64::max);
        is_led[joint] = way > LEAST_WAY * reach;
        if is_led[joint] && below[joint] > most {
            found = Some(Walker {
                root: JointIndex(joint as u32),
                above,
                up,
                start,
                way,
            });
        }
    }
    found
}

/// The clip in place, and what is otherwise then; `None` where it goes nowhere.
pub fn in_place(model: &Model, clip: &Clip) -> Option<(Clip, Change)> {
    let Walker {
        root,
        above,
        up,
        start,
        way,
    } = walker(model, clip)?;
    // Only what is along the up axis is kept of a place.
    let upwards = DMat3::from_cols(up * up.x, up * up.y, up * up.z);
    let kept = above.inverse() * upwards * above;
    let keep = |place: Vec3| (kept * place.as_dvec3()).as_vec3();
    let offset = start - keep(start);
    let translation = clip.tracks[root.index()].translation().mapped(keep);
    let translation = translation.and_then(|channel| channel.moved(offset)).ok()?;
    let mut tracks = clip.tracks.clone();
    let track = &tracks[root.index()];
    tracks[root.index()] = Track::of_channels(translation, track.rotation().clone(), track.scale().clone());
    let message = format!(
        "\"{}\" stays over where it starts; it went {way:.3} over the ground.",
        clip.name
    );
    Some((with_tracks(clip, tracks), Change::new("in-place", message)))
}
