//! What is open and how it is looked at. Commands change it, time moves it, a [`RenderFrame`] comes out.

mod apply;
mod clips;
mod command;
mod files;
mod going_back;
mod joining;
mod joint_rows;
mod joints;
mod load;
mod look;
mod looking;
mod maps;
mod materials;
mod mixing;
mod motion;
mod opening;
mod overlaid;
mod picking;
mod playing;
mod pointing;
mod pose;
mod quality;
mod replacing;
mod skeleton_view;
mod sky;
mod subsets;
mod textures;

pub use clips::ClipSummary;
pub use command::{Command, Effect, Event};
pub use files::{File, FileSet};
pub use going_back::GPU_REFUSED;
pub use joint_rows::JointRow;
pub use joints::{JointCommand, Joints, SelectedVertex};
pub use load::{LoadError, OpenModel, load};
pub use look::{Look, LookCommand, MAX_EXPOSURE_STOPS, MAX_LINE_LENGTH};
pub use maps::{Maps, UnreadableMap, UsedMap};
pub use materials::MAX_SPEC_POWER;
pub use mixing::{Blend, DEFAULT_CROSSFADE_SECS, MAX_CROSSFADE_SECS};
pub use quality::{PassChoice, PassState, Quality, RenderScale};
pub use skeleton_view::SkinColorsKey;
pub use subsets::{SubsetCommand, Subsets};
pub use textures::{Checklist, FoundMap, MapNames, MapSlot, MapSource, MaterialMaps, find_map, find_maps, map_notices};

use std::sync::Arc;

use glam::Affine3A;

use materials::Materials;
use mixing::Mix;
use motion::Motion;
use overlaid::Overlaid;
use picking::Picker;
use pose::OnShow;
use skeleton_view::SkeletonView;
use sky::Sky;

use crate::anim::{LoopMode, Playback, PoseBuffers};
use crate::model::{self, Clip, Handedness, UpAxis};
use crate::scene::{Aabb, Camera, Insets, Overlay, RenderFrame, Theme};

/// Speeds of the slower and faster keys.
pub const SPEEDS: [f32; 10] = [0.05, 0.1, 0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 2.0, 4.0];

/// The viewer's state, without window, clock or GPU.
#[derive(Clone, Debug, Default)]
pub struct Session {
    /// Shared with what is kept to go back to.
    open: Option<Arc<OpenModel>>,
    files: FileSet,
    maps: Maps,
    sky: Sky,
    materials: Materials,
    subsets: Subsets,
    joints: Joints,
    error: Option<LoadError>,
    /// All of it as the GPU was last seen to have it, while something newer is on its way there.
    before: Option<Box<Self>>,

    clip: Option<usize>,
    playback: Playback,
    scrubbing: bool,
    reduced_motion: bool,
    pose: PoseBuffers,
    posed: Option<OnShow>,
    bind_share: f32,
    mix: Mix,

    picker: Picker,
    skeleton_view: SkeletonView,
    overlaid: Overlaid,

    camera: Camera,
    motion: Motion,
    framed: bool,
    aspect: f32,
    insets: Insets,
    handedness_override: Option<Handedness>,
    up_axis_override: Option<UpAxis>,
    look: Look,
    quality: Quality,
    theme: Theme,

    model_revision: u64,
    clips_revision: u64,
    maps_revision: u64,
    picture_revision: u64,
    events: Vec<Event>,
}

impl Session {
    /// Nothing open. Under `reduced_motion` a model waits on its first frame instead of playing.
    pub fn new(reduced_motion: bool) -> Self {
        Self {
            reduced_motion,
            aspect: 1.0,
            ..Self::default()
        }
    }

    /// As a new one, but for the window that it is seen in: closes what is open and forgets what was chosen. What counts changes
    /// counts on, so that nobody takes what comes next for what was there.
    pub fn start_over(&mut self, reduced_motion: bool) {
        *self = Self {
            aspect: self.aspect,
            insets: self.insets,
            theme: self.theme,
            model_revision: self.model_revision + 1,
            clips_revision: self.clips_revision + 1,
            maps_revision: self.maps_revision + 1,
            picture_revision: self.picture_revision + 1,
            ..Self::new(reduced_motion)
        };
    }

    /// The model on screen.
    pub fn open_model(&self) -> Option<&OpenModel> {
        self.open.as_deref()
    }

    /// Files of the last drop that had a model.
    pub fn files(&self) -> &FileSet {
        &self.files
    }

    /// What was mended or is worth knowing about the model on screen, its maps and the sky.
    pub fn notices(&self) -> impl Iterator<Item = &crate::diagnostic::Diagnostic> {
        let of_file = self.open.iter().flat_map(|open| &open.notices);
        let of_joined = self.open.iter().flat_map(|open| open.joined_notices());
        of_file
            .chain(of_joined)
            .chain(self.maps.notices())
            .chain(self.sky.notices())
    }

    /// Maps of the model on screen.
    pub fn maps(&self) -> &Maps {
        &self.maps
    }

    /// Why the last load failed, until it is dismissed or another load succeeds.
    pub fn error(&self) -> Option<&LoadError> {
        self.error.as_ref()
    }

    /// Index of the clip on show.
    pub fn clip_index(&self) -> Option<usize> {
        self.clip
    }

    /// The clip on show.
    pub fn clip(&self) -> Option<&Clip> {
        self.open.as_ref()?.model.clips.get(self.clip?)
    }

    /// Where playing is.
    pub fn playback(&self) -> &Playback {
        &self.playback
    }

