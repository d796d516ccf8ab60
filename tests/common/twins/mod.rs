//! The light's shaders in Rust: the same functions, steps and names as in the `.wgsl` files. Tests take them as the oracle of
//! what a GPU draws, and prove by them that the formulas keep energy.

#![allow(dead_code, reason = "shared by two test programs, neither of which needs all of it")]

pub(crate) mod book;
pub(crate) mod pbr;
pub(crate) mod studio;
pub(crate) mod tone_map;
