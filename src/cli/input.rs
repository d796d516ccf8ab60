//! From a path to bytes, and from bytes to a model.

use std::path::Path;

use super::failure::Failure;
use crate::session::{self, File, OpenModel};

/// A file's bytes. It is taken for a model whatever its name says, so that a picture is refused for what it is.
pub(super) fn read(path: &Path) -> Result<File, Failure> {
    let bytes = std::fs::read(path).map_err(|reason| Failure::Unreadable {
        path: path.to_owned(),
        reason,
    })?;
    Ok(File::new("model.m3d", bytes))
}

/// A model that can be shown.
pub(super) fn load(path: &Path) -> Result<OpenModel, Failure> {
    session::load(&read(path)?).map_err(|error| Failure::Refused {
        path: path.to_owned(),
        error,
    })
}
