//! glTF 2.0 as its files have it: the container, the JSON, buffers, and accessors read into numbers.
//!
//! It knows nothing of models. Every index, offset and length is proved before anything is read or allocated by it, and what is wrong
//! has its place: a JSON pointer, or an offset in bytes. The codes are [`codes::OF_GLTF`](crate::diagnostic::codes::OF_GLTF).

mod accessor;
mod buffers;
mod container;
mod json;
mod parse;
mod rules;
mod uri;

pub use accessor::Reader;
pub(crate) use buffers::out_of_range;
pub use buffers::{Buffers, FindFile};
pub use container::{Container, open};
pub use json::{
    Accessor, Animation, Channel, Image, Index, Interpolation, Material, Mesh, Node, NormalTexture, OcclusionTexture,
    Path, PbrMetallicRoughness, Primitive, Root, Sampler, Scene, Skin, Texture, TextureInfo, TextureTransform,
};
pub use parse::{check_asset, parse};
pub use rules::note_broken_rules;
pub use uri::{Uri, UriError};

use crate::diagnostic::{Code, Diagnostic};

/// Something that stops the reading.
pub type Fault = Box<Diagnostic>;

/// A fault at a place in the JSON.
pub(crate) fn fault(code: &Code, pointer: impl Into<String>, message: impl Into<String>) -> Fault {
    Box::new(code.says(message).pointing_at(pointer))
}

/// Whether bytes begin as a glTF file does: a `.glb` container, or JSON that says what its asset is.
pub fn begins_like_gltf(bytes: &[u8]) -> bool {
    container::is_binary(bytes) || (container::is_json(bytes) && memchr::memmem::find(bytes, b"\"asset\"").is_some())
}
