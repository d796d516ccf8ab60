//! What is open and how it is looked at. Commands change it, time moves it, a [`RenderFrame`] comes out.

mod command;
mod files;
mod load;
mod textures;

pub use command::{Command, Effect, Event};
pub use files::{File, FileSet};
pub use load::{LoadError, OpenModel, load};
pub use textures::{Checklist, FoundMap, MapSlot, MapSource, MaterialMaps, find_map, find_maps, map_notices};

use crate::anim::{LoopMode, Playback, PoseBuffers};
use crate::model::{Clip, Handedness, UpAxis, world_from_model};
use crate::scene::{Aabb, Background, Camera, FrameOptions, Insets, Projection, RenderFrame, Theme};

/// Speeds of the slower and faster keys.
pub const SPEEDS: [f32; 9] = [0.1, 0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 2.0, 4.0];

/// The viewer's state, without window, clock or GPU.
#[derive(Debug, Default)]
pub struct Session {
    open: Option<OpenModel>,
    files: FileSet,
    error: Option<LoadError>,

    clip: Option<usize>,
    playback: Playback,
    scrubbing: bool,
    reduced_motion: bool,
    pose: PoseBuffers,
    posed_at: Option<(Option<usize>, f32)>,

    camera: Camera,
    framed: bool,
    aspect: f32,
    insets: Insets,
    handedness_override: Option<Handedness>,
    up_axis_override: Option<UpAxis>,
    grid_visible: bool,
    theme: Theme,

    model_revision: u64,
    picture_revision: u64,
    events: Vec<Event>,
}

impl Session {
    /// Nothing open. Under `reduced_motion` a model waits on its first frame instead of playing.
    pub fn new(reduced_motion: bool) -> Self {
        Self {
            reduced_motion,
            aspect: 1.0,
            grid_visible: true,
            ..Self::default()
        }
    }

    /// The model on screen.
    pub fn open_model(&self) -> Option<&OpenModel> {
        self.open.as_ref()
    }

