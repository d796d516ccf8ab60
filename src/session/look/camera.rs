//! From where the model is seen: turning, zooming, gliding, flying.

use glam::{Vec2, Vec3};

use super::view::{Framed, View};
use crate::model::{Handedness, UpAxis};
use crate::scene::{Camera, Insets, Projection, ViewPreset};
use crate::session::Session;

/// Flight ends this far from the scene's middle, in radii of the scene: where zooming ends too.
const FARTHEST_RADII: f32 = 100.0;

/// Directions that differ by less, as unit vectors, are the same: a hundredth of what a key turns the camera by.
const LOOKS_FROM_TOLERANCE: f32 = 1e-3;

/// A command about the camera.
#[derive(Clone, Debug, PartialEq)]
pub enum CameraCommand {
    Orbit {
        /// Positive moves the eye to its left.
        yaw_radians: f32,
        /// Positive lifts the eye.
        pitch_radians: f32,
    },
    Pan {
        /// Fractions of the picture's height, x right, y down.
        drag: Vec2,
    },
    /// Comes nearer (factor below 1) to what is under the pointer.
    Zoom {
        /// Factor of the distance.
        factor: f32,
        /// Fractions of the picture's height from its centre, x right, y down.
        pointer: Vec2,
    },
    /// Frames all that the clip reaches; those of all instances in a crowd.
    FrameModel,
    /// Frames what is selected as it is posed now: what a joint moves, the neighbourhood of a vertex, or a submesh. When nothing of it
    /// is selected, all that the clip of the selected instance reaches.
    FrameSelection,
    /// Looks from a named direction and frames.
    LookFrom(ViewPreset),
    /// Perspective or orthographic.
    ToggleProjection,
    Reset,
    /// Applies another command, but where the camera would jump, it moves there within a quarter of a second. Under reduced
    /// motion it jumps.
    Glide(Box<CameraCommand>),
    /// The pointer takes hold of the camera: glides and flings end, and the turntable waits until [`CameraCommand::EndDrag`].
    BeginDrag,
    EndDrag,
    /// Goes on turning after a drag, slower and slower. Does nothing under reduced motion.
    Fling {
        /// Rate of [`CameraCommand::Orbit`]'s yaw when the pointer let go, radians a second.
        yaw_radians_per_sec: f32,
        pitch_radians_per_sec: f32,
    },
    /// Starts or stops turning the camera about the model, once in twelve seconds.
    SetTurntable(bool),
    /// Starts or stops the turntable, whichever it is not.
    ToggleTurntable,
    /// Flies at one radius of the scene a second until the next such command. It is sent whenever the keys that are held change.
    Fly {
        /// To the right, up in the world, forward: −1…1 each. Zero ends it.
        direction: Vec3,
        /// Four times as fast.
        fast: bool,
    },
    /// Turns the head: the eye stays where it is.
    FlyLook {
        /// Positive looks to the right.
        yaw_radians: f32,
        /// Positive looks up.
        pitch_radians: f32,
    },
    /// The picture's shape, and what of it is covered by panels.
    SetViewport {
        aspect: f32,
        insets: Insets,
    },
}

impl CameraCommand {
    /// Whether it moves the camera to a place.
    fn sends_camera(&self) -> bool {
        matches!(
            self,
            Self::Orbit { .. }
                | Self::Pan { .. }
                | Self::Zoom { .. }
                | Self::FrameModel
                | Self::FrameSelection
                | Self::LookFrom(_)
                | Self::Reset
                | Self::SetViewport { .. }
        )
    }
}

impl Session {
    pub(in crate::session) fn apply_to_camera(&mut self, command: CameraCommand) {
        match command {
            CameraCommand::Orbit {
                yaw_radians,
                pitch_radians,
            } => {
                self.view.motion.interrupt();
                self.view.camera.orbit(yaw_radians, pitch_radians);
            }
            CameraCommand::Pan { drag } => {
                self.view.motion.interrupt();
                self.view.camera.pan(drag);
                self.view.framed = Framed::No;
            }
            CameraCommand::Zoom { factor, pointer } => {
                self.view.motion.interrupt();
                self.zoom(factor, pointer);
            }
            CameraCommand::FrameModel => {
                self.view.motion.interrupt();
                self.frame_model();
            }
            CameraCommand::FrameSelection => {
                self.view.motion.interrupt();
                self.frame_selection();
            }
            CameraCommand::LookFrom(preset) => {
                self.view.motion.interrupt();
                self.view.camera.look_from(preset);
                self.frame_model();
            }
            CameraCommand::ToggleProjection => self.change_goal(|session| {
                let View { camera, look, .. } = &mut session.view;
                camera.set_projection(match camera.projection {
                    Projection::Perspective { .. } => Projection::Orthographic,
                    Projection::Orthographic => Projection::perspective(look.light),
                });
            }),
            CameraCommand::Reset => {
                self.view.motion.interrupt();
                self.view.camera = Camera {
                    projection: Projection::perspective(self.view.look.light),
                    ..Camera::default()
                };
                self.frame_model();
            }
            CameraCommand::Glide(command) => self.glide(*command),
            CameraCommand::BeginDrag => self.view.motion.hold(true),
            CameraCommand::EndDrag => self.view.motion.hold(false),
            CameraCommand::Fling {
                yaw_radians_per_sec,
                pitch_radians_per_sec,
            } if !self.reduced_motion => self.view.motion.fling(yaw_radians_per_sec, pitch_radians_per_sec),
            CameraCommand::Fling { .. } => {}
            CameraCommand::SetTurntable(turns) => self.view.motion.set_turntable(turns),
            CameraCommand::ToggleTurntable => self.view.motion.set_turntable(!self.turntable()),
            CameraCommand::Fly { direction, fast } => self.view.motion.fly(direction, fast),
            CameraCommand::FlyLook {
                yaw_radians,
                pitch_radians,
            } => {
                self.view.motion.interrupt();
                self.view.camera.look_around(yaw_radians, pitch_radians);
                self.view.framed = Framed::No;
            }
            CameraCommand::SetViewport { aspect, insets } => {
                if (self.view.aspect, self.view.insets) != (aspect, insets) {
                    self.change_goal(|session| session.set_viewport(aspect, insets));
                }
            }
        }
    }

