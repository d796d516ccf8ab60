//! A `.zip` of several files, packed in parts.

use std::fmt;
use std::io::{self, Cursor, Write as _};

use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

/// So many bytes are packed in a step: some milliseconds.
const PART_LEN: usize = 1 << 18;

/// Files on their way into an archive. The same files give the same bytes, whenever that is.
pub(in crate::session) struct Archive {
    writer: ZipWriter<Cursor<Vec<u8>>>,
    files: Vec<(String, bytes::Bytes)>,
    /// The file that is packed, and how much of it is.
    file: usize,
    packed: usize,
}

impl fmt::Debug for Archive {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [done, total] = self.progress();
        write!(f, "Archive({done} of {total} parts)")
    }
}

impl Archive {
    pub(in crate::session) fn new(files: impl Iterator<Item = (String, bytes::Bytes)>) -> Self {
        Self {
            writer: ZipWriter::new(Cursor::new(Vec::new())),
            files: files.collect(),
            file: 0,
            packed: 0,
        }
    }

    /// Parts that are packed, and all of them.
    pub(in crate::session) fn progress(&self) -> [usize; 2] {
        let parts = |files: &[(String, bytes::Bytes)]| -> usize {
            files.iter().map(|(_, bytes)| 1 + bytes.len() / PART_LEN).sum()
        };
        let done = parts(&self.files[..self.file]) + self.packed / PART_LEN;
        [done, parts(&self.files) + 1]
    }

    /// Packs a part; the archive once all is in it.
    pub(in crate::session) fn step(&mut self) -> io::Result<Option<Vec<u8>>> {
        let Some((name, bytes)) = self.files.get(self.file) else {
            let writer = std::mem::replace(&mut self.writer, ZipWriter::new(Cursor::new(Vec::new())));
            return Ok(Some(writer.finish()?.into_inner()));
        };
        if self.packed == 0 {
            let method = if is_packed(name) {
                CompressionMethod::Stored
            } else {
                CompressionMethod::Deflated
            };
            let options = SimpleFileOptions::default().compression_method(method);
            self.writer.start_file(name.as_str(), options)?;
        }
        let end = bytes.len().min(self.packed + PART_LEN);
        self.writer.write_all(&bytes[self.packed..end])?;
        self.packed = end;
        if end == bytes.len() {
            (self.file, self.packed) = (self.file + 1, 0);
        }
        Ok(None)
    }
}

/// Whether a file of this name is compressed already.
fn is_packed(name: &str) -> bool {
    let name = name.to_ascii_lowercase();
    [".png", ".jpg", ".jpeg"]
        .iter()
        .any(|extension| name.ends_with(extension))
}
