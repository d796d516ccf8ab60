//! Tests of `model`.

mod bounds;
mod clips;
mod codes;
mod curve;
mod errors;
mod geometry;
mod influences;
mod many;
mod materials;
mod names;
mod overflow;
mod real_files;
mod sides;
mod skeleton;
mod space;
mod tree;
