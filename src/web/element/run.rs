//! A viewer on a canvas: its app, and the task that draws its frames.

use std::cell::{Cell, RefCell};
use std::rc::Rc;
use std::sync::mpsc;

use wasm_bindgen_futures::spawn_local;
use web_sys::HtmlCanvasElement;

use super::app::App;
use super::frames::Frames;
use super::surface::CanvasSurface;
use crate::painter::NextPass;
use crate::session::Command;
use crate::web::backend::Chosen;
use crate::web::canvas::watch_device;
use crate::web::picture::{AppSlot, Drawn};
use crate::web::shared::{Shared, Started};

/// Starts on a canvas. `start` is the number of the start.
pub(in crate::web) async fn run(
    canvas: HtmlCanvasElement,
    chosen: Chosen,
    shared: &Rc<Shared>,
    start: u32,
) -> Result<Started, String> {
    let surface = CanvasSurface::claim(canvas, chosen).await?;
    let started = Started {
        app: Rc::new(RefCell::new(None)),
        frames: Frames::default(),
        adapter: surface.gpu.adapter.clone(),
        device: surface.gpu.device.clone(),
        queue: surface.gpu.queue.clone(),
        drawn: Rc::new(Cell::new(Drawn::NOTHING)),
    };
    let (app, drawn) = (Rc::clone(&started.app), Rc::clone(&started.drawn));
    let shared = Rc::clone(shared);
    spawn_local(draw_frames(surface, app, started.frames.clone(), drawn, shared, start));
    Ok(started)
}

/// Draws a frame whenever one is due, until the app is taken away or the device is lost.
async fn draw_frames(
    surface: CanvasSurface,
    app: AppSlot,
    frames: Frames,
    drawn: Rc<Cell<Drawn>>,
    shared: Rc<Shared>,
    start: u32,
) {
    let waker = frames.begin().await;
    if shared.starts.get() != start {
        return;
    }
    let (tell_of_loss, loss) = mpsc::channel();
    watch_device(&surface.gpu.device, waker.clone(), tell_of_loss);
    let theme = shared.face.shown_theme();
    shared.session.borrow_mut().apply(Command::SetTheme(theme));
    app.replace(Some(App::new(Rc::clone(&shared.session), surface, waker)));
    let mut next = NextPass::AtOnce;
    loop {
        frames.wait_for(next).await;
        if shared.face.is_out_of_sight.get() && !frames.have_ended() {
            next = NextPass::WhenAsked;
            continue;
        }
        frames.display_is_ready().await;
        if let Ok(reason) = loss.try_recv() {
            shared.emit_loss(start, &reason);
            return;
        }
        {
            let mut app = app.borrow_mut();
            let Some(app) = app.as_mut() else { return };
            next = frames.draw(|| app.frame(shared.face.take_had_input()));
            shared.note_drawn(&drawn, Drawn::by(app));
        }
        shared.follow_frame(shared.face.is_held());
    }
}
