//! Panels that float over the view, what hangs from buttons, and how panels share the window.

use egui::{
    Align2, Area, CornerRadius, Frame, Id, LayerId, Margin, Order, Popup, PopupCloseBehavior, Pos2, Rect, RectAlign,
    Response, ScrollArea, Ui, Vec2, pos2, vec2,
};

use super::theme::{self, LOW_HEIGHT, LOW_WIDTH, MARGIN, NARROW_WIDTH, Tokens};
use super::widgets::{control_size, rule};

/// Width of the panel on the left.
pub(super) const SIDE_WIDTH: f32 = 246.0;
/// Width of the inspector on the right.
pub(super) const INSPECTOR_WIDTH: f32 = 288.0;
/// Margin around the controls of the bars at the top.
const BAR_MARGIN: f32 = 4.0;
/// Border and margins of the timeline's panel, above and below together.
pub(super) const STRIP_AROUND: f32 = 2.0 * 9.0;

/// How the panels share the window.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Arrangement {
    /// Panels around the view.
    Wide,
    /// A bar above, below a sheet with the timeline and with what was opened.
    Narrow,
    /// A bar above, the timeline in one row below, and between them what was opened, beside the model.
    Low,
}

impl Arrangement {
    pub(super) fn of(window: Rect) -> Self {
        if window.height() < LOW_HEIGHT && window.width() >= LOW_WIDTH {
            Self::Low
        } else if window.width() >= NARROW_WIDTH {
            Self::Wide
        } else {
            Self::Narrow
        }
    }
}

/// Height of the bars at the top.
pub(super) fn bar_height(ui: &Ui) -> f32 {
    control_size(ui) + 2.0 * BAR_MARGIN
}

/// Height of the timeline's strip, without border and margins.
pub(super) fn strip_height(ui: &Ui, arrangement: Arrangement) -> f32 {
    let control = control_size(ui);
    match arrangement {
        Arrangement::Wide => control.max(34.0),
        Arrangement::Narrow => 44.0 + 8.0 + control,
        Arrangement::Low => 44.0,
    }
}

/// A list in a panel that scrolls once it is higher than `most`. A panel remembers the size that it had, so without a word
/// about it a list that grows would scroll in the height of before.
pub(super) fn scrolled(id: &'static str, most: f32) -> ScrollArea {
    ScrollArea::vertical()
        .id_salt(id)
        .max_height(most)
        .min_scrolled_height(most)
}

/// Where a panel is that was shown in the last pass.
pub(super) fn shown_rect(ui: &Ui, name: &'static str) -> Option<Rect> {
    let layer = LayerId::new(Order::Middle, id_of(name));
    ui.memory(|memory| {
        let shown = memory.areas().visible_last_frame(&layer);
        memory.area_rect(layer.id).filter(|_| shown)
    })
}

fn id_of(name: &'static str) -> Id {
    Id::unique(("panel", name))
}

/// Border and margins of a panel, of two sides together, unless its margins are its own.
pub(super) const PANEL_AROUND: f32 = 26.0;

/// Where a panel is and what it looks like.
#[derive(Clone, Copy, Debug)]
pub(super) struct Panel {
    name: &'static str,
    pivot: Align2,
    at: Pos2,
    order: Order,
    margin: Margin,
    corner_radius: CornerRadius,
}

impl Panel {
    /// A panel whose `pivot` corner is at a point.
    pub(super) fn new(name: &'static str, pivot: Align2, at: Pos2) -> Self {
        let corner_radius = CornerRadius::same(theme::PANEL_RADIUS);
        Self {
            name,
            pivot,
            at,
            order: Order::Middle,
            margin: Margin::same(12),
            corner_radius,
        }
    }

    /// Over the other panels.
    pub(super) fn on_top(self) -> Self {
        Self {
            order: Order::Foreground,
            ..self
        }
    }

    /// Room between border and contents; 12 points unless told.
    pub(super) fn margin(self, margin: Margin) -> Self {
        Self { margin, ..self }
    }

    /// Round corners at the top alone, as a sheet that comes from below.
    pub(super) fn sheet(self) -> Self {
        Self {
            corner_radius: CornerRadius {
                nw: 14,
                ne: 14,
                sw: 0,
                se: 0,
            },
            ..self
        }
    }

    /// Shows it. Where it came to be.
    pub(super) fn show(self, ui: &Ui, contents: impl FnOnce(&mut Ui)) -> Rect {
        let frame: Frame = theme::panel_frame(&Tokens::of(ui))
            .inner_margin(self.margin)
            .corner_radius(self.corner_radius);
        let before = ui.memory(|memory| memory.area_rect(id_of(self.name)));
        let now = Area::new(id_of(self.name))
            .order(self.order)
            .pivot(self.pivot)
            .fixed_pos(self.at)
            .constrain_to(ui.max_rect())
            // What a panel may grow to before it is first measured.
            .default_size(ui.max_rect().size())
            .fade_in(false)
            .show(ui.ctx(), |ui| frame.show(ui, contents))
            .response
            .rect;
        // A panel stands by the size that it had, and others and the model stand beside it: the next pass puts all right.
        if before.is_none_or(|before| before.size() != now.size()) {
            ui.ctx().request_repaint();
        }
        now
    }
}

/// Margin inside a popover.
const POPOVER_MARGIN: f32 = 12.0;
/// From a button to its menu: as far from the bar as the panels are.
const MENU_GAP: f32 = MARGIN + 4.0;
/// The least height before something scrolls.
const LEAST_HEIGHT: f32 = 120.0;
/// With less room than this above the sheet of a phone a popover stands over the sheet, and below the bars over them.
const LEAST_ROOM: f32 = 180.0;

/// Opens and shuts with the button; a click elsewhere or Esc shuts it.
pub(super) fn popover(ui: &Ui, button: &Response, width: f32, contents: impl FnOnce(&mut Ui)) {
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
pub(super) fn popover_menu(ui: &Ui, button: &Response, align: RectAlign, width: f32, contents: impl FnOnce(&mut Ui)) {
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
        .frame(popover_frame(&Tokens::of(ui)))
        .show(|ui| {
            ui.set_width(size.x);
            scrolled("popover", size.y.max(LEAST_HEIGHT)).show(ui, contents);
        });
}

/// An opaque panel, since it lies over text.
fn popover_frame(tokens: &Tokens) -> Frame {
    theme::panel_frame(tokens)
        .fill(tokens.panel.to_opaque())
        .inner_margin(POPOVER_MARGIN)
}

/// A hairline between the parts of a popover.
pub(super) fn popover_gap(ui: &mut Ui) {
    rule(ui, POPOVER_MARGIN);
}

/// Stands over a button at the window's lower edge, as far from the window's sides as the panels are.
pub(super) fn popover_above(ui: &Ui, button: &Response, width: f32, contents: impl FnOnce(&mut Ui)) {
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
