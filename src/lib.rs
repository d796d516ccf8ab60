//! Bindpose: skinned `.m3d` models, from bytes to pixels.

pub mod anim;
pub mod diagnostic;
pub mod format;
pub mod model;
pub mod sample;
pub mod scene;
