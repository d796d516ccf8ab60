//! Panels that float over the view, the room that they leave, popovers and menus.

use egui::accesskit::HasPopup;
use egui::{
    Align2, Area, CornerRadius, Frame, Id, LayerId, Margin, Order, Popup, PopupCloseBehavior, Pos2, Rect, RectAlign,
    Response, Role, ScrollArea, Sense, Ui, Vec2, pos2, vec2,
};

use crate::ui::kit::theme::{self, MARGIN, Tokens};
use crate::ui::kit::{rule, tell_popup};

/// Names of panels that more than the layout asks for.
pub(in crate::ui) const TITLE: &str = "title";
pub(in crate::ui) const FINDINGS: &str = "findings";
pub(in crate::ui) const PAGE: &str = "page";
pub(in crate::ui) const DRAWER: &str = "drawer";

/// The part of the window that no panel covers. Panels are shown one after the other, and each cuts off what it took with a margin.
#[derive(Clone, Copy, Debug)]
pub(in crate::ui) struct Free {
    window: Rect,
    pub(in crate::ui) rect: Rect,
}

impl Free {
    pub(in crate::ui) fn new(window: Rect) -> Self {
        Self { window, rect: window }
    }

    /// The room for the next panel: the free part, at a margin from the edges of the window.
    pub(in crate::ui) fn room(&self) -> Rect {
        self.rect.intersect(self.window.shrink(MARGIN))
    }

    pub(in crate::ui) fn cut_top(&mut self, panel: Rect) {
        self.rect.min.y = panel.max.y + MARGIN;
    }

    pub(in crate::ui) fn cut_bottom(&mut self, panel: Rect) {
        self.rect.max.y = panel.min.y - MARGIN;
    }

    pub(in crate::ui) fn cut_left(&mut self, panel: Rect) {
        self.rect.min.x = panel.max.x + MARGIN;
    }

    pub(in crate::ui) fn cut_right(&mut self, panel: Rect) {
        self.rect.max.x = panel.min.x - MARGIN;
    }
}

/// A list that scrolls once it is higher than `most`. The least height is set too: a popover remembers its last size, and a list that
/// grows would scroll in that.
pub(in crate::ui) fn scrolled(id: &'static str, most: f32) -> ScrollArea {
    ScrollArea::vertical()
        .id_salt(id)
        .max_height(most)
        .min_scrolled_height(most)
}

/// The rect of a panel in the last pass, if it was shown. Popovers need it: they are shown before or inside of the panel.
fn shown_rect(ui: &Ui, name: &'static str) -> Option<Rect> {
    let layer = LayerId::new(Order::Middle, id_of(name));
    ui.memory(|memory| {
        let shown = memory.areas().visible_last_frame(&layer);
        memory.area_rect(layer.id).filter(|_| shown)
    })
}

/// Notes where the transport is. Popovers do not cover it.
pub(in crate::ui) fn mark_transport(ui: &Ui, rect: Rect) {
    ui.interact(rect, id_of("transport"), Sense::hover());
}

pub(in crate::ui) fn id_of(name: &str) -> Id {
    Id::unique(("panel", name))
}

/// A panel at a corner of its room.
#[derive(Clone, Copy, Debug)]
pub(in crate::ui) struct Panel<'a> {
    name: &'static str,
    role: Role,
    label: &'a str,
    corner: Align2,
    width: Option<f32>,
    order: Order,
    margin: Margin,
    corner_radius: CornerRadius,
}

impl<'a> Panel<'a> {
    /// A panel as large as its contents. For programs that read the screen it is a region of this label.
    pub(in crate::ui) fn new(name: &'static str, label: &'a str, corner: Align2) -> Self {
        let corner_radius = CornerRadius::same(theme::PANEL_RADIUS);
        Self {
            name,
            role: Role::Region,
            label,
            corner,
            width: None,
            order: Order::Middle,
            margin: Margin::same(12),
            corner_radius,
        }
    }

    /// Its width with border and margins, whatever the contents need.
    pub(in crate::ui) fn width(self, width: f32) -> Self {
        let width = Some(width);
        Self { width, ..self }
    }

    /// What it is for programs that read the screen.
    pub(in crate::ui) fn role(self, role: Role) -> Self {
        Self { role, ..self }
    }

