//! All that a renderer needs for one frame, plain data.

use glam::Affine3A;

use super::{Aabb, Camera};
use crate::anim::Palette;

/// Dark or light surroundings.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Theme {
    /// Light things on dark ground.
    #[default]
    Dark,
    /// Dark things on light ground.
    Light,
}

/// What is behind the model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Background {
    /// The quiet gradient of the theme.
    Backdrop,
    /// Nothing: alpha 0, for pictures.
    Transparent,
}

/// What is drawn beside the model and how.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameOptions {
    /// Colours of backdrop and grid.
    pub theme: Theme,
    /// What is behind the model.
    pub background: Background,
    /// Whether the ground grid is drawn.
    pub grid_visible: bool,
    /// Whether the green of normal maps points against the bitangent (up in the picture, the way of OpenGL) instead of along
    /// it (down in the picture, the way of DirectX and of the books).
    pub normal_green_flipped: bool,
}

/// One frame, plain data.
#[derive(Clone, Debug)]
pub struct RenderFrame<'a> {
    /// From where.
    pub camera: Camera,
    /// The file's space -> the world. May mirror.
    pub world_from_model: Affine3A,
    /// Box of everything the clip reaches, world space: depth range, grid, shadow.
    pub world_bounds: Aabb,
    /// Joint matrices; empty for a static model.
    pub palette: &'a Palette,
    /// What is drawn beside the model and how.
    pub options: FrameOptions,
}
