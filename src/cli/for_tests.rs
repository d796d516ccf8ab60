//! Parts that tests look at one by one.

pub use super::in_order::in_order;
pub use super::output::UntilClosed;
pub use super::text::{Plain, column_width, grouped};
pub use super::textures::walk_warnings;
