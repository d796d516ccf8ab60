//! What is open and how it is looked at. Commands change it, time moves it, a [`RenderFrame`](crate::scene::RenderFrame) comes out.
//!
//! The parts know nothing of the session: each takes what it needs of the others as arguments, so it can be read and tested on its own.
//! What needs several parts is a method of `Session`, in a file named by what it is about.

mod apply;
mod changes;
mod choose;
mod command;
mod event;
#[doc(hidden)]
pub mod for_tests;
mod history;
mod look;
mod open;
mod play;
mod published;
mod write;

pub use crate::import::FileFormat;
pub use changes::Changes;
pub use choose::joint_rows::JointRow;
pub use choose::joints::{Joints, SelectedVertex};
pub use choose::naming::NameCommand;
pub use choose::selecting::{JointCommand, SubmeshCommand};
pub use choose::submeshes::Submeshes;
pub use command::Command;
pub use event::{Event, News};
pub use history::{History, HistoryCommand};
pub use look::camera::CameraCommand;
pub use look::materials::{MAX_SPEC_POWER, MaterialCommand};
pub use look::quality::{
    Lowered, MOST_SAMPLES, PassChoice, PassState, Quality, QualityCommand, QualityMode, RenderScale,
};
pub use look::skeleton_cache::SkinColorsKey;
pub use look::{Look, LookCommand, MAX_EXPOSURE_STOPS, MAX_GROUND_OFFSET, MAX_LINE_LENGTH};
pub use open::files::{FILE_KINDS, File, FileKind, FileSet};
pub use open::load::{LoadError, load, load_beside};
pub use open::maps::{Maps, UnreadableMap, UsedMap};
pub use open::open_model::{ClipSummary, OpenModel};
pub use open::opening::{BeingOpened, FileCommand};
pub use open::textures::{
    Checklist, FoundMap, MapNames, MapSource, MaterialMaps, find_map, find_maps, map_diagnostics, named_maps,
};
pub use play::crowd::CrowdCommand;
pub use play::instances::{CrowdState, MAX_CROWD};
pub use play::mixer::{Blend, DEFAULT_CROSSFADE_SECS, MAX_CROSSFADE_SECS};
pub use play::playing::PlayCommand;
pub use published::handing_over::HandedOver;
pub use published::link::{Link, Linked, MAX_LINK_LEN};
pub use published::link_fields::names as link_names;
pub use published::series::Series;
pub use published::summary;
pub use published::verdicts::limits_once_converted;
pub use published::view_state::{AppearanceState, CameraState, PlaybackState, SelectionState, ViewState};
pub use write::export::{Export, ExportCommand, ExportOptions, ExportRange};
pub use write::export_job::{
    ExportFormat, ExportJob, ExportRefusal, ExportedFile, PlannedExport, ToExport, WrittenModel,
};
pub use write::export_plan::ExportPlan;

use changes::Revisions;
use choose::picking::Picker;
pub use look::overlays::GHOSTS_SRGB;
use look::overlays::OverlayCache;
use look::skeleton_cache::SkeletonCache;
use look::view::View;
use open::content::Content;
use open::underway::Opening;
use play::actor::Actor;
use play::crowd_cache::CrowdCache;
use play::instances::Instances;
use write::export::Exporting;

use std::sync::Arc;

use crate::anim::Playback;
use crate::image::Image;
use crate::model::{Clip, Material};
use crate::scene::{Aabb, FrameCost, FrameOptions, Overlay, Theme};

/// Speeds of the slower and faster keys.
pub const SPEEDS: [f32; 10] = [0.05, 0.1, 0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 2.0, 4.0];

/// The viewer's state, without window, clock or GPU.
///
/// Each part can be borrowed on its own: a function that needs three parts takes three.
#[derive(Clone, Debug, Default)]
pub struct Session {
    content: Content,
    /// What will be open next.
    opening: Opening,
    /// The selected instance of the model.
    actor: Actor,
    instances: Instances,
    view: View,
    selection: Selection,
    quality: Quality,
    /// Of the frame that was drawn last.
    cost: FrameCost,
    history: History,
    exporting: Exporting,
    /// Made from the parts above, and from nothing else.
    caches: Caches,
    revisions: Revisions,
    events: Vec<Event>,
    news: Vec<News>,
    reduced_motion: bool,
    /// The session as it was when the GPU last took all of it, until it has taken what is open now.
    before: Option<Box<Self>>,
}

