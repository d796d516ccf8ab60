//! Buttons that move the time: play, steps, ends.

use egui::{Response, Role, Sense, Stroke, Ui, Vec2, WidgetInfo};

use super::super::icons::{self, Icon};
use super::super::theme::Tokens;
use super::super::widgets::{control_size, icon_button};
use crate::anim::Direction;
use crate::model::JointIndex;
use crate::session::{Command, Session};

/// Frames of a step with Shift.
const MANY_FRAMES: i32 = 10;

/// The round button that plays and pauses.
pub(super) fn play_button(ui: &mut Ui, session: &Session, diameter: f32, commands: &mut Vec<Command>) {
    let playing = session.playback().is_playing();
    let (rect, response) = ui.allocate_exact_size(Vec2::splat(diameter), Sense::click());
    let tokens = Tokens::of(ui);
    let lift = if response.hovered() { 1.0 } else { 0.92 };
    ui.painter()
        .circle_filled(rect.center(), diameter * 0.5, tokens.accent.gamma_multiply(lift));
    if response.has_focus() {
        ui.painter()
            .circle_stroke(rect.center(), diameter * 0.5 + 2.0, Stroke::new(1.5, tokens.accent));
    }
    icons::paint(
        ui.painter(),
        rect,
        if playing { Icon::Pause } else { Icon::Play },
        tokens.on_accent,
    );
    let label = if playing { "Pause (Space)" } else { "Play (Space)" };
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, label));
    if response.on_hover_text(label).clicked() {
        commands.push(Command::TogglePlay);
    }
}

/// Plays backward.
pub(super) fn backward_button(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let on = session.playback().is_playing() && session.playback().is_backward();
    if icon_button(ui, Icon::PlayBackward, "Backward (Shift Space)", on).clicked() {
        commands.push(Command::TogglePlayBackward);
    }
}

/// To an end of what plays.
pub(super) fn end_button(ui: &mut Ui, direction: Direction, commands: &mut Vec<Command>) {
    let (icon, label, command) = match direction {
        Direction::Backward => (Icon::SkipStart, "First frame (Home)", Command::SeekStart),
        Direction::Forward => (Icon::SkipEnd, "Last frame (End)", Command::SeekEnd),
    };
    if icon_button(ui, icon, label, false).clicked() {
        commands.push(command);
    }
}

/// One frame on or back; with Shift, or held by a finger, ten.
pub(super) fn frame_button(ui: &mut Ui, direction: Direction, commands: &mut Vec<Command>) {
    let (icon, label, sign) = match direction {
        Direction::Backward => (Icon::StepBack, "One frame back (←, with Shift ten)", -1),
        Direction::Forward => (Icon::StepForward, "One frame on (→, with Shift ten)", 1),
    };
    let response = icon_button(ui, icon, label, false);
    // Fingers have no Shift, but patience.
    let long = response.long_touched();
    if response.clicked() || long {
        let many = long || ui.input(|input| input.modifiers.shift);
        let frames = if many { MANY_FRAMES } else { 1 };
        commands.push(Command::StepFrames(sign * frames));
    }
}

/// To the next key of a joint, or of any.
pub(super) fn key_button(
    ui: &mut Ui,
    direction: Direction,
    joint: Option<JointIndex>,
    commands: &mut Vec<Command>,
) -> Response {
    let (icon, label) = match direction {
        Direction::Backward => (Icon::KeyBack, "Previous key (↓)"),
        Direction::Forward => (Icon::KeyForward, "Next key (↑)"),
    };
    let response = icon_button(ui, icon, label, false);
    if response.clicked() {
        commands.push(Command::StepKey { direction, joint });
    }
    response
}

/// All buttons that move the time but play, spread over the width: for where a strip has no room for them.
pub(super) fn all_steps(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let joint = session.joints().selected();
    // The slimmest phones reach the ends on the bar alone.
    let with_ends = ui.available_width() >= 7.0 * control_size(ui);
    let count = if with_ends { 7.0 } else { 5.0 };
    ui.horizontal(|ui| {
        let free = ui.available_width() - count * control_size(ui);
        ui.spacing_mut().item_spacing.x = (free / (count - 1.0)).clamp(0.0, 24.0);
        if with_ends {
            end_button(ui, Direction::Backward, commands);
        }
        key_button(ui, Direction::Backward, joint, commands);
        frame_button(ui, Direction::Backward, commands);
        backward_button(ui, session, commands);
        frame_button(ui, Direction::Forward, commands);
        key_button(ui, Direction::Forward, joint, commands);
        if with_ends {
            end_button(ui, Direction::Forward, commands);
        }
    });
}
