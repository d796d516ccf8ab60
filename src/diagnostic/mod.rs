//! What went wrong or was mended, as data: severity, stable code, place and words.
//!
//! Every stage speaks of problems with the same [`Diagnostic`], so that the panel, the error card, the command line and
//! the JSON outputs say the same thing. [`codes`] is the table of all codes.

pub mod codes;
pub(crate) mod collect;
pub mod limits;
pub mod of_export;
mod places;

use std::fmt;

pub use places::{Entry, Places};

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

/// The part of a file that a diagnostic is about, so that a panel can select it.
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
    /// A map that a material names, by its index among all that materials name, in their order, the diffuse map first.
    Map(u32),
}

impl Subject {
    /// The word that outputs use, and the index.
    pub fn kind_and_index(self) -> (&'static str, u32) {
        match self {
            Self::Material(index) => ("material", index),
            Self::Subset(index) => ("subset", index),
            Self::Vertex(index) => ("vertex", index),
            Self::Triangle(index) => ("triangle", index),
            Self::Bone(index) => ("bone", index),
            Self::Clip(index) => ("clip", index),
            Self::Map(index) => ("map", index),
        }
    }
}

/// When in a clip something is, and on which bone, as far as that is known.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Moment {
    /// Seconds of the clip's own time.
    pub time_secs: Option<f32>,
    /// The bone, by its number in the file.
    pub bone: Option<u32>,
}

impl Moment {
    /// A bone, at any time.
    pub(crate) fn of_bone(bone: u32) -> Self {
        Self {
            time_secs: None,
            bone: Some(bone),
        }
    }

    /// A bone at a time.
    pub(crate) fn new(time_secs: f32, bone: u32) -> Self {
        Self {
            time_secs: Some(time_secs),
            bone: Some(bone),
        }
    }
}

/// What stops a stage. It is boxed, so that results stay small.
pub type Fault = Box<Diagnostic>;

/// One thing that is worth telling about a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnostic {
    /// How bad it is.
    pub severity: Severity,
    /// Name of its [`Code`], for example `weights-not-normalized`.
    pub code: &'static str,
    /// One sentence for people, without the place.
    pub message: String,
    /// What was expected at `position`, when that can be said in a few words.
    pub expected: Option<String>,
    /// What stood there instead.
    pub found: Option<String>,
    /// Where it is in the file, when it is somewhere.
    pub position: Option<Position>,
    /// How many bytes from `position` on are meant; 0 when only the point is known.
    pub length: u32,
    /// What of a JSON document it is about, as RFC 6901 points at it: `/meshes/0/primitives/1`.
    pub pointer: Option<String>,
    /// Where it is in a binary file, in bytes from its start.
    pub byte_offset: Option<u64>,
    /// The part of the model it is about; the first one when there are several.
    pub subject: Option<Subject>,
    /// How many occurrences it stands for, rows of the file or parts of the model; 1 for a single one.
    pub count: u32,
    /// Positions of the first occurrences, at most [`Diagnostic::MOST_PLACES`]; the first is `position`. Empty without a
    /// place.
    pub places: Vec<Position>,
    /// Parts of the model that the first occurrences are about, at most [`Diagnostic::MOST_PLACES`]; the first is `subject`.
    pub subjects: Vec<Subject>,
    /// Of a finding about clips: when the first occurrences are, and on which bones, at most [`Diagnostic::MOST_PLACES`].
    pub moments: Vec<Moment>,
}

impl Diagnostic {
    /// How many occurrences have their positions listed.
    pub const MOST_PLACES: usize = 20;
    /// How many of these JSON names.
    const FEW_PLACES: usize = 4;

    /// The positions that JSON names.
    pub fn few_places(&self) -> &[Position] {
        &self.places[..self.places.len().min(Self::FEW_PLACES)]
    }

    /// What follows the file's name where a line of text says the place: `:3:14`, `#/meshes/0` or `@20`; empty for the whole file.
    pub fn place_in_file(&self) -> String {
        match (self.position, &self.pointer, self.byte_offset) {
            (Some(at), ..) => format!(":{}:{}", at.line, at.column),
            (None, Some(pointer), _) => format!("#{pointer}"),
            (None, None, Some(offset)) => format!("@{offset}"),
            (None, None, None) => String::new(),
        }
    }

    /// The same at a place in a JSON document.
    #[must_use]
    pub(crate) fn pointing_at(self, pointer: impl Into<String>) -> Self {
        Self {
            pointer: Some(pointer.into()),
            ..self
        }
    }

