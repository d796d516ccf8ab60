//! The handle that makes the panel with the tree wider, for deep trees and long names.

use egui::accesskit::{Action, Orientation};
use egui::{CursorIcon, Rangef, Rect, Role, Sense, Stroke, Ui, WidgetInfo, pos2};

use crate::ui::kit::theme::Tokens;
use crate::ui::kit::{arrow_steps, is_touch, tell_node};

/// The greatest width of the panel, in points and as a fraction of the window.
const MOST: f32 = 520.0;
const MOST_FRACTION: f32 = 0.45;
/// Points for one press of an arrow key.
const STEP: f32 = 16.0;
/// How far the handle reaches out of the panel for a mouse, and for fingers.
const REACH: f32 = 8.0;
const TOUCH_REACH: f32 = 24.0;

/// A width within the bounds of a window.
pub(in crate::ui) fn side_width(ui: &Ui, width: f32, least: f32) -> f32 {
    let most = MOST.min(MOST_FRACTION * ui.max_rect().width()).max(least);
    width.clamp(least, most)
}

/// The handle at the right edge of the panel. Returns a width that was asked for.
pub(in crate::ui) fn show_handle(ui: &Ui, panel: Rect, least: f32) -> Option<f32> {
    let reach = if is_touch(ui) { TOUCH_REACH } else { REACH };
    let place = Rect::from_min_max(panel.right_top(), pos2(panel.max.x + reach, panel.max.y));
    let response = ui.interact(place, ui.scope_id().with("panel width"), Sense::drag());
    let held = response.hovered() || response.dragged() || response.has_focus();
    if held {
        ui.set_cursor_icon(CursorIcon::ResizeHorizontal);
        let y = Rangef::point(panel.center().y).expand(18.0);
        let stroke = Stroke::new(2.0, Tokens::of(ui).accent);
        ui.painter().vline(panel.max.x + 3.0, y, stroke);
    }
    response.widget_info(|| WidgetInfo::labeled(Role::Splitter, true, "Width of the panel"));
    tell_node(&response, |node| {
        node.set_orientation(Orientation::Vertical);
        node.set_numeric_value(panel.width().into());
        node.add_action(Action::Increment);
        node.add_action(Action::Decrement);
    });
    let steps = arrow_steps(ui, &response);
    let wanted = match response.interact_pointer_pos().filter(|_| response.dragged()) {
        Some(pointer) => pointer.x - panel.min.x,
        None if steps != 0.0 => panel.width() + STEP * steps,
        None => return None,
    };
    Some(side_width(ui, wanted, least))
}
