//! A `.zip` of several files.

use std::io::{Cursor, Result, Write as _};

use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

use crate::slices::{Slices, Stage};

/// So many bytes are packed at once: some milliseconds.
const PART_LEN: usize = 1 << 18;

/// Packs files with their names, in slices. The same files give the same bytes, whenever that is.
pub(in crate::session) async fn pack(files: &[(String, bytes::Bytes)], slices: &Slices) -> Result<Vec<u8>> {
    let total = files.iter().map(|(_, bytes)| bytes.len()).sum();
    let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
    let mut packed = 0;
    for (name, bytes) in files {
        let method = if is_packed(name) {
            CompressionMethod::Stored
        } else {
            CompressionMethod::Deflated
        };
        let options = SimpleFileOptions::default().compression_method(method);
        writer.start_file(name.as_str(), options)?;
        for part in bytes.chunks(PART_LEN) {
            slices.pause_at(Stage::Packing, packed, total).await;
            writer.write_all(part)?;
            packed += part.len();
        }
    }
    Ok(writer.finish()?.into_inner())
}

/// Whether a file of this name is compressed already.
fn is_packed(name: &str) -> bool {
    let name = name.to_ascii_lowercase();
    [".png", ".jpg", ".jpeg"]
        .iter()
        .any(|extension| name.ends_with(extension))
}
