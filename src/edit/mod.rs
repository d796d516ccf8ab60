//! Changes to a model before it is written: functions from a [`Model`] to a [`Model`], each in a file of its own.
//!
//! [`apply`] makes all that [`Edits`] ask for, in one order: choose, fix, range, close, reduce, scale and axes, rename, and last what the
//! books' demo needs. Each thing that came out otherwise than it was is a [`Change`]; what changes nothing is none.

mod choose;
mod close_loop;
mod error;
mod fix;
mod for_book;
mod range;
mod reduce;
mod rename;
mod space;

pub use error::EditError;

use crate::model::{Clip, Front, Handedness, JointNames, Model, Track, UpAxis};

/// What to change. The default changes nothing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Edits {
    /// Names of the clips to keep; `None` keeps all.
    pub clips: Option<Vec<String>>,
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
    /// Brings it into the shape that the books' demo shows: right-handed, y up, of a height that is seen, one root as bone 0, children
    /// after their parents, keys for each bone from 0 s on, names of one word and the demo's clip among them.
    pub for_book: bool,
}

/// Something that came out otherwise than it was.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Change {
    /// Stable name of its kind. What check names has check's code.
    pub code: &'static str,
    /// One sentence.
    pub message: String,
}

impl Change {
    fn new(code: &'static str, message: impl Into<String>) -> Self {
        Self {
            code,
            message: message.into(),
        }
    }
}

/// A changed model.
#[derive(Clone, Debug)]
pub struct Edited {
    /// The model.
    pub model: Model,
    /// Names of its bones, by their numbers in the model as it is now.
    pub names: JointNames,
    /// What is otherwise than before, in the order of the edits.
    pub changes: Vec<Change>,
}

/// Makes all edits, in the order that the module's doc names. `names` are those that a person gave to bones.
///
/// # Errors
/// When an edit names what is not there or cannot be made; see [`EditError`].
pub fn apply(model: Model, names: &JointNames, edits: &Edits) -> Result<Edited, EditError> {
    let mut edited = Edited {
        model,
        names: names.clone(),
        changes: Vec::new(),
    };
    if let Some(clips) = &edits.clips {
        choose::choose_clips(&mut edited, clips)?;
    }
    if edits.fix {
        fix::fix(&mut edited);
    }
    if let Some(range_secs) = edits.range_secs {
        range::cut(&mut edited, range_secs)?;
    }
    if let Some(secs) = edits.close_loop_secs {
        close_loop::close_loops(&mut edited, secs)?;
    }
    if let Some(tolerance) = edits.reduce {
        reduce::reduce(&mut edited, tolerance)?;
    }
    if edits.for_book {
        for_book::check_size(&edited.model)?;
    }
    // The demo mirrors its character alone.
    let of_book = if edited.model.skeleton.joint_count() > 0 {
        Handedness::Right
    } else {
        Handedness::Left
    };
    let to = space::Space {
        handedness: edits.handedness.or(edits.for_book.then_some(of_book)),
        up_axis: edits.up_axis.or(edits.for_book.then_some(UpAxis::Y)),
        front: edits.front.or(edits.for_book.then_some(Front::Negative)),
    };
    space::turn(&mut edited, to);
    let scale = edits
        .scale
        .or_else(|| for_book::scale(&edited.model).filter(|_| edits.for_book));
    if let Some(factor) = scale {
        space::scale(&mut edited, factor)?;
    }
    rename::rename_clips(&mut edited, &edits.clip_names)?;
    rename::rename_bones(&mut edited, &edits.bone_names)?;
    if edits.for_book {
        for_book::shape(&mut edited)?;
    }
    Ok(edited)
}

/// The clip with other tracks.
fn with_tracks(clip: &Clip, tracks: Vec<Track>) -> Clip {
    Clip::new(clip.name.clone(), tracks)
}

/// `1 key`, `2 keys`.
fn counted(count: usize, one: &str, many: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { many })
}
