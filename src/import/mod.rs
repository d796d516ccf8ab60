//! Files of other programs become models: one file here for each format, all with the same result.

mod m3d;

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
}

/// Whether a file begins as one of the formats does, whatever its name.
///
/// A quick look. What it accepts [`import`] may still refuse.
pub fn begins_like_model(bytes: &[u8]) -> bool {
    m3d::begins_like_model(bytes)
}

/// Reads a model.
///
/// # Errors
/// When the bytes are of no format that is known here, or what they say makes no model. The diagnostic has a place in the file
/// where there is one.
pub fn import(bytes: &[u8]) -> Result<Imported, Box<Diagnostic>> {
    m3d::import(bytes)
}
