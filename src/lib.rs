//! Bindpose: skinned `.m3d` models, from bytes to pixels.

pub mod anim;
#[cfg(feature = "viewer")]
pub mod app;
#[cfg(all(feature = "cli", not(target_arch = "wasm32")))]
pub mod cli;
pub mod diagnostic;
pub mod format;
pub mod image;
pub mod model;
#[cfg(feature = "render")]
pub mod render;
pub mod sample;
pub mod scene;
pub mod session;
pub mod shaders;
#[cfg(feature = "viewer")]
pub mod ui;
#[cfg(all(feature = "viewer", target_arch = "wasm32"))]
mod web;
