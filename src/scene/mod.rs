//! What is looked at, and from where: plain data for a renderer.

mod camera;
mod frame;

pub use crate::model::Aabb;
pub use camera::{Camera, DEFAULT_FOV_Y_RADIANS, Insets, Projection, ViewPreset};
pub use frame::{Background, FrameOptions, RenderFrame, Theme};
