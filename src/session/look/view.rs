//! How the model is seen: from where, how it stands in the world, in which light, with what beside it.

use glam::{Affine3A, Vec3};

use super::Look;
use super::motion::Motion;
use super::quality::Quality;
use crate::model::{self, Handedness, UpAxis};
use crate::scene::{Camera, FrameOptions, Insets, Theme};
use crate::session::open::open_model::OpenModel;

#[derive(Clone, Debug)]
pub(in crate::session) struct View {
    pub(in crate::session) camera: Camera,
    pub(in crate::session) motion: Motion,
    pub(in crate::session) framed: Framed,
    pub(in crate::session) aspect: f32,
    /// Margins of the picture that panels cover.
    pub(in crate::session) insets: Insets,
    /// Chosen instead of what was found in the file.
    pub(in crate::session) handedness: Option<Handedness>,
    pub(in crate::session) up_axis: Option<UpAxis>,
    pub(in crate::session) look: Look,
    pub(in crate::session) theme: Theme,
}

/// Whether the camera frames all that the clip reaches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::session) enum Framed {
    /// It was panned, zoomed, flown or sent to a place.
    No,
    /// It was not since then: it frames anew wherever the picture or its free part changes.
    Yes,
    /// A link sent it to where that is so in a picture of this shape (width / height): it frames anew in one of another.
    InShape(f32),
}

impl Default for View {
    fn default() -> Self {
        Self {
            camera: Camera::default(),
            motion: Motion::default(),
            framed: Framed::No,
            aspect: 1.0,
            insets: Insets::default(),
            handedness: None,
            up_axis: None,
            look: Look::default(),
            theme: Theme::default(),
        }
    }
}

impl View {
    /// Another model: what was chosen for the old one is forgotten, and the camera looks from the front.
    pub(in crate::session) fn reset_for_model(&mut self) {
        self.motion.reset_for_model();
        self.handedness = None;
        self.up_axis = None;
        self.camera = Camera {
            projection: self.camera.projection,
            ..Camera::default()
        };
    }

    /// Whether a picture of this view is the same as one of another, if the model stands in the world as it does there. The aspect ratio
    /// says which instances of a crowd are in sight.
    pub(in crate::session) fn shows_the_same_as(&self, other: &Self) -> bool {
        self.camera == other.camera
            && self.aspect == other.aspect
            && self.look == other.look
            && self.theme == other.theme
    }

    /// The same, but for what lies over the model.
    pub(in crate::session) fn shows_the_same_scene_as(&self, other: &Self) -> bool {
        self.camera == other.camera
            && self.aspect == other.aspect
            && self.look.lights_as(&other.look)
            && self.theme == other.theme
    }

    /// The handedness in force: chosen, or else found.
    pub(in crate::session) fn handedness(&self, open: Option<&OpenModel>) -> Handedness {
        let found = || open.map(|open| open.model.handedness);
        self.handedness.or_else(found).unwrap_or_default()
    }

    /// The up axis in force: chosen, or else found.
    pub(in crate::session) fn up_axis(&self, open: Option<&OpenModel>) -> UpAxis {
        let found = || open.map(|open| open.model.up_axis);
        self.up_axis.or_else(found).unwrap_or_default()
    }

    /// The file's space -> the world.
    pub(in crate::session) fn world_from_model(&self, open: Option<&OpenModel>) -> Affine3A {
        let front = open.map(|open| open.model.front).unwrap_or_default();
        model::world_from_model(self.handedness(open), self.up_axis(open), front)
    }

    /// The part of it that a renderer needs, with the detail of now.
    pub(in crate::session) fn frame_options(&self, quality: &Quality) -> FrameOptions {
        let look = &self.look;
        let [occlusion_detail, shadow_detail] = quality.details_now();
        FrameOptions {
            theme: self.theme,
            light: look.light,
            split: look.split,
            view_mode: look.view_mode,
            background: look.background,
            overlays: look.overlays,
            passes: quality.passes(),
            occlusion_detail,
            shadow_detail,
            environment_turn_radians: look.environment_turn_radians,
            exposure_stops: look.exposure_stops,
            book_lights_turn_radians: look.book_lights_turn_radians,
            normal_green_flipped: look.normal_green_flipped,
            aperture: 0.0,
            focus: None,
            points_high: None,
        }
    }

    /// Frames points of the world in what the panels leave free.
    pub(in crate::session) fn frame_points(&mut self, world_points: &[Vec3]) {
        // Centred in the window where that fits between the panels at the sides, else in the room that they leave.
        let centered = Insets {
            left: 0.0,
            right: 0.0,
            ..self.insets
        };
        self.camera.frame(world_points, self.aspect, centered);
        let (left, right) = self.camera.free_at_sides(world_points, self.aspect);
        if left < self.insets.left || right < self.insets.right {
            self.camera.frame(world_points, self.aspect, self.insets);
        }
    }
}
