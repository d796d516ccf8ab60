//! Rows of panels: facts, choices, lists, hairlines.

use egui::{Align2, Color32, FontId, Painter, Rect, Response, Role, Sense, Stroke, Ui, Vec2, WidgetInfo, pos2, vec2};

use super::control::{
    control_size, focus_ring, hint_beside, paint_ground, paint_name, paint_row_ground, pressed_row_height, tell_node,
};
use crate::ui::kit::icons::{self, Icon};
use crate::ui::kit::theme::{CONTROL_RADIUS, ROW_HEIGHT, Tokens};

/// A small icon in a row. `on` marks a switch that is on.
pub(crate) fn row_icon(ui: &Ui, place: Rect, row: &Response, icon: Icon, label: &str, on: bool) -> Response {
    let tokens = Tokens::of(ui);
    // It is one control whichever picture it has now.
    let from_right = (row.rect.max.x - place.max.x).round() as i32;
    let response = ui.interact(place, row.id.with(("icon", from_right)), Sense::click());
    let color = match (on, response.hovered() || response.has_focus()) {
        (true, _) => tokens.accent,
        (false, hovered) => tokens.muted_to_text(hovered),
    };
    icons::paint(ui.painter(), place, icon, color);
    focus_ring(ui, place, &response);
    response.widget_info(|| WidgetInfo::selected(Role::Button, true, on, label));
    hint_beside(response, Some(row.rect), label)
}

/// A row of a panel. Text goes in from both ends, in 13 points where no size is given. Call `told` last: it
/// names the row for screen readers, which need all of its words.
pub(crate) struct Row {
    pub(crate) rect: Rect,
    pub(crate) response: Response,
    painter: Painter,
    /// What is still free of it.
    pub(crate) left: f32,
    pub(crate) right: f32,
    /// The middle of its words.
    pub(crate) y: f32,
}

impl Row {
    /// A row over the whole width.
    pub(crate) fn new(ui: &mut Ui, height: f32) -> Self {
        Self::sized(ui, vec2(ui.available_width(), height))
    }

    pub(crate) fn sized(ui: &mut Ui, size: Vec2) -> Self {
        let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
        Self::of(ui, rect, response)
    }

    /// A row that can be pressed, over the whole width. Its ground shows whether it is hovered or `selected`.
    pub(crate) fn pressable(ui: &mut Ui, selected: bool) -> Self {
        let size = vec2(ui.available_width(), pressed_row_height(ui));
        let (rect, response) = ui.allocate_exact_size(size, Sense::click());
        paint_row_ground(ui, rect, &response, selected, response.contains_pointer());
        Self::of(ui, rect, response)
    }

    /// The row of a widget that is there already.
    pub(crate) fn of(ui: &Ui, rect: Rect, response: Response) -> Self {
        Self {
            rect,
            response,
            painter: ui.painter().clone(),
            left: rect.min.x,
            right: rect.max.x,
            y: rect.center().y,
        }
    }

    pub(crate) fn left(&mut self, text: &str, color: Color32) {
        self.left_in(FontId::proportional(13.0), text, color);
    }

    pub(crate) fn left_in(&mut self, font: FontId, text: &str, color: Color32) {
        let at = pos2(self.left, self.y);
        self.left = self.painter.text(at, Align2::LEFT_CENTER, text, font, color).max.x;
    }

    pub(crate) fn right(&mut self, text: &str, color: Color32) {
        self.right_in(FontId::proportional(13.0), text, color);
    }

    pub(crate) fn right_in(&mut self, font: FontId, text: &str, color: Color32) {
        let at = pos2(self.right, self.y);
        self.right = self.painter.text(at, Align2::RIGHT_CENTER, text, font, color).min.x;
    }

    /// A name in what is free, as [`elided_name`](super::control::elided_name) has it.
    pub(crate) fn name(&self, name: &str, color: Color32) {
        self.name_in(FontId::proportional(13.0), name, color);
    }