    pub(in crate::ui) fn on_top(self) -> Self {
        Self {
            order: Order::Foreground,
            ..self
        }
    }

    /// Room between border and contents. 12 points unless told.
    pub(in crate::ui) fn margin(self, margin: Margin) -> Self {
        Self { margin, ..self }
    }

    /// A drawer at the bottom: only its upper corners are round.
    pub(in crate::ui) fn drawer(self) -> Self {
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

    /// Shows it in a room, and returns the rect that it took. What is available to the contents is the room without border and
    /// margins.
    pub(in crate::ui) fn show(self, ui: &Ui, room: Rect, contents: impl FnOnce(&mut Ui)) -> Rect {
        let tokens = Tokens::of(ui);
        let fill = match self.order {
            // It lies over other panels.
            Order::Foreground => tokens.panel.to_opaque(),
            _ => tokens.panel,
        };
        let frame: Frame = theme::panel_frame(&tokens)
            .fill(fill)
            .inner_margin(self.margin)
            .corner_radius(self.corner_radius);
        let before = ui.memory(|memory| memory.area_rect(id_of(self.name)));
        let now = Area::new(id_of(self.name))
            .role(self.role)
            .accessible_name(self.label)
            .order(self.order)
            .pivot(self.corner)
            .fixed_pos(self.corner.pos_in_rect(&room))
            .constrain_to(ui.max_rect())
            .default_size(room.size())
            .fade_in(false)
            .show(ui.ctx(), |ui| {
                ui.ctx()
                    .accesskit_node_builder(ui.unique_id(), |node| node.set_author_id(self.name));
                // In a tiny window the panels before it may have left less than nothing.
                let size = vec2(self.width.unwrap_or(room.width()), room.height());
                ui.set_max_size(size.max(Vec2::ZERO));
                frame.show(ui, |ui| {
                    if self.width.is_some() {
                        ui.take_available_width();
                    }
                    contents(ui);
                })
            })
            .response
            .rect;
        if before.is_none_or(|before| before.size() != now.size()) {
            self.place_again(ui);
        }
        now
    }

    /// egui places an area by its size in the last pass. Another pass of the same frame places all panels by their new sizes. While a
    /// size changes in every frame, as in a drag, the next frame is soon enough: a second pass of each would take twice the time.
    fn place_again(self, ui: &Ui) {
        let frame = ui.ctx().cumulative_frame_nr();
        let changed = id_of(self.name).with("changed");
        let last: Option<u64> = ui.data_mut(|data| {
            let last = data.get_temp(changed);
            data.insert_temp(changed, frame);
            last
        });
        if last.is_some_and(|last| last + 1 == frame) {
            ui.ctx().request_repaint();
        } else {
            ui.ctx().request_discard("a panel has another size");
        }
    }
}

const POPOVER_MARGIN: f32 = MARGIN;
/// From a button to its menu, so that the menu is as far from the bar as the panels are.
const MENU_GAP: f32 = MARGIN + 4.0;
/// The least height of a popover.
const LEAST_HEIGHT: f32 = 120.0;
/// With less room than this above the drawer of a phone a popover covers the drawer. With less below the bars it covers these.
pub(in crate::ui) const LEAST_ROOM: f32 = 180.0;

/// The button of a popover, and what the popover is called.
type Opener<'a> = (&'a Response, &'a str);

/// A popover of the toolbar. The button opens and closes it. A click elsewhere or Esc closes it.
pub(in crate::ui) fn popover(ui: &Ui, opener: Opener<'_>, width: f32, contents: impl FnOnce(&mut Ui)) {
    unscrolled_popover(ui, opener, width, |ui, most| {
        scrolled("popover", most).show(ui, contents);
    });
}

/// The same for contents that scroll by themselves; they are given the greatest height.
pub(in crate::ui) fn unscrolled_popover(ui: &Ui, opener: Opener<'_>, width: f32, contents: impl FnOnce(&mut Ui, f32)) {
    let window = ui.ctx().content_rect().shrink(MARGIN);
    let top = below_bars(ui);
    // A person can move the time while a popover is open. It may cover the drawer above the transport.
    let transport = ui.ctx().read_response(id_of("transport"));
    let bottom = transport.map_or(window.max.y, |transport| transport.rect.min.y - 2.0 * MARGIN);
    let corner = (pos2(window.max.x, top), RectAlign::BOTTOM_END);
    hang(ui, opener, corner, vec2(width, bottom - top - around(ui)), contents);
}

/// A menu below a button. A choice closes it. A menu higher than the window scrolls.
pub(in crate::ui) fn popover_menu(
    ui: &Ui,
    button: &Response,
    align: RectAlign,
    width: f32,
    contents: impl FnOnce(&mut Ui),
) {
    let bottom = ui.ctx().content_rect().max.y - MARGIN;
    let around = 2.0 * ui.style().spacing.menu_margin.bottom as f32;
    let room = bottom - (button.rect.max.y + MENU_GAP) - around;
    let name = tell_popup(ui, button, HasPopup::Menu);
    Popup::menu(button)
        .accessible_name(name)
        .align(align)
        .gap(MENU_GAP)
        .show(|ui| {
            ui.set_width(width);
            scrolled("menu", room.max(LEAST_HEIGHT)).show(ui, contents);
        });
}

/// The y where the room below the bars begins.
fn below_bars(ui: &Ui) -> f32 {
    let bar = shown_rect(ui, TITLE).unwrap_or(Rect::ZERO);
    bar.max.y + MARGIN
}

/// Border and margins of a popover, of two sides together.
fn around(ui: &Ui) -> f32 {
    popover_frame(&Tokens::of(ui)).total_margin().sum().x
}

/// Shows a popover at a corner, no larger than `size`.
fn hang(
    ui: &Ui,
    (button, name): Opener<'_>,
    (at, align): (Pos2, RectAlign),
    size: Vec2,
    contents: impl FnOnce(&mut Ui, f32),
) {
    tell_popup(ui, button, HasPopup::Dialog);
    Popup::from_toggle_button_response(button)
        .accessible_name(name)
        .close_behavior(PopupCloseBehavior::CloseOnClickOutside)
        .at_position(at)
        .align(align)
        .align_alternatives(&[])
        .gap(0.0)
        .frame(popover_frame(&Tokens::of(ui)))
        .show(|ui| {
            ui.set_width(size.x);
            contents(ui, size.y.max(LEAST_HEIGHT));
        });
}

/// An opaque frame, since it lies over text.
fn popover_frame(tokens: &Tokens) -> Frame {
    theme::panel_frame(tokens)
        .fill(tokens.panel.to_opaque())
        .inner_margin(POPOVER_MARGIN)
}

/// A hairline between the parts of a popover.
pub(in crate::ui) fn popover_gap(ui: &mut Ui) {
    rule(ui, POPOVER_MARGIN);
}

/// A popover above a button at the window's lower edge, as far from the window's sides as the panels are.
pub(in crate::ui) fn popover_above(ui: &Ui, opener: Opener<'_>, width: f32, contents: impl FnOnce(&mut Ui)) {
    let window = ui.ctx().content_rect().shrink(MARGIN);
    // On a phone the strip has two rows. A popover of the lower row is above both, unless the drawer leaves no room there.
    let above = |top: f32| top - MARGIN - 4.0;
    let drawer = shown_rect(ui, DRAWER).map(|drawer| above(drawer.min.y));
    let least = window.min.y + LEAST_ROOM;
    let transport = ui.ctx().read_response(id_of("transport"));
    let transport = transport
        .filter(|_| drawer.is_some())
        .map(|strip| above(strip.rect.min.y));
    let bottom = [drawer, transport]
        .into_iter()
        .flatten()
        .find(|&bottom| bottom >= least)
        .unwrap_or(above(opener.0.rect.min.y));
    // It scrolls rather than cover the bars at the top, unless the window is low.
    let below_bars = below_bars(ui);
    let is_low = ui.ctx().content_rect().height() < theme::LOW_HEIGHT;
    let top = if bottom - below_bars >= LEAST_ROOM && !is_low {
        below_bars
    } else {
        window.min.y
    };
    let around = around(ui);
    let room = bottom - top - around;
    let width = width.min(window.width() - around);
    let left = opener.0.rect.min.x.min(window.max.x - width - around).max(window.min.x);
    let corner = (pos2(left, bottom), RectAlign::TOP_START);
    hang(ui, opener, corner, vec2(width, room), |ui, most| {
        scrolled("popover", most).show(ui, contents);
    });
}
