//! The camera moves by itself: it runs on after a drag, glides to where it was sent, turns about the model, flies.

use std::f32::consts::{PI, TAU};

use glam::{Vec2, Vec3};

use super::{Command, Effect, Session};
use crate::scene::Camera;

/// After this time a turn that was let go has 1/e of its rate: long enough to feel a weight, too short to wait for.
const FLING_SECS: f32 = 0.15;
/// A slower turn would not go a pixel further in a window of usual height: it is over.
const LEAST_FLING_RADIANS_PER_SEC: f32 = 0.02;
/// A faster flick cannot be followed with the eyes.
const MOST_FLING_RADIANS_PER_SEC: f32 = 8.0 * PI;
/// How long a glide takes: seen as a way, not waited for.
const GLIDE_SECS: f32 = 0.25;
/// A turn of the turntable takes 12 seconds.
const TURNTABLE_RADIANS_PER_SEC: f32 = TAU / 12.0;
/// Speed of flight, in radii of the scene a second.
const FLIGHT_RADII_PER_SEC: f32 = 1.0;
/// How much faster fast flight is.
const FAST_FLIGHT: f32 = 4.0;
/// Flight ends this far from the scene's middle, in radii of the scene: where zooming ends too.
const FARTHEST_RADII: f32 = 100.0;

/// What moves the camera without a command.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Motion {
    /// The pointer holds the camera.
    held: bool,
    turntable: bool,
    /// Rates of yaw and pitch, radians a second.
    fling: Vec2,
    glide: Option<Glide>,
    flight: Option<Flight>,
}

#[derive(Clone, Copy, Debug)]
struct Glide {
    from: Camera,
    to: Camera,
    elapsed_secs: f32,
}

#[derive(Clone, Copy, Debug)]
struct Flight {
    /// To the right, up, forward; not longer than 1.
    direction: Vec3,
    fast: bool,
}

impl Motion {
    /// The camera belongs to someone else now: what it did by itself ends. The turntable goes on afterwards, and so does
    /// flight, which is keys that are held.
    pub(super) fn interrupt(&mut self) {
        self.fling = Vec2::ZERO;
        self.glide = None;
    }

    /// Another model: only what was chosen stays.
    pub(super) fn take_up_model(&mut self) {
        *self = Self {
            turntable: self.turntable,
            ..Self::default()
        };
    }

    pub(super) fn hold(&mut self, held: bool) {
        if held {
            self.interrupt();
        }
        self.held = held;
    }

    /// Whether the pointer holds the camera.
    pub(super) fn is_held(&self) -> bool {
        self.held
    }

    pub(super) fn set_turntable(&mut self, turns: bool) {
        self.turntable = turns;
    }

    pub(super) fn fling(&mut self, yaw_radians_per_sec: f32, pitch_radians_per_sec: f32) {
        let rates = Vec2::new(yaw_radians_per_sec, pitch_radians_per_sec);
        self.interrupt();
        // A length of numbers that have none cannot be limited.
        if rates.is_finite() && rates.length() >= LEAST_FLING_RADIANS_PER_SEC {
            let most = Vec2::splat(MOST_FLING_RADIANS_PER_SEC);
            self.fling = rates.clamp(-most, most);
        }
    }

    pub(super) fn fly(&mut self, direction: Vec3, fast: bool) {
        let direction = if direction.is_finite() {
            direction.clamp(Vec3::NEG_ONE, Vec3::ONE).clamp_length_max(1.0)
        } else {
            Vec3::ZERO
        };
        self.flight = (direction != Vec3::ZERO).then_some(Flight { direction, fast });
        if self.flight.is_some() {
            self.interrupt();
        }
    }

    fn is_flung(&self) -> bool {
        self.fling != Vec2::ZERO && !self.held
    }

    /// The turntable waits while the camera is held or goes somewhere.
    fn turns(&self) -> bool {
        self.turntable && !self.held && self.glide.is_none() && self.flight.is_none()
    }
}

impl Glide {
    /// Quick at first and slow at the end: the way that is left shrinks with the third power of the time that is left.
    fn camera(&self) -> Camera {
        let left = 1.0 - (self.elapsed_secs / GLIDE_SECS).clamp(0.0, 1.0);
        let share = 1.0 - left * left * left;
        let Self { from, to, .. } = self;
        let mix = |a: f32, b: f32| a * (1.0 - share) + b * share;
        // The short way round.
        let yaw = (to.yaw_radians - from.yaw_radians + PI).rem_euclid(TAU) - PI;
        Camera {
            target: from.target * (1.0 - share) + to.target * share,
            distance: mix(from.distance.ln(), to.distance.ln()).exp(),
            yaw_radians: (from.yaw_radians + yaw * share).rem_euclid(TAU),
            pitch_radians: mix(from.pitch_radians, to.pitch_radians),
            projection: to.projection,
        }
    }
}

