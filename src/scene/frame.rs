//! All that a renderer needs for one frame, as plain data.

use std::f32::consts::TAU;

use bytemuck::{Pod, Zeroable};
use glam::{Affine3A, Quat, Vec3};

use super::appearance::{Background, Detail, Light, Overlay, Overlays, Pass, Passes, Theme, ViewMode};
use super::{Aabb, Camera, Ground};
use crate::anim::Palette;
use crate::model::Mesh;

/// How the model is drawn, and what is drawn beside it.
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
    /// Samples of ambient occlusion.
    pub occlusion_detail: Detail,
    /// Taps of shadows.
    pub shadow_detail: Detail,
    /// Turn of the environment about y, radians.
    pub environment_turn_radians: f32,
    /// Exposure of the studio light: each stop doubles it.
    pub exposure_stops: f32,
    /// Turn of the book's lights about y, radians: the demo turns them by 0.1 a second.
    pub book_lights_turn_radians: f32,
    /// Whether the green of normal maps points against the bitangent (up in the picture, the way of OpenGL) instead of along
    /// it (down in the picture, the way of DirectX and of the books).
    pub normal_green_flipped: bool,
    /// Diameter of the lens as a part of the distance to what is in focus; 0 for a picture that is sharp everywhere. Only the mean of many
    /// pictures shows it, and only in perspective.
    pub aperture: f32,
    /// What is in focus, world space: where nothing is, the camera's target.
    pub focus: Option<Vec3>,
    /// Height of the window in points of the screen, where one shows the picture.
    pub points_high: Option<f32>,
}

impl FrameOptions {
    /// More blurs all but a line.
    pub const WIDEST_APERTURE: f32 = 0.5;

    /// Whether a pass is drawn for some part of the picture.
    pub fn draws(&self, pass: Pass) -> bool {
        let beside = self.split.map(|_| self.light.other());
        self.draws_under(pass, self.light) || beside.is_some_and(|light| self.draws_under(pass, light))
    }

    /// Whether a pass is drawn in the part of the picture that has this light: it is on, and the view mode shows its result.
    pub fn draws_under(&self, pass: Pass, light: Light) -> bool {
        let has_light = pass != Pass::ContactShadow || light == Light::Studio;
        self.passes.has(pass) && self.view_mode.shows(pass) && has_light
    }
}

/// One frame, plain data.
#[derive(Clone, Debug)]
pub struct RenderFrame<'a> {
    /// The camera.
    pub camera: Camera,
    /// Model space -> world. May mirror. This instance of the model is posed by `palette`; colours of vertices, ghosts, the highlighted
    /// submesh and lines of the model are its alone.
    pub world_from_model: Affine3A,
    /// Box of everything that the clips of all instances reach, world space: depth range, grid, shadow.
    pub world_bounds: Aabb,
    /// Where the model stands.
    pub ground: Ground,
    /// The mesh that the renderer has, for its edges; without it none are drawn.
    pub mesh: Option<&'a Mesh>,
    /// Joint matrices; empty for a static model.
    pub palette: &'a Palette,
    /// The model's other instances.
    pub crowd: Crowd<'a>,
    /// For each submesh whether it is hidden; submeshes beyond the slice are drawn.
    pub hidden_submeshes: &'a [bool],
    /// The highlighted submesh.
    pub highlighted_submesh: Option<usize>,
    /// Vertex colours, shown instead of the view mode's.
    pub vertex_colors: Option<VertexColors<'a>>,
    /// The model in other poses.
    pub ghosts: Ghosts<'a>,
    /// Lines and triangles that show through the model; `None` where there are none.
    pub seen_through: Option<&'a OverlayGeometry>,
    /// Which of the many pictures this is that a mean is made of, as one at rest is; none of a picture by itself.
    pub sample: Option<u32>,
    /// How the model is drawn, and what is drawn beside it.
    pub options: FrameOptions,
}

