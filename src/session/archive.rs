//! A `.zip` among dropped files: the files in it take its place, as if its folder had been dropped.

use std::io::{Cursor, Read as _};

use zip::ZipArchive;
use zip::result::ZipError;

use super::files::File;

/// The files of an archive may have so many bytes together: more than models with all their textures have, and little enough for a page.
const MOST_BYTES: u64 = 1 << 29;

/// Whether a file is an archive, by its name and its first bytes.
pub(super) fn is_archive(file: &File) -> bool {
    file.extension() == "zip" && (file.bytes.starts_with(b"PK\x03\x04") || file.bytes.starts_with(b"PK\x05\x06"))
}

/// The files in an archive, in its order; their paths begin with the archive's folder. What systems hide in archives is left out.
///
/// # Errors
/// In words, when a file in it cannot be unpacked, when there is none, or when they have too many bytes together.
pub(super) fn unpack(archive: &File) -> Result<Vec<File>, String> {
    unpack_within(archive, MOST_BYTES)
}

fn unpack_within(archive: &File, most_bytes: u64) -> Result<Vec<File>, String> {
    let mut entries =
        ZipArchive::new(Cursor::new(&archive.bytes[..])).map_err(|error| format!("it {}", fault(&error)))?;
    let folder = archive.path.strip_suffix(archive.base_name()).unwrap_or_default();
    let mut files = Vec::new();
    let mut bytes_left = most_bytes;
    for index in 0..entries.len() {
        let name = match entries.name_for_index(index) {
            Some(Ok(name)) => name.into_owned(),
            _ => return Err(format!("the name of file {} in it cannot be read", index + 1)),
        };
        if is_hidden(&name) || name.ends_with(['/', '\\']) {
            continue;
        }
        let mut bytes = Vec::new();
        let read = match entries.by_index(index) {
            Ok(entry) => entry
                .take(bytes_left + 1)
                .read_to_end(&mut bytes)
                .map_err(ZipError::from),
            Err(error) => Err(error),
        };
        read.map_err(|error| format!("{name} in it {}", fault(&error)))?;
        bytes_left = bytes_left
            .checked_sub(bytes.len() as u64)
            .ok_or_else(|| format!("its files have more than {} MiB together", most_bytes >> 20))?;
        files.push(File::new(&format!("{folder}{name}"), bytes));
    }
    if files.is_empty() {
        return Err("there is no file in it".to_owned());
    }
    Ok(files)
}

/// Whether a part of a path is of the kind that systems keep for themselves: `__MACOSX/`, `.DS_Store`.
fn is_hidden(path: &str) -> bool {
    path.split(['/', '\\'])
        .any(|part| part == "__MACOSX" || (part.starts_with('.') && part != "." && part != ".."))
}

/// What is wrong with an archive or a file in it, as the end of a sentence.
fn fault(error: &ZipError) -> String {
    match error {
        ZipError::UnsupportedArchive(ZipError::PASSWORD_REQUIRED) => "is encrypted".to_owned(),
        ZipError::CompressionMethodNotSupported(method) => format!("is packed by method {method}, which is not read"),
        // What is found only while a file is read comes inside an error of reading.
        ZipError::Io(error) => match error.get_ref().and_then(|inner| inner.downcast_ref()) {
            Some(inner) => fault(inner),
            None => format!("is damaged: {error}"),
        },
        error => format!("is damaged: {error}"),
    }
}

#[cfg(test)]
mod tests {
    use std::io::Write as _;

    use zip::ZipWriter;
    use zip::write::SimpleFileOptions;

    use super::*;

    #[test]
    fn a_few_bytes_that_become_very_many_are_not_all_unpacked() {
        let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
        for name in ["a.dds", "b.dds", "c.dds"] {
            let started = writer.start_file(name, SimpleFileOptions::default());
            started.expect("a file");
            writer.write_all(&vec![0; 1 << 20]).expect("zeros");
        }
        let bytes = writer.finish().expect("an archive").into_inner();
        assert!(bytes.len() < 1 << 14);
        let archive = File::new("bomb.zip", bytes);
        assert_eq!(unpack_within(&archive, 3 << 20).map(|files| files.len()), Ok(3));
        assert_eq!(
            unpack_within(&archive, (3 << 20) - 1).map(|files| files.len()),
            Err("its files have more than 2 MiB together".to_owned())
        );
    }
}
