//! What opens above the strip: dope sheet or curves, and the controls of each.

use egui::{Rect, Sense, Ui, UiBuilder, vec2};

use super::super::icons::Icon;
use super::super::state::UiState;
use super::super::theme::Tokens;
use super::super::widgets::{TextButton, control_size, icon_button, segmented};
use super::super::wording::counted;
use super::state::{SheetTab, TimelineState};
use super::{controls, curves, dope_sheet};
use crate::session::{Command, JointCommand, Session};

/// Room between the controls and what they control.
const GAP: f32 = 6.0;
/// Below this height a page has no room for buttons that move the time.
const WITH_TRANSPORT: f32 = 260.0;

/// The sheet of a wide window, this high.
pub(super) fn show(
    ui: &mut Ui,
    session: &Session,
    state: &mut TimelineState,
    height: f32,
    commands: &mut Vec<Command>,
) {
    let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), height), Sense::hover());
    let mut child = ui.new_child(UiBuilder::new().max_rect(rect).id_salt("sheet"));
    contents(&mut child, session, state, commands);
}

/// The sheet as a page of a narrow window, with `room` for its height.
pub(in crate::ui) fn page(ui: &mut Ui, session: &Session, state: &mut UiState, room: f32, commands: &mut Vec<Command>) {
    let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), room), Sense::hover());
    let mut child = ui.new_child(UiBuilder::new().max_rect(rect).id_salt("sheet"));
    if room >= WITH_TRANSPORT {
        controls::all_steps(&mut child, session, commands);
        child.add_space(GAP);
    }
    contents(&mut child, session, &mut state.timeline, commands);
}

fn contents(ui: &mut Ui, session: &Session, state: &mut TimelineState, commands: &mut Vec<Command>) {
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = vec2(GAP, 4.0);
        let tabs = [(SheetTab::Keys, "Dope sheet"), (SheetTab::Curves, "Curves")];
        if let Some(tab) = segmented_of_width(ui, 172.0, "Sheet", &tabs, state.tab) {
            state.tab = tab;
        }
        match state.tab {
            SheetTab::Keys => keys_controls(ui, session, state, commands),
            SheetTab::Curves => state.curves.controls(ui),
        }
        if state.window.is_part() && icon_button(ui, Icon::Frame, "All of the time", false).clicked() {
            state.window.show_all();
        }
    });
    ui.add_space(GAP);
    match state.tab {
        SheetTab::Keys => dope_sheet::show(ui, session, state, commands),
        SheetTab::Curves => curves::show(ui, session, state, commands),
    }
}

fn keys_controls(ui: &mut Ui, session: &Session, state: &mut TimelineState, commands: &mut Vec<Command>) {
    let by_motion = state.rows.by_motion;
    if icon_button(ui, Icon::Sort, "Sort by motion", by_motion).clicked() {
        state.rows.by_motion = !by_motion;
    }
    if !by_motion {
        let joints = session.joints();
        let any_folded = joints.tree().order().iter().any(|&joint| joints.is_folded(joint));
        let label = if any_folded { "Unfold all" } else { "Fold all" };
        if icon_button(ui, Icon::Fold, label, any_folded).clicked() {
            commands.push(JointCommand::SetAllFolded(!any_folded).into());
        }
    }
    let Some(key_box) = &state.key_box else { return };
    let [start_secs, end_secs] = key_box.span_secs;
    let words = format!(
        "{} · {start_secs:.2}–{end_secs:.2} s",
        counted(key_box.count(session), "key")
    );
    let color = Tokens::of(ui).muted;
    let galley = ui
        .painter()
        .layout_no_wrap(words.clone(), egui::FontId::proportional(12.5), color);
    let (rect, response) = ui.allocate_exact_size(vec2(galley.size().x + 8.0, control_size(ui)), Sense::hover());
    let at = rect.left_center() + vec2(4.0, -0.5 * galley.size().y);
    ui.painter().galley(at, galley, color);
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, true, &words));
    if start_secs < end_secs && TextButton::new("As range", "As range").show(ui).clicked() {
        commands.push(Command::ClearRange);
        commands.push(Command::SetRangeStart(Some(start_secs)));
        commands.push(Command::SetRangeEnd(Some(end_secs)));
    }
}

/// A switch among other controls.
pub(super) fn segmented_of_width<T: Copy + PartialEq>(
    ui: &mut Ui,
    width: f32,
    name: &str,
    choices: &[(T, &str)],
    in_force: T,
) -> Option<T> {
    let (rect, _) = ui.allocate_exact_size(vec2(width, control_size(ui)), Sense::hover());
    let mut child = ui.new_child(UiBuilder::new().max_rect(rect).id_salt(name));
    segmented(&mut child, name, choices, Some(in_force))
}

/// Where names end and time begins.
pub(super) fn split_x(area: Rect) -> f32 {
    let names = if area.width() < 600.0 { 124.0 } else { 196.0 };
    area.min.x + names
}
