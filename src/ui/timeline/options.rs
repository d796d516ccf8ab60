//! How a clip plays: speed, what happens at the end, the range.

use egui::{Align, FontId, Sense, Ui, vec2};

use super::super::popover;
use super::super::theme::{ROW_HEIGHT, Tokens};
use super::super::widgets::{TypedValue, control_size, section_name, section_with_action, segmented, typed_number};
use super::super::wording::trimmed;
use super::{TimelineState, controls, seam_list};
use crate::actions::speed_label;
use crate::anim::{LoopMode, WrapMode};
use crate::session::{Command, SPEEDS, Session};

/// Width of the popover.
pub(super) const WIDTH: f32 = 300.0;
/// Speeds in a row.
const IN_A_ROW: usize = 5;
const FIELD_WIDTH: f32 = 78.0;

/// The popover's contents. `with_steps`: the strip has not room for all buttons that move the time, so they are here.
pub(super) fn show(
    ui: &mut Ui,
    session: &Session,
    state: &mut TimelineState,
    with_steps: bool,
    commands: &mut Vec<Command>,
) {
    ui.spacing_mut().item_spacing.y = 4.0;
    if with_steps {
        controls::all_steps(ui, session, commands);
        popover::gap(ui);
    }
    speed(ui, session, commands);
    popover::gap(ui);
    at_the_end(ui, session, commands);
    popover::gap(ui);
    range(ui, session, commands);
    if state.seam.loops() {
        popover::gap(ui);
        seam_list::show(ui, session, state, commands);
    }
}

fn speed(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let speed = session.playback().speed();
    section_name(ui, "Speed");
    let text = speed_label(speed);
    if let Some(speed) = typed_row(ui, "Times as fast", &text, &trimmed(speed)) {
        commands.push(Command::SetSpeed(speed as f32));
    }
    let labels = SPEEDS.map(speed_label);
    let choices: Vec<(f32, &str)> = SPEEDS.into_iter().zip(labels.iter().map(String::as_str)).collect();
    let in_force = SPEEDS.into_iter().find(|choice| (choice - speed).abs() < 1e-4);
    for row in choices.chunks(IN_A_ROW) {
        if let Some(speed) = segmented(ui, "Speed", row, in_force) {
            commands.push(Command::SetSpeed(speed));
        }
    }
}

fn at_the_end(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let playback = session.playback();
    section_name(ui, "At the end");
    let modes = [LoopMode::Once, LoopMode::Loop, LoopMode::PingPong].map(|mode| (mode, mode.label()));
    if let Some(mode) = segmented(ui, "At the end", &modes, Some(playback.loop_mode())) {
        commands.push(Command::SetLoopMode(mode));
    }
    if playback.loop_mode() == LoopMode::Loop {
        let modes = [(WrapMode::Wrap, "Wrap"), (WrapMode::BookDemo, "As the book's demo")];
        if let Some(mode) = segmented(ui, "Loop", &modes, Some(playback.wrap_mode())) {
            commands.push(Command::SetWrapMode(mode));
        }
    }
}

fn range(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let playback = session.playback();
    let action = playback.range_secs().map(|_| "Clear");
    if section_with_action(ui, "Range", action) {
        commands.push(Command::ClearRange);
    }
    let [start_secs, end_secs] = playback.played_secs();
    for (name, secs) in [("In", start_secs), ("Out", end_secs)] {
        let typed = format!("{secs:.3}");
        if let Some(secs) = typed_row(ui, name, &format!("{typed} s"), &typed) {
            let secs = Some(secs as f32);
            commands.push(if name == "In" {
                Command::SetRangeStart(secs)
            } else {
                Command::SetRangeEnd(secs)
            });
        }
    }
}

/// A label and a number that can be typed.
fn typed_row(ui: &mut Ui, name: &'static str, text: &str, typed: &str) -> Option<f64> {
    let height = control_size(ui).max(ROW_HEIGHT);
    ui.horizontal(|ui| {
        let tokens = Tokens::of(ui);
        let label_width = ui.available_width() - FIELD_WIDTH - ui.spacing().item_spacing.x;
        let (rect, _) = ui.allocate_exact_size(vec2(label_width, height), Sense::hover());
        let (anchor, font) = (egui::Align2([Align::Min, Align::Center]), FontId::proportional(13.0));
        ui.painter().text(rect.left_center(), anchor, name, font, tokens.muted);
        let (entered, response) = TypedValue::new(ui, name, text, typed).width(FIELD_WIDTH).show(ui);
        response.on_hover_text("Click to type");
        entered.and_then(|typed| typed_number(&typed))
    })
    .inner
}
