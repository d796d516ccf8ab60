//! The parts of a file that a loader reads one after another.

use std::fmt;

/// What the loader reads when something happens.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Row {
    /// A count of the header.
    Header,
    /// A material, by its index.
    Material(u32),
    /// A subset, by its index.
    Subset(u32),
    /// A vertex, by its index.
    Vertex(u32),
    /// A triangle, by its index.
    Triangle(u32),
    /// The offset of a bone.
    Offset(u32),
    /// The parent of a bone.
    Parent(u32),
    /// The name of a clip, by its index.
    Clip(u32),
    /// How many keys a bone has in a clip.
    Bone {
        /// Index of the clip.
        clip: u32,
        /// Number of the bone.
        bone: u32,
    },
    /// A key of a bone in a clip.
    Key {
        /// Index of the clip.
        clip: u32,
        /// Number of the bone.
        bone: u32,
        /// Index of the key.
        key: u32,
    },
}

impl fmt::Display for Row {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Header => f.write_str("the header"),
            Self::Material(index) => write!(f, "material {index}"),
            Self::Subset(index) => write!(f, "subset {index}"),
            Self::Vertex(index) => write!(f, "vertex {index}"),
            Self::Triangle(index) => write!(f, "triangle {index}"),
            Self::Offset(bone) => write!(f, "the offset of bone {bone}"),
            Self::Parent(bone) => write!(f, "the parent of bone {bone}"),
            Self::Clip(index) => write!(f, "clip {index}"),
            Self::Bone { clip, bone } => write!(f, "bone {bone} of clip {clip}"),
            Self::Key { clip, bone, key } => write!(f, "key {key} of bone {bone} in clip {clip}"),
        }
    }
}