    /// Whether the model stays framed wherever panels open: the camera was not panned, zoomed, flown or sent to a place since it was framed.
    pub fn is_framed(&self) -> bool {
        self.view.framed == Framed::Yes
    }

    /// From where the model is seen.
    pub fn camera(&self) -> &Camera {
        &self.view.camera
    }

    /// The handedness in force: chosen, or else found.
    pub fn handedness(&self) -> Handedness {
        self.view.handedness(self.open_model())
    }

    /// The handedness that was chosen over what was found.
    pub fn handedness_override(&self) -> Option<Handedness> {
        self.view.handedness
    }

    /// The up axis in force: chosen, or else found.
    pub fn up_axis(&self) -> UpAxis {
        self.view.up_axis(self.open_model())
    }

    /// The up axis that was chosen over what was found.
    pub fn up_axis_override(&self) -> Option<UpAxis> {
        self.view.up_axis
    }

    fn zoom(&mut self, factor: f32, pointer: Vec2) {
        let [of_one, of_all] = [self.selected_bounds(), self.world_bounds()].map(|bounds| bounds.radius().max(1e-6));
        let View { camera, framed, .. } = &mut self.view;
        // Not through the model, and not so far away that all is a dot.
        let distance = (camera.distance * factor).clamp(of_one * 1e-2, of_all * 100.0);
        camera.zoom(distance / camera.distance, pointer);
        *framed = Framed::No;
    }

    /// Whether the camera looks from a named direction, or is on its way there.
    pub fn looks_from(&self, preset: ViewPreset) -> bool {
        let camera = self.view.motion.goal().unwrap_or(self.view.camera);
        let mut from = camera;
        from.look_from(preset);
        camera.forward().abs_diff_eq(from.forward(), LOOKS_FROM_TOLERANCE)
    }

    /// Whether the camera turns about the model by itself.
    pub fn turntable(&self) -> bool {
        self.view.motion.turntable()
    }

    pub(in crate::session) fn is_camera_moving(&self) -> bool {
        self.view.motion.is_moving(self.content.open.is_some())
    }

    /// Applies a command; the camera glides to where the command would move it at once.
    fn glide(&mut self, command: CameraCommand) {
        if self.reduced_motion || !command.sends_camera() {
            return self.apply_to_camera(command);
        }
        let from = self.view.camera;
        // While it glides, a new command counts from the end of that glide.
        if let Some(goal) = self.view.motion.goal() {
            self.view.camera = goal;
            self.view.motion.end_glide();
        }
        self.apply_to_camera(command);
        let View { camera, motion, .. } = &mut self.view;
        let to = std::mem::replace(camera, from);
        camera.projection = to.projection;
        if *camera != to {
            motion.glide(from, to);
        }
    }

    /// Changes the camera; while it glides, the end of the glide.
    pub(in crate::session) fn change_goal(&mut self, change: impl FnOnce(&mut Self)) {
        let Some(goal) = self.view.motion.goal() else {
            return change(self);
        };
        let here = std::mem::replace(&mut self.view.camera, goal);
        change(self);
        let View { camera, motion, .. } = &mut self.view;
        let to = std::mem::replace(camera, here);
        camera.set_projection(to.projection);
        motion.set_goal(to);
    }

    /// Gives a perspective view the field of view that goes with the light. What is looked at keeps its size.
    pub(in crate::session) fn follow_light(&mut self) {
        let wanted = Projection::perspective(self.view.look.light);
        let projection = self.view.camera.projection;
        if projection != Projection::Orthographic && projection != wanted {
            self.change_goal(|session| session.view.camera.set_projection(wanted));
        }
    }

    /// Lets time pass for the camera.
    pub(in crate::session) fn advance_camera(&mut self, dt_secs: f32) {
        if !(self.is_camera_moving() && dt_secs.is_finite() && dt_secs > 0.0) {
            return;
        }
        let has_model = self.content.open.is_some();
        let View { camera, motion, .. } = &mut self.view;
        let flight_radii = motion.advance(camera, dt_secs, has_model);
        if flight_radii != Vec3::ZERO {
            self.fly(flight_radii);
        }
    }

    fn fly(&mut self, way_radii: Vec3) {
        let bounds = self.world_bounds();
        let (center, radius) = (bounds.center(), bounds.radius().max(1e-6));
        let camera = &mut self.view.camera;
        // A camera that is farther out already may come nearer, but not go farther.
        let farthest = (FARTHEST_RADII * radius).max(camera.eye().distance(center));
        camera.fly(way_radii * radius);
        let off = camera.eye() - center;
        let target = camera.target - (off - off.clamp_length_max(farthest));
        if target.is_finite() {
            camera.target = target;
        }
        // An orthographic view grows instead; it ends where zooming does.
        self.zoom(1.0, Vec2::ZERO);
    }
}
