//! The container: JSON text, or a `.glb` file with its chunks.

use super::Fault;
use crate::diagnostic::{Diagnostic, codes};

const MAGIC: &[u8] = b"glTF";
const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";
const HEADER_LEN: usize = 12;
const CHUNK_HEADER_LEN: usize = 8;
const JSON_CHUNK: u32 = 0x4E4F_534A;
const BIN_CHUNK: u32 = 0x004E_4942;

/// The parts of a file.
#[derive(Clone, Copy, Debug)]
pub struct Container<'a> {
    /// Its JSON text.
    pub json: &'a [u8],
    /// Where the JSON begins in the file.
    pub json_offset: usize,
    /// The binary chunk.
    pub bin: Option<&'a [u8]>,
    /// Whether it is a `.glb` file.
    pub is_binary: bool,
}

pub(super) fn is_binary(bytes: &[u8]) -> bool {
    bytes.starts_with(MAGIC)
}

/// Whether the first character that is no blank opens an object.
pub(super) fn is_json(bytes: &[u8]) -> bool {
    let bytes = bytes.strip_prefix(BYTE_ORDER_MARK).unwrap_or(bytes);
    bytes.iter().find(|byte| !byte.is_ascii_whitespace()) == Some(&b'{')
}

/// Finds the parts of a file.
///
/// # Errors
/// When a `.glb` file is damaged or of another version.
pub fn open<'a>(bytes: &'a [u8], diagnostics: &mut Vec<Diagnostic>) -> Result<Container<'a>, Fault> {
    if is_binary(bytes) {
        return open_binary(bytes, diagnostics);
    }
    let json = bytes.strip_prefix(BYTE_ORDER_MARK).unwrap_or(bytes);
    if json.len() < bytes.len() {
        diagnostics.push(at(
            0,
            codes::GLTF_RULE_BROKEN.says("The text begins with a byte order mark, which glTF does not allow."),
        ));
    }
    Ok(Container {
        json,
        json_offset: bytes.len() - json.len(),
        bin: None,
        is_binary: false,
    })
}

fn open_binary<'a>(bytes: &'a [u8], diagnostics: &mut Vec<Diagnostic>) -> Result<Container<'a>, Fault> {
    let damaged = |offset, message: String| Box::new(at(offset, codes::GLB_DAMAGED.says(message)));
    let (Some(version), Some(length)) = (word(bytes, 4), word(bytes, 8)) else {
        return Err(damaged(bytes.len(), "The file ends in its header.".to_owned()));
    };
    if version != 2 {
        let message = format!("The .glb file is of version {version}; version 2 is read.");
        return Err(Box::new(at(4, codes::GLTF_VERSION.says(message))));
    }
    let length = length as usize;
    if length > bytes.len() {
        let message = format!(
            "The header says {length} bytes, but the file ends after {}.",
            bytes.len()
        );
        return Err(damaged(bytes.len(), message));
    }
    let mut surplus = |offset, message: String| diagnostics.push(at(offset, codes::GLB_SURPLUS.says(message)));
    if length < bytes.len() {
        surplus(
            length,
            format!(
                "{} bytes follow the end that the header gives; left out.",
                bytes.len() - length
            ),
        );
    }
    let bytes = &bytes[..length.max(HEADER_LEN)];
    let (mut json, mut bin) = (None, None);
    let mut offset = HEADER_LEN;
    let mut chunks = 0;
    while offset < bytes.len() {
        let (Some(chunk_length), Some(kind)) = (word(bytes, offset), word(bytes, offset + 4)) else {
            return Err(damaged(offset, "The file ends in the header of a chunk.".to_owned()));
        };
        let start = offset + CHUNK_HEADER_LEN;
        let Some(chunk) = start
            .checked_add(chunk_length as usize)
            .and_then(|end| bytes.get(start..end))
        else {
            let left = bytes.len() - start;
            return Err(damaged(
                offset,
                format!("A chunk of {chunk_length} bytes has {left} bytes before the file ends."),
            ));
        };
        match kind {
            JSON_CHUNK if chunks == 0 => json = Some((start, chunk)),
            _ if chunks == 0 => {
                return Err(damaged(offset, "The first chunk is not the JSON.".to_owned()));
            }
            BIN_CHUNK if bin.is_none() => {
                if chunks > 1 {
                    surplus(
                        offset,
                        "The binary chunk is not the second one, as it has to be; it is read.".to_owned(),
                    );
                }
                bin = Some(chunk);
            }
            JSON_CHUNK | BIN_CHUNK => surplus(offset, "A second chunk of one kind is left out.".to_owned()),
            _ => surplus(offset, format!("A chunk of the unknown kind {kind:#010x} is left out.")),
        }
        chunks += 1;
        offset = start + chunk.len();
    }
    let Some((json_offset, json)) = json else {
        return Err(damaged(offset, "There is no JSON chunk.".to_owned()));
    };
    Ok(Container {
        json,
        json_offset,
        bin,
        is_binary: true,
    })
}

fn word(bytes: &[u8], offset: usize) -> Option<u32> {
    let word = bytes.get(offset..)?.first_chunk()?;
    Some(u32::from_le_bytes(*word))
}

fn at(offset: usize, diagnostic: Diagnostic) -> Diagnostic {
    Diagnostic {
        byte_offset: Some(offset as u64),
        ..diagnostic
    }
}
