//! All that a renderer needs for one frame, plain data.

use glam::Affine3A;

use super::appearance::{Background, Light, Overlays, Pass, Passes, Theme, ViewMode};
use super::{Aabb, Camera, Ghosts, OverlayGeometry, VertexColors};
use crate::anim::Palette;

/// What is drawn beside the model and how.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FrameOptions {
    /// Colours of backdrop and grid.
    pub theme: Theme,
    /// How surfaces are lit.
    pub light: Light,
    /// Where the picture is divided, as a fraction of its width: `light` on the right, the other on the left.
    pub split: Option<f32>,
    /// What of a surface is shown.
    pub view_mode: ViewMode,
    /// What is behind the model.
    pub background: Background,
    /// Lines over and beside the model.
    pub overlays: Overlays,
    /// Which costly steps are drawn.
    pub passes: Passes,
    /// Turn of the environment about y, radians.
    pub environment_turn_radians: f32,
    /// Exposure of the studio light: each stop doubles it.
    pub exposure_stops: f32,
    /// Turn of the book's lights about y, radians: the demo turns them by 0.1 a second.
    pub book_lights_turn_radians: f32,
    /// Whether the green of normal maps points against the bitangent (up in the picture, the way of OpenGL) instead of along
    /// it (down in the picture, the way of DirectX and of the books).
    pub normal_green_flipped: bool,
}

impl FrameOptions {
    /// Whether a pass is drawn for some part of the picture.
    pub fn draws(&self, pass: Pass) -> bool {
        let beside = self.split.map(|_| self.light.other());
        self.draws_under(pass, self.light) || beside.is_some_and(|light| self.draws_under(pass, light))
    }

    /// Whether a pass is drawn where this light is: it is on, and there is something in which it shows.
    pub fn draws_under(&self, pass: Pass, light: Light) -> bool {
        let lit = self.view_mode == ViewMode::Lit;
        self.passes.has(pass)
            && match pass {
                Pass::Shadow => lit || self.view_mode == ViewMode::Shadow,
                Pass::AmbientOcclusion => lit || self.view_mode == ViewMode::AmbientOcclusion,
                Pass::ContactShadow => lit && light == Light::Studio && self.background != Background::None,
                Pass::Environment => lit,
            }
    }
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
    /// For each submesh whether it is left out; those beyond the slice are drawn.
    pub hidden_submeshes: &'a [bool],
    /// A submesh that stands out.
    pub highlighted_submesh: Option<usize>,
    /// Colours that are shown instead of the view mode's.
    pub vertex_colors: Option<VertexColors<'a>>,
    /// Poses beside that of now.
    pub ghosts: Ghosts<'a>,
    /// Lines and triangles that are seen through the model; none where there is nothing.
    pub over_model: Option<&'a OverlayGeometry>,
    /// What is drawn beside the model and how.
    pub options: FrameOptions,
}
