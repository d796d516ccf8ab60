//! Why an edit cannot be made.

use crate::model::ModelError;

/// An edit that asks for what is not there, or that would come to no sound model.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
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
    /// A range of more or less than one clip.
    #[error("A range is of one clip, and there are {clips}; choose one.")]
    RangeNeedsOneClip {
        /// How many clips there are.
        clips: usize,
    },
    /// A range that is none, or not inside the clip.
    #[error(
        "The range from {from} s to {to} s is not inside \"{clip}\", which goes from {start_secs} s to {end_secs} s."
    )]
    RangeOutside {
        /// The clip.
        clip: String,
        /// Start of the range.
        from: f32,
        /// End of the range.
        to: f32,
        /// Start of the clip.
        start_secs: f32,
        /// End of the clip.
        end_secs: f32,
    },
    /// A loop that is to be closed over more than the clip, or over no time.
    #[error("\"{clip}\" is {duration_secs} s long; its end cannot be eased over {secs} s.")]
    LoopTooShort {
        /// The clip.
        clip: String,
        /// Its length.
        duration_secs: f32,
        /// Seconds that were asked for.
        secs: f32,
    },
    /// A number that makes no sense for what it is.
    #[error("{what} cannot be {value}.")]
    Nonsense {
        /// What it is for, as the beginning of a sentence.
        what: &'static str,
        /// The number.
        value: f32,
    },
    /// Two clips would have one name, or one would have none.
    #[error("A clip cannot be named \"{name}\": {}.", if name.is_empty() { "that is no name" } else { "another one is" })]
    ClipName {
        /// The name.
        name: String,
    },
    /// A bone that is not there.
    #[error("There is no bone {bone}; there are {bone_count}.")]
    UnknownBone {
        /// Its number.
        bone: u32,
        /// Number of bones.
        bone_count: usize,
    },
    /// More bones than the books' shaders hold.
    #[error("The model has {bones} bones{}; the books' demo has room for {most}.", if *added { " with the root that all hang from" } else { "" })]
    TooManyBones {
        /// How many.
        bones: usize,
        /// Whether a root is among them that the model lacks.
        added: bool,
        /// How many there may be.
        most: usize,
    },
    /// More vertices than the books' indices can number.
    #[error("The model has {vertices} vertices; the books' demo can number {most}.")]
    TooManyVertices {
        /// How many.
        vertices: usize,
        /// How many there may be.
        most: usize,
    },
    /// More of something than the books' demo holds.
    #[error("{}", .why.iter().map(ToString::to_string).collect::<Vec<_>>().join(" "))]
    TooLarge {
        /// Each limit that does not hold.
        why: Vec<Self>,
    },
    /// Numbers that overflow.
    #[error("Numbers of the model overflow when it is changed so: {what}")]
    Overflows {
        /// Which, as a sentence.
        what: String,
    },
    /// A tolerance of reduced keys that is none, or leaves nothing of a motion.
    #[error(
        "The tolerance of reduced keys cannot be {tolerance}: it is a part of the model's size, above 0 and at most {most}."
    )]
    Tolerance {
        /// What was asked for.
        tolerance: f32,
        /// What may be asked for.
        most: f32,
    },
}

impl From<ModelError> for EditError {
    /// Of what was sound only numbers that grew are not.
    fn from(error: ModelError) -> Self {
        let what = error.to_string();
        Self::Overflows { what }
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
