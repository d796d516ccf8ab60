//! Panels that hang from a button of the toolbar. They stay while something in them is changed, and while the view is turned.
//! Like the toolbar they end at the window's right margin, where they cover the least of the model.

use egui::{Frame, Popup, PopupCloseBehavior, Pos2, RectAlign, Response, Ui, Vec2, pos2, vec2};

use super::layout::{Arrangement, bar_height};
use super::panel::{scrolled, shown_rect};
use super::theme::{self, MARGIN, Tokens};
use super::timeline::{STRIP_AROUND, strip_height};
use super::widgets::rule;

/// Margin inside a popover.
const POPOVER_MARGIN: f32 = 12.0;
/// From a button to its menu: as far from the bar as the panels are.
const MENU_GAP: f32 = MARGIN + 4.0;
/// The least height before something scrolls.
const LEAST_HEIGHT: f32 = 120.0;
/// With less room than this above the sheet of a phone a popover stands over the sheet, and below the bars over them.
const LEAST_ROOM: f32 = 180.0;

/// Opens and shuts with the button; a click elsewhere or Esc shuts it.
pub(super) fn show(ui: &Ui, button: &Response, width: f32, contents: impl FnOnce(&mut Ui)) {
    let window = ui.ctx().content_rect();
    let top = window.min.y + 2.0 * MARGIN + bar_height(ui);
    // Time can be moved while a popover is open: the strip stays free, though not a sheet above it.
    let strip =
        shown_rect(ui, "timeline").map(|timeline| timeline.max.y - strip_height(ui, Arrangement::Wide) - STRIP_AROUND);
    let bottom = strip.unwrap_or(window.max.y) - MARGIN;
    let room = bottom - top - 2.0 * (POPOVER_MARGIN + 1.0);
    let corner = (pos2(window.max.x - MARGIN, top), RectAlign::BOTTOM_END);
    hang(ui, button, corner, vec2(width, room), contents);
}

/// A menu below a button, which a choice shuts. What is higher than the window scrolls.
pub(super) fn menu(ui: &Ui, button: &Response, align: RectAlign, width: f32, contents: impl FnOnce(&mut Ui)) {
    let bottom = ui.ctx().content_rect().max.y - MARGIN;
    let around = 2.0 * ui.style().spacing.menu_margin.bottom as f32;
    let room = bottom - (button.rect.max.y + MENU_GAP) - around;
    Popup::menu(button).align(align).gap(MENU_GAP).show(|ui| {
        ui.set_width(width);
        scrolled("menu", room.max(LEAST_HEIGHT)).show(ui, contents);
    });
}

/// Shows the contents, `size` at most, from a corner on.
fn hang(ui: &Ui, button: &Response, (at, align): (Pos2, RectAlign), size: Vec2, contents: impl FnOnce(&mut Ui)) {
    Popup::from_toggle_button_response(button)
        .close_behavior(PopupCloseBehavior::CloseOnClickOutside)
        .at_position(at)
        .align(align)
        .align_alternatives(&[])
        .gap(0.0)
        .frame(frame(&Tokens::of(ui)))
        .show(|ui| {
            ui.set_width(size.x);
            scrolled("popover", size.y.max(LEAST_HEIGHT)).show(ui, contents);
        });
}

/// A panel through which nothing is seen, since it lies over other words.
fn frame(tokens: &Tokens) -> Frame {
    theme::panel_frame(tokens)
        .fill(tokens.panel.to_opaque())
        .inner_margin(POPOVER_MARGIN)
}

/// A hairline between the parts of a popover.
pub(super) fn gap(ui: &mut Ui) {
    rule(ui, POPOVER_MARGIN);
}

/// Stands over a button at the window's lower edge, as far from the window's sides as the panels are.
pub(super) fn show_above(ui: &Ui, button: &Response, width: f32, contents: impl FnOnce(&mut Ui)) {
    let window = ui.ctx().content_rect().shrink(MARGIN);
    // On a phone the strip has two rows: what hangs from the lower one stands over both, unless the sheet leaves no room there.
    let above = |top: f32| top - MARGIN - 4.0;
    let sheet = shown_rect(ui, "sheet").map(|sheet| above(sheet.min.y));
    let least = window.min.y + LEAST_ROOM;
    let bottom = sheet
        .filter(|&bottom| bottom >= least)
        .unwrap_or(above(button.rect.min.y));
    // What is higher scrolls, rather than to lie over the bars at the top.
    let below_bars = window.min.y + bar_height(ui) + MARGIN;
    let top = if bottom - below_bars >= LEAST_ROOM {
        below_bars
    } else {
        window.min.y
    };
    // Margins and border.
    let around = 2.0 * (POPOVER_MARGIN + 1.0);
    let room = bottom - top - around;
    let width = width.min(window.width() - around);
    let left = button.rect.min.x.min(window.max.x - width - around).max(window.min.x);
    let corner = (pos2(left, bottom), RectAlign::TOP_START);
    hang(ui, button, corner, vec2(width, room), contents);
}
