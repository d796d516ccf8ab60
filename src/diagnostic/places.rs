//! Where the parts of a model stand in its file, and what stands at a place: one question for all formats.

use std::fmt;

use super::Subject;
use super::collect::{Place, Tally};

/// What a file says of one part of a model, by the file's numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "named as the parts are")]
pub enum Entry {
    /// The counts at the beginning.
    Header,
    Material(u32),
    Subset(u32),
    Vertex(u32),
    /// The tangent of a vertex.
    Tangent(u32),
    Triangle(u32),
    /// A bone, where its parent is said.
    Bone(u32),
    /// The inverse bind matrix of a bone.
    Offset(u32),
    Clip(u32),
    /// The keys of a bone in a clip, and how many they are.
    Track {
        clip: u32,
        bone: u32,
    },
    Key {
        clip: u32,
        bone: u32,
        key: u32,
    },
}

impl fmt::Display for Entry {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Header => f.write_str("the header"),
            Self::Material(index) => write!(f, "material {index}"),
            Self::Subset(index) => write!(f, "subset {index}"),
            Self::Vertex(index) => write!(f, "vertex {index}"),
            Self::Tangent(index) => write!(f, "the tangent of vertex {index}"),
            Self::Triangle(index) => write!(f, "triangle {index}"),
            Self::Bone(bone) => write!(f, "the parent of bone {bone}"),
            Self::Offset(bone) => write!(f, "the offset of bone {bone}"),
            Self::Clip(index) => write!(f, "clip {index}"),
            Self::Track { clip, bone } => write!(f, "bone {bone} of clip {clip}"),
            Self::Key { clip, bone, key } => write!(f, "key {key} of bone {bone} in clip {clip}"),
        }
    }
}

/// What a format can tell of places. A text has lines, glTF has JSON pointers, binary FBX has bytes; what a format does not have is `None`.
pub trait Places {
    /// The line on which an entry begins, from 1.
    fn line(&self, _entry: Entry) -> Option<u32> {
        None
    }

    /// What stands on a line: the entry that begins there, or the last one before it.
    fn entry_on(&self, _line: u32) -> Option<Entry> {
        None
    }

    /// The pointer to an entry.
    fn pointer(&self, _entry: Entry) -> Option<String> {
        None
    }

    /// Where an entry begins in a binary file, in bytes from its start.
    fn byte_offset(&self, _entry: Entry) -> Option<u64> {
        None
    }

    /// The entry that a pointer leads to, or into.
    fn entry_at(&self, _pointer: &str) -> Option<Entry> {
        None
    }
}

impl dyn Places + '_ {
    /// Entries that are told of together.
    pub(crate) fn of_rows(&self, rows: &Tally, subject: fn(u32) -> Subject, entry: fn(u32) -> Entry) -> Place {
        Place::of_rows_on(rows, subject, |index| self.line(entry(index)))
    }
}
