//! The rim without egui: a surface of wgpu on the canvas, frames where something changes, and input that scripts hand on.

mod app;
mod calls;
mod face;
mod frames;
mod keys;
mod pointers;
mod run;
mod surface;

pub(super) use app::App;
pub(super) use face::{Face, books};
pub(super) use frames::Frames;
pub(super) use run::run;
