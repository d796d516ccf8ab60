//! The keyboard focus: the order of Tab, what opens and gives it back, what is scrolled into view, and the ring.
//!
//! egui goes through widgets in the order in which panels are shown, and that is the order of their layout. A person reads them in
//! another. So Tab is handled here, before the widgets of a pass. Where a page mirrors the controls as elements, Tab is the browser's among
//! them and does not come here; what opens and closes moves the focus all the same, and the elements follow.

use std::cmp::Reverse;

use egui::accesskit::{self, Action, ActionRequest};
use egui::{Context, Event, FocusDirection, Id, Key, LayerId, Modifiers, Order, Popup, Ui};

use super::panel;
use crate::ui::kit::{in_force, paint_focus_ring};
use crate::ui::rim::mirror::MirrorAction;

/// Panels in reading order. The view comes before the panels at its right.
const BEFORE_VIEW: [&str; 5] = ["title", "toolbar", "model", "legend", "frame"];
const AFTER_VIEW: [&str; 7] = ["diagnostics", "page", "inspector", "timeline", "sheet", "help", "error"];

/// Where the next Tab starts while nothing has the focus.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Start {
    /// After a widget: the last that was clicked.
    After(Id),
    /// In a panel or popover that was opened with the pointer.
    Into(Id),
}

/// A panel or popover that was opened, and takes the focus or gives it back.
#[derive(Clone, Copy, Debug)]
struct Opened {
    key: Id,
    opener: Option<Id>,
}

/// The focus when the last pass ended, and where it goes.
#[derive(Debug, Default)]
pub(in crate::ui) struct Focus {
    focused: Option<Id>,
    start: Option<Start>,
    /// The place of the focused widget in the order of Tab, for the case that it goes away.
    place: Option<usize>,
    /// The pointer was used last, not the keyboard.
    by_pointer: bool,
    /// In the order in which they opened.
    opened: Vec<Opened>,
    /// The focused widget is out of sight. The next pass scrolls it into view.
    reveal: Option<Id>,
}

impl Focus {
    /// Moves the focus with Tab. Called before the widgets of a pass.
    pub(in crate::ui) fn begin(&mut self, ctx: &Context) {
        if let Some(id) = self.reveal.take() {
            let request = ActionRequest {
                action: Action::ScrollIntoView,
                target_tree: accesskit::TreeId::ROOT,
                target_node: id.accesskit_id(),
                data: None,
            };
            ctx.input_mut(|input| input.events.push(Event::AccessKitActionRequest(request)));
        }
        let (tabs, arrows) = ctx.input(|input| {
            let mut tabs = None;
            let mut arrows = false;
            for event in &input.events {
                match event {
                    Event::Key {
                        key: Key::Tab,
                        pressed: true,
                        modifiers,
                        ..
                    } if !modifiers.any() || modifiers.shift_only() => tabs = Some(modifiers.shift),
                    Event::Key { key, pressed: true, .. } => {
                        arrows |= matches!(key, Key::ArrowUp | Key::ArrowDown | Key::ArrowLeft | Key::ArrowRight);
                    }
                    _ => {}
                }
            }
            let pointer = &input.pointer;
            if pointer.any_pressed() || pointer.any_click() {
                self.by_pointer = true;
            } else if input.events.iter().any(is_of_keyboard) {
                self.by_pointer = false;
            }
            (tabs, arrows)
        });
        if let Some(backward) = tabs {
            let next = self.next(ctx, backward);
            ctx.memory_mut(|memory| {
                memory.move_focus(FocusDirection::None);
                if let Some(next) = next {
                    memory.request_focus(next);
                }
            });
        } else if arrows && !Popup::is_any_open(ctx) {
            // In panels arrows are keys of the focused control or of the time.
            ctx.memory_mut(|memory| memory.move_focus(FocusDirection::None));
        }
    }

    /// The widget to which Tab goes.
    fn next(&mut self, ctx: &Context, backward: bool) -> Option<Id> {
        let order = self.order(ctx);
        let place = |id: Id| order.iter().position(|&(_, widget)| widget == id);
        let focused = ctx.memory(|memory| memory.focused());
        let from = match (focused.and_then(place), self.start) {
            (Some(place), _) => Some(place),
            (None, Some(Start::After(id))) => place(id).or(self.place),
            (None, Some(Start::Into(key))) => {
                let first = first_of(ctx, key).and_then(place);
                if !backward && first.is_some() {
                    self.place = first;
                    return first.and_then(|first| order.get(first)).map(|&(_, id)| id);
                }
                first
            }
            (None, None) => None,
        };
        let count = order.len();
        let next = match (from, backward) {
            (_, _) if count == 0 => return None,
            (Some(from), false) => (from + 1) % count,
            (Some(from), true) => (from + count - 1) % count,
            (None, false) => 0,
            (None, true) => count - 1,
        };
        self.place = Some(next);
        order.get(next).map(|&(_, id)| id)
    }

