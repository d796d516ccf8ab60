//! What a person asks for with pointer, fingers and wheel on the view. It knows no window: whoever has one says what is held, and how far it
//! moved.
//!
//! Movements are fractions of the view's height, x right, y down.

use std::f32::consts::PI;

use glam::Vec2;

use crate::session::{CameraCommand, Command, JointCommand, LookCommand, SubmeshCommand};

/// Radians of orbit for a drag over the height of the view.
const ORBIT_PER_HEIGHT: f32 = PI * 1.1;
/// Radians that the environment turns for a drag over the height of the view.
const ENVIRONMENT_TURN_PER_HEIGHT: f32 = PI;
/// Distance factor of one point of wheel movement.
const ZOOM_PER_POINT: f32 = 0.0025;

/// What a drag with one pointer moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Grab {
    /// The eye, about the model.
    Orbit,
    /// The light around the model.
    Environment,
    /// The model, along the picture.
    Pan,
}

impl Grab {
    /// By the button and what is held beside it. A finger is the primary button.
    pub fn of(is_primary: bool, shift: bool, alt: bool) -> Self {
        match (is_primary, shift, alt) {
            (true, false, false) => Self::Orbit,
            (true, _, true) => Self::Environment,
            _ => Self::Pan,
        }
    }
}

/// A drag of the view.
#[derive(Debug, Default)]
pub struct ViewDrag {
    orbit: DragTrail,
}

impl ViewDrag {
    /// The pointer moved while it held the view.
    pub fn drag(&mut self, grab: Grab, moved: Vec2, now_secs: f64) -> Option<Command> {
        if grab != Grab::Orbit {
            self.end();
        }
        match grab {
            Grab::Orbit => {
                let turn = moved * ORBIT_PER_HEIGHT;
                self.orbit.add(now_secs, turn);
                let orbit = CameraCommand::Orbit {
                    yaw_radians: turn.x,
                    pitch_radians: turn.y,
                };
                (turn != Vec2::ZERO).then(|| orbit.into())
            }
            Grab::Environment => {
                let turn = moved.x * ENVIRONMENT_TURN_PER_HEIGHT;
                (turn != 0.0).then(|| LookCommand::TurnEnvironment(turn).into())
            }
            Grab::Pan => Some(CameraCommand::Pan { drag: moved }.into()),
        }
    }

    /// The pointer let go: an orbit that was quick until then goes on.
    pub fn fling(&mut self, now_secs: f64) -> Option<Command> {
        let rate = self.orbit.rate_per_sec(now_secs);
        self.end();
        let fling = CameraCommand::Fling {
            yaw_radians_per_sec: rate.x,
            pitch_radians_per_sec: rate.y,
        };
        (rate != Vec2::ZERO).then(|| fling.into())
    }

    /// It ends, and nothing goes on.
    pub fn end(&mut self) {
        self.orbit.clear();
    }
}

/// Two fingers moved together, and apart by the factor `spread`; `middle` lies between them, from the centre of the view.
pub fn pinch(moved: Vec2, spread: f32, middle: Vec2) -> impl Iterator<Item = Command> {
    let pan = CameraCommand::Pan { drag: moved };
    [Some(pan.into()), zoom(0.0, spread, middle)].into_iter().flatten()
}

/// The wheel moved by so many points, down where they are below 0, or a touch pad was spread by a factor. `pointer` is from the centre of the view.
pub fn zoom(wheel_points: f32, spread: f32, pointer: Vec2) -> Option<Command> {
    let factor = (-wheel_points * ZOOM_PER_POINT).exp() / spread;
    (factor != 1.0).then(|| CameraCommand::Zoom { factor, pointer }.into())
}

/// A click at a place in the picture selects a bone or a vertex if `picks_bones`, otherwise a submesh.
pub fn click(at: Vec2, picks_bones: bool) -> Command {
    if picks_bones {
        JointCommand::SelectAt(at).into()
    } else {
        SubmeshCommand::SelectAt(at).into()
    }
}

/// Fractions of the view's width and height, from its upper left corner, as a place in the picture: x right, y up, −1…1.
pub fn in_picture(fractions: Vec2) -> Vec2 {
    Vec2::new(2.0 * fractions.x - 1.0, 1.0 - 2.0 * fractions.y)
}

/// Only this last part of a drag counts, in seconds. A person who slows down before the release wants to stop.
const RECENT_SECS: f64 = 0.08;

/// How far a pointer moved, step by step.
#[derive(Clone, Debug, Default)]
pub struct DragTrail {
    /// Times in seconds, and how far since the step before.
    steps: Vec<(f64, Vec2)>,
}

impl DragTrail {
    /// It moved so far since the step before.
    pub fn add(&mut self, now_secs: f64, moved: Vec2) {
        self.steps.retain(|&(at_secs, _)| now_secs - at_secs <= RECENT_SECS);
        self.steps.push((now_secs, moved));
    }

    /// The drag ended, or another one begins.
    pub fn clear(&mut self) {
        self.steps.clear();
    }

    /// Movement a second over the recent part of the drag.
    pub fn rate_per_sec(&self, now_secs: f64) -> Vec2 {
        let recent = self
            .steps
            .iter()
            .filter(|&&(at_secs, _)| now_secs - at_secs <= RECENT_SECS);
        recent.map(|&(_, moved)| moved).sum::<Vec2>() / RECENT_SECS as f32
    }
}
