//! Parts that tests look at one by one.

pub use super::blend;
pub use super::label::Labels;
pub use super::layout::{Layout, Place};
