//! Buttons that move the time: play, steps, ends.

use egui::{Role, Sense, Stroke, Ui, Vec2, WidgetInfo};

use super::super::icons::{self, Icon};
use super::super::theme::Tokens;
use super::super::widgets::{action_button, control_size, icon_button};
use crate::actions;
use crate::anim::Direction;
use crate::session::{Command, Session};

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
    let label = if playing {
        actions::PLAY.hint_of("Pause")
    } else {
        actions::PLAY.hint()
    };
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &label));
    if response.on_hover_text(label).clicked() {
        commands.extend(actions::PLAY.command(session));
    }
}

/// Plays backward.
pub(super) fn backward_button(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    action_button(ui, session, &actions::PLAY_BACKWARD, Icon::PlayBackward, commands);
}

/// To an end of what plays.
pub(super) fn end_button(ui: &mut Ui, session: &Session, direction: Direction, commands: &mut Vec<Command>) {
    let (icon, action) = match direction {
        Direction::Backward => (Icon::SkipStart, &actions::FIRST_FRAME),
        Direction::Forward => (Icon::SkipEnd, &actions::LAST_FRAME),
    };
    action_button(ui, session, action, icon, commands);
}

/// One frame on or back; with Shift, or held by a finger, ten.
pub(super) fn frame_button(ui: &mut Ui, session: &Session, direction: Direction, commands: &mut Vec<Command>) {
    let (icon, one, ten) = match direction {
        Direction::Backward => (Icon::StepBack, &actions::FRAME_BACK, &actions::TEN_FRAMES_BACK),
        Direction::Forward => (Icon::StepForward, &actions::FRAME_ON, &actions::TEN_FRAMES_ON),
    };
    let label = format!("{} ({}, with Shift ten)", one.label, one.key());
    let response = icon_button(ui, icon, &label, false);
    // Fingers have no Shift, but patience.
    let long = response.long_touched();
    if response.clicked() || long {
        let many = long || ui.input(|input| input.modifiers.shift);
        let action = if many { ten } else { one };
        commands.extend(action.command(session));
    }
}

/// To the next key of the selected joint, or of any.
pub(super) fn key_button(ui: &mut Ui, session: &Session, direction: Direction, commands: &mut Vec<Command>) {
    let (icon, action) = match direction {
        Direction::Backward => (Icon::KeyBack, &actions::PREVIOUS_KEY),
        Direction::Forward => (Icon::KeyForward, &actions::NEXT_KEY),
    };
    action_button(ui, session, action, icon, commands);
}

/// All buttons that move the time but play, spread over the width: for where a strip has no room for them.
pub(super) fn all_steps(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    // The slimmest phones reach the ends on the bar alone.
    let with_ends = ui.available_width() >= 7.0 * control_size(ui);
    let count = if with_ends { 7.0 } else { 5.0 };
    ui.horizontal(|ui| {
        let free = ui.available_width() - count * control_size(ui);
        ui.spacing_mut().item_spacing.x = (free / (count - 1.0)).clamp(0.0, 24.0);
        if with_ends {
            end_button(ui, session, Direction::Backward, commands);
        }
        key_button(ui, session, Direction::Backward, commands);
        frame_button(ui, session, Direction::Backward, commands);
        backward_button(ui, session, commands);
        frame_button(ui, session, Direction::Forward, commands);
        key_button(ui, session, Direction::Forward, commands);
        if with_ends {
            end_button(ui, session, Direction::Forward, commands);
        }
    });
}
