//! The browser: starting, the interface for scripts, panics and lost devices. The only module with web code.
//!
//! The page's scripts (`web/*.js`) own the DOM; this module owns the session, which lives as long as the page, and the
//! runner, which lives as long as a canvas. After a lost GPU the page makes another canvas and starts again.

#![expect(unreachable_pub, reason = "wasm-bindgen exports these to scripts")]

mod api;
mod backend;
mod kept_names;
mod picture;
mod picture_look;
mod playing;
mod state;

use std::cell::{Cell, RefCell};
use std::rc::Rc;

use js_sys::{Function, Reflect};
use wasm_bindgen::prelude::*;
use web_sys::HtmlCanvasElement;

use crate::app::App;
use crate::session::{Command, RenderScale, Session};
use crate::ui::Request;
use backend::{Chosen, Preference};
use kept_names::KeptNames;

/// Why a start came to nothing that was followed by another one, or by a stop.
const OVERTAKEN: &str = "another start came after this one";

thread_local! {
    static PAGE: RefCell<Option<Page>> = const { RefCell::new(None) };
    /// The page's listener, apart from `PAGE` so that a panic anywhere can still be told.
    static LISTENER: RefCell<Option<Function>> = const { RefCell::new(None) };
    /// Counts starts and stops, so that an earlier start and its device cannot speak for the present one.
    static STARTS: Cell<u32> = const { Cell::new(0) };
}

/// What lives as long as the page.
struct Page {
    session: Rc<RefCell<Session>>,
    running: Option<Running>,
}

/// What lives as long as a canvas.
struct Running {
    runner: eframe::WebRunner,
    app: Rc<RefCell<Option<App>>>,
    ctx: egui::Context,
    gpu: egui_wgpu::RenderState,
    backend: &'static str,
    adapter: String,
    frames_rendered: Rc<Cell<u64>>,
}

impl Running {
    /// Leaves the canvas, and frees what was made for it.
    fn give_up(self) {
        self.runner.destroy();
        self.app.take();
    }
}

/// Tells the page's listener.
fn emit(kind: &str, detail: &JsValue) {
    let listener = LISTENER.with_borrow(Clone::clone);
    if let Some(listener) = listener {
        // What a listener throws is its own affair; the browser reports it.
        let _ = listener.call2(&JsValue::NULL, &kind.into(), detail);
    }
}

/// An object with one field of text.
fn detail(name: &str, value: &str) -> JsValue {
    let object = js_sys::Object::new();
    let _ = Reflect::set(&object, &name.into(), &value.into());
    object.into()
}

/// Starts the viewer on a canvas that was never used. The session of an earlier start goes on.
///
/// `options`: `{backend: "auto" | "webgpu" | "webgl2", renderScale: number}`; the scale is that of a session that begins. Resolves with `{backend, adapter}` when the first
/// frame was drawn.
///
/// # Errors
/// When no backend works, with the reasons of each that was tried, and when another start or a stop came meanwhile.
#[wasm_bindgen]
pub async fn start(canvas: HtmlCanvasElement, options: JsValue, on_event: Function) -> Result<JsValue, JsError> {
    LISTENER.with_borrow_mut(|listener| *listener = Some(on_event));
    let option = |name: &str| Reflect::get(&options, &name.into()).unwrap_or(JsValue::UNDEFINED);
    let preference = Preference::from_name(&option("backend").as_string().unwrap_or_default());

    stop();
    let mine = STARTS.get();
    let is_overtaken = || STARTS.get() != mine;
    let session = PAGE.with_borrow_mut(|page| {
        let new_page = || {
            let mut session = Session::new(reduced_motion());
            let scale = option("renderScale").as_f64().unwrap_or(1.0);
            session.apply(Command::SetRenderScale(RenderScale::new(scale as f32)));
            Page {
                session: Rc::new(RefCell::new(session)),
                running: None,
            }
        };
        Rc::clone(&page.get_or_insert_with(new_page).session)
    });
    let chosen = backend::choose(preference)
        .await
        .map_err(|reasons| JsError::new(&reasons))?;
    if is_overtaken() {
        return Err(JsError::new(OVERTAKEN));
    }
    let running = run(canvas, chosen, session, mine).await?;
    if is_overtaken() {
        running.give_up();
        return Err(JsError::new(OVERTAKEN));
    }
    let (backend, adapter) = (running.backend, running.adapter.clone());
    let frames = Rc::clone(&running.frames_rendered);
    running.ctx.request_repaint();
    PAGE.with_borrow_mut(|page| {
        if let Some(page) = page {
            page.running = Some(running);
        }
    });
    // A frame that never comes (a hidden tab) must not hold the page up.
    for _ in 0..100 {
        if frames.get() > 0 {
            break;
        }
        sleep(20).await;
    }
    let result = detail("backend", backend);
    let _ = Reflect::set(&result, &"adapter".into(), &adapter.into());
    Ok(result)
}

