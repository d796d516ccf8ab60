//! The models that arguments name: files, all of a folder, standard input; and files that are written.

use std::fs::{self, File};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, Once, PoisonError};

use walkdir::WalkDir;

use super::diagnostic::write_diagnostic;
use super::failure::Failure;
use crate::diagnostic::{Diagnostic, codes};
use crate::import;
use crate::session::{self, FileKind};

/// The name of standard input.
const STDIN: &str = "-";

/// The most bytes of a file that are read. No model that a person works with is as large, and no device is read for ever.
const MOST_BYTES: u64 = 1_000_000_000;

/// So many bytes of a text decide whether it is a model. The page looks at as many.
const BEGINNING_LEN: u64 = 64 << 10;

/// The exit code after Ctrl+C, as shells have it.
const INTERRUPTED: i32 = 130;

/// The files that arguments name, in the order of the arguments; of a folder every model below it, by their paths. What cannot be
/// listed is a failure in its place. Links to folders are not followed. A pipe or a device in a folder is told and skipped: opening one
/// could wait for ever.
pub(super) fn models(arguments: &[PathBuf], err: &mut dyn Write) -> io::Result<Vec<Result<PathBuf, Failure>>> {
    let mut models = Vec::new();
    for argument in arguments {
        if !argument.is_dir() {
            models.push(Ok(argument.clone()));
            continue;
        }
        for entry in WalkDir::new(argument).sort_by_file_name() {
            let path = match entry {
                Ok(entry) if entry.file_type().is_dir() || !is_model(entry.path()) => continue,
                Ok(entry) => entry.into_path(),
                Err(error) => {
                    let path = error.path().unwrap_or(argument).to_owned();
                    models.push(Err(unreadable(&path)(error.into())));
                    continue;
                }
            };
            match fs::metadata(&path) {
                // A link to a folder is none of its files.
                Ok(metadata) if metadata.is_dir() => {}
                Ok(metadata) if !metadata.is_file() => write_diagnostic(err, &path, &not_a_file(), None)?,
                // That a link leads nowhere is said when it is read.
                _ => models.push(Ok(path)),
            }
        }
    }
    Ok(models)
}

/// That something has the name of a model or a map, but cannot be read as a file.
pub(super) fn not_a_file() -> Diagnostic {
    codes::NOT_A_FILE.says(codes::NOT_A_FILE.sentence)
}

/// By its name or, of a text, by how it begins.
fn is_model(path: &Path) -> bool {
    match session::File::new(&path.to_string_lossy(), []).kind() {
        Some(FileKind::Text) => path.is_file() && begins_like_model(path),
        kind => kind == Some(FileKind::Model),
    }
}

fn begins_like_model(path: &Path) -> bool {
    let mut beginning = Vec::new();
    let read = File::open(path).and_then(|file| file.take(BEGINNING_LEN).read_to_end(&mut beginning));
    read.is_ok() && import::begins_like_model(&beginning)
}

/// The bytes of a file, or of standard input where the path says `-`.
pub(super) fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    let bytes = match path == Path::new(STDIN) {
        true => read_at_most(io::stdin().lock(), Vec::new()),
        false => read_file(path),
    };
    bytes.map_err(unreadable(path))
}

/// The bytes of a file. One that is too large is refused before it is read; of a pipe no more than that is read.
pub(super) fn read_file(path: &Path) -> io::Result<Vec<u8>> {
    let file = File::open(path)?;
    let len = file.metadata()?.len();
    if len > MOST_BYTES {
        return Err(too_large());
    }
    let mut bytes = Vec::new();
    bytes.try_reserve_exact(len as usize)?;
    read_at_most(file, bytes)
}

fn read_at_most(from: impl Read, mut bytes: Vec<u8>) -> io::Result<Vec<u8>> {
    from.take(MOST_BYTES + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > MOST_BYTES {
        return Err(too_large());
    }
    Ok(bytes)
}

fn too_large() -> io::Error {
    io::Error::new(io::ErrorKind::FileTooLarge, "it is larger than 1 GB")
}

fn unreadable(path: &Path) -> impl FnOnce(io::Error) -> Failure {
    let path = path.to_owned();
    move |reason| Failure::Unreadable { path, reason }
}

/// What is being written: the file beside its place.
static PART: Mutex<Option<PathBuf>> = Mutex::new(None);

/// Refuses to write over a file that is marked as read-only, unless `force` says so.
pub(super) fn check_writable(path: &Path, force: bool) -> Result<(), Failure> {
    let is_read_only = |metadata: fs::Metadata| metadata.is_file() && metadata.permissions().readonly();
    if !force && fs::metadata(path).is_ok_and(is_read_only) {
        return Err(Failure::ReadOnly { path: path.to_owned() });
    }
    Ok(())
}

/// Writes a file whole: beside its place first, then renamed. Nobody reads half of it, and a failure or an interrupt leaves what was
/// there, and nothing beside it.
pub(super) fn write(path: &Path, bytes: &[u8], force: bool) -> Result<(), Failure> {
    check_writable(path, force)?;
    let unwritable = |reason| Failure::Unwritable {
        path: path.to_owned(),
        reason,
    };
    // A link stays one: what it leads to is written.
    let place = path.canonicalize().unwrap_or_else(|_| path.to_owned());
    let (Some(name), false) = (place.file_name(), is_special(&place)) else {
        // A pipe or a device, or nothing that a file can be.
        return fs::write(path, bytes).map_err(unwritable);
    };
    let beside = place.with_file_name(format!(".{}.{}.part", name.to_string_lossy(), std::process::id()));
    remove_part_on_interrupt();
    // An interrupt keeps the lock to the end of the process, so that nothing is made or renamed after it.
    let lock = || PART.lock().unwrap_or_else(PoisonError::into_inner);
    let create = || -> io::Result<File> {
        let mut part = lock();
        *part = Some(beside.clone());
        File::create(&beside)
    };
    let written = create().and_then(|mut file| file.write_all(bytes));
    let mut part = lock();
    *part = None;
    written.and_then(|()| fs::rename(&beside, &place)).map_err(|reason| {
        // It may not be there.
        let _ = fs::remove_file(&beside);
        unwritable(reason)
    })
}

/// Whether a path leads to a pipe, a device or a folder.
pub(super) fn is_special(path: &Path) -> bool {
    path.metadata().is_ok_and(|metadata| !metadata.is_file())
}

/// Lets Ctrl+C, a terminal that closes and a request to end remove what is half written.
fn remove_part_on_interrupt() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        // Where the process was told to ignore such a signal, as by nohup, that stays.
        let _ = ctrlc::try_set_handler(|| {
            let part = PART.lock().unwrap_or_else(PoisonError::into_inner);
            if let Some(part) = &*part {
                let _ = fs::remove_file(part);
            }
            std::process::exit(INTERRUPTED);
        });
    });
}
