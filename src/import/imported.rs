//! What comes out of a file of any format.

use crate::diagnostic::Diagnostic;
use crate::format::{Dialect, LineMap};
use crate::model::Model;

/// Why a file makes no model.
#[derive(Clone, Debug)]
pub struct Refused {
    /// What is wrong. It has a place in the file where there is one.
    pub error: Diagnostic,
    /// What was mended or is worth knowing of the part that was read before.
    pub diagnostics: Vec<Diagnostic>,
}

/// What came out of a file.
#[derive(Clone, Debug)]
pub struct Imported {
    /// Spelling of the file.
    pub dialect: Dialect,
    /// The model, in the file's space.
    pub model: Model,
    /// What was mended or is worth knowing, in the order of the file.
    pub diagnostics: Vec<Diagnostic>,
    /// Where its parts stand in the file; empty for a format without lines.
    pub lines: LineMap,
}
