//! What a viewer shares with its callbacks, and what it has while it runs.

use std::cell::{Cell, RefCell};
use std::rc::Rc;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use js_sys::Function;
use wasm_bindgen::prelude::*;
use web_sys::HtmlCanvasElement;

use super::canvas::{ContextWatch, lose_context};
use super::picture::{AppSlot, Drawn};
use super::rim::{Face, Frames};
use super::timings::Timings;
use super::{object, sleep, state};
use crate::session::Session;

/// What a viewer shares with its callbacks.
pub(super) struct Shared {
    pub(super) session: Rc<RefCell<Session>>,
    pub(super) face: Face,
    pub(super) running: RefCell<Option<Running>>,
    /// Counts starts and stops, so that events of an earlier start or its device are ignored.
    pub(super) starts: Cell<u32>,
    /// Hears of events until the viewer is dropped.
    listener: RefCell<Option<Function>>,
    /// Of the last opening, and its slices.
    pub(super) timings: Rc<Timings>,
    /// Whether tasks go on with an opening.
    pub(super) is_opening: Cell<bool>,
    /// Whether what is seen changed by itself, or something was held, in the frame before.
    is_busy: Cell<bool>,
}

/// What a rim has started on a canvas.
pub(super) struct Started {
    pub(super) app: AppSlot,
    pub(super) frames: Frames,
    pub(super) adapter: wgpu::Adapter,
    pub(super) device: wgpu::Device,
    pub(super) queue: wgpu::Queue,
    pub(super) drawn: Rc<Cell<Drawn>>,
}

/// What lives as long as a viewer has its canvas.
pub(super) struct Running {
    pub(super) canvas: HtmlCanvasElement,
    pub(super) app: AppSlot,
    pub(super) frames: Frames,
    pub(super) backend: &'static str,
    pub(super) adapter: String,
    pub(super) device: wgpu::Device,
    pub(super) queue: wgpu::Queue,
    pub(super) drawn: Rc<Cell<Drawn>>,
    pub(super) context_watch: ContextWatch,
}

impl Running {
    /// Leaves the canvas with its listeners and frames, and frees what was made for it.
    ///
    /// It happens later: the caller may run within a frame, which borrows all of it.
    pub(super) fn give_back(self) {
        wasm_bindgen_futures::spawn_local(async move {
            if self.frames.have_panicked() {
                // A frame that panicked never ends its borrows.
                std::mem::forget(self);
                return;
            }
            self.frames.end();
            self.app.take();
            drop(self.context_watch);
            // The browser would keep all of it until it next collects garbage.
            lose_context(&self.canvas);
            if self.backend == "webgpu" {
                until_done(&self.queue).await;
            }
            self.device.destroy();
        });
    }
}

/// Waits until a queue has nothing to do, but not for ever. A page of Chromium's was seen to stand still for good when a device was destroyed that still
/// drew.
async fn until_done(queue: &wgpu::Queue) {
    const TICK_MS: i32 = 16;
    const MOST_TICKS: usize = 300;
    let is_done = Arc::new(AtomicBool::new(false));
    let done = Arc::clone(&is_done);
    queue.on_submitted_work_done(move || done.store(true, Ordering::Relaxed));
    for _ in 0..MOST_TICKS {
        if is_done.load(Ordering::Relaxed) {
            return;
        }
        sleep(TICK_MS).await;
    }
}

impl Shared {
    pub(super) fn new(mut session: Session, face: Face, listener: Function) -> Self {
        let timings = Rc::<Timings>::default();
        timings.give_to(&mut session);
        Self {
            timings,
            is_opening: Cell::default(),
            is_busy: Cell::default(),
            session: Rc::new(RefCell::new(session)),
            face,
            running: RefCell::new(None),
            starts: Cell::new(0),
            listener: RefCell::new(Some(listener)),
        }
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

    /// Notes what was drawn, once a frame has ended.
    pub(super) fn note_drawn(&self, noted: &Cell<Drawn>, drawn: Drawn) {
        if noted.replace(drawn).frames != drawn.frames {
            self.timings.note_drawn();
        }
    }

    /// Goes on after a frame: with what is opened, and with what the page hears. `is_held`: a pointer holds something.
    pub(super) fn follow_frame(self: &Rc<Self>, is_held: bool) {
        self.tell_settling(is_held);
        self.go_on_opening();
        self.emit_events();
    }

    /// Tells the page after each frame, and once when what is seen changes by itself or something is held: a link to it
    /// waits until that rests.
    fn tell_settling(&self, is_held: bool) {
        let is_busy = is_held || self.session.borrow().is_moving();
        let was_busy = self.is_busy.replace(is_busy);
        if !is_busy {
            self.emit("settling", &JsValue::UNDEFINED);
        } else if !was_busy {
            self.emit("moving", &JsValue::UNDEFINED);
        }
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
