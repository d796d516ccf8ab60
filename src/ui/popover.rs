//! Panels that hang from a button of the toolbar. They stay while something in them is changed, and while the view is turned.
//! Like the toolbar they end at the window's right margin, where they cover the least of the model.

use egui::{Popup, PopupCloseBehavior, RectAlign, Response, Ui, pos2};

use super::layout::bar_height;
use super::panel::scrolled;
use super::theme::{self, MARGIN, Tokens};
use super::widgets::rule;

/// Margin inside a popover.
const POPOVER_MARGIN: f32 = 12.0;

/// Opens and shuts with the button; a click elsewhere or Esc shuts it.
pub(super) fn show(ui: &Ui, button: &Response, width: f32, contents: impl FnOnce(&mut Ui)) {
    let tokens = Tokens::of(ui);
    let window = ui.ctx().content_rect();
    let top = window.min.y + 2.0 * MARGIN + bar_height(ui);
    let room = window.max.y - top - MARGIN - 2.0 * POPOVER_MARGIN;
    Popup::from_toggle_button_response(button)
        .close_behavior(PopupCloseBehavior::CloseOnClickOutside)
        .at_position(pos2(window.max.x - MARGIN, top))
        .align(RectAlign::BOTTOM_END)
        .align_alternatives(&[])
        .gap(0.0)
        .frame(theme::panel_frame(&tokens).inner_margin(POPOVER_MARGIN))
        .show(|ui| {
            ui.set_width(width);
            scrolled("popover", room.max(120.0)).show(ui, contents);
        });
}

/// A hairline between the parts of a popover.
pub(super) fn gap(ui: &mut Ui) {
    rule(ui, POPOVER_MARGIN);
}

/// Hangs over a button at the window's lower edge.
pub(super) fn show_above(ui: &Ui, button: &Response, width: f32, contents: impl FnOnce(&mut Ui)) {
    let tokens = Tokens::of(ui);
    let window = ui.ctx().content_rect();
    let gap = MARGIN + 4.0;
    let room = button.rect.min.y - gap - window.min.y - MARGIN - 2.0 * POPOVER_MARGIN;
    let width = width.min(window.width() - 2.0 * (MARGIN + POPOVER_MARGIN + 1.0));
    Popup::from_toggle_button_response(button)
        .close_behavior(PopupCloseBehavior::CloseOnClickOutside)
        .align(RectAlign::TOP_START)
        .align_alternatives(&[RectAlign::TOP_END, RectAlign::TOP])
        .gap(gap)
        .frame(theme::panel_frame(&tokens).inner_margin(POPOVER_MARGIN))
        .show(|ui| {
            ui.set_width(width);
            scrolled("popover", room.max(120.0)).show(ui, contents);
        });
}
