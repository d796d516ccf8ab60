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

/// Stands over a button at the window's lower edge, as far from the window's sides as the panels are.
pub(super) fn show_above(ui: &Ui, button: &Response, width: f32, contents: impl FnOnce(&mut Ui)) {
    let tokens = Tokens::of(ui);
    let window = ui.ctx().content_rect().shrink(MARGIN);
    let bottom = button.rect.min.y - MARGIN - 4.0;
    let room = bottom - window.min.y - 2.0 * POPOVER_MARGIN;
    // Margins and border.
    let around = 2.0 * (POPOVER_MARGIN + 1.0);
    let width = width.min(window.width() - around);
    let left = button.rect.min.x.min(window.max.x - width - around).max(window.min.x);
    Popup::from_toggle_button_response(button)
        .close_behavior(PopupCloseBehavior::CloseOnClickOutside)
        .at_position(pos2(left, bottom))
        .align(RectAlign::TOP_START)
        .align_alternatives(&[])
        .gap(0.0)
        .frame(theme::panel_frame(&tokens).inner_margin(POPOVER_MARGIN))
        .show(|ui| {
            ui.set_width(width);
            scrolled("popover", room.max(120.0)).show(ui, contents);
        });
}
