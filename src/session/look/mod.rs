//! How the model is looked at: light, view mode, background, lines, ghosts, bones, colours of the skin, trails.

pub(super) mod camera;
pub(super) mod framing;
pub(super) mod materials;
pub(super) mod motion;
pub(super) mod overlays;
pub(super) mod pacing;
pub(super) mod quality;
pub(super) mod showing;
pub(super) mod skeleton_cache;
pub(super) mod sky;
pub(super) mod view;

use std::f32::consts::TAU;
use std::sync::Arc;

use crate::anim::{GhostPlan, SkinView};
use crate::model::JointIndex;
use crate::scene::{Background, BoneStyle, Light, Overlay, Overlays, ViewMode};

/// The book's lights turn by this much a second.
const BOOK_TURN_RADIANS_PER_SEC: f32 = 0.1;

/// Stops of exposure that can be asked for, either way.
pub const MAX_EXPOSURE_STOPS: f32 = 4.0;
/// The ground can be moved so far, up and down, in heights of the model.
pub const MAX_GROUND_OFFSET: f32 = 0.5;

/// The longest line along a normal, as a fraction of the scene's radius.
pub const MAX_LINE_LENGTH: f32 = 0.25;

/// How the model is looked at.
#[derive(Clone, Debug, Default, PartialEq)]
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
    /// How far the ground is above where it was found to be, in heights of the model.
    pub ground_offset: f32,
    /// Turn of the book's lights about y, radians.
    pub book_lights_turn_radians: f32,
    /// Whether the green of normal maps points up in the picture.
    pub normal_green_flipped: bool,
    /// Poses before and after that of now as ghosts.
    pub ghosts: Option<GhostPlan>,
    /// Whether the bind pose is seen as a ghost.
    pub bind_ghost: bool,
    /// How bones are drawn when they are.
    pub bone_style: BoneStyle,
    /// Whether bones are drawn.
    pub bones_visible: bool,
    /// Whether names shall stand at the joints. They are drawn only while bones are.
    pub(super) labels_wanted: bool,
    /// The property of the skin that is shown as colours.
    pub skin_view: Option<SkinView>,
    /// Joints whose path through the clip is drawn, in the order in which they were chosen.
    pub trails: Arc<Vec<JointIndex>>,
}

/// A command about the look.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LookCommand {
    /// Studio or book light.
    SetLight(Light),
    ToggleLight,
    /// Divides the picture between both lights at a fraction of its width, or shows one.
    SetSplit(Option<f32>),
    SetViewMode(ViewMode),
    /// The view mode some places further in the menu. While the skin is shown in colours, the view mode without them.
    CycleViewMode(i32),
    /// What is behind the model.
    SetBackground(Background),
    /// Shows or hides lines.
    SetOverlay(Overlay, bool),
    /// Shows lines that are hidden, hides lines that are shown.
    ToggleOverlay(Overlay),
    /// Length of the lines along normals and tangents, as a fraction of the scene's radius.
    SetLineLength(f32),
    /// Turns the environment to an angle about y, radians.
    SetEnvironmentTurn(f32),
    /// Turns the environment on by an angle about y, radians.
    TurnEnvironment(f32),
    /// Exposure of the studio light; each stop doubles it.
    SetExposure(f32),
    /// Moves the ground up from where it was found to be, in heights of the model.
    SetGroundOffset(f32),
    /// Which way the green of normal maps points.
    SetNormalGreenFlipped(bool),
    /// Shows poses before and after that of now as ghosts, or none.
    SetGhosts(Option<GhostPlan>),
    /// Shows the bind pose as a ghost, or not.
    SetBindGhost(bool),
    SetBoneStyle(BoneStyle),
    /// Shows or hides bones.
    SetBonesVisible(bool),
    /// Shows or hides names at the joints. Names stand only where bones are drawn: showing them shows the bones too.
    SetLabelsVisible(bool),
    /// Shows a property of the skin as colours, or the skin as it is.
    SetSkinView(Option<SkinView>),
    /// Shows or hides the path of a joint through the clip, whichever it is not.
    ToggleTrail(JointIndex),
    ClearTrails,
}

impl Look {
    /// Whether names stand at the joints: when they are wanted and bones are drawn.
    pub fn labels_visible(&self) -> bool {
        self.labels_wanted && self.bones_visible
    }

    /// Whether the model, its light and its ground look the same, whatever lies over them: lines, ghosts, bones and trails.
    pub(super) fn lights_as(&self, other: &Self) -> bool {
        let of_scene = |look: &Self| {
            let turns_radians = [look.environment_turn_radians, look.book_lights_turn_radians];
            let shown = (
                look.view_mode,
                look.skin_view,
                look.background,
                look.overlays.has(Overlay::Grid),
            );
            let light = (look.light, look.split, turns_radians, look.exposure_stops);
            (light, shown, look.normal_green_flipped, look.ground_offset)
        };
        of_scene(self) == of_scene(other)
    }

    /// Applies a command, for a model with `joint_count` joints. NaN and infinity are ignored; other numbers are clamped to their
    /// range.
    pub(super) fn apply(&mut self, command: LookCommand, joint_count: usize) {
        match command {
            LookCommand::SetLight(light) => self.light = light,
            LookCommand::ToggleLight => self.light = self.light.other(),
            LookCommand::SetSplit(split) => self.split = split.filter(|at| at.is_finite()).map(|at| at.clamp(0.0, 1.0)),
            LookCommand::SetViewMode(mode) => self.view_mode = mode,
            // The colours of the skin cover the view mode: they go first, so that something visible happens.
            LookCommand::CycleViewMode(places) => match self.skin_view.take() {
                Some(_) => {}
                None => self.view_mode = self.view_mode.cycled(places),
            },
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
                let radians = self.environment_turn_radians + radians;
                self.apply(LookCommand::SetEnvironmentTurn(radians), joint_count);
            }
            LookCommand::SetExposure(stops) if stops.is_finite() => {
                self.exposure_stops = stops.clamp(-MAX_EXPOSURE_STOPS, MAX_EXPOSURE_STOPS);
            }
            LookCommand::SetGroundOffset(heights) if heights.is_finite() => {
                self.ground_offset = heights.clamp(-MAX_GROUND_OFFSET, MAX_GROUND_OFFSET);
            }
            LookCommand::SetLineLength(_)
            | LookCommand::SetEnvironmentTurn(_)
            | LookCommand::SetExposure(_)
            | LookCommand::SetGroundOffset(_) => {}
            LookCommand::SetNormalGreenFlipped(flipped) => self.normal_green_flipped = flipped,
            // A plan without a pose before or after shows no ghosts.
            LookCommand::SetGhosts(plan) => self.ghosts = plan.filter(|plan| plan.before > 0 || plan.after > 0),
            LookCommand::SetBindGhost(visible) => self.bind_ghost = visible,
            LookCommand::SetBoneStyle(style) => self.bone_style = style,
            LookCommand::SetBonesVisible(visible) => self.bones_visible = visible,
            LookCommand::SetLabelsVisible(visible) => {
                self.labels_wanted = visible;
                self.bones_visible |= visible;
            }
            LookCommand::SetSkinView(view) => self.skin_view = view,
            LookCommand::ToggleTrail(joint) => match self.trails.iter().position(|&other| other == joint) {
                Some(place) => drop(Arc::make_mut(&mut self.trails).remove(place)),
                None if joint.index() < joint_count => Arc::make_mut(&mut self.trails).push(joint),
                None => {}
            },
            LookCommand::ClearTrails => self.trails = Arc::default(),
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
