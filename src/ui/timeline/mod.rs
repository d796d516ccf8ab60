//! The panel at the bottom: transport and bar, and above them, when it is open, the dope sheet or curves of a joint.

mod axis;
mod bar;
mod clips;
mod controls;
mod curve_plot;
mod curves;
mod dope_sheet;
mod edge;
mod folded;
mod joint_row;
mod key_box;
mod key_press;
mod marks;
mod options;
mod plot;
mod readouts;
mod rows;
mod ruler;
mod seam;
mod seam_list;
mod sheet;
mod state;
mod time_area;
mod transport;

pub(super) use sheet::page;
pub(super) use state::TimelineState;
pub(super) use transport::narrow;

use egui::Ui;

use super::layout::Arrangement;
use super::state::UiState;
use super::theme::MARGIN;
use super::widgets::control_size;
use crate::session::{Command, Session};

/// Room between sheet and transport.
const SHEET_GAP: f32 = 8.0;
/// Border and margins of the panel, above and below together.
pub(super) const STRIP_AROUND: f32 = 2.0 * 9.0;

/// Height of the strip's content.
pub(super) fn strip_height(ui: &Ui, arrangement: Arrangement) -> f32 {
    let control = control_size(ui);
    match arrangement {
        Arrangement::Wide => control.max(34.0),
        Arrangement::Narrow => 44.0 + 8.0 + control,
        Arrangement::Low => 44.0,
    }
}

/// The panel's contents in a wide window.
pub(super) fn wide(ui: &mut Ui, session: &Session, state: &mut UiState, commands: &mut Vec<Command>) {
    edge::show(ui, &mut state.timeline);
    if let Some(height) = state.timeline.sheet_height(ui) {
        sheet::show(ui, session, &mut state.timeline, height, commands);
        ui.add_space(SHEET_GAP);
    }
    transport::wide(ui, session, state, commands);
}

/// Room that the panel takes from a wide window's lower edge, with margins.
pub(super) fn covered_height(ui: &Ui, session: &Session, state: &TimelineState) -> f32 {
    if session.clip().is_none() {
        return 0.0;
    }
    let sheet = state.sheet_height(ui);
    strip_height(ui, Arrangement::Wide) + sheet.map_or(0.0, |height| height + SHEET_GAP) + STRIP_AROUND + MARGIN * 2.0
}
