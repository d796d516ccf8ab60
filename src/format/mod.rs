//! The `.m3d` text format.

mod document;

pub use document::*;

use crate::diagnostic::Diagnostic;

/// A file that was understood.
#[derive(Clone, Debug, PartialEq)]
pub struct Parsed {
    /// What it says.
    pub document: Document,
    /// Where it says it.
    pub lines: LineMap,
    /// What was mended or is worth knowing, in the order of the file.
    pub notices: Vec<Diagnostic>,
}
