//! Why a file could not be read: where, what was expected, what was found.

use std::fmt;

use super::label::Section;
use super::likeness::Stranger;
use crate::diagnostic::{Code, Diagnostic, Position, codes};

/// A file that could not be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{position}: {kind}")]
pub struct ParseError {
    /// Where the reader stood. At the end of a file: behind its last byte that is not blank.
    pub position: Position,
    /// How many bytes from there on are meant; 0 for a point.
    pub length: u32,
    /// What was wrong.
    pub kind: ParseErrorKind,
}

/// What was wrong. Texts that come from the file are shortened and made printable.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ParseErrorKind {
    /// Nothing but blanks.
    Empty,
    /// Another format, or a relative of this one.
    Stranger(Stranger),
    /// Text that does not begin as an `.m3d` file does.
    NotM3d {
        /// The first word.
        found: String,
    },
    /// The header lacks a count that nothing can be read without.
    CountMissing {
        /// Which one: `Materials`, `Vertices` or `Triangles`.
        count: &'static str,
    },
    /// A section stands where another one belongs.
    WrongSection {
        /// The one that belongs there.
        expected: Section,
        /// The one that is there.
        found: Section,
    },
    /// A number of rows that was announced, and another one that follows.
    RowCount {
        /// What announced it, as the beginning of a sentence: `The header`.
        announcer: String,
        /// What is counted, in the plural.
        rows: &'static str,
        /// What holds them: `the Vertices section`.
        holder: String,
        /// As announced.
        announced: u32,
        /// As found.
        counted: u32,
    },
    /// The file ends too early.
    UnexpectedEnd {
        /// Inside this section.
        section: Section,
        /// What should have come next, with its article.
        expected: String,
    },
    /// A line ends before it has all its values.
    ValueMissing {
        /// The value that should have come next.
        value: Value,
    },
    /// A label of a row is not the one that belongs there.
    WrongLabel {
        /// The label that belongs there, without its colon.
        expected: &'static str,
        /// What is there.
        found: String,
    },
    /// A word where a number belongs.
    NotANumber {
        /// What the number would have been.
        value: Value,
        /// What is there.
        found: String,
    },
    /// No whole number, or one outside of its range.
    NotInRange {
        /// What the number would have been.
        value: Value,
        /// The smallest allowed.
        smallest: i64,
        /// The largest allowed; smaller than `smallest` where none is.
        largest: i64,
        /// What is there.
        found: String,
    },
    /// A material with too few of its lines to be one.
    MaterialIncomplete {
        /// Its number in the file, from 0.
        material: u32,
    },
    /// More bytes of value 0 at the end than there are before them.
    MostlyZeros {
        /// How many there are at the end.
        zeros: usize,
    },
}

