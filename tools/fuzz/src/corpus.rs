//! The inputs that a fuzzer found worth keeping: an archive for each target, since they are many and small.

use std::fs::{self, File};
use std::io::{self, Read as _, Write as _};
use std::path::{Path, PathBuf};

use zip::write::SimpleFileOptions;
use zip::{ZipArchive, ZipWriter};

fn archive(target: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus");
    folder.join(target).with_extension("zip")
}

/// The inputs of a target and their names.
///
/// # Errors
/// When its archive is not there or cannot be read.
pub fn inputs(target: &str) -> io::Result<Vec<(String, Vec<u8>)>> {
    let mut archive = ZipArchive::new(File::open(archive(target))?)?;
    let mut inputs = Vec::new();
    for index in 0..archive.len() {
        let mut entry = archive.by_index(index)?;
        let mut bytes = Vec::new();
        entry.read_to_end(&mut bytes)?;
        inputs.push((entry.name()?.into_owned(), bytes));
    }
    Ok(inputs)
}

/// Writes the inputs of a target into a folder.
///
/// # Errors
/// As [`inputs`], and when a file cannot be written.
pub fn unpack(target: &str, folder: &Path) -> io::Result<()> {
    inputs(target)?
        .into_iter()
        .try_for_each(|(name, bytes)| fs::write(folder.join(name), bytes))
}

/// Longer inputs are mostly copies of a fixture with a few bytes changed: they are not kept, since the checks run the fixtures too.
const MOST_KEPT_BYTES: u64 = 2048;

/// Keeps the files of a folder as the inputs of a target, in the order of their names and without their times, so that equal inputs
/// make equal archives.
///
/// # Errors
/// When a file cannot be read, or the archive cannot be written.
pub fn pack(target: &str, folder: &Path) -> io::Result<()> {
    let entries: io::Result<Vec<_>> = fs::read_dir(folder)?.collect();
    let mut paths: Vec<_> = entries?.into_iter().map(|entry| entry.path()).collect();
    paths.sort();
    let mut archive = ZipWriter::new(File::create(archive(target))?);
    for path in paths {
        if fs::metadata(&path)?.len() > MOST_KEPT_BYTES {
            continue;
        }
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        archive.start_file(name, SimpleFileOptions::default())?;
        archive.write_all(&fs::read(&path)?)?;
    }
    archive.finish()?;
    Ok(())
}
