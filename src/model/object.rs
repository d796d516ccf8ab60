//! Objects: what a file has apart, though it is one mesh here.

use std::ops::Range;
use std::sync::Arc;

use serde_json::Value;

/// An object of the file, with a mesh of its own. Its vertices stand in bind space as all others do.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Object {
    /// What the file says of its node.
    pub node: Tag,
    /// What it says of its mesh: one for all objects that share a mesh in the file.
    pub mesh: Arc<Tag>,
    /// The submeshes that are its.
    pub submeshes: Range<usize>,
}

/// What a file says of a part of it that changes nothing of the picture.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tag {
    /// Empty where it has none.
    pub name: String,
    /// Values of its author's own, as JSON.
    pub extras: Option<Value>,
}

impl Tag {
    /// About how many bytes it takes in a file.
    pub(crate) fn len(&self) -> usize {
        self.name.len() + self.extras.as_ref().map_or(0, |extras| extras.to_string().len())
    }
}
