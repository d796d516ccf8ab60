//! Calls of scripts that need panels: what is said over the view, the controls as elements, edits, contact sheets.

use std::rc::Rc;

use js_sys::Promise;
use wasm_bindgen::prelude::*;

use super::mirror::take_changes;
use super::pictures;
use crate::session::HistoryCommand;
use crate::ui::view_in_words;
use crate::web::shared::Shared;
use crate::web::viewer::Viewer;
use crate::web::{object, picture, promise};

#[wasm_bindgen]
impl Viewer {
    /// Shows a sentence above the timeline, with a button to open files and one that takes it away; without words takes it away.
    pub fn greet(&self, words: Option<String>) {
        self.shared.face.ui.borrow_mut().greeting = words;
        self.shared.request_repaint();
    }

    /// Shows a sentence over the view for a while, and has it spoken.
    pub fn tell(&self, words: String) {
        self.shared.face.ui.borrow_mut().messages.say(words);
        self.shared.request_repaint();
    }

    /// Reads the names that are kept for the open model once more: they were changed on another page.
    #[wasm_bindgen(js_name = readNames)]
    pub fn read_names(&self) {
        self.shared.face.names_changed.set(true);
        self.shared.request_repaint();
    }

    /// Does what a person did with an element of the mirror: `{node, action, value}`, where the action is `click`, `focus`, `setValue`,
    /// `expand`, `collapse` or `scrollIntoView`; `{action: "blur"}` lets go of the focus within the viewer. From `{action: "hold"}` to
    /// `{action: "release"}` what changes is one step to undo.
    pub fn act(&self, asked: &JsValue) {
        self.shared.face.mirror.act(asked);
        self.shared.request_repaint();
    }

    /// Takes a `keydown` or `keyup` event of an element of the mirror. Returns whether the viewer uses the key, so that the browser must not.
    pub fn press(&self, event: &JsValue) -> bool {
        let used = self.shared.face.mirror.press(event);
        self.shared.request_repaint();
        used
    }

    /// Hears whether an element of the mirror has the focus of the page. Then the viewer has the keyboard.
    #[wasm_bindgen(js_name = setMirrorFocused)]
    pub fn set_mirror_focused(&self, focused: bool) {
        self.shared.face.mirror.set_focused(focused);
        self.shared.request_repaint();
    }

    /// Many pictures on one, as the bytes of a PNG: of the clip or the range that plays, or with `turntable` from all sides, each with a label.
    /// `columns` and `rows` are 4 and 3 where they are absent, `width` and `height`, of the whole sheet, those of the canvas; `transparent`
    /// leaves out all grounds but those of labels. What is open plays on meanwhile. An `AbortSignal` as `signal` ends it.
    ///
    /// Rejects as [`Viewer::snapshot`] does, when another model is opened meanwhile, and with an `AbortError` after the signal.
    #[wasm_bindgen(js_name = contactSheet)]
    pub fn contact_sheet(&self, options: JsValue) -> Promise {
        let running = self.shared.app_and_size();
        promise(async {
            let (app, canvas_size) = running.ok_or_else(picture::not_running)?;
            pictures::contact_sheet(app, canvas_size, options).await
        })
    }

    /// Takes the last edit back. Returns whether there was one.
    pub fn undo(&self) -> bool {
        self.shared.step_in_history(HistoryCommand::Undo)
    }

    /// Does the edit again that was undone last. Returns whether there was one.
    pub fn redo(&self) -> bool {
        self.shared.step_in_history(HistoryCommand::Redo)
    }
}

impl Shared {
    /// Undoes or redoes. Returns whether there was a step.
    fn step_in_history(&self, command: HistoryCommand) -> bool {
        let revision = || self.session.borrow().history().revision();
        let before = revision();
        self.apply(command);
        revision() != before
    }

    /// Tells the page what a frame has changed of the controls, once the frame has ended: called in its first pass.
    pub(super) fn tell_mirror(self: &Rc<Self>, ctx: &egui::Context) {
        if !self.face.mirror.tells() {
            return;
        }
        let (shared, ctx) = (Rc::clone(self), ctx.clone());
        wasm_bindgen_futures::spawn_local(async move {
            if let Some(changes) = take_changes(&ctx) {
                let view = view_in_words(&shared.session.borrow());
                shared.emit("mirror", &object([("changes", changes), ("view", view.into())]));
            }
            shared.face.mirror.rest(&ctx).await;
        });
    }
}
