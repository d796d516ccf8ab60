//! Keeps a clip over where it starts: what walks away walks on the spot.
//!
//! The topmost joint that moves has its way over the ground taken out, in the model's space; up and down it goes as before.

use glam::{DAffine3, DMat3, DVec3, Vec3};

use super::edited::{Change, Edited, with_tracks};
use super::error::EditError;
use crate::model::{Clip, JointIndex, Model, Skeleton, Track, UpAxis};

/// A way over the ground that is less than this part of the model's reach is none.
const LEAST_WAY: f64 = 1e-4;

/// Keeps the clips of these names in place.
pub(super) fn keep_in_place(edited: &mut Edited, names: &[String]) -> Result<(), EditError> {
    for name in names {
        let Some(index) = edited.model.clips.iter().position(|clip| clip.name == *name) else {
            return Err(EditError::no_clip(name, &edited.model.clips));
        };
        let kept = in_place(&edited.model, &edited.model.clips[index]);
        if let Some((clip, way)) = kept {
            edited.model.clips[index] = clip;
            let message = format!("\"{name}\" stays over where it starts; it went {way:.3} over the ground.");
            edited.changes.push(Change::new("in-place", message));
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

fn walker(model: &Model, clip: &Clip) -> Option<Walker> {
    let skeleton = &model.skeleton;
    let root = root(skeleton, clip)?;
    let up = match model.up_axis {
        UpAxis::Y => DVec3::Y,
        UpAxis::Z => DVec3::Z,
    };
    let above = model_from_parent(skeleton, root).matrix3;
    let channel = clip.tracks[root.index()].translation();
    let start = channel.at(clip.start_secs);
    let over_ground = |place: Vec3| {
        let way = above * (place - start).as_dvec3();
        (way - up * way.dot(up)).length()
    };
    let way = channel
        .values()
        .iter()
        .map(|&place| over_ground(place))
        .fold(0.0, f64::max);
    let reach: f64 = skeleton
        .rest()
        .iter()
        .map(|rest| f64::from(rest.translation.length()))
        .sum();
    let walks = way > LEAST_WAY * reach && above.determinant() != 0.0;
    walks.then_some(Walker {
        root,
        above,
        up,
        start,
        way,
    })
}

/// The clip in place, and how far it went; `None` where it goes nowhere.
pub fn in_place(model: &Model, clip: &Clip) -> Option<(Clip, f64)> {
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
    Some((with_tracks(clip, tracks), way))
}

/// The topmost joint that a clip moves from its place; of several the one with most joints below.
fn root(skeleton: &Skeleton, clip: &Clip) -> Option<JointIndex> {
    let parents = skeleton.parents();
    let mut below = vec![1u32; parents.len()];
    for (joint, parent) in parents.iter().enumerate().rev() {
        if let Some(parent) = parent {
            below[parent.index()] += below[joint];
        }
    }
    let moves = |joint: usize| clip.tracks[joint].translation().has_keys();
    let mut is_below = vec![false; parents.len()];
    for (joint, parent) in parents.iter().enumerate() {
        is_below[joint] = parent.is_some_and(|parent| is_below[parent.index()] || moves(parent.index()));
    }
    let tops = (0..parents.len()).filter(|&joint| moves(joint) && !is_below[joint]);
    tops.max_by_key(|&joint| (below[joint], std::cmp::Reverse(joint)))
        .map(|joint| JointIndex(joint as u32))
}

/// Where the parent of a joint is at rest.
fn model_from_parent(skeleton: &Skeleton, joint: JointIndex) -> DAffine3 {
    let mut placed = DAffine3::IDENTITY;
    let mut at = skeleton.parents()[joint.index()];
    while let Some(parent) = at {
        placed = skeleton.rest()[parent.index()].parent_from_joint().as_daffine3() * placed;
        at = skeleton.parents()[parent.index()];
    }
    placed
}
