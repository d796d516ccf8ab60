//! Starting a viewer on a canvas.

use std::rc::Rc;

use wasm_bindgen::prelude::*;
use web_sys::HtmlCanvasElement;

use super::backend::{self, Chosen, Preference};
use super::canvas::{ContextWatch, lose_context};
use super::shared::{Running, Shared};
use super::{object, rim, sleep};
use crate::render::device;
use crate::session::QualityCommand;

/// Why a start failed that was followed by another one, or by a stop.
const OVERTAKEN: &str = "another start came after this one";

/// Starts a viewer; see `Viewer::start`.
pub(super) async fn start(
    shared: Rc<Shared>,
    canvas: HtmlCanvasElement,
    preference: Preference,
) -> Result<JsValue, JsValue> {
    shared.stop();
    let mine = shared.starts.get();
    let is_overtaken = || shared.starts.get() != mine;
    let chosen = backend::choose(preference).await?;
    if is_overtaken() {
        return Err(JsError::new(OVERTAKEN).into());
    }
    let running = run(canvas, chosen, &shared, mine).await?;
    if is_overtaken() {
        running.give_back();
        return Err(JsError::new(OVERTAKEN).into());
    }
    let started = object([
        ("backend", running.backend.into()),
        ("adapter", (&*running.adapter).into()),
    ]);
    let drawn = Rc::clone(&running.drawn);
    running.frames.request();
    shared.running.replace(Some(running));
    // In a hidden tab no frame comes. Elsewhere the page does not wait for it for ever.
    for _ in 0..100 {
        if drawn.get().frames > 0 || is_hidden() {
            break;
        }
        sleep(20).await;
    }
    Ok(started)
}

/// Runs on a canvas. `start` is the number of the start.
async fn run(canvas: HtmlCanvasElement, chosen: Chosen, shared: &Rc<Shared>, start: u32) -> Result<Running, JsError> {
    let backend = chosen.name();
    let told = Rc::downgrade(shared);
    let context_watch = ContextWatch::new(&canvas, move || {
        if let Some(shared) = told.upgrade() {
            shared.emit_loss(start, "the WebGL context was lost");
        }
    })?;
    let started = rim::run(canvas.clone(), chosen, shared, start).await;
    let started = started.map_err(|reason| {
        lose_context(&canvas);
        JsError::new(&format!("{backend}: {reason}"))
    })?;
    let slow = device::is_software(&started.adapter.get_info());
    let mut session = shared.session.borrow_mut();
    session.apply(QualityCommand::SetSlowDevice(slow));
    Ok(Running {
        canvas,
        app: started.app,
        frames: started.frames,
        backend,
        adapter: backend::adapter_name(&started.adapter),
        device: started.device,
        queue: started.queue,
        drawn: started.drawn,
        context_watch,
    })
}

/// Whether the page is in a tab that is not shown.
fn is_hidden() -> bool {
    let document = web_sys::window().and_then(|window| window.document());
    document.is_some_and(|document| document.hidden())
}
