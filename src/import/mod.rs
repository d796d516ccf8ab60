//! Files of other programs become models: one module here for each format, all with the same result.
//!
//! A format decides what its files mean, mends what can be mended and notes it with its place; what has no place is
//! [`Model`](crate::model::Model)'s to prove. Normals and tangents are computed for any format.

mod error;
mod imported;
pub mod m3d;
mod normals;
mod tangents;

pub use error::{ImportError, ImportErrorKind};
pub use imported::{Imported, Refused};

/// Whether a file begins as one of the formats does, whatever its name.
///
/// A quick look. What it accepts [`import`] may still refuse.
pub fn begins_like_model(bytes: &[u8]) -> bool {
    m3d::begins_like_model(bytes)
}

/// Reads a model.
///
/// # Errors
/// When the bytes are of no format that is known here, or what they say makes no model.
pub fn import(bytes: &[u8]) -> Result<Imported, Box<Refused>> {
    m3d::import(bytes)
}
