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

/// Adds the pictures of a folder and of the folders in it.
pub(super) fn read_pictures(folder: &Path, files: &mut Vec<File>) -> Result<(), Failure> {
    let unreadable = |path: &Path| {
        let path = path.to_owned();
        move |reason| Failure::Unreadable { path, reason }
    };
    let mut entries = std::fs::read_dir(folder)
        .and_then(Iterator::collect::<Result<Vec<_>, _>>)
        .map_err(unreadable(folder))?;
    // The order of a folder differs between systems; which of two pictures is taken should not.
    entries.sort_by_key(std::fs::DirEntry::file_name);
    for entry in entries {
        let path = entry.path();
        let kind = entry.file_type().map_err(unreadable(&path))?;
        if kind.is_dir() {
            read_pictures(&path, files)?;
        } else if File::new(&path.to_string_lossy(), []).is_image() {
            let bytes = std::fs::read(&path).map_err(unreadable(&path))?;
            files.push(File::new(&path.to_string_lossy(), bytes));
        }
    }
    Ok(())
}

/// A model that can be shown.
pub(super) fn load(path: &Path) -> Result<OpenModel, Failure> {
    session::load(&read(path)?).map_err(|error| Failure::Refused {
        path: path.to_owned(),
        error,
    })
}
