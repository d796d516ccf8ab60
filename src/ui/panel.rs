//! Panels that float over the view.

use egui::{Align2, Area, CornerRadius, Frame, Id, LayerId, Margin, Order, Pos2, Rect, ScrollArea, Ui};

use super::theme::{self, Tokens};

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
