//! Tests of the core: they need neither GPU nor UI.

mod anim;
mod format;
mod model;
mod sample;
mod shaders;
