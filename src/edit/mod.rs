//! Changes to a model before it is written: functions from a [`Model`] to a [`Model`], each in a file of its own.
//!
//! [`apply`] makes all that [`Edits`] ask for, in one order: choose, keep in place, fix, range, close, reduce, scale and axes, rename, and last what the
//! books' demo needs. Each thing that came out otherwise than it was is a [`Change`]; what changes nothing is none.

mod choose;
mod close_loop;
mod edited;
mod error;
mod fix;
mod for_book;
mod in_place;
mod range;
mod reduce;
mod rename;
mod retarget;
mod space;

pub use edited::{Change, Edited};
pub use error::EditError;
pub use for_book::too_large_for_book;
pub use in_place::{in_place, leads_away};
pub use retarget::{Retargeted, common_name, has_names, retarget};

use crate::model::{Front, Handedness, JointNames, Model, UpAxis};
use crate::slices::{Slices, Stage, at_once};

/// What to change. The default changes nothing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Edits {
    /// Names of the clips to keep; `None` keeps all.
    pub clips: Option<Vec<String>>,
    /// Names of the clips that stay over where they start, where those that are kept have them.
    pub in_place: Vec<String>,
    /// Mends what [`check`](crate::check) names and can be mended without a choice.
    pub fix: bool,
    /// The part of the only clip to keep, from and to, in seconds of its own time.
    pub range_secs: Option<[f32; 2]>,
    /// Seconds at the end of each clip over which it is brought back to its first pose.
    pub close_loop_secs: Option<f32>,
    /// How far joints and their tips may be moved by keys that are left out, as a fraction of the bind pose's diagonal.
    pub reduce: Option<f32>,
    /// Factor of all lengths, above 0.
    pub scale: Option<f32>,
    /// The up axis to come out with.
    pub up_axis: Option<UpAxis>,
    /// The handedness to come out with.
    pub handedness: Option<Handedness>,
    /// Which way characters are to face, as formats have it.
    pub front: Option<Front>,
    /// New names of clips: the old one and the new one.
    pub clip_names: Vec<(String, String)>,
    /// New names of bones, by their numbers in the file.
    pub bone_names: Vec<(u32, String)>,
    /// Gives each bone that a clip has no keys for one at rest, without which the books' programs stop.
    pub keys_for_all: bool,
    /// Brings it into the shape that the books' demo shows: right-handed, y up, of a height that is seen, one root as bone 0, children
    /// after their parents, keys for each bone from 0 s on, names of one word and the demo's clip among them.
    pub for_book: bool,
}

impl Edits {
    /// With what the books' programs expect, where nothing else is asked: y up, characters that face as theirs do, right-handed with bones,
    /// keys for each of them.
    #[must_use]
    pub fn in_space_of_the_books(mut self, model: &Model) -> Self {
        // The demo mirrors its character alone.
        let handedness = if model.skeleton.joint_count() > 0 {
            Handedness::Right
        } else {
            Handedness::Left
        };
        self.handedness.get_or_insert(handedness);
        self.up_axis.get_or_insert(UpAxis::Y);
        self.front.get_or_insert(Front::Negative);
        self.keys_for_all = true;
        self
    }
}

/// Makes all edits, in the order that the module's doc names. `names` are those that a person gave to bones.
///
/// # Errors
/// When an edit names what is not there or cannot be made; see [`EditError`].
pub fn apply(model: Model, names: &JointNames, edits: &Edits) -> Result<Edited, EditError> {
    at_once(apply_in(model, names, edits, &Slices::ENDLESS))
}

/// The same, in slices.
///
/// # Errors
/// As [`apply`].
pub async fn apply_in(model: Model, names: &JointNames, edits: &Edits, slices: &Slices) -> Result<Edited, EditError> {
    let mut edited = Edited {
        model,
        names: names.clone(),
        changes: Vec::new(),
    };
    // Each clip whose keys are thinned is a part, and so are all edits before it and all after it.
    let thinned = edits.reduce.map_or(0, |_| edited.model.clips.len());
    slices.pause_at(Stage::Editing, 0, 2 + thinned).await;
    edit_clips(&mut edited, edits)?;
    if let Some(tolerance) = edits.reduce {
        reduce::reduce(&mut edited, tolerance, slices).await?;
    }
    slices.pause_at(Stage::Editing, 1 + thinned, 2 + thinned).await;
    edit_space_and_names(&mut edited, edits)?;
    Ok(edited)
}

/// All edits that come before the thinning of keys.
fn edit_clips(edited: &mut Edited, edits: &Edits) -> Result<(), EditError> {
    if let Some(clips) = &edits.clips {
        choose::choose_clips(edited, clips)?;
    }
    in_place::keep_in_place(edited, &edits.in_place)?;
    if edits.fix {
        fix::fix(edited);
    }
    if let Some(range_secs) = edits.range_secs {
        range::cut(edited, range_secs)?;
    }
    if let Some(secs) = edits.close_loop_secs {
        close_loop::close_loops(edited, secs)?;
    }
    if edits.for_book {
        for_book::check_size(edited)?;
    }
    Ok(())
}

/// All edits that come after it.
fn edit_space_and_names(edited: &mut Edited, edits: &Edits) -> Result<(), EditError> {
    let asked = if edits.for_book {
        edits.clone().in_space_of_the_books(&edited.model)
    } else {
        edits.clone()
    };
    let to = space::Space {
        handedness: asked.handedness,
        up_axis: asked.up_axis,
        front: asked.front,
    };
    space::turn(edited, to);
    let scale = edits
        .scale
        .or_else(|| for_book::scale(&edited.model).filter(|_| edits.for_book));
    if let Some(factor) = scale {
        space::scale(edited, factor)?;
    }
    rename::rename_clips(edited, &edits.clip_names)?;
    rename::rename_bones(edited, &edits.bone_names)?;
    if edits.for_book {
        for_book::shape(edited)?;
    } else if edits.keys_for_all {
        for_book::give_keys(edited, false)?;
    }
    Ok(())
}
