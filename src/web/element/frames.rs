//! The frames of a canvas: one task draws each of them, when something asked for it and the display is ready for it.

use std::cell::{Cell, RefCell};
use std::future::poll_fn;
use std::rc::Rc;
use std::task::{Poll, Waker};

use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::spawn_local;

use crate::painter::NextPass;
use crate::web::sleep;

#[derive(Clone, Default)]
pub(in crate::web) struct Frames(Rc<Task>);

#[derive(Default)]
struct Task {
    waker: RefCell<Option<Waker>>,
    /// Frames that began until now.
    begun: Cell<u64>,
    is_drawing: Cell<bool>,
    /// Whether the display is ready for a frame that waits.
    is_ready: Cell<bool>,
    has_ended: Cell<bool>,
}

impl Frames {
    /// Asks for a frame.
    pub(in crate::web) fn request(&self) {
        if let Some(waker) = &*self.0.waker.borrow() {
            waker.wake_by_ref();
        }
    }

    /// Whether a frame panicked. Asked between frames.
    pub(in crate::web) fn have_panicked(&self) -> bool {
        self.0.is_drawing.get()
    }

    /// Ends them, also where one is waited for.
    pub(in crate::web) fn end(&self) {
        self.0.has_ended.set(true);
        self.request();
    }

    pub(super) fn have_ended(&self) -> bool {
        self.0.has_ended.get()
    }

    /// The waker of the task that draws, which calls it: to wake it is to ask for a frame.
    pub(super) async fn begin(&self) -> Waker {
        let waker = poll_fn(|context| Poll::Ready(context.waker().clone())).await;
        self.0.waker.replace(Some(waker.clone()));
        waker
    }

    /// Waits until a frame is due or asked for.
    pub(super) async fn wait_for(&self, next: NextPass) {
        // A pass of this canvas that shows nothing new costs next to nothing.
        if let NextPass::After { secs } | NextPass::ToPrepare { secs } = next {
            let (frames, begun) = (self.clone(), self.0.begun.get());
            spawn_local(async move {
                sleep((secs * 1e3).ceil() as i32).await;
                if frames.0.begun.get() == begun {
                    frames.request();
                }
            });
        }
        if next != NextPass::AtOnce {
            woken().await;
        }
    }

    /// Waits until the display is ready for one, which in a hidden tab it is not, or until they have ended.
    pub(super) async fn display_is_ready(&self) {
        let frames = self.clone();
        let ready = Closure::once_into_js(move || {
            frames.0.is_ready.set(true);
            frames.request();
        });
        let asked = web_sys::window().map(|window| window.request_animation_frame(ready.unchecked_ref()));
        self.0.is_ready.set(!matches!(asked, Some(Ok(_))));
        poll_fn(|_| match self.0.is_ready.get() || self.have_ended() {
            true => Poll::Ready(()),
            false => Poll::Pending,
        })
        .await;
    }

    /// Draws one.
    pub(super) fn draw<T>(&self, draw: impl FnOnce() -> T) -> T {
        self.0.begun.set(self.0.begun.get() + 1);
        self.0.is_drawing.set(true);
        let drawn = draw();
        self.0.is_drawing.set(false);
        drawn
    }
}

/// Waits until this task is woken.
async fn woken() {
    let mut is_waiting = false;
    poll_fn(|_| match std::mem::replace(&mut is_waiting, true) {
        true => Poll::Ready(()),
        false => Poll::Pending,
    })
    .await;
}