async fn run(
    canvas: HtmlCanvasElement,
    chosen: Chosen,
    session: Rc<RefCell<Session>>,
    start: u32,
) -> Result<Running, JsError> {
    let backend = chosen.name();
    let web_options = eframe::WebOptions {
        renderer: eframe::Renderer::Wgpu,
        wgpu_options: chosen.into_configuration(),
        // The page's own listeners take drops; keys of the browser stay with the browser.
        should_stop_propagation: Box::new(|_| false),
        should_prevent_default: Box::new(owns_event),
        ..Default::default()
    };
    let app_slot = Rc::new(RefCell::new(None));
    let frames_rendered = Rc::new(Cell::new(0));
    let shared = Rc::new(RefCell::new(None));
    let runner = eframe::WebRunner::new();
    watch_panics();
    let shell = Shell {
        app: Rc::clone(&app_slot),
        session: Rc::clone(&session),
        frames: Rc::clone(&frames_rendered),
        names: KeptNames::default(),
    };
    let shared_out = Rc::clone(&shared);
    runner
        .start(
            canvas.clone(),
            web_options,
            Box::new(move |creation| {
                let gpu = creation.wgpu_render_state.clone().ok_or("the viewer needs wgpu")?;
                watch_device(&gpu.device, start);
                *shell.app.borrow_mut() = Some(App::new(
                    &creation.egui_ctx,
                    &gpu,
                    Rc::clone(&shell.session),
                    coarse_pointer(),
                ));
                *shared_out.borrow_mut() = Some((creation.egui_ctx.clone(), gpu));
                Ok(Box::new(shell))
            }),
        )
        .await
        .map_err(|error| JsError::new(&format!("{backend}: {}", text_of(&error))))?;
    watch_context(&canvas, start)?;
    let (ctx, gpu) = shared.take().ok_or_else(|| JsError::new("the viewer did not start"))?;
    let adapter = backend::adapter_name(&gpu.adapter);
    Ok(Running {
        runner,
        app: app_slot,
        ctx,
        gpu,
        backend,
        adapter,
        frames_rendered,
    })
}

/// Gives the canvas up, also one on which a start is under way. The session stays.
#[wasm_bindgen]
pub fn stop() {
    STARTS.set(STARTS.get() + 1);
    let running = PAGE.with_borrow_mut(|page| page.as_mut().and_then(|page| page.running.take()));
    if let Some(running) = running {
        running.give_up();
    }
}

/// What eframe runs: the app, and the page's share of what it asks for.
struct Shell {
    app: Rc<RefCell<Option<App>>>,
    session: Rc<RefCell<Session>>,
    frames: Rc<Cell<u64>>,
    names: KeptNames,
}

