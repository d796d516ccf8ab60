//! What is done with the elements of the page, on its way to a frame.

use egui::{Context, Event, Id, Key, Modifiers, RawInput};

use super::record::MirrorAction;

const HOLDS_KEY: &str = "an element of the page holds a key";

/// Collects what is done with the elements between two frames.
#[derive(Debug, Default)]
pub struct MirrorInput {
    /// Clicks and other actions, as [`MirrorAction::event`] makes them, and keys.
    pub events: Vec<Event>,
    /// A key is down that the browser turns into clicks or values: until it is up, what changes is one step to undo.
    pub holds_key: bool,
    /// An element has the focus of the page.
    focused: bool,
    /// The widget that has the focus in egui is to let go of it.
    blurs: bool,
}

impl MirrorInput {
    /// Takes the focus from the widget that has it in egui.
    pub fn blur(&mut self) {
        // What had the focus for a moment needs no more.
        self.events.retain(|event| !MirrorAction::is_focus(event));
        self.blurs = true;
    }

    /// Takes a key of an element, by the names that browsers give to it and to its place. Returns egui's name of it.
    pub fn press(&mut self, name: &str, place: &str, pressed: bool, modifiers: Modifiers) -> Option<Key> {
        // Always, since the pointer may have told of others meanwhile.
        self.events.push(Event::ModifiersChanged(modifiers));
        if pressed && !modifiers.command && name.chars().count() == 1 {
            self.events.push(Event::Text(name.to_owned()));
        }
        let physical_key = Key::from_name(place);
        let key = Key::from_name(name).or(physical_key)?;
        self.events.push(Event::Key {
            key,
            physical_key,
            pressed,
            repeat: false,
            modifiers,
        });
        Some(key)
    }

    /// Hears whether an element has the focus of the page.
    pub fn set_focused(&mut self, focused: bool) {
        if std::mem::replace(&mut self.focused, focused) != focused {
            // Keys that come up elsewhere are not heard of.
            self.events.push(Event::ModifiersChanged(Modifiers::NONE));
        }
    }

    /// Adds all of it to the input of a frame.
    pub fn begin_frame(&mut self, ctx: &Context, input: &mut RawInput) {
        input.events.append(&mut self.events);
        if std::mem::take(&mut self.blurs) {
            ctx.memory_mut(|memory| memory.focused().map(|id| memory.surrender_focus(id)));
        }
        ctx.data_mut(|data| data.insert_temp(Id::unique(HOLDS_KEY), self.holds_key));
        if self.focused {
            // The elements are the viewer's, as its canvas is. egui would forget the modifiers when the window loses the focus.
            input.focused = true;
            let lost = input
                .events
                .iter_mut()
                .filter(|event| **event == Event::WindowFocused(false));
            lost.for_each(|event| *event = Event::ModifiersChanged(Modifiers::NONE));
        }
    }
}

/// Whether a key is down that the browser turns into clicks or values.
pub(in crate::ui) fn holds_key(ctx: &Context) -> bool {
    ctx.data(|data| data.get_temp(Id::unique(HOLDS_KEY))).unwrap_or(false)
}