    pub(crate) fn name_in(&self, font: FontId, name: &str, color: Color32) {
        let at = pos2(self.left, self.y);
        paint_name(&self.painter, at, name, font, color, self.right - self.left);
    }

    pub(crate) fn told(self, role: Role, label: impl Into<String>) -> Response {
        let label = label.into();
        self.response.widget_info(|| WidgetInfo::labeled(role, true, &label));
        self.response
    }
}

/// A row of a panel: a quiet label and a value at the right edge.
pub(crate) fn value_row(ui: &mut Ui, label: &str, value: &str) -> Response {
    let tokens = Tokens::of(ui);
    let mut row = Row::new(ui, ROW_HEIGHT);
    row.left(label, tokens.muted);
    row.right(value, tokens.text);
    row.told(Role::Label, format!("{label} {value}"))
}

/// A row of a panel whose value opens a menu.
pub(crate) fn choice_row(ui: &mut Ui, label: &str, value: &str, how: &str) -> Response {
    let tokens = Tokens::of(ui);
    let mut row = Row::pressable(ui, false);
    row.left(label, tokens.muted);
    let chevron = Rect::from_center_size(pos2(row.right - 5.0, row.y), Vec2::splat(16.0));
    icons::paint(ui.painter(), chevron, Icon::ChevronDown, tokens.muted);
    row.right -= 15.0;
    row.right(how, tokens.muted);
    row.right -= 4.0;
    row.right(value, tokens.text);
    row.told(Role::Button, format!("{label}: {value} {how}"))
}

/// How much of a work is done, as a bar and as `5 of 12`.
pub(crate) fn progress_bar(ui: &mut Ui, name: &str, size: Vec2, [done, count]: [usize; 2]) {
    let tokens = Tokens::of(ui);
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    paint_ground(ui, rect, tokens.field);
    let fraction = done as f32 / count.max(1) as f32;
    let filled = rect.with_max_x(rect.min.x + rect.width() * fraction.min(1.0));
    ui.painter().rect_filled(filled, CONTROL_RADIUS, tokens.accent_ground);
    let words = format!("{done} of {count}");
    let font = FontId::proportional(12.5);
    ui.painter()
        .text(rect.center(), Align2::CENTER_CENTER, &words, font, tokens.text);
    response.widget_info(|| WidgetInfo::labeled(Role::ProgressIndicator, true, name));
    tell_node(&response, |node| {
        node.set_min_numeric_value(0.0);
        node.set_max_numeric_value(count as f64);
        node.set_numeric_value(done as f64);
        node.set_value(words);
    });
}

/// A hairline across a panel, from border to border.
pub(crate) fn rule(ui: &mut Ui, panel_margin: f32) {
    let tokens = Tokens::of(ui);
    ui.add_space(7.0);
    let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), 1.0), Sense::hover());
    let rect = rect.expand2(vec2(panel_margin, 0.0));
    ui.painter()
        .hline(rect.x_range(), rect.center().y, Stroke::new(1.0, tokens.hairline));
    ui.add_space(7.0);
}

/// Height of the handle of a drawer.
const DRAWER_HANDLE_HEIGHT: f32 = 24.0;

/// The grip of the drawer. `label`: what it opens or closes.
pub(crate) fn drawer_handle(ui: &mut Ui, label: &str) -> Response {
    let tokens = Tokens::of(ui);
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), DRAWER_HANDLE_HEIGHT), Sense::hover());
    // By touch its target reaches a little above the drawer.
    let above = (control_size(ui) - rect.height()).max(0.0);
    let target = Rect::from_min_max(pos2(rect.min.x, rect.min.y - above), rect.max);
    let response = ui.interact(target, response.id.with("grip"), Sense::click_and_drag());
    focus_ring(ui, rect, &response);
    let grip = Rect::from_center_size(rect.center(), vec2(38.0, 4.0));
    ui.painter().rect_filled(
        grip,
        2.0,
        if response.hovered() {
            tokens.faint
        } else {
            tokens.hairline
        },
    );
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, label));
    response
}
