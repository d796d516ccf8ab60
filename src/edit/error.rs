//! Why an edit cannot be made.

use crate::diagnostic::Fault;
use crate::model::Clip;

/// An edit that asks for what is not there, or that would come to no sound model.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum EditError {
    /// A clip that is not there.
    #[error("There is no clip \"{asked}\"; {}.", listed(.known))]
    UnknownClip {
        /// Its name.
        asked: String,
        /// Names that are there.
        known: Vec<String>,
    },
    /// Something else that is not there or makes no sense, as a sentence.
    #[error("{0}")]
    Refused(String),
    /// More bones or vertices than the books' demo holds, as sentences.
    #[error("{0}")]
    TooLarge(String),
    /// Numbers that overflow: which, as a sentence.
    #[error("Numbers of the model overflow when it is changed so: {0}")]
    Overflows(String),
}

impl EditError {
    pub(super) fn no_clip(asked: &str, clips: &[Clip]) -> Self {
        Self::UnknownClip {
            asked: asked.to_owned(),
            known: clips.iter().map(|clip| clip.name.clone()).collect(),
        }
    }
}

impl From<Fault> for EditError {
    /// Of what was sound only numbers that grew are not.
    fn from(fault: Fault) -> Self {
        Self::Overflows(fault.to_string())
    }
}

/// `it has "Walk", "Run"`.
fn listed(clips: &[String]) -> String {
    if clips.is_empty() {
        return "the model has none".into();
    }
    let quoted: Vec<String> = clips.iter().map(|name| format!("\"{name}\"")).collect();
    format!("it has {}", quoted.join(", "))
}
