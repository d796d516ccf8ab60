//! The bytes of buffers and of their views.

use std::collections::HashMap;
use std::fmt;
use std::ops::Deref;

use super::json::{Index, Root};
use super::uri::{Uri, UriError};
use super::{Container, Fault, fault};
use crate::diagnostic::codes;

/// Gives the bytes of a file at a path relative to the one that is read.
pub type FindFile<'a> = &'a dyn Fn(&str) -> Option<bytes::Bytes>;

/// The buffers of a document. What is wrong with one is told when its bytes are asked for.
#[derive(Debug)]
pub struct Buffers<'a> {
    root: &'a Root,
    buffers: Vec<Result<Bytes<'a>, Fault>>,
    byte_count: u64,
}

#[derive(Debug)]
enum Bytes<'a> {
    Chunk(&'a [u8]),
    Decoded(Vec<u8>),
    File(bytes::Bytes),
}

impl Deref for Bytes<'_> {
    type Target = [u8];

    fn deref(&self) -> &[u8] {
        match self {
            Self::Chunk(bytes) => bytes,
            Self::Decoded(bytes) => bytes,
            Self::File(bytes) => bytes,
        }
    }
}

impl<'a> Buffers<'a> {
    /// Finds the bytes of all buffers.
    pub fn new(root: &'a Root, container: &Container<'a>, find: FindFile<'_>) -> Self {
        // Each file is asked for once, and its bytes count once, however many buffers name it.
        let mut files: HashMap<String, Option<bytes::Bytes>> = HashMap::new();
        let mut find = |path: &str| files.entry(path.to_owned()).or_insert_with(|| find(path)).clone();
        let buffers = root.buffers().iter().enumerate().map(|(index, buffer)| {
            let pointer = format!("/buffers/{index}");
            let bytes = match (&buffer.uri, container.bin) {
                (Some(uri), _) => at_uri(uri, &pointer, &mut find)?,
                (None, Some(bin)) if index == 0 => Bytes::Chunk(bin),
                (None, _) => {
                    let message = format!("Buffer {index} has no data: neither an address nor a binary chunk.");
                    return Err(fault(&codes::GLTF_BUFFER_MISSING, pointer, message));
                }
            };
            let (said, there) = (buffer.byte_length.0, bytes.len());
            if said > there as u64 {
                let message = format!("Buffer {index} is to have {said} bytes, but there are {there}.");
                return Err(fault(
                    &codes::GLTF_BUFFER_SHORT,
                    format!("{pointer}/byteLength"),
                    message,
                ));
            }
            Ok(bytes)
        });
        let buffers: Vec<_> = buffers.collect();
        let beside = files.values().flatten().map(|bytes| bytes.len() as u64);
        let inside = buffers.iter().flatten().map(|bytes| match bytes {
            Bytes::File(_) => 0,
            bytes => bytes.len() as u64,
        });
        Self {
            root,
            byte_count: beside.chain(inside).sum(),
            buffers,
        }
    }

    /// How many bytes the buffers have together. A file that several of them name counts once.
    pub fn byte_count(&self) -> u64 {
        self.byte_count
    }

    /// What is wrong with buffers that cannot be read.
    pub fn faults(&self) -> impl Iterator<Item = &Fault> {
        self.buffers.iter().filter_map(|buffer| buffer.as_ref().err())
    }

    /// The fault of the first buffer whose file is missing. It says how many more are.
    pub fn first_missing(&self) -> Option<Fault> {
        let mut missing = self
            .faults()
            .filter(|fault| fault.code == codes::GLTF_BUFFER_MISSING.name);
        let mut first = missing.next()?.clone();
        let more = match missing.count() {
            0 => String::new(),
            1 => " 1 more buffer is missing too.".to_owned(),
            count => format!(" {count} more buffers are missing too."),
        };
        first.message += &more;
        first.message += " Drop the .gltf together with its .bin files.";
        Some(first)
    }