    /// The same at a place; `length` bytes from there on are meant.
    #[must_use]
    pub(crate) fn at(self, position: Position, length: u32) -> Self {
        Self {
            position: Some(position),
            places: vec![position],
            length,
            ..self
        }
    }

    /// The same at the start of a line, where there is one.
    #[must_use]
    pub(crate) fn on_line(self, line: Option<u32>) -> Self {
        match line {
            Some(line) => self.at(Position { line, column: 1 }, 0),
            None => self,
        }
    }

    #[must_use]
    pub(crate) fn about(self, subject: Subject) -> Self {
        Self {
            subject: Some(subject),
            ..self
        }
    }

    #[must_use]
    pub(crate) fn expected(self, expected: impl Into<String>) -> Self {
        Self {
            expected: Some(expected.into()),
            ..self
        }
    }

    #[must_use]
    pub(crate) fn found(self, found: impl Into<String>) -> Self {
        Self {
            found: Some(found.into()),
            ..self
        }
    }

    /// When and on which bone the first occurrence is, as far as that is known.
    pub fn moment(&self) -> Moment {
        self.moments.first().copied().unwrap_or_default()
    }

    /// Part, position and moment of each occurrence that is known, as far as it has them.
    pub fn occurrences(&self) -> impl ExactSizeIterator<Item = (Option<Subject>, Option<Position>, Moment)> {
        let (subjects, places, moments) = (&self.subjects, &self.places, &self.moments);
        // Rows of one part share that part. Parts of which only some have a line cannot be told which.
        let (one_part, are_pairs) = (subjects.len() <= 1, subjects.len() == places.len());
        (0..subjects.len().max(places.len()).max(moments.len())).map(move |index| {
            let subject = if one_part {
                self.subject
            } else {
                subjects.get(index).copied()
            };
            let place = places.get(index).filter(|_| one_part || are_pairs);
            (subject, place.copied(), moments.get(index).copied().unwrap_or_default())
        })
    }
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(position) = self.position {
            write!(f, "{position}: ")?;
        }
        f.write_str(&self.message)
    }
}

impl std::error::Error for Diagnostic {}

/// One kind of diagnostic: a row of the table [`codes`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Code {
    /// Stable kebab-case name, unique in the table.
    pub name: &'static str,
    /// How bad it usually is; the place that gives the diagnostic may raise or lower it.
    pub severity: Severity,
    /// What is the case, and what was done about it, for one occurrence without its details.
    pub sentence: &'static str,
    /// What it means for the model, or where it may come from.
    pub explanation: &'static str,
    /// What Bindpose does about it.
    pub handling: &'static str,
    /// How to mend it for good: in the exporter, where a file is at fault.
    pub mending: &'static str,
    /// Whether it is mended here, so that an export is without it.
    pub mended: Mended,
}

/// Whether Bindpose mends what a code names, and when. The file itself is never changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mended {
    /// It is not mended.
    No,
    /// On reading: every export is without it.
    OnReading,
    /// On writing, with `--fix`.
    WithFix,
    /// On writing what the books' demo is to show.
    ForBook,
}

impl Code {
    /// What it means and how to mend it, for outputs that have one text for both.
    pub fn help(&self) -> String {
        format!("{} {}", self.explanation, self.mending)
    }

    /// How to keep what is mended, or can be; `None` where nothing is.
    pub fn permanent(&self) -> Option<&'static str> {
        match self.mended {
            Mended::No => None,
            Mended::OnReading => {
                Some("The file itself is unchanged. Export, or `bindpose convert IN OUT`, writes it mended.")
            }
            Mended::WithFix => Some("The file itself is unchanged. `bindpose convert IN OUT --fix` writes it mended."),
            Mended::ForBook => Some(
                "The file itself is unchanged. Export for the book's demo, or `bindpose convert IN OUT.m3d --for-book`, writes it mended.",
            ),
        }
    }

    /// A diagnostic of this code with its usual severity, without a place and without a subject.
    pub(crate) fn says(&self, message: impl Into<String>) -> Diagnostic {
        Diagnostic {
            severity: self.severity,
            code: self.name,
            message: message.into(),
            expected: None,
            found: None,
            position: None,
            length: 0,
            pointer: None,
            byte_offset: None,
            subject: None,
            count: 1,
            places: Vec::new(),
            subjects: Vec::new(),
            moments: Vec::new(),
        }
    }
}
