//! A model in the books' format.

mod document;
mod look;
mod losses;

use super::{ExportError, Exported, MapImages};
use crate::format::{self, Dialect};
use crate::model::{JointNames, Model};
use crate::slices::{Slices, at_once};
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
    let looks = looks(model, &MapImages::default());
    at_once(m3d_in(model, names, dialect, &looks, &Slices::ENDLESS))
}

/// The same file, of materials that look so, in slices.
///
/// # Errors
/// As [`m3d`].
pub async fn m3d_in(
    model: &Model,
    names: &JointNames,
    dialect: Dialect,
    looks: &[Look],
    slices: &Slices,
) -> Result<Exported, ExportError> {
    let losses = m3d_losses(model, names, dialect);
    let document = document(model, dialect, looks);
    Ok(Exported {
        losses,
        bytes: format::write_in(&document, slices).await.into_bytes(),
    })
}
