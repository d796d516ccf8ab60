//! Calls of scripts that stand in for what a window would bring: its size, its theme, input.

use glam::Vec2;
use wasm_bindgen::prelude::*;

use super::keys;
use crate::scene::Theme;
use crate::session::Command;
use crate::web::field;
use crate::web::shared::Shared;
use crate::web::viewer::Viewer;

#[wasm_bindgen]
impl Viewer {
    /// Gives the canvas a size in pixels of the display. The picture has it from the next frame on.
    pub fn resize(&self, width: u32, height: u32) {
        if let Some(running) = &*self.shared.running.borrow() {
            running.canvas.set_width(width);
            running.canvas.set_height(height);
            running.frames.request();
        }
    }

    /// Draws for a theme, `light` or `dark`, in place of that of the options.
    #[wasm_bindgen(js_name = setTheme)]
    pub fn set_theme(&self, name: &str) {
        let Some(theme) = Theme::from_name(name) else { return };
        self.shared.face.choose_theme(theme);
        self.shared.apply(Command::SetTheme(theme));
    }

    /// Takes an event of the canvas: `pointerdown`, `pointermove`, `pointerup`, `pointercancel`, `click`, `wheel` or `keydown`. Returns whether
    /// the viewer uses it, so that the browser must not.
    pub fn handle(&self, event: &JsValue) -> bool {
        self.shared.handle(event).unwrap_or_default()
    }
}

impl Shared {
    /// See [`Viewer::handle`]; `None` while there is no canvas.
    fn handle(&self, event: &JsValue) -> Option<bool> {
        let canvas = self.running.borrow().as_ref()?.canvas.clone();
        let kind = field(event, "type").as_string()?;
        let (is_used, commands) = if kind == "keydown" {
            let action = keys::action(event)?;
            let command = keys::command(action, &self.session.borrow());
            // A held key goes on stepping, but switches only once.
            let is_due = action.repeats || !field(event, "repeat").is_truthy();
            (command.is_some(), command.filter(|_| is_due).into_iter().collect())
        } else {
            if kind == "pointerdown" {
                // Its moves outside of the canvas count. An event that a script made has no pointer to be captured.
                let id = field(event, "pointerId").as_f64().unwrap_or_default();
                let _ = canvas.set_pointer_capture(id as i32);
            }
            let size = Vec2::new(canvas.client_width() as f32, canvas.client_height() as f32);
            let commands = self
                .face
                .pointers
                .borrow_mut()
                .read(event, size, &self.session.borrow());
            (!commands.is_empty() || self.face.is_held(), commands)
        };
        if is_used {
            self.face.note_input();
            for command in commands {
                self.session.borrow_mut().apply(command);
            }
            self.tell_of_changes();
        }
        Some(is_used)
    }
}