impl Session {
    /// Whether the camera turns about the model by itself.
    pub fn turntable(&self) -> bool {
        self.motion.turntable
    }

    /// Whether something on screen moves by itself, be it the clip, a fade between clips or the camera: then another frame is due.
    pub fn is_moving(&self) -> bool {
        self.is_animating() || self.is_fading() || self.is_camera_moving()
    }

    fn is_camera_moving(&self) -> bool {
        let motion = &self.motion;
        let needs_model = motion.turns() || motion.flight.is_some();
        motion.is_flung() || motion.glide.is_some() || (needs_model && self.open.is_some())
    }

    /// Does what was asked, and lets the camera go there instead of jumping.
    pub(super) fn glide(&mut self, command: Command) -> Effect {
        if self.reduced_motion || !command.sends_camera() {
            return self.perform(command);
        }
        let from = self.camera;
        // Sent again on its way, it goes from here to where it would have been sent from there.
        if let Some(glide) = self.motion.glide.take() {
            self.camera = glide.to;
        }
        let effect = self.perform(command);
        let to = std::mem::replace(&mut self.camera, from);
        self.camera.projection = to.projection;
        if self.camera != to {
            // One way at a time.
            self.motion.interrupt();
            self.motion.glide = Some(Glide {
                from,
                to,
                elapsed_secs: 0.0,
            });
        }
        effect
    }

    /// Changes the camera, or where it is going while it glides.
    pub(super) fn change_goal(&mut self, change: impl FnOnce(&mut Self)) {
        let Some(glide) = self.motion.glide else {
            return change(self);
        };
        let here = std::mem::replace(&mut self.camera, glide.to);
        change(self);
        let to = std::mem::replace(&mut self.camera, here);
        self.camera.projection = to.projection;
        self.motion.glide = Some(Glide { to, ..glide });
    }

    /// Lets time pass for the camera.
    pub(super) fn advance_camera(&mut self, dt_secs: f32) {
        if !(self.is_camera_moving() && dt_secs.is_finite() && dt_secs > 0.0) {
            return;
        }
        if self.motion.turns() && self.open.is_some() {
            self.camera.orbit(TURNTABLE_RADIANS_PER_SEC * dt_secs, 0.0);
        }
        if self.motion.is_flung() {
            // The same way in many steps as in one: the integral of a rate that decays.
            let kept = (-dt_secs / FLING_SECS).exp();
            let turn = self.motion.fling * FLING_SECS * (1.0 - kept);
            self.camera.orbit(turn.x, turn.y);
            self.motion.fling *= kept;
            if self.motion.fling.length() < LEAST_FLING_RADIANS_PER_SEC {
                self.motion.fling = Vec2::ZERO;
            }
        }
        if let Some(glide) = &mut self.motion.glide {
            glide.elapsed_secs += dt_secs;
            let is_there = glide.elapsed_secs >= GLIDE_SECS;
            self.camera = if is_there { glide.to } else { glide.camera() };
            if is_there {
                self.motion.glide = None;
            }
        }
        if let Some(Flight { direction, fast }) = self.motion.flight {
            let speed = FLIGHT_RADII_PER_SEC * if fast { FAST_FLIGHT } else { 1.0 };
            self.fly_on(direction * (speed * dt_secs));
        }
    }

    /// `way` in radii of the scene.
    fn fly_on(&mut self, way: Vec3) {
        let bounds = self.world_bounds();
        let (center, radius) = (bounds.center(), bounds.radius().max(1e-6));
        // Whoever is farther out already comes nearer or stays.
        let farthest = (FARTHEST_RADII * radius).max(self.camera.eye().distance(center));
        self.camera.fly(way * radius);
        let off = self.camera.eye() - center;
        let target = self.camera.target - (off - off.clamp_length_max(farthest));
        if target.is_finite() {
            self.camera.target = target;
        }
        // An orthographic view grows instead; it ends where zooming does.
        self.zoom(1.0, Vec2::ZERO);
    }
}

impl Command {
    /// Whether it says where the camera shall be.
    fn sends_camera(&self) -> bool {
        matches!(
            self,
            Self::Orbit { .. }
                | Self::Pan { .. }
                | Self::Zoom { .. }
                | Self::FrameModel
                | Self::FrameSelection
                | Self::LookFrom(_)
                | Self::ResetCamera
                | Self::SetViewport { .. }
        )
    }
}
