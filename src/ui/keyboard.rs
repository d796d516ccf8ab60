//! Who has the keyboard: a field into which words are typed, a control, or nobody, and then keys are shortcuts.

use egui::{Context, Id, Popup, Ui};

/// Who had the keyboard when the last pass ended, and which button opened what hangs from one.
#[derive(Debug, Default)]
pub(super) struct Keyboard {
    focused: Option<Id>,
    typing: bool,
    opener: Option<Id>,
}

impl Keyboard {
    /// Whether keys were typed into a field when this pass began: it had the keyboard, or had it until a key of this pass.
    pub(super) fn was_typing(&self, ctx: &Context) -> bool {
        self.typing || ctx.text_edit_focused()
    }

    /// Whether keys are typed into a field as this pass ends, or it is being pressed.
    pub(super) fn is_typing(&mut self, ctx: &Context) -> bool {
        let pressed = ctx.data_mut(|data| data.remove_temp::<()>(pressed_field()).is_some());
        self.typing = pressed || ctx.text_edit_focused();
        self.typing
    }

    /// Gives the keyboard back to whom something that was shut had taken it from. `popover_was_open`: when this pass began;
    /// `escape_shut`: Esc has shut something.
    pub(super) fn give_back(&mut self, ctx: &Context, popover_was_open: bool, escape_shut: bool) {
        let before = self.focused;
        let focused = ctx.memory(|memory| memory.focused());
        let clicked = ctx.interaction_snapshot(|interaction| interaction.clicked);
        let opens = |button: &Id| Popup::is_id_open(ctx, popup_of(*button));
        if let Some(button) = [clicked, focused].into_iter().flatten().find(opens) {
            self.opener = Some(button);
        }
        let hung = |id: Id| {
            let layer = ctx.read_response(id).map(|response| response.layer_id.id);
            layer.is_some() && layer == self.opener.map(popup_of)
        };
        let popover_shut = popover_was_open && !Popup::is_any_open(ctx);
        if (popover_shut || escape_shut) && focused.is_none_or(|id| popover_shut && hung(id)) {
            // With a mouse nobody has it.
            let heir = before.and_then(|id| {
                if escape_shut && !hung(id) {
                    Some(id)
                } else {
                    self.opener
                }
            });
            if let Some(id) = heir {
                ctx.memory_mut(|memory| memory.request_focus(id));
            }
        }
        self.focused = ctx.memory(|memory| memory.focused());
    }
}

/// Says that the pointer presses a field: until it has the keyboard no key is a shortcut.
pub(super) fn press_field(ui: &Ui) {
    ui.data_mut(|data| data.insert_temp(pressed_field(), ()));
}

fn pressed_field() -> Id {
    Id::unique("a field is pressed")
}

/// What hangs from a button, by the name that egui gives it.
fn popup_of(button: Id) -> Id {
    button.with("popup")
}
