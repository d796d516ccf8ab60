//! The files in a `.zip`.

use std::io::{Cursor, Read as _};

use zip::ZipArchive;
use zip::result::ZipError;

use crate::slices::{Slices, Stage};

/// The files of an archive may have so many bytes together: more than models with all their textures have, and little enough for a page.
const MOST_BYTES: u64 = 1 << 29;

/// So many bytes are unpacked between two places at which that can stop.
const PIECE_LEN: u64 = 256 << 10;

pub(in crate::session) fn begins_like_archive(bytes: &[u8]) -> bool {
    bytes.starts_with(b"PK\x03\x04") || bytes.starts_with(b"PK\x05\x06")
}

/// The files in an archive with their paths, in its order. What systems hide in archives is left out.
///
/// # Errors
/// In words, when a file in it cannot be unpacked, when there is none, or when they have too many bytes together.
pub(in crate::session) async fn unpack(archive: &[u8], slices: &Slices) -> Result<Vec<(String, Vec<u8>)>, String> {
    unpack_within(archive, MOST_BYTES, slices).await
}

pub async fn unpack_within(archive: &[u8], most_bytes: u64, slices: &Slices) -> Result<Vec<(String, Vec<u8>)>, String> {
    let mut entries = ZipArchive::new(Cursor::new(archive)).map_err(|error| format!("it {}", fault(&error)))?;
    let mut files = Vec::new();
    let mut bytes_left = most_bytes;
    let count = entries.len();
    for index in 0..count {
        let name = match entries.name_for_index(index) {
            Some(Ok(name)) => name.into_owned(),
            _ => return Err(format!("the name of file {} in it cannot be read", index + 1)),
        };
        if is_hidden(&name) || name.ends_with(['/', '\\']) {
            continue;
        }
        let damaged = |error: &ZipError| format!("{name} in it {}", fault(error));
        let mut entry = entries
            .by_index(index)
            .map_err(|error| damaged(&error))?
            .take(bytes_left + 1);
        let mut bytes = Vec::new();
        loop {
            slices.pause_at(Stage::Unpacking, index, count).await;
            let piece = entry.by_ref().take(PIECE_LEN).read_to_end(&mut bytes);
            if piece.map_err(|error| damaged(&error.into()))? == 0 {
                break;
            }
        }
        bytes_left = bytes_left
            .checked_sub(bytes.len() as u64)
            .ok_or_else(|| format!("its files have more than {} MiB together", most_bytes >> 20))?;
        files.push((name, bytes));
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
