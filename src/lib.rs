//! Bindpose: skinned `.m3d` models, from bytes to pixels.

pub mod anim;
pub mod diagnostic;
pub mod format;
pub mod model;
#[cfg(feature = "render")]
pub mod render;
pub mod scene;
pub mod session;
pub mod shaders;
