//! The keyboard focus: what opens and gives it back, what is scrolled into view, and the ring.
//!
//! Tab is the page's: it goes through the elements that mirror the controls, in the order in which those stand. Here the focus moves
//! by arrow keys and with what opens and shuts, and the elements follow.

use std::cmp::Reverse;

use egui::accesskit::{self, Action, ActionRequest};
use egui::{Context, Event, FocusDirection, Id, Key, LayerId, Modifiers, Order, Popup, Ui, WidgetRects};

use super::panel;
use crate::ui::input::is_arrow;
use crate::ui::kit::{in_force, paint_focus_ring};
use crate::ui::rim::mirror::{MirrorAction, set_tab_start};

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
    /// What was clicked last, while nothing has the focus.
    clicked: Option<Id>,
    /// The pointer was used last, not the keyboard.
    by_pointer: bool,
    /// In the order in which they opened.
    opened: Vec<Opened>,
    /// The focused widget is out of sight. The next pass scrolls it into view.
    reveal: Option<Id>,
}

impl Focus {
    /// Keeps egui from moving the focus where that is not its own. Called before the widgets of a pass.
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
        let pressed = |wanted: fn(Key) -> bool| {
            let is_wanted = |event: &Event| matches!(event, Event::Key { key, pressed: true, .. } if wanted(*key));
            ctx.input(|input| input.events.iter().any(is_wanted))
        };
        ctx.input(|input| {
            let pointer = &input.pointer;
            if pointer.any_pressed() || pointer.any_click() {
                self.by_pointer = true;
            } else if input.events.iter().any(is_of_keyboard) {
                self.by_pointer = false;
            }
        });
        // In panels arrows are keys of the focused control or of the time.
        if pressed(|key| key == Key::Tab) || (pressed(is_arrow) && !Popup::is_any_open(ctx)) {
            ctx.memory_mut(|memory| memory.move_focus(FocusDirection::None));
        }
    }

    /// Moves the focus to the first or last control of a popover with Home and End, unless a control has taken the key.
    pub(in crate::ui) fn go_to_ends(&self, ctx: &Context) {
        if !Popup::is_any_open(ctx) || ctx.text_edit_focused() {
            return;
        }
        let pressed = |key| ctx.input_mut(|input| input.consume_key(Modifiers::NONE, key));
        let [home, end] = [Key::Home, Key::End].map(pressed);
        if !home && !end {
            return;
        }
        let wanted = ctx.viewport(|viewport| {
            let widgets = &viewport.this_pass.widgets;
            let mut controls = controls(widgets, widgets.get(self.focused?)?.layer_id);
            if home { controls.next() } else { controls.last() }
        });
        if let Some(id) = wanted {
            ctx.memory_mut(|memory| memory.request_focus(id));
        }
    }

    /// Moves the focus into what opened, and back to what opened it. Called after the widgets of a pass. `escape_shuts`: Esc is
    /// closing something, and leaves the focus where it was.
    pub(in crate::ui) fn end(&mut self, ctx: &Context, popover_was_open: bool, escape_shuts: bool) {
        let before = self.focused;
        let clicked = ctx.interaction_snapshot(|interaction| interaction.clicked);
        self.clicked = clicked.or_else(|| asked_to_click(ctx)).or(self.clicked);
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
            self.clicked = None;
            let hidden = ctx.viewport(|viewport| {
                let widget = viewport.this_pass.widgets.get(id);
                widget.is_some_and(|widget| !widget.interact_rect.expand(1.0).contains_rect(widget.rect))
            });
            if self.focused != before && hidden {
                self.reveal = Some(id);
                ctx.request_repaint();
            }
        }
        set_tab_start(ctx, self.clicked);
    }

    fn follow_opened(&mut self, ctx: &Context, before: Option<Id>) {
        let open = open_now(ctx);
        let opener = before.or(self.clicked);
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
            }
        }
        // What opened last closes first.
        while let Some(closed) = self.opened.iter().rposition(|opened| {
            let key = opened.key;
            open.iter().all(|&(open, _)| open != key)
        }) {
            let Opened { opener, .. } = self.opened.remove(closed);
            let focused = ctx.memory(|memory| memory.focused());
            let is_lost = focused.is_none_or(|id| !is_shown(ctx, id));
            let Some(opener) = opener.filter(|_| is_lost) else {
                continue;
            };
            if before.is_some() {
                ctx.memory_mut(|memory| memory.request_focus(opener));
                ctx.request_repaint();
            } else if self.clicked.is_none_or(|id| !is_shown(ctx, id)) {
                self.clicked = Some(opener);
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

/// What can have the focus in a layer, in the order in which it is shown.
fn controls(widgets: &WidgetRects, layer: LayerId) -> impl Iterator<Item = Id> {
    let widgets = widgets.get_layer(layer);
    let can_have_it = widgets.filter(|widget| widget.enabled && widget.sense.is_focusable());
    can_have_it.map(|widget| widget.id)
}

/// What lies open over or beside the view, each with its first control: popovers, dialogs, the page of the drawer.
fn open_now(ctx: &Context) -> Vec<(Id, Id)> {
    let beside = [panel::FINDINGS, panel::PAGE].map(panel::id_of);
    let mut open: Vec<(Id, Id)> = ctx.viewport(|viewport| {
        let widgets = &viewport.this_pass.widgets;
        let layers = widgets.layer_ids();
        let layers = layers.filter(|layer| layer.order == Order::Foreground || beside.contains(&layer.id));
        let first = |layer: LayerId| Some((layer.id, controls(widgets, layer).next()?));
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

/// Notes that a page of the drawer is open, with its first control.
pub(in crate::ui) fn note_page(ui: &Ui, key: Id, first: Id) {
    let pass = ui.ctx().cumulative_pass_nr();
    ui.data_mut(|data| data.insert_temp(page_id(), (pass, key, first)));
}

fn page_id() -> Id {
    Id::unique("page of the drawer")
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