    /// Whether the pointer holds the time.
    pub fn is_scrubbing(&self) -> bool {
        self.scrubbing
    }

    /// Whether time moves by itself. The camera may move too: [`Session::is_moving`].
    pub fn is_animating(&self) -> bool {
        // A clip of no length would loop on the spot for ever; playing it once still has to end.
        let [start_secs, end_secs] = self.playback.played_secs();
        let has_length = start_secs < end_secs || self.playback.loop_mode() == LoopMode::Once;
        self.playback.is_playing() && !self.scrubbing && self.clip().is_some() && has_length
    }

    /// From where the model is seen.
    pub fn camera(&self) -> &Camera {
        &self.camera
    }

    /// The handedness in force: chosen, or else found.
    pub fn handedness(&self) -> Handedness {
        self.handedness_override
            .unwrap_or(self.open.as_ref().map(|open| open.model.handedness).unwrap_or_default())
    }

    /// The handedness that was chosen over what was found.
    pub fn handedness_override(&self) -> Option<Handedness> {
        self.handedness_override
    }

    /// The up axis in force: chosen, or else found.
    pub fn up_axis(&self) -> UpAxis {
        self.up_axis_override
            .unwrap_or(self.open.as_ref().map(|open| open.model.up_axis).unwrap_or_default())
    }

    /// The up axis that was chosen over what was found.
    pub fn up_axis_override(&self) -> Option<UpAxis> {
        self.up_axis_override
    }

    /// Whether the ground grid is drawn.
    pub fn grid_visible(&self) -> bool {
        self.look.overlays.has(Overlay::Grid)
    }

    /// Which costly passes are drawn.
    pub fn quality(&self) -> &Quality {
        &self.quality
    }

    /// A pass of the window begins, `dt_secs` after the one before. That is how long a frame took if the pass before drew one and
    /// [`Session::frame_drawn`] told it to go on at once; any other time is a pause, and says nothing of the device.
    pub fn begin_pass(&mut self, dt_secs: f32) {
        if self.quality.take_times_frame() {
            self.note_frame(dt_secs);
        }
    }

    /// The window drew the picture. Returns whether it moves, by itself or under a pointer that holds the camera: the next pass is
    /// then to begin at once, so that the time until it is what the frame took and not how long the pointer rested.
    pub fn frame_drawn(&mut self) -> bool {
        let moves = self.is_moving() || self.motion.is_held();
        self.quality.frame_drawn(moves);
        moves
    }

    /// Learns how long a frame took while the picture moved: a device that cannot keep up is given less to draw.
    pub fn note_frame(&mut self, frame_secs: f32) {
        let (before, options) = (self.quality.passes(), self.frame_options());
        self.quality.note_frame(frame_secs, |pass| options.draws(pass));
        if self.quality.passes() != before {
            self.picture_revision += 1;
        }
    }

    /// Counts models opened: another number, another model.
    pub fn model_revision(&self) -> u64 {
        self.model_revision
    }

    /// Counts changes of the maps: another number, other maps.
    pub fn maps_revision(&self) -> u64 {
        self.maps_revision
    }

    /// Counts changes of the picture: the same number, the same picture.
    pub fn picture_revision(&self) -> u64 {
        self.picture_revision
    }

    /// What happened since the last call, in order, each kind of a run once.
    pub fn take_events(&mut self) -> Vec<Event> {
        std::mem::take(&mut self.events)
    }

    /// Moves time by `dt_secs` while it plays, and the camera while it moves.
    pub fn advance(&mut self, dt_secs: f32) {
        let seen_from = self.camera;
        self.advance_camera(dt_secs);
        if self.camera != seen_from {
            self.picture_revision += 1;
        }
        self.advance_fades(dt_secs);
        if !self.is_animating() {
            return;
        }
        let was_at = self.playback.time_secs();
        self.playback.advance(dt_secs);
        self.look.advance(dt_secs);
        if self.playback.time_secs() != was_at {
            self.picture_revision += 1;
            self.note(Event::TimeUpdate);
        }
        if !self.playback.is_playing() {
            self.note(Event::Pause);
        }
    }

    /// All that a renderer needs for the picture of now. The box is empty and the palette too when nothing is open.
    pub fn frame(&mut self) -> RenderFrame<'_> {
        let world_from_model = self.world_from_model();
        let world_bounds = self.world_bounds();
        self.pose_now();
        self.fill_overlaid();
        let options = self.frame_options();
        RenderFrame {
            camera: self.camera,
            world_from_model,
            world_bounds,
            palette: &self.pose.palette,
            hidden_submeshes: self.subsets.left_out(),
            highlighted_submesh: self.subsets.highlighted(),
            vertex_colors: self.overlaid.vertex_colors(),
            ghosts: self.overlaid.ghosts(),
            over_model: Some(self.overlaid.geometry()),
            options,
        }
    }

    /// The file's space -> the world.
    fn world_from_model(&self) -> Affine3A {
        model::world_from_model(self.handedness(), self.up_axis())
    }

    /// Box of all that the clips in the pose reach, world space; with the bind pose in it while the pose is brought there.
    pub fn world_bounds(&mut self) -> Aabb {
        let world_from_model = self.world_from_model();
        let reached = self.reach();
        let bounds = match &self.open {
            Some(open) if self.bind_share > 0.0 => reached.union(open.bind_bounds),
            _ => reached,
        };
        bounds.transformed(world_from_model)
    }

    fn note(&mut self, event: Event) {
        if self.events.last() != Some(&event) {
            self.events.push(event);
        }
    }
}
