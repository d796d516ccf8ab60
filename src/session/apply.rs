//! The one place where things change.

use super::actor::{PlaybackSettings, PoseInputs};
use super::content::Content;
use super::view::View;
use super::{Blend, Changes, Command, Event, Session};
use crate::anim::LoopMode;
use crate::model::{Handedness, Material, UpAxis};
use crate::scene::{Camera, Passes, Projection};

impl Session {
    /// Does what was asked, and tells what changed. What makes no sense now is left undone.
    pub fn apply(&mut self, command: Command) -> Changes {
        let to_go_back_to = match command {
            Command::AddFiles(_) | Command::AddClips(_) | Command::OpenFile(_) => self.to_go_back_to(),
            _ => None,
        };
        let changes = self.track(|session| session.perform(command));
        if changes.need_upload() && to_go_back_to.is_some() {
            self.before = to_go_back_to;
        }
        // Another model is an event of its own.
        if changes.playback && !changes.model {
            self.note(Event::PlaybackChange);
        }
        changes
    }

    pub(super) fn perform(&mut self, command: Command) {
        match command {
            Command::AddFiles(files) => self.add_files(files),
            Command::AddClips(files) => self.add_clips(files),
            Command::OpenFile(path) => self.open_file(&path),
            Command::ClearSky => self.clear_sky(),
            Command::DismissError => self.content.error = None,

            Command::Play => self.set_playing(true),
            Command::Pause => self.set_playing(false),
            Command::TogglePlay => {
                let playing = !self.actor.playback.is_playing();
                self.actor.playback.set_backward(false);
                self.set_playing(playing);
            }
            Command::TogglePlayBackward => {
                let playing = !(self.actor.playback.is_playing() && self.actor.playback.is_backward());
                self.actor.playback.set_backward(true);
                self.set_playing(playing);
            }
            Command::Seek { time_secs } => self.seek(time_secs),
            Command::StepFrames(frames) => self.step_frames(frames),
            Command::SeekFrame(frame) => self.seek_frame(frame),
            Command::StepKey { direction, joint } => self.step_key(direction, joint),
            Command::SeekStart => self.seek(self.actor.playback.played_secs()[0]),
            Command::SeekEnd => self.seek(self.actor.playback.played_secs()[1]),
            Command::SetRangeStart(secs) => {
                let secs = secs.unwrap_or(self.actor.playback.time_secs());
                self.actor.playback.set_range_start(secs);
            }
            Command::SetRangeEnd(secs) => {
                let secs = secs.unwrap_or(self.actor.playback.time_secs());
                self.actor.playback.set_range_end(secs);
            }
            Command::ClearRange => self.actor.playback.clear_range(),
            Command::BeginScrub => self.actor.scrubbing = true,
            Command::EndScrub => self.actor.scrubbing = false,
            Command::SelectClip(clip) => self.select_clip(clip),
            Command::CycleClip(places) => self.cycle_clip(places),
            Command::SetCrossfade(secs) => self.actor.mixer.set_crossfade(secs),
            Command::SetBlend { clip, weight } => {
                self.actor.set_blend(Blend { clip, weight }, self.content.clip_count());
            }
            Command::ClearBlend => self.actor.mixer.set_blend(None),
            Command::SetSpeed(speed) => self.actor.playback.set_speed(speed),
            Command::Slower => self.step_speed(|speeds, speed| speeds.iter().rev().find(|&&s| s < speed - 1e-4)),
            Command::Faster => self.step_speed(|speeds, speed| speeds.iter().find(|&&s| s > speed + 1e-4)),
            Command::SetLoopMode(mode) => self.actor.playback.set_loop_mode(mode),
            Command::CycleLoopMode => {
                let next = match self.actor.playback.loop_mode() {
                    LoopMode::Once => LoopMode::Loop,
                    LoopMode::Loop => LoopMode::PingPong,
                    LoopMode::PingPong => LoopMode::Once,
                };
                self.actor.playback.set_loop_mode(next);
            }
            Command::SetWrapMode(mode) => self.actor.playback.set_wrap_mode(mode),

            Command::Orbit {
                yaw_radians,
                pitch_radians,
            } => {
                self.view.motion.interrupt();
                self.view.camera.orbit(yaw_radians, pitch_radians);
            }
            Command::Pan { drag } => {
                self.view.motion.interrupt();
                self.view.camera.pan(drag);
                self.view.framed = false;
            }
            Command::Zoom { factor, pointer } => {
                self.view.motion.interrupt();
                self.zoom(factor, pointer);
            }
            Command::FrameModel => {
                self.view.motion.interrupt();
                self.frame_model();
            }
            Command::FrameSelection => {
                self.view.motion.interrupt();
                self.frame_selection();
            }
            Command::LookFrom(preset) => {
                self.view.motion.interrupt();
                self.view.camera.look_from(preset);
                self.frame_model();
            }
            Command::ToggleProjection => self.change_goal(|session| {
                session.view.camera.projection = match session.view.camera.projection {
                    Projection::Perspective { .. } => Projection::Orthographic,
                    Projection::Orthographic => Camera::default().projection,
                };
            }),
            Command::ResetCamera => {
                self.view.motion.interrupt();
                self.view.camera = Camera::default();
                self.frame_model();
            }
            Command::Glide(command) => self.glide(*command),
            Command::BeginDrag => self.view.motion.hold(true),
            Command::EndDrag => self.view.motion.hold(false),
            Command::Fling {
                yaw_radians_per_sec,
                pitch_radians_per_sec,
            } if !self.reduced_motion => self.view.motion.fling(yaw_radians_per_sec, pitch_radians_per_sec),
            Command::Fling { .. } => {}
            Command::SetTurntable(turns) => self.view.motion.set_turntable(turns),
            Command::ToggleTurntable => self.view.motion.set_turntable(!self.turntable()),
            Command::Fly { direction, fast } => self.view.motion.fly(direction, fast),
            Command::FlyLook {
                yaw_radians,
                pitch_radians,
            } => {
                self.view.motion.interrupt();
                self.view.camera.look_around(yaw_radians, pitch_radians);
                self.view.framed = false;
            }
            Command::SetViewport { aspect, insets } => {
                if (self.view.aspect, self.view.insets) != (aspect, insets) {
                    self.change_goal(|session| session.set_viewport(aspect, insets));
                }
            }

            Command::SetHandedness(handedness) => {
                self.view.handedness = handedness;
                self.change_goal(Self::frame_model);
            }
            Command::SetUpAxis(up_axis) => {
                self.view.up_axis = up_axis;
                self.change_goal(Self::frame_model);
            }
            Command::Subset(command) => {
                self.apply_to_subsets(command);
                if self.selection.subsets.selected().is_some() {
                    self.selection.joints.clear_selection();
                }
            }
            Command::Joint(command) => {
                self.apply_to_joints(command);
                if self.selection.joints.selected().is_some() || self.selection.joints.selected_vertex().is_some() {
                    self.selection.subsets.select(None, None);
                }
            }
            Command::SelectAt(pointer) => self.select_at(pointer),
            Command::SetBindWeight(weight) => self.actor.set_bind_weight(weight),
            Command::ToggleBindPose => {
                let weight = if self.actor.bind_weight < 0.5 { 1.0 } else { 0.0 };
                self.actor.set_bind_weight(weight);
            }
            Command::EditMaterial { index, material } => self.edit_material(index, &material),
            Command::ResetMaterial(material) => self.reset_material(material),
            Command::SetGhosts(plan) => self.view.set_ghosts(plan),
            Command::SetBindGhost(visible) => self.view.bind_ghost = visible,
            Command::Look(command) => self.view.look.apply(command),
            Command::SetPass(pass, choice) => self.quality.choose(pass, choice),
            Command::SetRenderScale(scale) => self.quality.render_scale = scale,
            Command::SetTheme(theme) => self.view.theme = theme,
            Command::Restore(state) => self.restore(&state),
        }
    }
}

