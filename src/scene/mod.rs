//! What is looked at, and from where: plain data for a renderer.

mod camera;
mod frame;
mod ground;
mod tint;

pub use crate::model::Aabb;
pub use camera::{Camera, DEFAULT_FOV_Y_RADIANS, Insets, Projection, ViewPreset};
pub use frame::{Background, FrameOptions, RenderFrame, Theme};
pub use ground::Ground;
pub use tint::{display_color, linear_from_srgb8, srgb8_from_linear};
