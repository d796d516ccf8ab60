//! What comes out of edits.

pub(super) use crate::diagnostic::collect::counted;
use crate::model::{Clip, JointNames, Model, Track};

/// Something that came out otherwise than it was.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Change {
    /// Stable name of its kind. What check names has check's code.
    pub code: &'static str,
    /// One sentence.
    pub message: String,
}

impl Change {
    pub(super) fn new(code: &'static str, message: impl Into<String>) -> Self {
        Self {
            code,
            message: message.into(),
        }
    }

    /// A change of so many parts, unless it is none: what one of them or several do, and what that means.
    pub(crate) fn counted(code: &'static str, count: usize, [one, many]: [&str; 2], rest: &str) -> Option<Self> {
        (count > 0).then(|| Self::new(code, format!("{} {rest}", counted(count, one, many))))
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

pub(super) fn with_tracks(clip: &Clip, tracks: Vec<Track>) -> Clip {
    Clip::new(clip.name.clone(), tracks)
}