#[derive(Clone, Debug, Default)]
struct Selection {
    submeshes: Submeshes,
    joints: Joints,
}

/// Buffers that are kept from frame to frame, each with what it was filled for. A copy of a session fills its own.
#[derive(Debug, Default)]
struct Caches {
    picker: Picker,
    skeleton: SkeletonCache,
    overlays: OverlayCache,
    crowd: CrowdCache,
}

impl Clone for Caches {
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl Session {
    /// Nothing open. Under `reduced_motion` a model waits on its first frame instead of playing.
    pub fn new(reduced_motion: bool) -> Self {
        Self {
            reduced_motion,
            ..Self::default()
        }
    }

    /// Whether the person asked for less motion.
    pub fn reduced_motion(&self) -> bool {
        self.reduced_motion
    }

    /// Closes what is open and forgets what was chosen; only the shape of the window and its theme stay. Revisions go on counting,
    /// so that no cache is used for what opens next.
    pub fn start_over(&mut self, reduced_motion: bool) {
        let mut new = Self::new(reduced_motion);
        new.view.aspect = self.view.aspect;
        new.view.insets = self.view.insets;
        new.view.theme = self.view.theme;
        new.revisions = self.revisions;
        new.revisions.beginnings += 1;
        new.opening = std::mem::take(&mut self.opening);
        new.quality = self.quality.on_same_device();
        *self = new;
        self.commit(Changes::CONTENT);
    }

    /// The model on screen.
    pub fn open_model(&self) -> Option<&OpenModel> {
        self.content.open.as_deref()
    }

    /// The files that the model on screen came with.
    pub fn files(&self) -> &FileSet {
        &self.content.files
    }

    /// What was mended or is worth knowing about the model on screen, its maps and the sky.
    pub fn diagnostics(&self) -> impl Iterator<Item = &crate::diagnostic::Diagnostic> {
        self.content.diagnostics()
    }

    /// Maps of the model on screen.
    pub fn maps(&self) -> &Maps {
        &self.content.maps
    }

    /// Why the last load failed, until it is dismissed or another load succeeds.
    pub fn error(&self) -> Option<&LoadError> {
        self.content.error.as_ref()
    }

    /// Index of the clip on show.
    pub fn clip_index(&self) -> Option<usize> {
        self.actor.player.clip
    }

    /// The clip on show.
    pub fn clip(&self) -> Option<&Clip> {
        self.content.clips().get(self.actor.player.clip?)
    }

    /// Where playing is.
    pub fn playback(&self) -> &Playback {
        &self.actor.player.playback
    }

    /// Whether the pointer holds the time.
    pub fn is_scrubbing(&self) -> bool {
        self.actor.scrubbing
    }

    /// Whether time moves by itself. The camera may move too: [`Session::is_moving`].
    pub fn is_animating(&self) -> bool {
        let another_goes = || self.instances.others().any(|(_, player)| player.has_way());
        self.actor.is_animating() || (self.actor.plays() && another_goes())
    }

    /// Whether the ground grid is drawn.
    pub fn grid_visible(&self) -> bool {
        self.view.look.overlays.has(Overlay::Grid)
    }

    /// Which costly passes are drawn.
    pub fn quality(&self) -> &Quality {
        &self.quality
    }

    /// Whether something on screen moves by itself, be it the clip, a fade between clips or the camera: then another frame is due.
    pub fn is_moving(&self) -> bool {
        self.is_animating() || self.is_fading() || self.is_camera_moving()
    }

    /// A pass of the window begins, `dt_secs` after the one before. That is how long a frame took if the pass before drew one and
    /// [`Session::frame_drawn`] told it to go on at once; any other time is a pause, and says nothing of the device.
    pub fn begin_pass(&mut self, dt_secs: f32) {
        self.track(|session| session.quality.begin_pass(dt_secs));
    }

    /// The window is about to draw: what moves is drawn with the detail that the device keeps up with, what rests with all.
    pub fn follow_motion(&mut self) {
        let (moves, has_crowd) = (self.is_in_motion(), self.instances.are_many());
        self.track(|session| session.quality.follow(moves, has_crowd));
    }

    /// The window drew the picture. Returns whether it moves, by itself or under a pointer that holds the camera or the time: the next
    /// pass is then to begin at once, so that the time until it is what the frame took and not how long the pointer rested.
    pub fn frame_drawn(&mut self, cost: FrameCost) -> bool {
        self.cost = cost;
        let moves = self.is_in_motion();
        self.quality.frame_drawn(moves, &cost);
        moves
    }

    /// What the frame that was drawn last cost.
    pub fn frame_cost(&self) -> FrameCost {
        self.cost
    }

    fn is_in_motion(&self) -> bool {
        self.is_moving() || self.view.motion.is_held() || self.is_scrubbing()
    }

    /// The dark or the light theme.
    pub fn theme(&self) -> Theme {
        self.view.theme
    }

    /// How the model is looked at.
    pub fn look(&self) -> &Look {
        &self.view.look
    }

    /// What of the view a renderer is told.
    fn frame_options(&self) -> FrameOptions {
        self.view.frame_options(&self.quality)
    }

    /// The cube map that is the sky.
    pub fn sky(&self) -> Option<&Arc<Image>> {
        self.content.sky.image()
    }

    /// The file of the sky.
    pub fn sky_file(&self) -> Option<&File> {
        self.content.sky.file()
    }

    /// Cube maps that came and can be the sky, in their order. [`FileCommand::UseSky`] takes one of them.
    pub fn skies(&self) -> &[File] {
        &self.content.sky.found
    }

    /// Counts changes of the sky: another number, another sky.
    pub fn sky_revision(&self) -> u64 {
        self.revisions.sky
    }

    /// The materials of the model on screen as they are drawn: the file's, but for what was edited.
    pub fn materials(&self) -> &[Material] {
        self.content.materials.drawn()
    }

    /// The name of a submesh: that of its material, with a number where several have the same.
    pub fn submesh_name(&self, submesh: usize) -> &str {
        let open = self.content.open.as_ref();
        let name = open.and_then(|open| open.submesh_names.get(submesh));
        name.map_or("", String::as_str)
    }

    /// Whether a material is another one than the file's.
    pub fn is_edited(&self, material: usize) -> bool {
        let of_file = self
            .content
            .open
            .as_ref()
            .and_then(|open| open.model.materials.get(material));
        self.content.materials.get(material) != of_file
    }

    /// Counts changes of the materials, those by another model included.
    pub fn materials_revision(&self) -> u64 {
        self.revisions.materials
    }

    /// Counts changes of which clips are under which indices, but for clips that join at the end: another number, other clips.
    pub fn clips_revision(&self) -> u64 {
        self.revisions.clips
    }

    /// Counts models opened: another number, another model.
    pub fn model_revision(&self) -> u64 {
        self.revisions.model
    }

    /// Counts changes of the maps: another number, other maps.
    pub fn maps_revision(&self) -> u64 {
        self.revisions.maps
    }

    /// Counts changes of the model, its light and its ground: the same number, the same picture but for what lies over it.
    pub fn scene_revision(&self) -> u64 {
        self.revisions.scene
    }

    /// Counts changes of the picture: the same number, the same picture.
    pub fn picture_revision(&self) -> u64 {
        self.revisions.picture
    }

    /// What happened since the last call, in order, each kind of a run once.
    pub fn take_events(&mut self) -> Vec<Event> {
        self.events.drain(..).collect()
    }

    /// What commands about files did out of sight since the last call, in order.
    pub fn take_news(&mut self) -> Vec<News> {
        std::mem::take(&mut self.news)
    }

    /// Moves time by `dt_secs` while it plays, and the camera while it moves.
    pub fn advance(&mut self, dt_secs: f32) -> Changes {
        self.track(|session| {
            session.advance_camera(dt_secs);
            let is_animating = session.is_animating();
            let (was_at, was_playing) = (session.playback().time_secs(), session.playback().is_playing());
            session.actor.advance(dt_secs);
            if is_animating {
                session.instances.advance(dt_secs);
                session.view.look.advance(dt_secs);
            }
            if session.playback().time_secs() != was_at {
                session.note(Event::TimeUpdate);
            }
            if was_playing && !session.playback().is_playing() {
                session.instances.set_playing(false);
                session.note(Event::Pause);
            }
        })
    }

    /// Box of all that the clips in the pose reach, world space; with the bind pose in it while the pose is brought there. In a crowd
    /// it holds all that any instance reaches.
    pub fn world_bounds(&self) -> Aabb {
        let selected = self.selected_bounds();
        if self.instances.are_many() {
            selected.union(self.instances.bounds(&self.formation()))
        } else {
            selected
        }
    }

    fn note(&mut self, event: Event) {
        if self.events.last() != Some(&event) {
            self.events.push(event);
        }
    }
}
