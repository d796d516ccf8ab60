//! One of a few, side by side.

use egui::{Align2, FontId, Rect, Role, Sense, Ui, WidgetInfo, pos2, vec2};

use super::super::theme::{CONTROL_RADIUS, Tokens};
use super::{control_size, focus_ring};

/// A switch with a place for each choice, over the whole width. What was chosen, when something was.
pub(crate) fn segmented<T: Copy + PartialEq>(
    ui: &mut Ui,
    name: &str,
    choices: &[(T, &str)],
    in_force: Option<T>,
) -> Option<T> {
    let tokens = Tokens::of(ui);
    let size = vec2(ui.available_width(), control_size(ui));
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    ui.painter().rect_filled(rect, CONTROL_RADIUS, tokens.field);
    let inner = rect.shrink(2.0);
    let width = inner.width() / choices.len().max(1) as f32;
    let mut chosen = None;
    for (index, &(choice, label)) in choices.iter().enumerate() {
        let left = inner.min.x + index as f32 * width;
        let place = Rect::from_min_max(pos2(left, inner.min.y), pos2(left + width, inner.max.y));
        // By touch the whole height can be pressed.
        let target = Rect::from_x_y_ranges(place.x_range(), rect.y_range());
        let part = ui.interact(target, response.id.with(index), Sense::click());
        let on = in_force == Some(choice);
        let color = match (on, part.hovered()) {
            (true, _) => tokens.accent,
            (false, true) => tokens.text,
            (false, false) => tokens.muted,
        };
        if on {
            ui.painter()
                .rect_filled(place, CONTROL_RADIUS - 2, tokens.accent_ground);
        }
        focus_ring(ui, place, &part);
        let font = FontId::proportional(12.5);
        ui.painter()
            .text(place.center(), Align2::CENTER_CENTER, label, font, color);
        part.widget_info(|| WidgetInfo::selected(Role::RadioButton, true, on, format!("{name}: {label}")));
        if part.clicked() {
            chosen = Some(choice);
        }
    }
    chosen
}