    /// All widgets that take the focus, in reading order, each with its layer. What hangs from a widget comes after it.
    fn order(&self, ctx: &Context) -> Vec<(LayerId, Id)> {
        ctx.viewport(|viewport| {
            let widgets = &viewport.prev_pass.widgets;
            let mut layers: Vec<LayerId> = widgets.layer_ids().collect();
            layers.sort_by_key(|layer| (rank(layer), layer.id.value()));
            let (hanging, panels): (Vec<_>, Vec<_>) = layers.into_iter().partition(|layer| rank(layer) == usize::MAX);
            let of_layer = |layer: LayerId| {
                let widgets = widgets.get_layer(layer);
                let focusable = widgets.filter(|widget| widget.enabled && widget.sense.is_focusable());
                focusable.map(move |widget| (layer, widget.id))
            };
            let mut order: Vec<_> = panels.into_iter().flat_map(of_layer).collect();
            for layer in hanging {
                let opener = self.opened.iter().find(|opened| opened.key == layer.id);
                let opener = opener.and_then(|opened| opened.opener);
                let at = order.iter().position(|&(_, id)| Some(id) == opener);
                let at = at.map_or(order.len(), |at| at + 1);
                order.splice(at..at, of_layer(layer));
            }
            order
        })
    }

    /// Moves the focus to the first or last control of a popover with Home and End, unless a control has taken the key.
    pub(in crate::ui) fn go_to_ends(&self, ctx: &Context) {
        if !Popup::is_any_open(ctx) || ctx.text_edit_focused() {
            return;
        }
        let pressed = |key| ctx.input_mut(|input| input.consume_key(Modifiers::NONE, key));
        let backward = if pressed(Key::Home) {
            false
        } else if pressed(Key::End) {
            true
        } else {
            return;
        };
        let focused = ctx.memory(|memory| memory.focused());
        let order = self.order(ctx);
        let layer = order
            .iter()
            .find(|&&(_, id)| Some(id) == focused)
            .map(|&(layer, _)| layer);
        let mut of_layer = order.iter().filter(|&&(of, _)| Some(of) == layer);
        let end = if backward {
            of_layer.next_back()
        } else {
            of_layer.next()
        };
        if let Some(&(_, id)) = end {
            ctx.memory_mut(|memory| memory.request_focus(id));
        }
    }

    /// Moves the focus into what opened, and back to what opened it. Called after the widgets of a pass. `escape_shuts`: Esc is
    /// closing something, and leaves the focus where it was.
    pub(in crate::ui) fn end(&mut self, ctx: &Context, popover_was_open: bool, escape_shuts: bool) {
        let before = self.focused;
        let clicked = ctx.interaction_snapshot(|interaction| interaction.clicked);
        if let Some(id) = clicked.or_else(|| asked_to_click(ctx)) {
            self.start = Some(Start::After(id));
        }
        let focused = ctx.memory(|memory| memory.focused());
        if focused.is_none()
            && escape_shuts
            && let Some(before) = before.filter(|&id| is_shown(ctx, id))
        {
            ctx.memory_mut(|memory| memory.request_focus(before));
        }
        self.follow_opened(ctx, before);
        if popover_was_open && !Popup::is_any_open(ctx) {
            // What had the focus in it is gone in the next pass.
            ctx.request_repaint();
        }

        self.focused = ctx.memory(|memory| memory.focused());
        if let Some(id) = self.focused {
            self.start = Some(Start::After(id));
            let hidden = ctx.viewport(|viewport| {
                let widget = viewport.this_pass.widgets.get(id);
                widget.is_some_and(|widget| !widget.interact_rect.expand(1.0).contains_rect(widget.rect))
            });
            if self.focused != before && hidden {
                self.reveal = Some(id);
                ctx.request_repaint();
            }
        }
    }

