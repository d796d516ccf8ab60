//! Keeps a clip over where it starts: what walks away walks on the spot.
//!
//! The topmost joint that goes over the ground has its way there taken out, in the model's space; up and down it goes as before. Joints above it are taken as
//! they are at the start.

use glam::{DMat3, DVec3, Vec3};

use super::edited::{Change, Edited, with_tracks};
use super::error::EditError;
use crate::model::{Clip, JointIndex, Model, Track, UpAxis};

/// A way over the ground that is less than this part of the model's reach, which is all its bones in a row, is none: hips sway so far on the spot.
const LEAST_WAY: f64 = 0.02;

/// Keeps the clips of these names in place, each once.
pub(super) fn keep_in_place(edited: &mut Edited, names: &[String]) -> Result<(), EditError> {
    for (place, name) in names.iter().enumerate() {
        let Some(index) = edited.model.clips.iter().position(|clip| clip.name == *name) else {
            return Err(EditError::no_clip(name, &edited.model.clips));
        };
        let is_first = !names[..place].contains(name);
        if is_first && let Some((clip, change)) = in_place(&edited.model, &edited.model.clips[index]) {
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
    let lengths = above.iter().zip(rest);
    let reach: f64 = lengths
        .map(|((above, _), rest)| (*above * rest.translation.as_dvec3()).length())
        .sum();
    let mut is_led = vec![false; parents.len()];
    let mut found: Option<Walker> = None;
    for (joint, (above, above_count)) in above.into_iter().enumerate() {
        is_led[joint] = parents[joint].is_some_and(|parent| is_led[parent.index()]);
        let channel = clip.tracks[joint].translation();
        let start = channel.at(clip.start_secs);
        let over_ground = |&place: &Vec3| {
            let way = above * (place - start).as_dvec3();
            (way - up * way.dot(up)).length()
        };
        let way = channel.values().iter().map(over_ground).fold(0.0, f64::max);
        // An arm has less than a third of a character.
        let has_most = 3 * below[joint] >= parents.len() - above_count;
        let leads = has_most && way > LEAST_WAY * reach && above.determinant() != 0.0;
        let most = found.as_ref().map_or(0, |found| below[found.root.index()]);
        if leads && !is_led[joint] && below[joint] > most {
            found = Some(Walker {
                root: JointIndex(joint as u32),
                above,
                up,
                start,
                way,
            });
        }
        is_led[joint] |= leads;
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
