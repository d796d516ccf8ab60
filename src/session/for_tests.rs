//! Parts that tests look at one by one.

pub use super::archive::unpack_within;
pub use super::instances::{JITTER, fraction, noise, place};
pub use super::overlays::{GHOST_ALPHA, ghost_color};
pub use super::pacing::{Pacer, Step};
pub use super::picking::{Alpha, first_met};
