//! What went wrong or was mended, as data: severity, stable code, place and words.
//!
//! Every stage speaks of problems with the same [`Diagnostic`], so that the panel, the error card, the command line and
//! the JSON outputs say the same thing.

use std::fmt;

/// A place in a file. Both numbers start at 1; the column counts bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Position {
    /// Line, from 1.
    pub line: u32,
    /// Column in bytes, from 1.
    pub column: u32,
}

impl fmt::Display for Position {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}, column {}", self.line, self.column)
    }
}

/// How bad it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// Worth knowing; the file is fine.
    Note,
    /// Something was mended or left out; the model shows.
    Warning,
    /// The file cannot be shown.
    Error,
}

impl Severity {
    /// The lower-case word that outputs use: `note`, `warning`, `error`.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Note => "note",
            Self::Warning => "warning",
            Self::Error => "error",
        }
    }
}

impl fmt::Display for Severity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.as_str())
    }
}

/// What a finding is about, so that a panel can select it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Subject {
    /// A material, by its index in the file.
    Material(u32),
    /// A subset, by its index in the file.
    Subset(u32),
    /// A vertex, by its index in the file.
    Vertex(u32),
    /// A triangle, by its index in the file.
    Triangle(u32),
    /// A bone, by its number in the file.
    Bone(u32),
    /// A clip, by its index in the file.
    Clip(u32),
}

/// One finding about a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// How bad it is.
    pub severity: Severity,
    /// Stable kebab-case name of this kind of finding, for example `weights-not-normalized`.
    pub code: &'static str,
    /// One sentence for people, without the place.
    pub message: String,
    /// What was expected at the place, when that can be said in a few words.
    pub expected: Option<String>,
    /// What stood there instead.
    pub found: Option<String>,
    /// Where it is in the file, when it is somewhere.
    pub position: Option<Position>,
    /// How many bytes from `position` on are meant; 0 when only the point is known.
    pub length: u32,
    /// The part of the model it is about; the first one when there are several.
    pub subject: Option<Subject>,
    /// How many alike things it tells of, rows of the file or parts of the model; 1 for a single one.
    pub count: u32,
    /// Where the first of them stand, at most [`Diagnostic::MOST_PLACES`]; the first is `position`. Empty without a place.
    pub places: Vec<Position>,
}

impl Diagnostic {
    /// How many of many alike things are given their places.
    pub const MOST_PLACES: usize = 4;

    /// A finding that has no place in a file and is about no part of a model.
    pub(crate) fn without_place(severity: Severity, code: &'static str, message: String) -> Self {
        Self {
            severity,
            code,
            message,
            expected: None,
            found: None,
            position: None,
            length: 0,
            subject: None,
            count: 1,
            places: Vec::new(),
        }
    }
}
