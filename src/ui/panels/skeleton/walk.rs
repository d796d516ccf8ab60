//! Rows of long lists: one row is a stop of Tab, and screen readers know the place of each.

use egui::accesskit::{self, Action};
use egui::style::ScrollAnimation;
use egui::{Id, Rect, Response, Role, Sense, Ui, WidgetInfo};

/// Gives a row of a list the keyboard's focus, and brings it into view.
pub(super) fn focus_row(ui: &Ui, row: Id, rect: Rect) {
    ui.memory_mut(|memory| memory.request_focus(row));
    ui.scroll_to_rect_animation(rect, None, ScrollAnimation::none());
}

/// What a row of a list can do: only the row that Tab stops at takes the focus.
pub(super) fn row_sense(is_stop: bool) -> Sense {
    if is_stop { Sense::click() } else { Sense::CLICK }
}

/// Tells screen readers about a row of a list: its place, whether it is selected, and that it takes the focus. Returns whether one
/// asks for the focus.
pub(super) fn tell_row(ui: &Ui, row: &Response, role: Role, label: &str, place: usize, selected: bool) -> bool {
    row.widget_info(|| WidgetInfo::labeled(role, true, label));
    ui.ctx().accesskit_node_builder(row.id, |node| {
        node.set_position_in_set(place);
        node.set_selected(selected);
        node.add_action(Action::Focus);
    });
    asks(ui, row.id, Action::Focus)
}

/// Whether a screen reader asks for an action.
pub(super) fn asks(ui: &Ui, id: Id, action: Action) -> bool {
    ui.input(|input| input.has_accesskit_action_request(id, action))
}

/// A part of a panel that screen readers know as a list, a tree or a table. `count`: all its rows, also those that are not drawn.
pub(super) fn labelled<R>(ui: &mut Ui, role: Role, label: &str, count: usize, rows: impl FnOnce(&mut Ui) -> R) -> R {
    let builder = egui::UiBuilder::new()
        .id_salt(("rows", label))
        .accessibility_role(role)
        .accessibility_label(label.to_owned());
    let shown = ui.scope_builder(builder, |ui| (ui.unique_id(), rows(ui)));
    let (id, result) = shown.inner;
    let Rect { min, max } = shown.response.rect;
    ui.ctx().accesskit_node_builder(id, |node| {
        node.set_bounds(accesskit::Rect::new(
            min.x.into(),
            min.y.into(),
            max.x.into(),
            max.y.into(),
        ));
        if role == Role::Table {
            node.set_row_count(count);
        } else {
            node.set_size_of_set(count);
        }
    });
    result
}
