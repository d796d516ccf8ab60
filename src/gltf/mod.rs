//! glTF 2.0 as its files have it: the container, the JSON, buffers, and accessors read into numbers.
//!
//! It knows nothing of models. Every index, offset and length is proved before anything is read or allocated by it, and what is wrong
//! has its place: a JSON pointer, or an offset in bytes. The codes are [`codes::OF_GLTF`](crate::diagnostic::codes::OF_GLTF).

mod accessor;
mod buffers;
mod component;
mod container;
mod fault;
mod json;
mod parse;
mod places;
mod rules;
mod uri;

pub use crate::diagnostic::Fault;
pub use accessor::{Effort, Reader};
pub(crate) use buffers::out_of_range;
pub use buffers::{Buffers, FindFile};
pub(crate) use component::Fit;
pub use component::Wanted;
pub use container::{Container, begins_like_gltf, open};
pub(crate) use fault::fault;
pub use json::{
    Accessor, Animation, Channel, Image, Index, Interpolation, Material, MaterialExtensions, Mesh, Node, NormalTexture,
    OcclusionTexture, Path, PbrMetallicRoughness, Primitive, Root, Sampler, Scene, Skin, Texture, TextureInfo,
    TextureTransform, Transmission,
};
pub use parse::{check_asset, parse};
pub use places::position_of;
pub(crate) use rules::{is_attribute, note_broken_rules};
pub use uri::{Uri, UriError};
