//! The real `bindpose` binary on real files: what it prints, what it writes, how it exits.

mod appearance;
mod check;
mod codes;
mod convert;
mod folders;
mod formats;
mod gltf;
mod info;
mod parts;
mod pipe;
mod pose;
mod program;
mod render;
mod series;
#[path = "../common/shared.rs"]
mod shared;
#[path = "../core/textbook.rs"]
mod textbook;
mod wrong_use;
