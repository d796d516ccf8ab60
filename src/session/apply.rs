//! The one place where things change.

use super::pose::OnShow;
use super::{Command, Effect, Event, Look, Session};
use crate::anim::{GhostPlan, LoopMode, WrapMode};
use crate::model::{Handedness, UpAxis};
use crate::scene::{Camera, Passes, Projection, Theme};

impl Session {
    /// Does what was asked. What makes no sense now is left undone.
    pub fn apply(&mut self, command: Command) -> Effect {
        let (before, played) = (self.shown(), self.played());
        let to_go_back_to = match command {
            Command::AddFiles(_) | Command::AddClips(_) | Command::OpenFile(_) => self.to_go_back_to(),
            _ => None,
        };
        let uploads = self.uploads();
        let effect = self.perform(command);
        if self.uploads() != uploads && to_go_back_to.is_some() {
            self.before = to_go_back_to;
        }
        let now = self.played();
        // Another model is an event of its own.
        if now != played && now.model == played.model {
            self.note(Event::PlaybackChange);
        }
        if self.shown() != before {
            self.picture_revision += 1;
        }
        effect
    }

    pub(super) fn perform(&mut self, command: Command) -> Effect {
        let mut effect = Effect::default();
        match command {
            Command::AddFiles(files) => effect.model_replaced = self.add_files(files),
            Command::AddClips(files) => effect.model_replaced = self.add_clips(files),
            Command::OpenFile(path) => effect.model_replaced = self.open_file(&path),
            Command::ClearSky => self.clear_sky(),
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
            Command::SeekFrame(frame) => self.seek_frame(frame),
            Command::StepKey { direction, joint } => self.step_key(direction, joint),
            Command::SeekStart => self.seek(self.playback.played_secs()[0]),
            Command::SeekEnd => self.seek(self.playback.played_secs()[1]),
            Command::SetRangeStart(secs) => {
                let secs = secs.unwrap_or(self.playback.time_secs());
                self.playback.set_range_start(secs);
            }
            Command::SetRangeEnd(secs) => {
                let secs = secs.unwrap_or(self.playback.time_secs());
                self.playback.set_range_end(secs);
            }
            Command::ClearRange => self.playback.clear_range(),
            Command::BeginScrub => self.scrubbing = true,
            Command::EndScrub => self.scrubbing = false,
            Command::SelectClip(clip) => self.select_clip(clip),
            Command::CycleClip(places) => self.cycle_clip(places),
            Command::SetCrossfade(secs) => self.set_crossfade(secs),
            Command::SetBlend { clip, share } => self.set_blend(clip, share),
            Command::ClearBlend => self.clear_blend(),
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
            Command::SetWrapMode(mode) => self.playback.set_wrap_mode(mode),

            Command::Orbit {
                yaw_radians,
                pitch_radians,
            } => {
                self.motion.interrupt();
                self.camera.orbit(yaw_radians, pitch_radians);
            }
            Command::Pan { drag } => {
                self.motion.interrupt();
                self.camera.pan(drag);
                self.framed = false;
            }
            Command::Zoom { factor, pointer } => {
                self.motion.interrupt();
                self.zoom(factor, pointer);
            }
            Command::FrameModel => {
                self.motion.interrupt();
                self.frame_model();
            }
            Command::FrameSelection => {
                self.motion.interrupt();
                self.frame_selection();
            }
            Command::LookFrom(preset) => {
                self.motion.interrupt();
                self.camera.look_from(preset);
                self.frame_model();
            }
            Command::ToggleProjection => self.change_goal(|session| {
                session.camera.projection = match session.camera.projection {
                    Projection::Perspective { .. } => Projection::Orthographic,
                    Projection::Orthographic => Camera::default().projection,
                };
            }),
            Command::ResetCamera => {
                self.motion.interrupt();
                self.camera = Camera::default();
                self.frame_model();
            }
            Command::Glide(command) => effect = self.glide(*command),
            Command::BeginDrag => self.motion.hold(true),
            Command::EndDrag => self.motion.hold(false),
            Command::Fling {
                yaw_radians_per_sec,
                pitch_radians_per_sec,
            } if !self.reduced_motion => self.motion.fling(yaw_radians_per_sec, pitch_radians_per_sec),
            Command::Fling { .. } => {}
            Command::SetTurntable(turns) => self.motion.set_turntable(turns),
            Command::ToggleTurntable => self.motion.set_turntable(!self.turntable()),
            Command::Fly { direction, fast } => self.motion.fly(direction, fast),
            Command::FlyLook {
                yaw_radians,
                pitch_radians,
            } => {
                self.motion.interrupt();
                self.camera.look_around(yaw_radians, pitch_radians);
                self.framed = false;
            }
            Command::SetViewport { aspect, insets } => {
                if (self.aspect, self.insets) != (aspect, insets) {
                    self.change_goal(|session| session.set_viewport(aspect, insets));
                }
            }

            Command::SetHandedness(handedness) => {
                self.handedness_override = handedness;
                self.change_goal(Self::frame_model);
            }
            Command::SetUpAxis(up_axis) => {
                self.up_axis_override = up_axis;
                self.change_goal(Self::frame_model);
            }
            Command::Subset(command) => {
                self.apply_to_subsets(command);
                if self.subsets.selected().is_some() {
                    self.joints.let_go();
                }
            }
            Command::Joint(command) => {
                self.apply_to_joints(command);
                if self.joints.selected().is_some() || self.joints.selected_vertex().is_some() {
                    self.subsets.select(None, None);
                }
            }
            Command::SelectAt(pointer) => self.select_at(pointer),
            Command::SetBindShare(share) => self.set_bind_share(share),
            Command::ToggleBindPose => self.set_bind_share(if self.bind_share < 0.5 { 1.0 } else { 0.0 }),
            Command::EditMaterial { index, material } => self.materials.edit(index, &material),
            Command::ResetMaterial(material) => self.reset_material(material),
            Command::SetGhosts(plan) => self.overlaid.set_ghosts(plan),
            Command::SetBindGhost(visible) => self.overlaid.set_bind_ghost(visible),
            Command::Look(command) => self.look.apply(command),
            Command::SetPass(pass, choice) => self.quality.choose(pass, choice),
            Command::SetRenderScale(scale) => self.quality.render_scale = scale,
            Command::SetTheme(theme) => self.theme = theme,
        }
        effect
    }

