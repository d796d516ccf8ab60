//! A model in the books' format.

use super::{ExportError, Exported, Loss};
use crate::format::Dialect;
use crate::model::{JointNames, Model};

/// Writes a model as a `.m3d` file that the loaders of the books read. `names` are names that a person gave to bones.
///
/// # Errors
/// None yet.
pub fn m3d(model: &Model, names: &JointNames, dialect: Dialect) -> Result<Exported, ExportError> {
    let losses = m3d_losses(model, names, dialect);
    Ok(Exported {
        bytes: Vec::new(),
        losses,
    })
}

/// What such a file does not hold, or holds otherwise.
pub fn m3d_losses(_model: &Model, _names: &JointNames, _dialect: Dialect) -> Vec<Loss> {
    Vec::new()
}
