//! The sheet above the strip: dope sheet or curves with their controls, and the edge that opens it.

pub(in crate::ui) mod dope_sheet;
pub(in crate::ui) mod joint_row;
pub(in crate::ui) mod key_cursor;
pub(in crate::ui) mod rows;

use egui::{CursorIcon, FontId, PointerButton, Rect, Role, Sense, Ui, UiBuilder, WidgetInfo, vec2};

use super::curves::curve_plot;
use super::state::{SheetTab, TimelineState};
use super::strip::controls;
use super::time_area::segmented_of_width;
use crate::session::{JointCommand, PlayCommand};
use crate::ui::cx::Cx;
use crate::ui::kit::icons::Icon;
use crate::ui::kit::theme::Tokens;
use crate::ui::kit::wording::counted;
use crate::ui::kit::{TextButton, arrow_steps, control_size, icon_button, push_button, tell_node, tell_push};
use crate::ui::state::UiState;

/// Gap between the controls and the sheet.
const GAP: f32 = 6.0;
/// Pages lower than this have no buttons that step.
const WITH_TRANSPORT: f32 = 260.0;

/// The sheet of a wide window, with a height.
pub(super) fn show(ui: &mut Ui, cx: &mut Cx<'_, TimelineState>, height: f32) {
    let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), height), Sense::hover());
    let mut child = ui.new_child(UiBuilder::new().max_rect(rect).id_salt("sheet"));
    contents(&mut child, cx);
}

/// The sheet as a page of a narrow window, as high as what is available.
pub(in crate::ui) fn page(ui: &mut Ui, cx: &mut Cx<'_, UiState>) {
    let (rect, _) = ui.allocate_exact_size(ui.available_size(), Sense::hover());
    let mut child = ui.new_child(UiBuilder::new().max_rect(rect).id_salt("sheet"));
    if rect.height() >= WITH_TRANSPORT {
        controls::all_steps(&mut child, cx);
        child.add_space(GAP);
    }
    contents(&mut child, &mut cx.part(|state| &mut state.timeline));
}

fn contents(ui: &mut Ui, cx: &mut Cx<'_, TimelineState>) {
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = vec2(GAP, 4.0);
        let tabs = [(SheetTab::Keys, "Dope sheet"), (SheetTab::Curves, "Curves")];
        segmented_of_width(ui, 172.0, "Sheet", &tabs, &mut cx.state.tab);
        match cx.state.tab {
            SheetTab::Keys => keys_controls(ui, cx),
            SheetTab::Curves => curve_plot::controls(ui, &mut cx.state.curves),
        }
        chosen_keys(ui, cx);
        if cx.state.seen.is_part() && push_button(ui, Icon::Frame, "All of the time").clicked() {
            cx.state.seen.show_all();
        }
    });
    ui.add_space(GAP);
    match cx.state.tab {
        SheetTab::Keys => dope_sheet::show(ui, cx),
        SheetTab::Curves => curve_plot::show(ui, cx),
    }
}

fn keys_controls(ui: &mut Ui, cx: &mut Cx<'_, TimelineState>) {
    let by_motion = cx.state.rows.by_motion;
    if icon_button(ui, Icon::Sort, "Sort by motion", by_motion).clicked() {
        cx.state.rows.by_motion = !by_motion;
    }
    if !by_motion {
        let joints = cx.session.joints();
        let any_folded = joints.tree().order().iter().any(|&joint| joints.is_folded(joint));
        let label = if any_folded { "Unfold all" } else { "Fold all" };
        let fold = icon_button(ui, Icon::Fold, label, any_folded);
        tell_push(&fold);
        if fold.clicked() {
            cx.push(JointCommand::SetAllFolded(!any_folded));
        }
    }
}

/// How many keys are chosen, and what can be done with them.
fn chosen_keys(ui: &mut Ui, cx: &mut Cx<'_, TimelineState>) {
    let Some(key_box) = &cx.state.key_box else { return };
    let [start_secs, end_secs] = key_box.span_secs;
    let words = format!(
        "{} · {start_secs:.2}–{end_secs:.2} s",
        counted(key_box.count(cx.session), "key")
    );
    let color = Tokens::of(ui).muted;
    let galley = ui
        .painter()
        .layout_no_wrap(words.clone(), FontId::proportional(12.5), color);
    let (rect, response) = ui.allocate_exact_size(vec2(galley.size().x + 8.0, control_size(ui)), Sense::hover());
    let at = rect.left_center() + vec2(4.0, -0.5 * galley.size().y);
    ui.painter().galley(at, galley, color);
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, &words));
    if start_secs < end_secs && TextButton::new("As range", "As range").show(ui).clicked() {
        cx.push(PlayCommand::ClearRange);
        cx.push(PlayCommand::SetRangeStart(Some(start_secs)));
        cx.push(PlayCommand::SetRangeEnd(Some(end_secs)));
    }
}

/// How far an arrow key moves the edge.
const STEP: f32 = 24.0;
/// How far the edge reaches into the panel's margin.
const REACH: f32 = 9.0;

/// The upper edge of the panel, above its contents. A drag opens and resizes the sheet.
pub(super) fn show_edge(ui: &Ui, state: &mut TimelineState) {
    let contents = ui.max_rect();
    let edge = Rect::from_x_y_ranges(contents.x_range(), contents.min.y - REACH..=contents.min.y - 1.0);
    let response = ui
        .interact(edge, ui.scope_id().with("edge"), Sense::click_and_drag())
        .on_hover_cursor(CursorIcon::ResizeVertical);
    if response.drag_started() && !state.open {
        state.dragged_height = Some(0.0);
    }
    if response.dragged() {
        let height = state
            .dragged_height
            .or(state.sheet_height(ui.available_height()))
            .unwrap_or(0.0);
        state.drag_height(height - response.drag_delta().y);
    }
    if response.drag_stopped() {
        state.settle_height(ui.available_height());
    }
    // Enter or Space, or what a screen reader asks for.
    let typed = response.clicked() && !response.clicked_by(PointerButton::Primary);
    if response.double_clicked() || typed {
        state.open = !state.open;
    }
    let steps = arrow_steps(ui, &response);
    if steps != 0.0 {
        let height = state.sheet_height(ui.available_height()).unwrap_or(0.0);
        state.drag_height(height + steps * STEP);
        state.settle_height(ui.available_height());
    }
    let tokens = Tokens::of(ui);
    let color = if response.has_focus() {
        tokens.accent
    } else if response.hovered() || response.dragged() {
        tokens.muted
    } else {
        tokens.hairline
    };
    let grip = Rect::from_center_size(edge.center() - vec2(0.0, 1.0), vec2(38.0, 3.0));
    ui.painter().rect_filled(grip, 1.5, color);
    response.widget_info(|| WidgetInfo::labeled(Role::Splitter, true, "Height of the dope sheet"));
    tell_node(&response, |node| node.set_expanded(state.open));
}
