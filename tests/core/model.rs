//! Tests of `model`.

mod clips;
mod codes;
mod errors;
mod geometry;
mod influences;
mod materials;
mod names;
mod real_files;
mod skeleton;
mod tree;
