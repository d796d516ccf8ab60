//! Tests of `model`.

mod clips;
mod errors;
mod geometry;
mod influences;
mod materials;
mod real_files;
mod skeleton;
