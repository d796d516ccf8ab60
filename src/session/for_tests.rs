//! Parts that tests look at one by one.

pub use super::choose::picking::{Alpha, first_met};
pub use super::look::overlays::{GHOST_ALPHA, ghost_color};
pub use super::look::pacing::{Pacer, Step};
pub use super::open::archive::unpack_within;
pub use super::play::instances::{JITTER, fraction, noise, place};
