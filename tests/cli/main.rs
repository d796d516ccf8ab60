//! The real `bindpose` binary on real files: what it prints, what it writes, how it exits.

mod appearance;
mod check;
mod convert;
mod info;
mod pipe;
mod pose;
mod program;
mod render;
#[path = "../common/shared.rs"]
mod shared;
#[path = "../core/textbook.rs"]
mod textbook;
mod wrong_use;