    fn follow_opened(&mut self, ctx: &Context, before: Option<Id>) {
        let open = open_now(ctx);
        let opener = before.or(match self.start {
            Some(Start::After(id)) => Some(id),
            _ => None,
        });
        for &(key, first) in &open {
            if self.opened.iter().any(|opened| opened.key == key) {
                continue;
            }
            self.opened.push(Opened { key, opener });
            let enters = !self.by_pointer && before.is_some();
            if enters || asked_to_click(ctx).is_some() {
                let first = in_force(ctx, key).unwrap_or(first);
                ctx.memory_mut(|memory| memory.request_focus(first));
                ctx.request_repaint();
            } else {
                self.start = Some(Start::Into(key));
            }
        }
        // What opened last closes first.
        while let Some(closed) = self.opened.iter().rposition(|opened| {
            let key = opened.key;
            open.iter().all(|&(open, _)| open != key)
        }) {
            let Opened { key, opener } = self.opened.remove(closed);
            let focused = ctx.memory(|memory| memory.focused());
            let is_lost = focused.is_none_or(|id| !is_shown(ctx, id));
            let Some(opener) = opener.filter(|_| is_lost) else {
                continue;
            };
            if before.is_some() {
                ctx.memory_mut(|memory| memory.request_focus(opener));
                ctx.request_repaint();
            } else if self.start == Some(Start::Into(key)) {
                self.start = Some(Start::After(opener));
            }
        }
    }

    /// Draws the ring round the focused widget, over all of its layer.
    pub(in crate::ui) fn paint(&self, ui: &Ui) {
        let widget = |id| {
            ui.ctx()
                .viewport(|viewport| viewport.this_pass.widgets.get(id).copied())
        };
        if let Some(widget) = self.focused.and_then(widget) {
            paint_focus_ring(ui, &widget);
        }
    }
}

/// Whether an event is of the keyboard, or of a program that reads the screen.
fn is_of_keyboard(event: &Event) -> bool {
    matches!(
        event,
        Event::Key { pressed: true, .. } | Event::Text(_) | Event::AccessKitActionRequest(_)
    )
}

/// The place of a layer in reading order. Popovers have the last.
fn rank(layer: &LayerId) -> usize {
    if layer.order == Order::Background {
        return BEFORE_VIEW.len();
    }
    let place = |names: &[&str]| names.iter().position(|name| panel::id_of(name) == layer.id);
    let before = place(&BEFORE_VIEW);
    let after = || place(&AFTER_VIEW).map(|place| BEFORE_VIEW.len() + 1 + place);
    before.or_else(after).unwrap_or(usize::MAX)
}

/// What lies open over or beside the view, each with its first control: popovers, dialogs, the page of a sheet.
fn open_now(ctx: &Context) -> Vec<(Id, Id)> {
    let beside = ["diagnostics", "page"].map(panel::id_of);
    let mut open: Vec<(Id, Id)> = ctx.viewport(|viewport| {
        let widgets = &viewport.this_pass.widgets;
        let layers = widgets.layer_ids();
        let layers = layers.filter(|layer| layer.order == Order::Foreground || beside.contains(&layer.id));
        let first = |layer: LayerId| {
            let mut widgets = widgets.get_layer(layer);
            let first = widgets.find(|widget| widget.enabled && widget.sense.is_focusable())?;
            Some((layer.id, first.id))
        };
        layers.filter_map(first).collect()
    });
    open.sort_by_key(|&(key, _)| Reverse(key.value()));
    let page = ctx.data(|data| data.get_temp::<(u64, Id, Id)>(page_id()));
    open.extend(
        page.filter(|&(pass, ..)| pass == ctx.cumulative_pass_nr())
            .map(|(_, key, first)| (key, first)),
    );
    open
}

fn first_of(ctx: &Context, key: Id) -> Option<Id> {
    let widgets = ctx.viewport(|viewport| {
        let widgets = &viewport.prev_pass.widgets;
        let layer = widgets.layer_ids().find(|layer| layer.id == key)?;
        let mut widgets = widgets.get_layer(layer);
        let first = widgets.find(|widget| widget.enabled && widget.sense.is_focusable())?;
        Some(first.id)
    });
    widgets.or_else(|| {
        let page = ctx.data(|data| data.get_temp::<(u64, Id, Id)>(page_id()))?;
        (page.1 == key).then_some(page.2)
    })
}

/// Notes that a page of the sheet is open, with its first control.
pub(in crate::ui) fn note_page(ui: &Ui, key: Id, first: Id) {
    let pass = ui.ctx().cumulative_pass_nr();
    ui.data_mut(|data| data.insert_temp(page_id(), (pass, key, first)));
}

fn page_id() -> Id {
    Id::unique("page of the sheet")
}

fn is_shown(ctx: &Context, id: Id) -> bool {
    ctx.viewport(|viewport| viewport.this_pass.widgets.contains(id))
}

/// The widget that a program asks to click.
fn asked_to_click(ctx: &Context) -> Option<Id> {
    let target = ctx.input(|input| input.events.iter().find_map(MirrorAction::clicked))?;
    ctx.viewport(|viewport| {
        let widgets = &viewport.this_pass.widgets;
        let mut ids = widgets
            .layers()
            .flat_map(|(_, widgets)| widgets)
            .map(|widget| widget.id);
        ids.find(|id| id.accesskit_id() == target)
    })
}