impl RenderFrame<'_> {
    /// Whether anything lies over the model: what it can hide (ghosts, a highlight, lines, its box), and what is seen through it.
    pub fn has_overlays(&self) -> [bool; 2] {
        let lines = [Overlay::Wireframe, Overlay::Normals, Overlay::Tangents, Overlay::Bounds];
        let has = |overlay: Overlay| self.options.overlays.has(overlay);
        let is_on_model = !self.ghosts.palettes.is_empty() || self.highlighted_submesh.is_some();
        let is_seen_through = self.seen_through.is_some_and(|shapes| !shapes.is_empty());
        [
            is_on_model || lines.into_iter().any(has),
            is_seen_through || has(Overlay::Axes),
        ]
    }

    /// The same without all that [`RenderFrame::has_overlays`] tells of. The grid stays: it lies on the ground.
    #[must_use]
    pub fn without_overlays(&self) -> Self {
        let mut options = self.options;
        options.overlays = Overlays::none();
        options
            .overlays
            .set(Overlay::Grid, self.options.overlays.has(Overlay::Grid));
        Self {
            highlighted_submesh: None,
            ghosts: Ghosts::default(),
            seen_through: None,
            options,
            ..self.clone()
        }
    }

    /// Whether a pass is drawn in the part of the picture that has this light: [`FrameOptions::draws_under`], and not only colours of
    /// vertices are shown, which do not use it.
    pub fn draws_under(&self, pass: Pass, light: Light) -> bool {
        let colored_alone = self.vertex_colors.is_some() && self.crowd.in_sight.min(self.crowd.instances.len()) == 0;
        let is_read = pass != Pass::AmbientOcclusion || !colored_alone;
        is_read && self.options.draws_under(pass, light)
    }
}

/// The instances of the model beside the one that the frame names. Empty where there is one model.
#[derive(Clone, Copy, Debug, Default)]
pub struct Crowd<'a> {
    /// Those in sight of the camera come first.
    pub instances: &'a [CrowdInstance],
    /// How many of them, from the first on, may be in sight. The others may cast shadows into it.
    pub in_sight: usize,
    /// Joint matrices of the poses, one palette after another, each as long as the frame's. Instances in equal poses share one. A device
    /// holds as many as its bone texture has room for: 524 288 joints where textures have 2048 rows. An instance whose palette is not
    /// there is posed by the last that is.
    pub palettes: &'a [Affine3A],
}

/// One more instance of the model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CrowdInstance {
    /// Model space -> world. It mirrors if the frame's does.
    pub world_from_model: Affine3A,
    /// Which of [`Crowd::palettes`] poses it, counted in palettes.
    pub palette: u32,
}

/// A vertex of the lines and triangles over the model.
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct OverlayVertex {
    /// World space.
    pub position: [f32; 3],
    /// sRGB, straight alpha.
    pub color_srgb: [u8; 4],
}

/// Lines and triangles, in buffers that are used again. Later ones are drawn over earlier ones.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct OverlayGeometry {
    /// Two for each line.
    pub lines: Vec<OverlayVertex>,
    /// Three for each triangle, clockwise seen from outside.
    pub triangles: Vec<OverlayVertex>,
}

impl OverlayGeometry {
    /// Empties both buffers and keeps their memory.
    pub fn clear(&mut self) {
        self.lines.clear();
        self.triangles.clear();
    }

    /// Whether nothing is in it.
    pub fn is_empty(&self) -> bool {
        self.lines.is_empty() && self.triangles.is_empty()
    }

    /// Adds a line, world space.
    pub fn line(&mut self, from: Vec3, to: Vec3, color_srgb: [u8; 4]) {
        self.lines.extend([from, to].map(|position| OverlayVertex {
            position: position.to_array(),
            color_srgb,
        }));
    }

    /// Adds a tube of three sides, world space.
    pub fn tube(&mut self, from: Vec3, to: Vec3, radius: f32, color_srgb: [u8; 4]) {
        let along = (to - from).normalize_or(Vec3::Y);
        let beside = along.any_orthonormal_vector();
        let edge = |third: u8| Quat::from_axis_angle(along, f32::from(third) * TAU / 3.0) * beside * radius;
        for third in 0..3 {
            let [edge, next] = [edge(third), edge(third + 1)];
            self.triangle([from + edge, to + edge, to + next], color_srgb);
            self.triangle([from + edge, to + next, from + next], color_srgb);
        }
    }

    /// Adds a triangle, world space.
    pub fn triangle(&mut self, corners: [Vec3; 3], color_srgb: [u8; 4]) {
        self.triangles.extend(corners.map(|position| OverlayVertex {
            position: position.to_array(),
            color_srgb,
        }));
    }
}

/// A colour for each vertex of the mesh, in its order.
#[derive(Clone, Copy, Debug)]
pub struct VertexColors<'a> {
    /// sRGB; alpha is not read. Vertices beyond the slice are black.
    pub colors_srgb: &'a [[u8; 4]],
    /// Changes whenever the colours change.
    pub revision: u64,
}

/// The model in other poses, each as a ghost in one colour.
#[derive(Clone, Copy, Debug, Default)]
pub struct Ghosts<'a> {
    /// Joint matrices of each ghost.
    pub palettes: &'a [crate::anim::Palette],
    /// Colour of each ghost, sRGB, straight alpha; as many as palettes.
    pub colors_srgb: &'a [[u8; 4]],
}
