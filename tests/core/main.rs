//! Tests of the core: they need neither GPU nor UI.

mod anim;
mod documents;
mod format;
mod image;
mod light;
mod model;
mod rigs;
mod sample;
mod session;
mod shaders;
mod textbook;
