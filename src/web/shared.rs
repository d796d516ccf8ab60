//! What a viewer shares with its callbacks, and what it has while it runs.

use std::cell::{Cell, RefCell};
use std::rc::Rc;

use js_sys::{Function, Uint8Array};
use wasm_bindgen::prelude::*;
use web_sys::HtmlCanvasElement;

use super::canvas::{ContextWatch, lose_context};
use super::contrast::ContrastWatch;
use super::mirror::{self, MirrorLink};
use super::picture::AppSlot;
use super::state::Drawn;
use super::timings::Timings;
use super::{object, state};
use crate::session::{ExportedFile, Session};
use crate::ui::{UiState, view_in_words};

/// What a viewer shares with its callbacks.
pub(super) struct Shared {
    pub(super) session: Rc<RefCell<Session>>,
    pub(super) ui: Rc<RefCell<UiState>>,
    pub(super) running: RefCell<Option<Running>>,
    pub(super) mirror: MirrorLink,
    /// Counts starts and stops, so that events of an earlier start or its device are ignored.
    pub(super) starts: Cell<u32>,
    /// Hears of events until the viewer is dropped.
    listener: RefCell<Option<Function>>,
    /// Other names were kept for a model elsewhere; the next frame reads them.
    pub(super) names_changed: Cell<bool>,
    /// Of the last opening, and its slices.
    pub(super) timings: Rc<Timings>,
    /// Whether tasks go on with an opening.
    pub(super) is_opening: Cell<bool>,
}

/// What lives as long as a viewer has its canvas.
pub(super) struct Running {
    pub(super) canvas: HtmlCanvasElement,
    pub(super) app: AppSlot,
    pub(super) ctx: egui::Context,
    pub(super) backend: &'static str,
    pub(super) adapter: String,
    pub(super) drawn: Rc<Cell<Drawn>>,
    pub(super) device: wgpu::Device,
    pub(super) runner: eframe::WebRunner,
    pub(super) _context_watch: ContextWatch,
    pub(super) _contrast_watch: ContrastWatch,
}

impl Running {
    /// Leaves the canvas with its listeners and frames, and frees what was made for it.
    ///
    /// It happens later: the caller may run within a frame, which borrows all of it.
    pub(super) fn give_back(self) {
        wasm_bindgen_futures::spawn_local(async move {
            if self.runner.has_panicked() {
                // A frame that panicked never ends its borrows. eframe has removed the listeners.
                std::mem::forget(self);
                return;
            }
            self.runner.destroy();
            self.app.take();
            // The browser would keep all of it until it next collects garbage.
            self.device.destroy();
            lose_context(&self.canvas);
        });
    }
}

impl Shared {
    pub(super) fn new(mut session: Session, listener: Function) -> Self {
        let timings = Rc::<Timings>::default();
        timings.give_to(&mut session);
        Self {
            timings,
            is_opening: Cell::default(),
            mirror: MirrorLink::default(),
            session: Rc::new(RefCell::new(session)),
            running: RefCell::new(None),
            ui: Rc::default(),
            starts: Cell::new(0),
            listener: RefCell::new(Some(listener)),
            names_changed: Cell::default(),
        }
    }

    /// Hands a file, as text or bytes, to the page, which saves it.
    pub(super) fn save_file(&self, name: &str, contents: JsValue, kind: &str) {
        let file = [("name", name.into()), ("contents", contents), ("type", kind.into())];
        self.emit("save", &object(file));
    }

    /// Hands a file that was exported to the page.
    pub(super) fn save_export(&self, file: &ExportedFile) {
        let bytes = Uint8Array::from(file.bytes.as_slice());
        self.save_file(&file.name, bytes.into(), file.media_type());
    }

    pub(super) fn emit(&self, kind: &str, detail: &JsValue) {
        let listener = self.listener.borrow().clone();
        if let Some(listener) = listener {
            // The browser reports what a listener throws.
            let _ = listener.call2(&JsValue::NULL, &kind.into(), detail);
        }
    }

    /// Passes what happened in the session on to the listener, with the state that it would ask for.
    pub(super) fn emit_events(&self) {
        let events = self.session.borrow_mut().take_events();
        for event in events {
            let detail = state::event_detail(&self.session.borrow(), event);
            self.emit(event.name(), &detail);
        }
    }

    /// Tells the page what a frame has changed of the controls, once the frame has ended: called in its first pass.
    pub(super) fn tell_mirror(self: &Rc<Self>, ctx: &egui::Context) {
        if !self.mirror.tells() {
            return;
        }
        let (shared, ctx) = (Rc::clone(self), ctx.clone());
        wasm_bindgen_futures::spawn_local(async move {
            if let Some(changes) = mirror::take_changes(&ctx) {
                let view = view_in_words(&shared.session.borrow());
                shared.emit("mirror", &object([("changes", changes), ("view", view.into())]));
            }
            shared.mirror.rest(&ctx).await;
        });
    }

    /// Tells of a lost device or context, unless it is that of an earlier start.
    pub(super) fn emit_loss(&self, start: u32, reason: &str) {
        if start == self.starts.get() {
            self.emit("devicelost", &object([("reason", reason.into())]));
        }
    }

    /// Stops telling of events.
    pub(super) fn silence(&self) {
        self.listener.take();
    }

    /// Whether the viewer was dropped.
    pub(super) fn is_silenced(&self) -> bool {
        self.listener.borrow().is_none()
    }

    /// Gives the canvas back, also one on which a start is under way.
    pub(super) fn stop(&self) {
        self.starts.set(self.starts.get() + 1);
        if let Some(running) = self.running.take() {
            running.give_back();
        }
    }
}
