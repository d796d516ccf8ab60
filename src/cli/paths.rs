//! The models that arguments name: files, all of a folder, standard input; and files that are written.

use std::io::{self, Read};
use std::path::{Path, PathBuf};

use walkdir::WalkDir;

use super::failure::Failure;
use crate::session::{File, FileKind};

/// The name of standard input.
const STDIN: &str = "-";

/// The files that arguments name, in the order of the arguments; of a folder every model below it, by their paths. What cannot be
/// listed is a failure in its place. Links to folders are not followed.
pub(super) fn models(arguments: &[PathBuf]) -> Vec<Result<PathBuf, Failure>> {
    let mut models = Vec::new();
    for argument in arguments {
        if !argument.is_dir() {
            models.push(Ok(argument.clone()));
            continue;
        }
        for entry in WalkDir::new(argument).sort_by_file_name() {
            match entry {
                Ok(entry) if entry.file_type().is_dir() || !is_model(entry.path()) => {}
                Ok(entry) => models.push(Ok(entry.into_path())),
                Err(error) => models.push(Err(Failure::Unreadable {
                    path: error.path().unwrap_or(argument).to_owned(),
                    reason: error.into(),
                })),
            }
        }
    }
    models
}

fn is_model(path: &Path) -> bool {
    File::new(&path.to_string_lossy(), []).kind() == Some(FileKind::Model)
}

/// The bytes of a file, or of standard input where the path says `-`.
pub(super) fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    let bytes = if path == Path::new(STDIN) {
        let mut bytes = Vec::new();
        io::stdin().lock().read_to_end(&mut bytes).map(|_| bytes)
    } else {
        std::fs::read(path)
    };
    bytes.map_err(|reason| Failure::Unreadable {
        path: path.to_owned(),
        reason,
    })
}

/// Writes a file whole: beside its place first, then renamed. Nobody reads half of it, and a failure leaves what was there.
pub(super) fn write(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    let unwritable = |reason| Failure::Unwritable {
        path: path.to_owned(),
        reason,
    };
    // A link stays one: what it leads to is written.
    let place = path.canonicalize().unwrap_or_else(|_| path.to_owned());
    let is_special = place.metadata().is_ok_and(|metadata| !metadata.is_file());
    let (Some(name), false) = (place.file_name(), is_special) else {
        // A pipe or a device, or nothing that a file can be.
        return std::fs::write(path, bytes).map_err(unwritable);
    };
    let beside = place.with_file_name(format!(".{}.{}.part", name.to_string_lossy(), std::process::id()));
    let written = std::fs::write(&beside, bytes).and_then(|()| std::fs::rename(&beside, &place));
    written.map_err(|reason| {
        // It may not be there.
        let _ = std::fs::remove_file(&beside);
        unwritable(reason)
    })
}
