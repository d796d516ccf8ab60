//! A small rounded label.

use egui::{Align2, Color32, FontId, Painter, Pos2, Rect, Response, Role, Sense, Ui, Vec2, WidgetInfo, vec2};

use super::super::theme::Tokens;

/// Room around the words, left and right together, above and below together.
const AROUND: Vec2 = vec2(14.0, 5.0);

/// A chip in a row.
pub(crate) fn chip(ui: &mut Ui, text: &str, color: Color32) -> Response {
    let ground = Tokens::of(ui).field;
    let galley = layout(ui.painter(), text, color);
    let (rect, response) = ui.allocate_exact_size(galley.size() + AROUND, Sense::hover());
    paint_chip(ui.painter(), rect.min, Align2::LEFT_TOP, text, color, ground);
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, text));
    response
}

/// How large a chip is.
pub(crate) fn chip_size(ui: &Ui, text: &str) -> Vec2 {
    layout(ui.painter(), text, Color32::WHITE).size() + AROUND
}

/// Draws a chip whose `anchor` is at a point. Where it came to be.
pub(crate) fn paint_chip(
    painter: &Painter,
    at: Pos2,
    anchor: Align2,
    text: &str,
    color: Color32,
    ground: Color32,
) -> Rect {
    let galley = layout(painter, text, color);
    let rect = anchor.anchor_size(at, galley.size() + AROUND);
    painter.rect_filled(rect, rect.height() * 0.5, ground);
    painter.galley(rect.min + AROUND * 0.5, galley, color);
    rect
}

fn layout(painter: &Painter, text: &str, color: Color32) -> std::sync::Arc<egui::Galley> {
    painter.layout_no_wrap(text.to_owned(), FontId::proportional(11.5), color)
}