    /// Files of the last drop that had a model.
    pub fn files(&self) -> &FileSet {
        &self.files
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

    /// Whether time moves by itself.
    pub fn is_animating(&self) -> bool {
        // A clip of no length would loop on the spot for ever; playing it once still has to end.
        let has_length = self.playback.duration_secs() > 0.0 || self.playback.loop_mode() == LoopMode::Once;
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
        self.grid_visible
    }

    /// Counts models opened: another number, another model.
    pub fn model_revision(&self) -> u64 {
        self.model_revision
    }

    /// Counts changes of the picture: the same number, the same picture.
    pub fn picture_revision(&self) -> u64 {
        self.picture_revision
    }

    /// What happened since the last call, in order, each kind of a run once.
    pub fn take_events(&mut self) -> Vec<Event> {
        std::mem::take(&mut self.events)
    }

    /// Moves time by `dt_secs` while it plays.
    pub fn advance(&mut self, dt_secs: f32) {
        if !self.is_animating() {
            return;
        }
        let was_at = self.playback.time_secs();
        self.playback.advance(dt_secs);
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
        let world_from_model = world_from_model(self.handedness(), self.up_axis());
        let world_bounds = self.world_bounds();
        if let Some(open) = &self.open {
            let wanted = (self.clip, self.playback.time_secs());
            if self.posed_at != Some(wanted) {
                let skeleton = &open.model.skeleton;
                match self.clip.and_then(|clip| open.model.clips.get(clip)) {
                    Some(clip) => self.pose.evaluate(skeleton, clip, wanted.1),
                    None => self.pose.set_bind_pose(skeleton),
                }
                self.posed_at = Some(wanted);
            }
        }
        RenderFrame {
            camera: self.camera,
            world_from_model,
            world_bounds,
            palette: &self.pose.palette,
            options: FrameOptions {
                theme: self.theme,
                background: Background::Backdrop,
                grid_visible: self.grid_visible,
                normal_green_flipped: false,
            },
        }
    }

    /// Box of all that the clip reaches, world space.
    pub fn world_bounds(&mut self) -> Aabb {
        let world_from_model = world_from_model(self.handedness(), self.up_axis());
        let clip = self.clip;
        let bounds = self.open.as_mut().map(|open| open.extent(clip).0);
        bounds.unwrap_or_default().transformed(world_from_model)
    }

    /// Does what was asked. What makes no sense now is left undone.
    pub fn apply(&mut self, command: Command) -> Effect {
        let mut effect = Effect::default();
        let before = self.shown();
        match command {
            Command::AddFiles(files) => effect.model_replaced = self.add_files(files),
            Command::OpenFile(path) => effect.model_replaced = self.open_file(&path),
            Command::DismissError => self.error = None,

            Command::Play => self.set_playing(true),
            Command::Pause => self.set_playing(false),
            Command::TogglePlay => {
                let playing = !self.playback.is_playing();
                self.playback.set_backward(false);
                self.set_playing(playing);
            }
            Command::TogglePlayBackward => {
                let playing = !(self.playback.is_playing() && self.playback.is_backward());
                self.playback.set_backward(true);
                self.set_playing(playing);
            }
            Command::Seek { time_secs } => self.seek(time_secs),
            Command::StepFrames(frames) => self.step_frames(frames),
            Command::SeekStart => self.seek(f32::NEG_INFINITY),
            Command::SeekEnd => self.seek(f32::INFINITY),
            Command::BeginScrub => self.scrubbing = true,
            Command::EndScrub => self.scrubbing = false,
            Command::SelectClip(clip) => self.select_clip(clip),
            Command::CycleClip(places) => self.cycle_clip(places),
            Command::SetSpeed(speed) => self.playback.set_speed(speed),
            Command::Slower => self.step_speed(|speeds, speed| speeds.iter().rev().find(|&&s| s < speed - 1e-4)),
            Command::Faster => self.step_speed(|speeds, speed| speeds.iter().find(|&&s| s > speed + 1e-4)),
            Command::SetLoopMode(mode) => self.playback.set_loop_mode(mode),
            Command::CycleLoopMode => {
                let next = match self.playback.loop_mode() {
                    LoopMode::Once => LoopMode::Loop,
                    LoopMode::Loop => LoopMode::PingPong,
                    LoopMode::PingPong => LoopMode::Once,
                };
                self.playback.set_loop_mode(next);
            }

            Command::Orbit {
                yaw_radians,
                pitch_radians,
            } => self.camera.orbit(yaw_radians, pitch_radians),
            Command::Pan { drag } => {
                self.camera.pan(drag);
                self.framed = false;
            }
            Command::Zoom { factor, pointer } => self.zoom(factor, pointer),
            Command::FrameModel => self.frame_model(),
            Command::LookFrom(preset) => {
                self.camera.look_from(preset);
                self.frame_model();
            }
            Command::ToggleProjection => {
                self.camera.projection = match self.camera.projection {
                    Projection::Perspective { .. } => Projection::Orthographic,
                    Projection::Orthographic => Camera::default().projection,
                };
            }
            Command::ResetCamera => {
                self.camera = Camera::default();
                self.frame_model();
            }
            Command::SetViewport { aspect, insets } => {
                if (self.aspect, self.insets) != (aspect, insets) {
                    self.set_viewport(aspect, insets);
                }
            }

            Command::SetHandedness(handedness) => {
                self.handedness_override = handedness;
                self.frame_model();
            }
            Command::SetUpAxis(up_axis) => {
                self.up_axis_override = up_axis;
                self.frame_model();
            }
            Command::SetGridVisible(visible) => self.grid_visible = visible,
            Command::ToggleGrid => self.grid_visible = !self.grid_visible,
            Command::SetTheme(theme) => self.theme = theme,
        }
        if self.shown() != before {
            self.picture_revision += 1;
        }
        effect
    }

    fn shown(&self) -> Shown {
        Shown {
            model: self.model_revision,
            clip: self.clip,
            time_secs: self.playback.time_secs(),
            camera: self.camera,
            handedness: self.handedness(),
            up_axis: self.up_axis(),
            grid_visible: self.grid_visible,
            theme: self.theme,
        }
    }

    fn add_files(&mut self, files: Vec<File>) -> bool {
        let files = FileSet::new(files);
        let Some(path) = files.models().first().map(|file| file.path.clone()) else {
            self.fail(LoadError::no_model(files.files().len()));
            return false;
        };
        // The old set stays while the new model is not there: its other models can still be opened.
        let previous = std::mem::replace(&mut self.files, files);
        let opened = self.open_file(&path);
        if !opened {
            self.files = previous;
        }
        opened
    }

    fn open_file(&mut self, path: &str) -> bool {
        let Some(file) = self.files.get(path) else { return false };
        match load(file) {
            Ok(open) => {
                self.replace_model(open);
                true
            }
            Err(error) => {
                self.fail(*error);
                false
            }
        }
    }

    fn fail(&mut self, error: LoadError) {
        self.error = Some(error);
        self.note(Event::Error);
    }

    /// Shows another model. The same file again keeps camera, clip, time and choices.
    fn replace_model(&mut self, open: OpenModel) {
        let again = self
            .open
            .as_ref()
            .filter(|old| old.file.base_name() == open.file.base_name());
        let kept_clip = again.and_then(|_| Some(self.clip()?.name.clone()));
        let again = again.is_some();
        let was_playing = self.playback.is_playing();

        self.pose = PoseBuffers::for_skeleton(&open.model.skeleton);
        self.posed_at = None;
        self.error = None;
        // The bar that was held may be gone, and nothing would let go of the time.
        self.scrubbing = false;
        self.model_revision += 1;
        self.open = Some(open);
        if again {
            let time_secs = self.playback.time_secs();
            let clips = self
                .open
                .as_ref()
                .map(|open| open.model.clips.as_slice())
                .unwrap_or_default();
            let clip = kept_clip
                .and_then(|name| clips.iter().position(|clip| clip.name == name))
                .unwrap_or(0);
            self.clip = None;
            if self.show_clip(clip) {
                self.playback.seek(time_secs);
            } else {
                self.playback = Playback::default();
            }
        } else {
            self.handedness_override = None;
            self.up_axis_override = None;
            self.clip = None;
            self.playback = Playback::default();
            self.show_clip(0);
            self.camera = Camera {
                projection: self.camera.projection,
                ..Camera::default()
            };
            self.frame_model();
            if self.clip.is_some() && !self.reduced_motion {
                self.playback.play();
            }
        }
        self.note(Event::Load);
        if self.playback.is_playing() != was_playing {
            self.note(if was_playing { Event::Pause } else { Event::Play });
        }
        self.note(Event::TimeUpdate);
    }

    fn set_playing(&mut self, playing: bool) {
        if self.clip().is_none() || playing == self.playback.is_playing() {
            return;
        }
        let was_at = self.playback.time_secs();
        if playing {
            self.playback.play();
        } else {
            self.playback.pause();
        }
        self.note(if playing { Event::Play } else { Event::Pause });
        // What stood at its end begins anew.
        if self.playback.time_secs() != was_at {
            self.note(Event::TimeUpdate);
        }
    }

    fn seek(&mut self, time_secs: f32) {
        if self.clip().is_none() || time_secs.is_nan() {
            return;
        }
        let was_at = self.playback.time_secs();
        self.playback.seek(time_secs);
        if self.playback.time_secs() != was_at {
            self.note(Event::TimeUpdate);
        }
    }

    fn step_frames(&mut self, frames: i32) {
        let Some(clip) = self.clip() else { return };
        let time_secs = clip.step_frames(self.playback.time_secs(), frames);
        self.set_playing(false);
        self.seek(time_secs);
    }

    fn select_clip(&mut self, index: usize) {
        if self.clip != Some(index) && self.show_clip(index) {
            self.note(Event::TimeUpdate);
        }
    }

    /// Goes to a clip's first time; false when there is no such clip.
    fn show_clip(&mut self, index: usize) -> bool {
        let Some(clip) = self.open.as_ref().and_then(|open| open.model.clips.get(index)) else {
            return false;
        };
        self.playback.set_range(clip.start_secs, clip.end_secs);
        self.playback.seek(if self.playback.is_backward() {
            clip.end_secs
        } else {
            clip.start_secs
        });
        self.clip = Some(index);
        true
    }

    fn cycle_clip(&mut self, places: i32) {
        let count = self.open.as_ref().map_or(0, |open| open.model.clips.len());
        if let (Some(clip), true) = (self.clip, count > 0) {
            self.select_clip((clip as i64 + i64::from(places)).rem_euclid(count as i64) as usize);
        }
    }

    fn step_speed(&mut self, pick: impl Fn(&'static [f32], f32) -> Option<&'static f32>) {
        if let Some(&speed) = pick(&SPEEDS, self.playback.speed()) {
            self.playback.set_speed(speed);
        }
    }

    fn zoom(&mut self, factor: f32, pointer: glam::Vec2) {
        let radius = self.world_bounds().radius().max(1e-6);
        // Neither through the model nor so far that it is a dot.
        let distance = (self.camera.distance * factor).clamp(radius * 1e-2, radius * 100.0);
        self.camera.zoom(distance / self.camera.distance, pointer);
        self.framed = false;
    }

    fn frame_model(&mut self) {
        let world_from_model = world_from_model(self.handedness(), self.up_axis());
        if let Some(open) = &mut self.open {
            let (_, points) = open.extent(self.clip);
            let world_points: Vec<_> = points
                .iter()
                .map(|&point| world_from_model.transform_point3(point))
                .collect();
            // A figure stands in the middle of the window; only what would reach under the panels beside it makes way.
            let centered = Insets {
                left: 0.0,
                right: 0.0,
                ..self.insets
            };
            self.camera.frame(&world_points, self.aspect, centered);
            let (left, right) = self.camera.free_at_sides(&world_points, self.aspect);
            if left < self.insets.left || right < self.insets.right {
                self.camera.frame(&world_points, self.aspect, self.insets);
            }
        }
        self.framed = true;
    }

    /// A model that nobody panned or zoomed stays framed in a picture of another shape. A shape that is none is left out.
    fn set_viewport(&mut self, aspect: f32, insets: Insets) {
        let Insets {
            left,
            right,
            top,
            bottom,
        } = insets;
        if !(aspect.is_finite() && aspect > 0.0 && [left, right, top, bottom].into_iter().all(f32::is_finite)) {
            return;
        }
        (self.aspect, self.insets) = (aspect, insets);
        if self.framed {
            self.frame_model();
        }
    }

    fn note(&mut self, event: Event) {
        if self.events.last() != Some(&event) {
            self.events.push(event);
        }
    }
}

/// All that the picture depends on, but for its size.
#[derive(PartialEq)]
struct Shown {
    model: u64,
    clip: Option<usize>,
    time_secs: f32,
    camera: Camera,
    handedness: Handedness,
    up_axis: UpAxis,
    grid_visible: bool,
    theme: Theme,
}