/// The parts of a session that are small enough to be compared: whatever of them a command changes, and in whatever way, is
/// noticed. What is large (model, maps, sky, materials) and what is changed in few places notes its changes by itself.
struct Before {
    view: View,
    /// How the model stands in the world.
    space: (Handedness, UpAxis),
    pose: PoseInputs,
    settings: PlaybackSettings,
    clip_count: usize,
    passes: Passes,
}

impl Session {
    fn before(&self) -> Before {
        Before {
            view: self.view.clone(),
            space: (self.handedness(), self.up_axis()),
            pose: self.actor.pose_inputs(),
            settings: self.actor.settings(),
            clip_count: self.content.clip_count(),
            passes: self.quality.passes(),
        }
    }

    /// What is different from before, and what the parts noted.
    fn changes_since(&mut self, before: &Before) -> Changes {
        let mut changes = self.content.changes.take();
        changes |= self.selection.joints.take_changes();
        changes.picture |= self.selection.subsets.take_redraw();
        changes.pose |= self.actor.mixer.take_changed() || self.actor.pose_inputs() != before.pose;
        changes.playback |=
            changes.clips || self.actor.settings() != before.settings || self.content.clip_count() != before.clip_count;
        changes.picture |= changes.pose
            || changes.maps
            || changes.materials
            || changes.sky
            || (self.handedness(), self.up_axis()) != before.space
            || self.quality.passes() != before.passes
            || !self.view.shows_the_same_as(&before.view);
        changes
    }

    /// Counts changes, so that whoever keeps something that was made from what they are about makes it again.
    pub(super) fn commit(&mut self, changes: Changes) {
        self.revisions.count(changes);
    }

    /// Does something, and counts what it changed.
    pub(super) fn track(&mut self, act: impl FnOnce(&mut Self)) -> Changes {
        let before = self.before();
        act(self);
        let changes = self.changes_since(&before);
        self.commit(changes);
        changes
    }

    fn edit_material(&mut self, index: usize, wanted: &Material) {
        let Content { materials, changes, .. } = &mut self.content;
        changes.materials |= materials.edit(index, wanted);
    }

    fn reset_material(&mut self, index: usize) {
        let Content {
            open,
            materials,
            changes,
            ..
        } = &mut self.content;
        if let Some(open) = open {
            changes.materials |= materials.reset(index, &open.model.materials);
        }
    }
}
