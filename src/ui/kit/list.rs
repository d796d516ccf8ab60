//! Lists: arrow keys go from row to row, only what is seen is drawn, and screen readers know the place of each row.

use std::ops::Range;

use egui::accesskit::{self, Action};
use egui::style::ScrollAnimation;
use egui::{Id, Rect, Response, Role, Sense, Ui, UiBuilder, WidgetInfo, vec2};

use super::control::tell_node;
use super::keys::walked;

/// Rows that a page key goes by.
const PAGE: usize = 10;

/// A list of rows, for screen readers and for the arrow keys: they move the focus from row to row.
#[derive(Debug, Default)]
pub(crate) struct RowList {
    rows: Vec<Id>,
    focused: Option<usize>,
}

impl RowList {
    /// Shows a list of this name. The contents tell of each row with [`RowList::row`].
    pub(crate) fn show(ui: &mut Ui, name: &str, contents: impl FnOnce(&mut Ui, &mut Self)) {
        let shown = ui.scope(|ui| {
            let mut list = Self::default();
            contents(ui, &mut list);
            list.walk(ui);
        });
        shown
            .response
            .widget_info(|| WidgetInfo::labeled(Role::List, true, name));
    }

    /// Tells of the next row.
    pub(crate) fn row(&mut self, response: &Response, selected: bool) {
        if response.has_focus() {
            self.focused = Some(self.rows.len());
        }
        if response.gained_focus() {
            response.scroll_to_me(None);
        }
        self.rows.push(response.id);
        tell_node(response, |node| node.set_selected(selected));
    }

    fn walk(self, ui: &Ui) {
        let Some((focused, &id)) = self.focused.and_then(|at| Some((at, self.rows.get(at)?))) else {
            return;
        };
        if let Some(to) = walked(ui, id, focused, self.rows.len(), PAGE) {
            ui.memory_mut(|memory| memory.request_focus(self.rows[to]));
        }
    }
}

/// Rows of one height in a list that scrolls. Those in view are drawn, and the one that has the focus: it keeps it out of view.
pub(crate) struct DrawnRows {
    pub(crate) in_view: Range<usize>,
    /// The row that has the focus, if it is not in view.
    pub(crate) out_of_view: Option<usize>,
    /// The row that Tab stops at: the one that has the focus, or else the nearest in view.
    pub(crate) tab_stop: usize,
    /// Rows that a page key goes by.
    pub(crate) page: usize,
    place: Rect,
    height: f32,
}

impl DrawnRows {
    /// Takes the room of the rows in view. `stop`: the row that Tab would stop at if it is in view, and its id.
    pub(crate) fn new(ui: &mut Ui, in_view: Range<usize>, height: f32, (stop, id): (usize, Id)) -> Self {
        let size = vec2(ui.available_width(), in_view.len() as f32 * height);
        let (place, _) = ui.allocate_exact_size(size, Sense::hover());
        let has_focus = ui.memory(|memory| memory.has_focus(id));
        let nearest = stop.min(in_view.end.saturating_sub(1)).max(in_view.start);
        Self {
            out_of_view: Some(stop).filter(|stop| has_focus && !in_view.contains(stop)),
            tab_stop: if has_focus { stop } else { nearest },
            page: in_view.len().saturating_sub(2).max(1),
            in_view,
            place,
            height,
        }
    }

    pub(crate) fn rect_of(&self, row: usize) -> Rect {
        let y = self.place.min.y + (row as f32 - self.in_view.start as f32) * self.height;
        Rect::from_x_y_ranges(self.place.x_range(), y..=y + self.height)
    }
}

/// Lays out those of some rows of one height that are seen.
pub(crate) fn rows_in_view(ui: &mut Ui, height: f32, count: usize, mut row: impl FnMut(&mut Ui, usize)) {
    let (top, seen) = (ui.cursor().min.y, ui.clip_rect());
    let place = |y: f32| ((y - top) / height).clamp(0.0, count as f32);
    let (first, end) = (place(seen.min.y).floor() as usize, place(seen.max.y).ceil() as usize);
    ui.add_space(first as f32 * height);
    for index in first..end {
        row(ui, index);
    }
    ui.add_space(count.saturating_sub(end.max(first)) as f32 * height);
}

/// Gives a row of a list the keyboard's focus, and brings it into view.
pub(crate) fn focus_row(ui: &Ui, row: Id, rect: Rect) {
    ui.memory_mut(|memory| memory.request_focus(row));
    ui.scroll_to_rect_animation(rect, None, ScrollAnimation::none());
}

/// What a row of a list can do: only the row that Tab stops at takes the focus.
pub(crate) fn row_sense(is_stop: bool) -> Sense {
    if is_stop { Sense::click() } else { Sense::CLICK }
}

/// Tells screen readers about a row of a list: its place, whether it is selected, and that it takes the focus. Returns whether one
/// asks for the focus.
pub(crate) fn tell_row(ui: &Ui, row: &Response, role: Role, label: &str, place: usize, selected: bool) -> bool {
    row.widget_info(|| WidgetInfo::labeled(role, true, label));
    ui.ctx().accesskit_node_builder(row.id, |node| {
        node.set_position_in_set(place);
        node.set_selected(selected);
        node.add_action(Action::Focus);
    });
    asks(ui, row.id, Action::Focus)
}

/// Whether a screen reader asks for an action.
fn asks(ui: &Ui, id: Id, action: Action) -> bool {
    ui.input(|input| input.has_accesskit_action_request(id, action))
}

/// Tells screen readers that a row unfolds, and whether it is open. Returns whether one wants that otherwise.
pub(crate) fn tell_folds(ui: &Ui, row: Id, is_open: bool) -> bool {
    let other = if is_open { Action::Collapse } else { Action::Expand };
    ui.ctx().accesskit_node_builder(row, |node| {
        node.set_expanded(is_open);
        node.add_action(other);
    });
    asks(ui, row, other)
}

/// A part of a panel that screen readers know as a list, a tree or a table. `count`: all its rows, also those that are not drawn.
pub(crate) fn labelled<R>(ui: &mut Ui, role: Role, label: &str, count: usize, rows: impl FnOnce(&mut Ui) -> R) -> R {
    let builder = UiBuilder::new()
        .id_salt(("rows", label))
        .accessibility_role(role)
        .accessibility_label(label.to_owned());
    let shown = ui.scope_builder(builder, |ui| (ui.unique_id(), rows(ui)));
    let (id, result) = shown.inner;
    let Rect { min, max } = shown.response.rect;
    ui.ctx().accesskit_node_builder(id, |node| {
        let [x0, y0, x1, y1] = [min.x, min.y, max.x, max.y].map(f64::from);
        node.set_bounds(accesskit::Rect { x0, y0, x1, y1 });
        if role == Role::Table {
            node.set_row_count(count);
        } else {
            node.set_size_of_set(count);
        }
    });
    result
}