impl eframe::App for Shell {
    fn ui(&mut self, ui: &mut egui::Ui, _frame: &mut eframe::Frame) {
        let mut requests = Vec::new();
        if let Some(app) = self.app.borrow_mut().as_mut() {
            requests = app.ui(ui);
            self.frames.set(app.frames_rendered());
        }
        for request in requests {
            match request {
                Request::PickFiles => emit("pickfiles", &JsValue::UNDEFINED),
                Request::ReadAgain => emit("readagain", &JsValue::UNDEFINED),
                Request::PickClips => emit("pickclips", &JsValue::UNDEFINED),
                Request::SavePicture { size, transparent } => picture::save(size, transparent),
                // The app has done it.
                Request::UseTheme(_) => {}
            }
        }
        tell_events(&self.session);
        if self.names.follow(&mut self.session.borrow_mut()) {
            ui.ctx().request_repaint();
        }
    }

    fn clear_color(&self, _visuals: &egui::Visuals) -> [f32; 4] {
        [0.0, 0.0, 0.0, 1.0]
    }

    fn persist_egui_memory(&self) -> bool {
        false
    }
}

/// Passes what happened in the session on to listeners, with the state that they would ask for.
fn tell_events(session: &Rc<RefCell<Session>>) {
    let events = session.borrow_mut().take_events();
    for event in events {
        let detail = state::event_detail(&session.borrow(), event);
        emit(event.name(), &detail);
    }
}

/// Keys that the viewer acts on, and all pointer events; the rest is the browser's (F5, F12, Ctrl+L …).
fn owns_event(event: &egui::Event) -> bool {
    match event {
        egui::Event::Key {
            key: egui::Key::Tab, ..
        } => false,
        egui::Event::Key { key, modifiers, .. } => crate::ui::owns_key(*key, *modifiers),
        egui::Event::Text(_) | egui::Event::Copy | egui::Event::Cut => false,
        _ => true,
    }
}

/// Whether the browser says that the first pointer is a finger.
fn coarse_pointer() -> bool {
    matches_media("(pointer: coarse)")
}

/// Whether the person wants things to stand still.
fn reduced_motion() -> bool {
    matches_media("(prefers-reduced-motion: reduce)")
}

fn matches_media(query: &str) -> bool {
    let query = web_sys::window().and_then(|window| window.match_media(query).ok().flatten());
    query.is_some_and(|query| query.matches())
}

fn watch_panics() {
    // eframe's hook, installed just now, logs and stops its runner; this one adds the page's message.
    let logged = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |info| {
        logged(info);
        emit("panic", &detail("message", &info.to_string()));
    }));
}

fn watch_device(device: &egui_wgpu::wgpu::Device, start: u32) {
    device.on_uncaptured_error(std::sync::Arc::new(|error: egui_wgpu::wgpu::Error| {
        web_sys::console::error_1(&format!("GPU error: {error}").into());
    }));
    device.set_device_lost_callback(move |reason, message| {
        let by_us = reason == egui_wgpu::wgpu::DeviceLostReason::Destroyed && message.is_empty();
        if start == STARTS.get() && !by_us {
            emit("devicelost", &detail("reason", &message));
        }
    });
}

fn watch_context(canvas: &HtmlCanvasElement, start: u32) -> Result<(), JsError> {
    let lost = Closure::<dyn FnMut(web_sys::Event)>::new(move |event: web_sys::Event| {
        event.prevent_default();
        if start == STARTS.get() {
            emit("devicelost", &detail("reason", "the WebGL context was lost"));
        }
    });
    canvas
        .add_event_listener_with_callback("webglcontextlost", lost.as_ref().unchecked_ref())
        .map_err(|error| JsError::new(&text_of(&error)))?;
    // Lives as long as the canvas, which the page drops.
    lost.forget();
    Ok(())
}

fn text_of(value: &JsValue) -> String {
    value.as_string().unwrap_or_else(|| format!("{value:?}"))
}

/// Waits without holding the page up.
async fn sleep(milliseconds: i32) {
    let promise = js_sys::Promise::new(&mut |resolve, _| {
        let window = web_sys::window();
        let asked = window.map(|w| w.set_timeout_with_callback_and_timeout_and_arguments_0(&resolve, milliseconds));
        if !matches!(asked, Some(Ok(_))) {
            let _ = resolve.call0(&JsValue::NULL);
        }
    });
    let _ = wasm_bindgen_futures::JsFuture::from(promise).await;
}
