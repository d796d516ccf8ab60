//! The camera moves by itself: it runs on after a drag, glides to where it was sent, turns about the model, flies.

use std::f32::consts::{PI, TAU};

use glam::{Vec2, Vec3};

use crate::scene::Camera;

/// After this time a turn that was let go has 1/e of its rate: long enough to feel a weight, too short to wait for.
const FLING_SECS: f32 = 0.15;
/// A slower turn would not go a pixel further in a window of usual height: it is over.
const LEAST_FLING_RADIANS_PER_SEC: f32 = 0.02;
/// A faster flick cannot be followed with the eyes.
const MOST_FLING_RADIANS_PER_SEC: f32 = 8.0 * PI;
/// How long a glide takes: long enough to be seen, too short to wait for.
const GLIDE_SECS: f32 = 0.25;
/// A turn of the turntable takes 12 seconds.
const TURNTABLE_RADIANS_PER_SEC: f32 = TAU / 12.0;
/// Speed of flight, in radii of the scene a second.
const FLIGHT_RADII_PER_SEC: f32 = 1.0;
const FAST_FLIGHT: f32 = 4.0;

/// What moves the camera without a command.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::session) struct Motion {
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
    /// A command takes the camera: fling and glide end. The turntable goes on afterwards, and so does flight, since its keys
    /// are still held.
    pub(in crate::session) fn interrupt(&mut self) {
        self.fling = Vec2::ZERO;
        self.glide = None;
    }

    /// Another model: only what was chosen stays.
    pub(in crate::session) fn reset_for_model(&mut self) {
        *self = Self {
            turntable: self.turntable,
            ..Self::default()
        };
    }

    pub(in crate::session) fn hold(&mut self, held: bool) {
        if held {
            self.interrupt();
        }
        self.held = held;
    }

    pub(in crate::session) fn is_held(&self) -> bool {
        self.held
    }

    /// Whether the camera turns about the model.
    pub(in crate::session) fn turntable(&self) -> bool {
        self.turntable
    }

    /// Whether the camera moves by itself.
    pub(in crate::session) fn is_moving(&self, has_model: bool) -> bool {
        let needs_model = self.turns() || self.flight.is_some();
        self.is_flung() || self.glide.is_some() || (needs_model && has_model)
    }

    /// Where a glide ends that is under way.
    pub(in crate::session) fn goal(&self) -> Option<Camera> {
        self.glide.map(|glide| glide.to)
    }

    /// Ends a glide where the camera is now.
    pub(in crate::session) fn end_glide(&mut self) {
        self.glide = None;
    }

    /// Ends the glide that is under way at another place.
    pub(in crate::session) fn set_goal(&mut self, to: Camera) {
        if let Some(glide) = &mut self.glide {
            glide.to = to;
        }
    }

    /// Lets the camera go from one place to another, and nowhere else.
    pub(in crate::session) fn glide(&mut self, from: Camera, to: Camera) {
        self.interrupt();
        self.glide = Some(Glide {
            from,
            to,
            elapsed_secs: 0.0,
        });
    }

    /// Moves the camera as it moves by itself in a time. Returns how far it flies, in radii of the scene: to the right, up,
    /// forward.
    pub(in crate::session) fn advance(&mut self, camera: &mut Camera, dt_secs: f32, has_model: bool) -> Vec3 {
        if self.turns() && has_model {
            camera.orbit(TURNTABLE_RADIANS_PER_SEC * dt_secs, 0.0);
        }
        if self.is_flung() {
            // The same way in many steps as in one: the integral of a rate that decays.
            let kept = (-dt_secs / FLING_SECS).exp();
            let turn = self.fling * FLING_SECS * (1.0 - kept);
            camera.orbit(turn.x, turn.y);
            self.fling *= kept;
            if self.fling.length() < LEAST_FLING_RADIANS_PER_SEC {
                self.fling = Vec2::ZERO;
            }
        }
        if let Some(glide) = &mut self.glide {
            glide.elapsed_secs += dt_secs;
            let is_there = glide.elapsed_secs >= GLIDE_SECS;
            *camera = if is_there { glide.to } else { glide.camera() };
            if is_there {
                self.glide = None;
            }
        }
        self.flight.map_or(Vec3::ZERO, |Flight { direction, fast }| {
            let speed = FLIGHT_RADII_PER_SEC * if fast { FAST_FLIGHT } else { 1.0 };
            direction * (speed * dt_secs)
        })
    }

    pub(in crate::session) fn set_turntable(&mut self, turns: bool) {
        self.turntable = turns;
    }

    pub(in crate::session) fn fling(&mut self, yaw_radians_per_sec: f32, pitch_radians_per_sec: f32) {
        let rates = Vec2::new(yaw_radians_per_sec, pitch_radians_per_sec);
        self.interrupt();
        // NaN and infinity cannot be clamped.
        if rates.is_finite() && rates.length() >= LEAST_FLING_RADIANS_PER_SEC {
            let most = Vec2::splat(MOST_FLING_RADIANS_PER_SEC);
            self.fling = rates.clamp(-most, most);
        }
    }

    pub(in crate::session) fn fly(&mut self, direction: Vec3, fast: bool) {
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
        let fraction = 1.0 - left * left * left;
        let Self { from, to, .. } = self;
        let mix = |a: f32, b: f32| a * (1.0 - fraction) + b * fraction;
        // The short way round.
        let yaw = (to.yaw_radians - from.yaw_radians + PI).rem_euclid(TAU) - PI;
        Camera {
            target: from.target * (1.0 - fraction) + to.target * fraction,
            distance: mix(from.distance.ln(), to.distance.ln()).exp(),
            yaw_radians: (from.yaw_radians + yaw * fraction).rem_euclid(TAU),
            pitch_radians: mix(from.pitch_radians, to.pitch_radians),
            projection: to.projection,
        }
    }
}
