//! Files of other programs become models: one module here for each format, all with the same result.
//!
//! A format decides what its files mean, mends what can be mended and notes it with its place; what has no place is
//! [`Model`](crate::model::Model)'s to prove. Nodes, skins and meshes go through one `scene`, normals and tangents are
//! computed for any format, and what only a format knows of its file, such as places, stays in [`Source`].

mod fbx;
mod gltf;
mod imported;
mod keys;
pub mod m3d;
mod normals;
mod offsets;
mod scene;
mod source;
mod tangents;
mod weights;

pub use imported::{Imported, Picture, Refused};
pub use source::{FileFormat, Source};

use crate::gltf::FindFile;
use crate::slices::{Slices, at_once};

/// Whether a file begins as one of the formats does, whatever its name.
///
/// A quick look. What it accepts [`import`] may still refuse.
pub fn begins_like_model(bytes: &[u8]) -> bool {
    m3d::begins_like_model(bytes) || gltf::begins_like_model(bytes) || fbx::begins_like_model(bytes)
}

/// Whether a file begins as one of a format that others read too: glTF or FBX, in either form.
pub fn is_of_others(bytes: &[u8]) -> bool {
    gltf::begins_like_model(bytes) || fbx::begins_like_model(bytes)
}

/// Whether a file has motions of bones and no mesh. A quick look.
pub fn is_motion(bytes: &[u8]) -> bool {
    fbx::begins_like_model(bytes) && fbx::is_motion(bytes) || gltf::begins_like_model(bytes) && gltf::is_motion(bytes)
}

/// Reads a model that needs no other file.
///
/// # Errors
/// When the bytes are of no format that is known here, or what they say makes no model.
pub fn import(bytes: &[u8]) -> Result<Imported, Box<Refused>> {
    import_beside(bytes, &|_| None)
}

/// Reads a model; `find` gives the files beside it that it names ([`files_beside`]).
///
/// # Errors
/// As [`import`], and when such a file is not there.
pub fn import_beside(bytes: &[u8], find: FindFile<'_>) -> Result<Imported, Box<Refused>> {
    at_once(import_in(bytes, find, &Slices::ENDLESS))
}

/// [`import_beside`] in slices.
///
/// # Errors
/// As [`import_beside`].
pub async fn import_in(bytes: &[u8], find: FindFile<'_>, slices: &Slices) -> Result<Imported, Box<Refused>> {
    if gltf::begins_like_model(bytes) {
        gltf::import(bytes, find, slices).await
    } else if fbx::begins_like_model(bytes) {
        fbx::import(bytes, find, slices).await
    } else {
        m3d::import(bytes, slices).await
    }
}

/// The relative paths of the files that a model needs beside itself: data and pictures. A quick look for those who read files.
pub fn files_beside(bytes: &[u8]) -> Vec<String> {
    if gltf::begins_like_model(bytes) {
        gltf::files_beside(bytes)
    } else if fbx::begins_like_model(bytes) {
        fbx::files_beside(bytes)
    } else {
        Vec::new()
    }
}
