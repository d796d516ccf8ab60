//! The panel's upper edge: dragged, it opens the sheet and sizes it.

use egui::{CursorIcon, Rect, Role, Sense, Ui, WidgetInfo, vec2};

use super::super::theme::Tokens;
use super::TimelineState;

/// The edge lies over the panel's margin.
const REACH: f32 = 9.0;

/// Takes hold of the edge of the panel whose contents begin here.
pub(super) fn show(ui: &Ui, state: &mut TimelineState) {
    let contents = ui.max_rect();
    let edge = Rect::from_x_y_ranges(contents.x_range(), contents.min.y - REACH..=contents.min.y - 1.0);
    let response = ui
        .interact(edge, ui.scope_id().with("edge"), Sense::click_and_drag())
        .on_hover_cursor(CursorIcon::ResizeVertical);
    if response.drag_started() && !state.open {
        state.dragged_height = Some(0.0);
    }
    if response.dragged() {
        let height = state.dragged_height.or(state.sheet_height(ui)).unwrap_or(0.0);
        state.drag_height(height - response.drag_delta().y);
    }
    if response.drag_stopped() {
        state.settle_height(ui);
    }
    if response.double_clicked() {
        state.open = !state.open;
    }
    let tokens = Tokens::of(ui);
    let color = if response.hovered() || response.dragged() {
        tokens.muted
    } else {
        tokens.hairline
    };
    let grip = Rect::from_center_size(edge.center() - vec2(0.0, 1.0), vec2(38.0, 3.0));
    ui.painter().rect_filled(grip, 1.5, color);
    response.widget_info(|| WidgetInfo::labeled(Role::Splitter, true, "Height of the dope sheet"));
}
