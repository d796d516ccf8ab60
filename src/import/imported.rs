//! What comes out of a file of any format.

use super::source::Source;
use crate::diagnostic::Diagnostic;
use crate::model::Model;

/// Why a file makes no model.
#[derive(Clone, Debug)]
pub struct Refused {
    /// What is wrong. It has a place in the file where there is one.
    pub error: Diagnostic,
    /// What was mended or is worth knowing of the part that was read before.
    pub diagnostics: Vec<Diagnostic>,
}

/// What came out of a file, whatever its format.
#[derive(Clone, Debug)]
pub struct Imported {
    /// The model, in the file's space.
    pub model: Model,
    /// What was mended or is worth knowing, in the order of the file.
    pub diagnostics: Vec<Diagnostic>,
    /// Pictures inside the file, and those beside it that were given, as its materials name them.
    pub pictures: Vec<Picture>,
    /// What only its format knows.
    pub source: Source,
}

/// A picture that came with a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// The name that materials give it, with its extension; unique in the file.
    pub name: String,
    /// Its bytes, as a file of its kind has them.
    pub bytes: bytes::Bytes,
}
