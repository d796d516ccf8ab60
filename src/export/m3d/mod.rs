//! A model in the books' format.

mod document;
mod look;
mod losses;

use super::{ExportError, Exported, MapImages};
use crate::format::{self, Dialect};
use crate::model::{JointNames, Model};
use document::document;

pub use look::{Bake, Look, looks};
pub use losses::m3d_losses;

/// Writes a model as a `.m3d` file that the loaders of the books read, in the model's own space. `names` are names that a person gave
/// to bones.
///
/// Numbers are as short as they can be and still read back exactly. A file that was read, written and read again is the same model,
/// where each subset has a material of its own and all names are single words.
///
/// # Errors
/// None at present.
pub fn m3d(model: &Model, names: &JointNames, dialect: Dialect) -> Result<Exported, ExportError> {
    m3d_with(model, names, dialect, &looks(model, &MapImages::default()))
}

/// The same file, of materials that look so.
///
/// # Errors
/// As [`m3d`].
pub fn m3d_with(model: &Model, names: &JointNames, dialect: Dialect, looks: &[Look]) -> Result<Exported, ExportError> {
    Ok(Exported {
        losses: m3d_losses(model, names, dialect),
        bytes: format::write(&document(model, dialect, looks)).into_bytes(),
    })
}
