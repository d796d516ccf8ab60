//! What comes out of a file of any format.

use crate::diagnostic::Diagnostic;
use crate::format::Dialect;
use crate::model::Model;

/// What came out of a file.
#[derive(Clone, Debug)]
pub struct Imported {
    /// Spelling of the file.
    pub dialect: Dialect,
    /// The model, in the file's space.
    pub model: Model,
    /// What was mended or is worth knowing, in the order of the file.
    pub diagnostics: Vec<Diagnostic>,
    /// Line of each clip in the file; empty for a format without lines.
    pub clip_lines: Vec<u32>,
}
