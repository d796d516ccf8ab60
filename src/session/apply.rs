//! The one place where things change.

use super::{Command, Effect, Look, Session};
use crate::anim::LoopMode;
use crate::model::{Handedness, UpAxis};
use crate::scene::{Camera, Passes, Projection, Theme};

impl Session {
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
            Command::Look(command) => self.look.apply(command),
            Command::SetPass(pass, choice) => self.quality.choose(pass, choice),
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
            maps: self.maps_revision,
            clip: self.clip,
            time_secs: self.playback.time_secs(),
            camera: self.camera,
            handedness: self.handedness(),
            up_axis: self.up_axis(),
            look: self.look,
            passes: self.quality.passes(),
            theme: self.theme,
        }
    }
}

/// All that the picture depends on, but for its size.
#[derive(PartialEq)]
struct Shown {
    model: u64,
    maps: u64,
    clip: Option<usize>,
    time_secs: f32,
    camera: Camera,
    handedness: Handedness,
    up_axis: UpAxis,
    look: Look,
    passes: Passes,
    theme: Theme,
}
