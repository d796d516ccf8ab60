//! Tests of `model`.

mod clips;
mod codes;
mod errors;
mod geometry;
mod influences;
mod materials;
mod real_files;
mod skeleton;
