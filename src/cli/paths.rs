//! The models that arguments name: files, all of a folder, standard input.

use std::io::{self, Read};
use std::path::{Path, PathBuf};

use walkdir::WalkDir;

use super::failure::Failure;

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
    path.extension()
        .and_then(|extension| extension.to_str())
        .is_some_and(|extension| {
            ["m3d", "glb", "gltf"]
                .iter()
                .any(|known| extension.eq_ignore_ascii_case(known))
        })
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
