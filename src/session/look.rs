//! How the model is looked at: light, view mode, background, lines, ghosts.

use std::f32::consts::TAU;

use crate::anim::GhostPlan;
use crate::scene::{Background, Light, Overlay, Overlays, ViewMode};

/// The book's lights turn by this much a second.
const BOOK_TURN_RADIANS_PER_SEC: f32 = 0.1;

/// Stops of exposure that can be asked for, either way.
pub const MAX_EXPOSURE_STOPS: f32 = 4.0;

/// The longest line along a normal, as a fraction of the scene's radius.
pub const MAX_LINE_LENGTH: f32 = 0.25;

/// How the model is looked at.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Look {
    /// Studio or book light.
    pub light: Light,
    /// Where the picture is divided between both lights, as a fraction of its width.
    pub split: Option<f32>,
    /// What of a surface is shown.
    pub view_mode: ViewMode,
    /// What is behind the model.
    pub background: Background,
    /// Lines over and beside the model.
    pub overlays: Overlays,
    /// Turn of the environment about y, radians.
    pub environment_turn_radians: f32,
    /// Exposure of the studio light.
    pub exposure_stops: f32,
    /// Turn of the book's lights about y, radians.
    pub book_lights_turn_radians: f32,
    /// Whether the green of normal maps points up in the picture.
    pub normal_green_flipped: bool,
    /// Poses before and after that of now as ghosts.
    pub ghosts: Option<GhostPlan>,
    /// Whether the bind pose is seen as a ghost.
    pub bind_ghost: bool,
}

/// A wish about the look.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LookCommand {
    /// Studio or book light.
    SetLight(Light),
    /// The other light.
    ToggleLight,
    /// Divides the picture between both lights at a fraction of its width, or shows one.
    SetSplit(Option<f32>),
    /// What of a surface is shown.
    SetViewMode(ViewMode),
    /// The view mode some places further in the menu.
    CycleViewMode(i32),
    /// What is behind the model.
    SetBackground(Background),
    /// Shows or hides lines.
    SetOverlay(Overlay, bool),
    /// Shows or hides lines, in turn.
    ToggleOverlay(Overlay),
    /// Length of the lines along normals and tangents, as a fraction of the scene's radius.
    SetLineLength(f32),
    /// Turns the environment to an angle about y, radians.
    SetEnvironmentTurn(f32),
    /// Turns the environment on by an angle about y, radians.
    TurnEnvironment(f32),
    /// Exposure of the studio light; each stop doubles it.
    SetExposure(f32),
    /// Which way the green of normal maps points.
    SetNormalGreenFlipped(bool),
    /// Shows poses before and after that of now as ghosts, or none.
    SetGhosts(Option<GhostPlan>),
    /// Shows the bind pose as a ghost, or not.
    SetBindGhost(bool),
}

impl Look {
    /// Does what was asked. Numbers that are none are left out, others are brought into their range.
    pub(super) fn apply(&mut self, command: LookCommand) {
        match command {
            LookCommand::SetLight(light) => self.light = light,
            LookCommand::ToggleLight => self.light = self.light.other(),
            LookCommand::SetSplit(split) => self.split = split.filter(|at| at.is_finite()).map(|at| at.clamp(0.0, 1.0)),
            LookCommand::SetViewMode(mode) => self.view_mode = mode,
            LookCommand::CycleViewMode(places) => self.view_mode = self.view_mode.cycled(places),
            LookCommand::SetBackground(background) => self.background = background,
            LookCommand::SetOverlay(overlay, visible) => self.overlays.set(overlay, visible),
            LookCommand::ToggleOverlay(overlay) => self.overlays.set(overlay, !self.overlays.has(overlay)),
            LookCommand::SetLineLength(length) if length.is_finite() => {
                self.overlays.line_length = length.clamp(0.0, MAX_LINE_LENGTH);
            }
            LookCommand::SetEnvironmentTurn(radians) if radians.is_finite() => {
                self.environment_turn_radians = radians.rem_euclid(TAU);
            }
            LookCommand::TurnEnvironment(radians) => {
                self.apply(LookCommand::SetEnvironmentTurn(self.environment_turn_radians + radians));
            }
            LookCommand::SetExposure(stops) if stops.is_finite() => {
                self.exposure_stops = stops.clamp(-MAX_EXPOSURE_STOPS, MAX_EXPOSURE_STOPS);
            }
            LookCommand::SetLineLength(_) | LookCommand::SetEnvironmentTurn(_) | LookCommand::SetExposure(_) => {}
            LookCommand::SetNormalGreenFlipped(flipped) => self.normal_green_flipped = flipped,
            // A plan without any is none.
            LookCommand::SetGhosts(plan) => self.ghosts = plan.filter(|plan| plan.before > 0 || plan.after > 0),
            LookCommand::SetBindGhost(visible) => self.bind_ghost = visible,
        }
    }

    /// Turns the book's lights to an angle about y, radians. What is not finite is ignored.
    pub(super) fn set_book_lights_turn(&mut self, radians: f32) {
        if radians.is_finite() {
            self.book_lights_turn_radians = radians.rem_euclid(TAU);
        }
    }

    /// Lets time pass: the book's lights turn. A step that is not finite is ignored.
    pub(super) fn advance(&mut self, dt_secs: f32) {
        self.set_book_lights_turn(self.book_lights_turn_radians + dt_secs * BOOK_TURN_RADIANS_PER_SEC);
    }
}