/// What a number in the file stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Value {
    /// A count of the header, by its name there.
    Count(&'static str),
    /// A number of a material line, by its label.
    Material(&'static str),
    /// A number of the subset table, by its label.
    Subset(&'static str),
    /// A number of a vertex, by its label.
    Vertex(&'static str),
    /// One of `BlendIndices`.
    BlendIndex,
    /// A corner of a triangle.
    VertexIndex,
    /// One of the sixteen numbers of a bone offset.
    BoneOffset,
    /// The parent of a bone.
    Parent,
    /// `#Keyframes`.
    KeyframeCount,
    /// A number of a key, by its label.
    Keyframe(&'static str),
}

impl Value {
    /// The beginning of a sentence about it.
    fn subject(self) -> String {
        match self {
            Self::Count(name) => format!("The header's count of {name}"),
            Self::Subset(label) => label.into(),
            Self::Material(label) | Self::Vertex(label) | Self::Keyframe(label) => format!("A value of {label}"),
            Self::BlendIndex => "A blend index".into(),
            Self::VertexIndex => "A vertex index".into(),
            Self::BoneOffset => "A value of a bone offset".into(),
            Self::Parent => "A parent index".into(),
            Self::KeyframeCount => "The number of keyframes".into(),
        }
    }

    /// What it is a part of, to be said behind what was expected.
    fn owner(self) -> String {
        match self {
            Self::Material(label) | Self::Subset(label) | Self::Vertex(label) | Self::Keyframe(label) => {
                format!(" of {label}")
            }
            Self::BoneOffset => " of a bone offset".into(),
            Self::Count(name) => format!(" of {name}"),
            Self::BlendIndex | Self::VertexIndex | Self::Parent | Self::KeyframeCount => String::new(),
        }
    }

    /// What belongs in its place, in a few words.
    pub(super) fn expected(self) -> &'static str {
        match self {
            Self::Count(_) => "a count",
            Self::Material(_) | Self::Vertex(_) | Self::BoneOffset | Self::Keyframe(_) => "a number",
            Self::Subset(_) => "a whole number",
            Self::BlendIndex => "a bone index",
            Self::VertexIndex => "a vertex index",
            Self::Parent => "a parent index",
            Self::KeyframeCount => "a number of keyframes",
        }
    }
}

impl ParseErrorKind {
    /// The row of the table of codes.
    pub fn code(&self) -> &'static Code {
        match self {
            Self::Empty => &codes::EMPTY_FILE,
            Self::Stranger(stranger) if stranger.is_relative() => &codes::RELATIVE_FORMAT,
            Self::Stranger(_) => &codes::OTHER_FORMAT,
            Self::NotM3d { .. } => &codes::NOT_M3D,
            Self::CountMissing { .. } => &codes::COUNT_MISSING,
            Self::WrongSection { .. } => &codes::WRONG_SECTION,
            Self::RowCount { .. } => &codes::ROW_COUNT,
            Self::UnexpectedEnd { .. } => &codes::UNEXPECTED_END,
            Self::ValueMissing { .. } => &codes::VALUE_MISSING,
            Self::WrongLabel { .. } => &codes::WRONG_LABEL,
            Self::NotANumber { .. } => &codes::NOT_A_NUMBER,
            Self::NotInRange { .. } => &codes::NOT_IN_RANGE,
            Self::MaterialIncomplete { .. } => &codes::MATERIAL_INCOMPLETE,
            Self::MostlyZeros { .. } => &codes::MOSTLY_ZEROS,
        }
    }

    /// What was expected, in a few words: `a bone index`.
    pub fn expected(&self) -> Option<String> {
        match self {
            Self::Empty | Self::Stranger(_) | Self::NotM3d { .. } => Some("an m3d file header".into()),
            Self::CountMissing { count } => Some(format!("#{count}")),
            Self::WrongSection { expected, .. } => Some(format!("the {} section", expected.name())),
            Self::RowCount { rows, announced, .. } => Some(counted_rows(*announced, rows)),
            Self::UnexpectedEnd { expected, .. } => Some(expected.clone()),
            Self::ValueMissing { value } | Self::NotANumber { value, .. } | Self::NotInRange { value, .. } => {
                Some(value.expected().into())
            }
            Self::WrongLabel { expected, .. } => Some((*expected).into()),
            Self::MaterialIncomplete { .. } => Some("the lines of a material".into()),
            Self::MostlyZeros { .. } => Some("the end of the file".into()),
        }
    }

    /// What was found instead, where that is a piece of the file or a number.
    pub fn found(&self) -> Option<String> {
        match self {
            Self::NotM3d { found }
            | Self::WrongLabel { found, .. }
            | Self::NotANumber { found, .. }
            | Self::NotInRange { found, .. } => Some(found.clone()),
            Self::Stranger(stranger) => Some(stranger.name().into()),
            Self::WrongSection { found, .. } => Some(format!("the {} section", found.name())),
            Self::RowCount { rows, counted, .. } => Some(counted_rows(*counted, rows)),
            Self::UnexpectedEnd { .. } => Some("the end of the file".into()),
            Self::ValueMissing { .. } => Some("the end of the line".into()),
            Self::MostlyZeros { zeros } => Some(format!("{zeros} bytes of value 0")),
            Self::Empty | Self::CountMissing { .. } | Self::MaterialIncomplete { .. } => None,
        }
    }
}

impl fmt::Display for ParseErrorKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty | Self::MaterialIncomplete { .. } => f.write_str(self.code().sentence),
            Self::Stranger(stranger) => write!(f, "{stranger}"),
            Self::NotM3d { found } => {
                write!(
                    f,
                    "This is not an .m3d file: it begins with \"{found}\" instead of an m3d-File-Header."
                )
            }
            Self::CountMissing { count } => write!(f, "The header does not say how many {count} there are."),
            Self::WrongSection { expected, found } => {
                write!(
                    f,
                    "The {} section must come here, but the {} section was found.",
                    expected.name(),
                    found.name()
                )
            }
            Self::RowCount {
                announcer,
                rows,
                holder,
                announced,
                counted,
            } => {
                let announced = counted_rows(*announced, rows);
                write!(f, "{announcer} announces {announced}, but {holder} holds {counted}.")
            }
            Self::UnexpectedEnd { section, expected } => {
                write!(
                    f,
                    "The file ends inside the {} section, where {expected} was expected.",
                    section.name()
                )
            }
            Self::ValueMissing { value } => {
                write!(
                    f,
                    "The line ends where {}{} was expected.",
                    value.expected(),
                    value.owner()
                )
            }
            Self::WrongLabel { expected, found } => write!(f, "{expected} must come here, but \"{found}\" was found."),
            Self::NotANumber { value, found } => {
                write!(f, "{} must be a number, but \"{found}\" was found.", value.subject())
            }
            Self::NotInRange {
                value,
                smallest,
                largest,
                found,
            } if largest < smallest => {
                write!(
                    f,
                    "{} has nothing to point at here, but \"{found}\" was found.",
                    value.subject()
                )
            }
            // A bound that is only what fits would explain nothing.
            Self::NotInRange {
                value,
                smallest,
                largest,
                found,
            } if *largest == i64::from(u32::MAX) => write!(
                f,
                "{} must be a whole number, {smallest} or more, but \"{found}\" was found.",
                value.subject()
            ),
            Self::NotInRange {
                value,
                smallest,
                largest,
                found,
            } => write!(
                f,
                "{} must be a whole number from {smallest} to {largest}, but \"{found}\" was found.",
                value.subject()
            ),
            Self::MostlyZeros { zeros } => write!(
                f,
                "The file ends in {zeros} bytes of value 0, more than stand before them: it was not written or copied whole."
            ),
        }
    }
}