    fn played(&self) -> Played {
        Played {
            model: self.model_revision,
            clips: self.clips_revision,
            clip_count: self.open.as_ref().map_or(0, |open| open.model.clips.len()),
            clip: self.clip,
            range_secs: self.playback.range_secs(),
            speed: self.playback.speed(),
            loop_mode: self.playback.loop_mode(),
            wrap_mode: self.playback.wrap_mode(),
        }
    }

    fn shown(&self) -> Shown {
        Shown {
            model: self.model_revision,
            maps: self.maps_revision,
            sky: self.sky.revision(),
            materials: self.materials.revision(),
            subsets: self.subsets.drawn_revision(),
            joints: self.joints.drawn_revision(),
            ghosts: (self.ghost_plan(), self.bind_ghost()),
            pose: self.on_show(),
            camera: self.camera,
            handedness: self.handedness(),
            up_axis: self.up_axis(),
            look: self.look,
            passes: self.quality.passes(),
            theme: self.theme,
        }
    }
}

/// What plays, and how.
#[derive(PartialEq)]
struct Played {
    model: u64,
    clips: u64,
    clip_count: usize,
    clip: Option<usize>,
    range_secs: Option<[f32; 2]>,
    speed: f32,
    loop_mode: LoopMode,
    wrap_mode: WrapMode,
}

/// All that the picture depends on, but for its size.
#[derive(PartialEq)]
struct Shown {
    model: u64,
    maps: u64,
    sky: u64,
    materials: u64,
    subsets: u64,
    joints: u64,
    ghosts: (Option<GhostPlan>, bool),
    pose: OnShow,
    camera: Camera,
    handedness: Handedness,
    up_axis: UpAxis,
    look: Look,
    passes: Passes,
    theme: Theme,
}