    /// The bytes of a view, and the step between its elements where it gives one. `pointer` is where the view is named.
    ///
    /// # Errors
    /// When the view or its buffer is not there, or it reaches beyond its buffer.
    pub fn view(&self, view: Index, pointer: impl fmt::Display) -> Result<(&[u8], Option<u64>), Fault> {
        let index = view.0;
        let Some(view) = usize::try_from(index)
            .ok()
            .and_then(|index| self.root.buffer_views().get(index))
        else {
            return Err(out_of_range(
                &pointer.to_string(),
                "buffer view",
                index,
                self.root.buffer_views().len(),
            ));
        };
        let buffer = usize::try_from(view.buffer.0)
            .ok()
            .and_then(|buffer| self.buffers.get(buffer));
        let Some(buffer) = buffer else {
            let pointer = format!("/bufferViews/{index}/buffer");
            return Err(out_of_range(&pointer, "buffer", view.buffer.0, self.buffers.len()));
        };
        let buffer = buffer.as_ref().map_err(Clone::clone)?;
        let offset = view.byte_offset.unwrap_or_default().0;
        let range = offset.checked_add(view.byte_length.0).and_then(|end| {
            let range = usize::try_from(offset).ok()?..usize::try_from(end).ok()?;
            buffer.get(range)
        });
        let Some(bytes) = range else {
            let message = format!(
                "Buffer view {index} has {} bytes from {offset} on, but its buffer has {}.",
                view.byte_length.0,
                buffer.len()
            );
            return Err(fault(
                &codes::GLTF_BUFFER_SHORT,
                format!("/bufferViews/{index}"),
                message,
            ));
        };
        Ok((bytes, view.byte_stride.map(|stride| stride.0)))
    }
}

fn at_uri<'a>(
    uri: &str,
    pointer: &str,
    find: &mut impl FnMut(&str) -> Option<bytes::Bytes>,
) -> Result<Bytes<'a>, Fault> {
    let pointer = || format!("{pointer}/uri");
    let index = pointer();
    let index = index.trim_start_matches("/buffers/").trim_end_matches("/uri");
    match Uri::parse(uri) {
        Ok(Uri::Data { bytes, .. }) => Ok(Bytes::Decoded(bytes)),
        Ok(Uri::Path(path)) => find(&path).map(Bytes::File).ok_or_else(|| {
            let message = format!("The file \"{path}\", which has the data of buffer {index}, is not there.");
            fault(&codes::GLTF_BUFFER_MISSING, pointer(), message)
        }),
        Err(error) => {
            let message = match error {
                UriError::NotRelative => format!("Buffer {index} is at \"{}\": {error}.", shortened(uri)),
                _ => format!("The data of buffer {index} cannot be read: {error}."),
            };
            Err(fault(&codes::GLTF_BUFFER_MISSING, pointer(), message))
        }
    }
}

/// The beginning of an address, for messages.
fn shortened(uri: &str) -> String {
    let mut letters = uri.chars();
    let beginning: String = letters.by_ref().take(60).collect();
    if letters.next().is_some() {
        format!("{beginning}…")
    } else {
        beginning
    }
}

/// That an index names nothing.
pub(crate) fn out_of_range(pointer: &str, what: &str, index: u64, count: usize) -> Fault {
    let there = match count {
        0 => "there is none".to_owned(),
        1 => "there is 1, with the number 0".to_owned(),
        count => format!("there are {count}"),
    };
    let message = format!("{} names {what} {index}, but {there}.", subject(pointer));
    fault(&codes::GLTF_INDEX_OUT_OF_RANGE, pointer, message)
}

/// What a value belongs to, by its pointer: `Accessor 4` of `/accessors/4/bufferView`.
pub(super) fn subject(pointer: &str) -> String {
    let parts: Vec<&str> = pointer.split('/').skip(1).collect();
    let mut subject = String::new();
    // The last part is the value itself.
    for pair in parts[..parts.len().saturating_sub(1)].windows(2) {
        let what = match pair[0] {
            "accessors" => "accessor",
            "animations" => "animation",
            "bufferViews" => "buffer view",
            "channels" => "channel",
            "images" => "image",
            "materials" => "material",
            "meshes" => "mesh",
            "nodes" => "node",
            "primitives" => "primitive",
            "samplers" => "sampler",
            "scenes" => "scene",
            "skins" => "skin",
            "textures" => "texture",
            _ => continue,
        };
        if pair[1].parse::<u64>().is_ok() {
            let rest = if subject.is_empty() {
                String::new()
            } else {
                format!(" of {subject}")
            };
            subject = format!("{what} {}{rest}", pair[1]);
        }
    }
    let mut letters = subject.chars();
    match letters.next() {
        Some(first) => first.to_ascii_uppercase().to_string() + letters.as_str(),
        None => "The file".to_owned(),
    }
}
