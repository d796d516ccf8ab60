//! Lists of rows by keys: one row of a list is a stop of Tab, and keys move the focus from row to row.

use egui::accesskit::{self, Action};
use egui::style::ScrollAnimation;
use egui::{Event, EventFilter, FocusDirection, Id, Key, Rect, Response, Role, Sense, Ui, WidgetInfo};

/// Reads the keys that move the focus through a list: ↑ ↓ to a neighbour, the page keys by a page, Home and End to an end. They are
/// consumed, so that they are not shortcuts too. Returns the place of the row that gets the focus, if it is another one.
pub(super) fn walked(ui: &Ui, row: &Response, place: usize, count: usize, page: usize) -> Option<usize> {
    if !row.has_focus() {
        return None;
    }
    let filter = EventFilter {
        horizontal_arrows: true,
        vertical_arrows: true,
        ..EventFilter::default()
    };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(row.id, filter));
    let last = count.saturating_sub(1);
    let mut to = place;
    retain_plain_keys(ui, |key| {
        to = match key {
            Key::ArrowUp => to.saturating_sub(1),
            Key::ArrowDown => to + 1,
            Key::PageUp => to.saturating_sub(page),
            Key::PageDown => to + page,
            Key::Home => 0,
            Key::End => last,
            _ => return true,
        }
        .min(last);
        false
    });
    // egui sees the arrows of a row that got the focus in the pass before.
    ui.memory_mut(|memory| memory.move_focus(FocusDirection::None));
    (to != place).then_some(to)
}

/// Consumes the pressed keys that `keep` refuses. Keys with Ctrl, Alt or Command are left alone.
pub(super) fn retain_plain_keys(ui: &Ui, mut keep: impl FnMut(Key) -> bool) {
    ui.input_mut(|input| {
        input.events.retain(|event| match event {
            Event::Key {
                key,
                pressed: true,
                modifiers,
                ..
            } if !modifiers.command && !modifiers.ctrl && !modifiers.alt => keep(*key),
            _ => true,
        });
    });
}

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
