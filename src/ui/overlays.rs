//! Lines over and beside the model.

use egui::Ui;

use super::skeleton::{self, SkeletonState};
use super::widgets::{Slider, section_name, switch_row};
use crate::actions;
use crate::scene::{Overlay, Overlays};
use crate::session::{Command, LookCommand, MAX_LINE_LENGTH, Session};

/// The popover's contents.
pub(super) fn show(ui: &mut Ui, session: &Session, state: &mut SkeletonState, commands: &mut Vec<Command>) {
    let overlays = &session.look().overlays;
    section_name(ui, "Overlays");
    for overlay in Overlay::ALL {
        let command = LookCommand::ToggleOverlay(overlay).into();
        let key = actions::key_of(session, &command);
        if switch_row(ui, overlay.label(), key, overlays.has(overlay)).clicked() {
            commands.push(command);
        }
        let last_with_lines = overlay == Overlay::Tangents;
        if last_with_lines && (overlays.has(Overlay::Normals) || overlays.has(Overlay::Tangents)) {
            line_length(ui, overlays.line_length, commands);
        }
    }
    skeleton::show_overlay_rows(ui, session, state, commands);
}

/// Whether anything beside the ground is drawn over the model.
pub(super) fn any_beside_the_grid(session: &Session) -> bool {
    let overlays = &session.look().overlays;
    let mut lines = Overlay::ALL.into_iter().filter(|&overlay| overlay != Overlay::Grid);
    lines.any(|overlay| overlays.has(overlay)) || skeleton::any_shown(session)
}

fn line_length(ui: &mut Ui, length: f32, commands: &mut Vec<Command>) {
    let text = format!("{:.1} %", length * 100.0);
    let slider = Slider::new("Line length", length, 0.0..=MAX_LINE_LENGTH, &text);
    if let Some(length) = slider.reset_to(Overlays::default().line_length).show(ui) {
        commands.push(LookCommand::SetLineLength(length).into());
    }
}