/// `1 vertex`, `2 vertices`.
fn counted_rows(count: u32, rows: &str) -> String {
    match rows {
        _ if count != 1 => format!("{count} {rows}"),
        "vertices" => "1 vertex".into(),
        _ => format!("1 {}", rows.strip_suffix('s').unwrap_or(rows)),
    }
}

impl ParseError {
    /// The same, as every stage speaks of problems.
    pub fn diagnostic(&self) -> Diagnostic {
        Diagnostic {
            expected: self.kind.expected(),
            found: self.kind.found(),
            position: Some(self.position),
            places: vec![self.position],
            length: self.length,
            ..self.kind.code().says(self.kind.to_string())
        }
    }
}

/// `text` as a message may quote it: printable, and no longer than a glance.
pub(super) fn quoted(text: &[u8]) -> String {
    /// Characters of a quote.
    const LONGEST: usize = 32;
    // A character has up to four bytes; what is cut is marked below.
    let start = text.get(..4 * LONGEST).unwrap_or(text);
    let decoded = String::from_utf8_lossy(start);
    let mut quote: String = decoded
        .chars()
        .take(LONGEST)
        .map(|character| {
            if character.is_control() {
                char::REPLACEMENT_CHARACTER
            } else {
                character
            }
        })
        .collect();
    if start.len() < text.len() || decoded.chars().nth(LONGEST).is_some() {
        quote.push('…');
    }
    quote
}
