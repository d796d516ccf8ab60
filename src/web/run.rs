//! A viewer on a canvas: starting, frames, the loss of the GPU, and giving the canvas back.

use std::cell::{Cell, RefCell};
use std::rc::{Rc, Weak};
use std::sync::mpsc;

use js_sys::{Function, Uint8Array};
use wasm_bindgen::prelude::*;
use web_sys::{HtmlCanvasElement, HtmlElement, WebGl2RenderingContext, WebglLoseContext};

use super::backend::{self, Chosen, Preference};
use super::contrast::{ContrastWatch, contrast};
use super::joint_names::JointNames;
use super::mirror::{self, MirrorLink};
use super::picture::{self, AppSlot};
use super::{coarse_pointer, field, next_task, now_secs, object, sleep, state, text_of};
use crate::app::{App, AppOptions};
use crate::render::device;
use crate::session::{ExportedFile, QualityCommand, Session};
use crate::ui::{Announcement, Request, SheetRequest, UiState, picture_name, report_name, sheet_name, view_in_words};

/// Why a start failed that was followed by another one, or by a stop.
const OVERTAKEN: &str = "another start came after this one";

/// What a viewer shares with its callbacks.
pub(super) struct Shared {
    pub(super) session: Rc<RefCell<Session>>,
    pub(super) ui: Rc<RefCell<UiState>>,
    pub(super) running: RefCell<Option<Running>>,
    pub(super) mirror: MirrorLink,
    /// Counts starts and stops, so that events of an earlier start or its device are ignored.
    starts: Cell<u32>,
    /// Hears of events until the viewer is dropped.
    listener: RefCell<Option<Function>>,
    /// Other names were kept for a model elsewhere; the next frame reads them.
    pub(super) names_changed: Cell<bool>,
}

/// What lives as long as a viewer has its canvas.
pub(super) struct Running {
    pub(super) canvas: HtmlCanvasElement,
    pub(super) app: AppSlot,
    pub(super) ctx: egui::Context,
    pub(super) backend: &'static str,
    pub(super) adapter: String,
    pub(super) frames_rendered: Rc<Cell<u64>>,
    device: wgpu::Device,
    runner: eframe::WebRunner,
    _context_watch: ContextWatch,
    _contrast_watch: ContrastWatch,
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
    pub(super) fn new(session: Session, listener: Function) -> Self {
        Self {
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
    fn save_file(&self, name: &str, contents: JsValue, kind: &str) {
        let file = [("name", name.into()), ("contents", contents), ("type", kind.into())];
        self.emit("save", &object(file));
    }

    /// Hands a file that was exported to the page.
    fn save_export(&self, file: &ExportedFile) {
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
    fn tell_mirror(self: &Rc<Self>, ctx: &egui::Context) {
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
    fn emit_loss(&self, start: u32, reason: &str) {
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

/// Starts a viewer; see `Viewer::start`.
pub(super) async fn start(
    shared: Rc<Shared>,
    canvas: HtmlCanvasElement,
    preference: Preference,
) -> Result<JsValue, JsError> {
    shared.stop();
    let mine = shared.starts.get();
    let is_overtaken = || shared.starts.get() != mine;
    let chosen = backend::choose(preference)
        .await
        .map_err(|reasons| JsError::new(&reasons))?;
    if is_overtaken() {
        return Err(JsError::new(OVERTAKEN));
    }
    let running = run(canvas, chosen, &shared, mine).await?;
    if is_overtaken() {
        running.give_back();
        return Err(JsError::new(OVERTAKEN));
    }
    let started = object([
        ("backend", running.backend.into()),
        ("adapter", (&*running.adapter).into()),
    ]);
    let frames = Rc::clone(&running.frames_rendered);
    running.ctx.request_repaint();
    shared.running.replace(Some(running));
    // In a hidden tab no frame comes. Elsewhere the page does not wait for it for ever.
    for _ in 0..100 {
        if frames.get() > 0 || is_hidden() {
            break;
        }
        sleep(20).await;
    }
    Ok(started)
}

/// Whether the page is in a tab that is not shown.
fn is_hidden() -> bool {
    let document = web_sys::window().and_then(|window| window.document());
    document.is_some_and(|document| document.hidden())
}

async fn run(canvas: HtmlCanvasElement, chosen: Chosen, shared: &Rc<Shared>, start: u32) -> Result<Running, JsError> {
    let backend = chosen.name();
    let context_watch = ContextWatch::new(&canvas, shared, start)?;
    let web_options = eframe::WebOptions {
        renderer: eframe::Renderer::Wgpu,
        wgpu_options: chosen.into_configuration(),
        // The page's own listeners take drops; keys of the browser stay with the browser.
        should_stop_propagation: Box::new(|_| false),
        should_prevent_default: Box::new(owns_event),
        ..Default::default()
    };
    let app = Rc::new(RefCell::new(None));
    let frames_rendered = Rc::new(Cell::new(0));
    let (tell_of_loss, loss) = mpsc::channel();
    let shell = Shell {
        canvas: canvas.clone(),
        app: Rc::clone(&app),
        shared: Rc::clone(shared),
        start,
        loss,
        is_lost: false,
        exports: Rc::default(),
        frames: Rc::clone(&frames_rendered),
        names: JointNames::default(),
        saved: Rc::default(),
    };
    let made = Rc::new(RefCell::new(None));
    let made_out = Rc::clone(&made);
    let runner = eframe::WebRunner::new();
    let had_focus = focused_element();
    let started = runner
        .start(
            canvas.clone(),
            web_options,
            Box::new(move |creation| {
                let gpu = creation.wgpu_render_state.clone().ok_or("the viewer needs wgpu")?;
                watch_device(&gpu.device, &creation.egui_ctx, tell_of_loss);
                shell.shared.mirror.begin();
                let (session, state) = (Rc::clone(&shell.shared.session), Rc::clone(&shell.shared.ui));
                let options = AppOptions {
                    coarse_pointer: coarse_pointer(),
                    now_secs,
                };
                let app = App::new(&creation.egui_ctx, &gpu, session, state, options);
                shell.app.replace(Some(app));
                let adapter = backend::adapter_name(&gpu.adapter);
                let slow = device::is_software(&gpu.adapter.get_info());
                shell
                    .shared
                    .session
                    .borrow_mut()
                    .apply(QualityCommand::SetSlowDevice(slow));
                *made_out.borrow_mut() = Some((creation.egui_ctx.clone(), adapter, gpu.device));
                Ok(Box::new(shell))
            }),
        )
        .await;
    if let Some(element) = had_focus {
        leave_focus(&canvas, &element);
    }
    if let Err(error) = started {
        runner.destroy();
        lose_context(&canvas);
        return Err(JsError::new(&format!("{backend}: {}", text_of(&error))));
    }
    let (ctx, adapter, device) = made.take().ok_or_else(|| JsError::new("the viewer did not start"))?;
    let contrast_watch = ContrastWatch::new(&ctx);
    take_prints(&runner, &canvas, &app)?;
    Ok(Running {
        canvas,
        app,
        ctx,
        backend,
        adapter,
        frames_rendered,
        device,
        runner,
        _context_watch: context_watch,
        _contrast_watch: contrast_watch,
    })
}

/// At a `beforeprint` event of the canvas the picture is drawn on it without the panels, at once: a print waits for no frame.
fn take_prints(runner: &eframe::WebRunner, canvas: &HtmlCanvasElement, app: &AppSlot) -> Result<(), JsError> {
    let app = Rc::clone(app);
    let set_alone = move |alone| {
        if let Some(app) = app.borrow_mut().as_mut() {
            app.set_picture_alone(alone);
        }
    };
    let listening = runner.add_event_listener(canvas, "beforeprint", move |_: web_sys::Event, runner| {
        set_alone(true);
        runner.logic();
        runner.paint();
        set_alone(false);
        runner.egui_ctx().request_repaint();
    });
    listening.map_err(|error| JsError::new(&text_of(&error)))
}

/// What eframe runs: the app, and what the page does for it.
struct Shell {
    canvas: HtmlCanvasElement,
    app: AppSlot,
    shared: Rc<Shared>,
    start: u32,
    /// Why the device was lost, once it was.
    loss: mpsc::Receiver<String>,
    is_lost: bool,
    /// Whether tasks go on with an export.
    exports: Rc<Cell<bool>>,
    frames: Rc<Cell<u64>>,
    names: JointNames,
    /// The picture that was saved last.
    saved: Rc<RefCell<Option<SavedPicture>>>,
}

/// Name and bytes of a picture, as fields of what the page is told.
type SavedPicture = [(&'static str, JsValue); 2];

impl Shell {
    /// Hands the last picture to the page once more, which lets the person choose where it is saved.
    fn save_picture_as(&self) {
        if let Some([name, bytes]) = self.saved.borrow().clone() {
            let asks = ("choosesPlace", true.into());
            self.shared.emit("picture", &object([name, bytes, asks]));
        }
    }

    /// Hands the report of what was found to the page, which saves it. A message says so.
    fn save_report(&self) {
        // The page is told when nothing is borrowed: its listener may call the viewer.
        let (name, text) = {
            let session = self.shared.session.borrow();
            let text = session.sarif().and_then(|sarif| state::json(&sarif));
            (report_name(&session), text)
        };
        let Some(text) = text else { return };
        self.shared.save_file(&name, text.into(), "application/sarif+json");
        if let Some(app) = self.app.borrow_mut().as_mut() {
            app.report_was_saved(&name);
        }
    }

    /// Goes on with what is exported, in tasks between frames: while frames take long, and in a hidden tab, where none comes.
    fn go_on_exporting(&self, ctx: &egui::Context) {
        if self.shared.session.borrow().export().is_none() || self.exports.replace(true) {
            return;
        }
        let (app, shared) = (Rc::clone(&self.app), Rc::clone(&self.shared));
        let (exports, ctx) = (Rc::clone(&self.exports), ctx.clone());
        wasm_bindgen_futures::spawn_local(async move {
            loop {
                next_task().await;
                let Some((true, file)) = app.borrow_mut().as_mut().map(App::step_export) else {
                    break;
                };
                if let Some(file) = file {
                    shared.save_export(&file);
                }
                ctx.request_repaint();
            }
            exports.set(false);
        });
    }

    /// Draws a picture and hands it to the page, which saves it. A message says so.
    fn save_picture(&self, ctx: &egui::Context, size: [u32; 2], transparent: bool) {
        // The name is made now: the clip and the time may change until the picture is drawn.
        let name = picture_name(&self.shared.session.borrow());
        let drawn = picture::of_window(Rc::clone(&self.app), size, transparent);
        self.hand_over(ctx, name, async { drawn.await.map(Some) });
    }

    fn save_sheet(&self, ctx: &egui::Context, wanted: SheetRequest) {
        let name = sheet_name(&self.shared.session.borrow());
        let (app, repainted) = (Rc::clone(&self.app), ctx.clone());
        let drawn = picture::sheet_of_window(Rc::clone(&app), wanted, move || repainted.request_repaint());
        self.hand_over(ctx, name, async move {
            let drawn = drawn.await;
            if let Some(app) = app.borrow_mut().as_mut() {
                app.end_sheet();
            }
            drawn
        });
    }

    /// Hands a picture to the page, which saves it, once it is drawn. A message says so. `None` is one that was cancelled.
    fn hand_over(
        &self,
        ctx: &egui::Context,
        name: String,
        drawn: impl Future<Output = Result<Option<(JsValue, [u32; 2])>, JsError>> + 'static,
    ) {
        let shared = Rc::clone(&self.shared);
        let (app, saved, ctx) = (Rc::clone(&self.app), Rc::clone(&self.saved), ctx.clone());
        wasm_bindgen_futures::spawn_local(async move {
            match drawn.await {
                Ok(Some((bytes, size))) => {
                    let picture = [("name", name.as_str().into()), ("bytes", bytes)];
                    shared.emit("picture", &object(picture.clone()));
                    *saved.borrow_mut() = Some(picture);
                    if let Some(app) = app.borrow_mut().as_mut() {
                        app.picture_was_saved(&name, size);
                    }
                }
                Ok(None) => {}
                Err(error) => {
                    let message = field(&error.into(), "message");
                    shared.emit("picturefailed", &object([("message", message)]));
                }
            }
            ctx.request_repaint();
        });
    }
}

impl eframe::App for Shell {
    fn raw_input_hook(&mut self, ctx: &egui::Context, input: &mut egui::RawInput) {
        fit_canvas(&self.canvas, input);
        self.shared.mirror.begin_frame(ctx, input);
    }

    /// All that runs in a hidden tab, and before each pass elsewhere.
    fn logic(&mut self, _ctx: &egui::Context, _frame: &mut eframe::Frame) {
        if let Ok(reason) = self.loss.try_recv() {
            self.is_lost = true;
            self.shared.emit_loss(self.start, &reason);
        }
    }

    fn ui(&mut self, ui: &mut egui::Ui, _frame: &mut eframe::Frame) {
        if self.is_lost {
            return;
        }
        if ui.ctx().current_pass_index() == 0 {
            self.shared.tell_mirror(ui.ctx());
        }
        let mut requests = Vec::new();
        if let Some(app) = self.app.borrow_mut().as_mut() {
            app.set_contrast(contrast());
            requests = app.ui(ui);
            self.frames.set(app.frames_rendered());
        }
        for request in requests {
            match request {
                Request::PickFiles => self.shared.emit("pickfiles", &JsValue::UNDEFINED),
                Request::ReadAgain => self.shared.emit("readagain", &JsValue::UNDEFINED),
                Request::PickClips => self.shared.emit("pickclips", &JsValue::UNDEFINED),
                Request::SavePicture { size, transparent } => self.save_picture(ui.ctx(), size, transparent),
                Request::SaveSheet(wanted) => self.save_sheet(ui.ctx(), wanted),
                Request::SavePictureAs => self.save_picture_as(),
                Request::SaveReport => self.save_report(),
                Request::ExplainCode(code) => self.shared.emit("explain", &object([("code", code.into())])),
                Request::CloseGreeting => self.shared.emit("greetingclosed", &JsValue::UNDEFINED),
                Request::Announce(Announcement { text, assertive }) => {
                    let detail = object([("text", text.into()), ("assertive", assertive.into())]);
                    self.shared.emit("announce", &detail);
                }
            }
        }
        self.go_on_exporting(ui.ctx());
        self.shared.emit_events();
        let changed_elsewhere = self.shared.names_changed.take();
        if self
            .names
            .follow(&mut self.shared.session.borrow_mut(), changed_elsewhere)
        {
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

/// Gives the canvas as many pixels as it has on the display. A browser that emulates a device reports them without the device's scale, and
/// eframe believes that.
fn fit_canvas(canvas: &HtmlCanvasElement, input: &mut egui::RawInput) {
    let scale = web_sys::window().map_or(1.0, |window| window.device_pixel_ratio()) as f32;
    let points = egui::vec2(canvas.client_width() as f32, canvas.client_height() as f32);
    let wanted = (points * scale).round();
    let off = (wanted - egui::vec2(canvas.width() as f32, canvas.height() as f32)).abs();
    // The points are whole ones, so that the browser's pixels may be some more or less.
    if points.min_elem() > 0.0 && off.max_elem() > 2.0 * scale.max(1.0) {
        canvas.set_width(wanted.x as u32);
        canvas.set_height(wanted.y as u32);
        input.screen_rect = Some(egui::Rect::from_min_size(egui::Pos2::ZERO, points));
    }
}

/// The element that has the focus; `None` when that is nothing but the page itself.
fn focused_element() -> Option<HtmlElement> {
    let document = web_sys::window()?.document()?;
    let element = document.active_element()?.dyn_into::<HtmlElement>().ok()?;
    (document.body().as_ref() != Some(&element)).then_some(element)
}

/// Gives the focus back to another viewer or a field of the page: eframe takes it when it starts on a canvas, for the hidden input that it
/// puts behind the canvas.
fn leave_focus(canvas: &HtmlCanvasElement, element: &HtmlElement) {
    let taken_by = focused_element().map(web_sys::Element::from);
    if taken_by.is_some() && taken_by == canvas.next_element_sibling() {
        let options = web_sys::FocusOptions::new();
        options.set_prevent_scroll(true);
        let _ = element.focus_with_options(&options);
    }
}

/// Logs the errors of a device that nobody waits for, and has the next frame hear of its loss: the callback may not hold what belongs to
/// one thread.
fn watch_device(device: &egui_wgpu::wgpu::Device, ctx: &egui::Context, tell_of_loss: mpsc::Sender<String>) {
    device.on_uncaptured_error(std::sync::Arc::new(|error: egui_wgpu::wgpu::Error| {
        web_sys::console::error_1(&format!("GPU error: {error}").into());
    }));
    let ctx = ctx.clone();
    device.set_device_lost_callback(move |reason, message| {
        let by_us = reason == egui_wgpu::wgpu::DeviceLostReason::Destroyed && message.is_empty();
        if !by_us && tell_of_loss.send(message).is_ok() {
            ctx.request_repaint();
        }
    });
}

/// Frees what WebGL holds for a canvas. A browser lets few contexts live, 16 in Chromium, and loses the oldest for a further one.
fn lose_context(canvas: &HtmlCanvasElement) {
    // A canvas of WebGPU has none.
    if let Ok(Some(context)) = canvas.get_context("webgl2")
        && let Ok(Some(extension)) = context
            .unchecked_into::<WebGl2RenderingContext>()
            .get_extension("WEBGL_lose_context")
    {
        extension.unchecked_into::<WebglLoseContext>().lose_context();
    }
}

/// Tells of a lost WebGL context of a canvas, until it is dropped.
struct ContextWatch {
    canvas: HtmlCanvasElement,
    on_lost: Closure<dyn FnMut(web_sys::Event)>,
}

impl ContextWatch {
    const EVENT: &str = "webglcontextlost";

    fn new(canvas: &HtmlCanvasElement, shared: &Rc<Shared>, start: u32) -> Result<Self, JsError> {
        let shared = Rc::downgrade(shared);
        let on_lost = Closure::<dyn FnMut(web_sys::Event)>::new(move |event: web_sys::Event| {
            event.prevent_default();
            if let Some(shared) = Weak::upgrade(&shared) {
                shared.emit_loss(start, "the WebGL context was lost");
            }
        });
        canvas
            .add_event_listener_with_callback(Self::EVENT, on_lost.as_ref().unchecked_ref())
            .map_err(|error| JsError::new(&text_of(&error)))?;
        Ok(Self {
            canvas: canvas.clone(),
            on_lost,
        })
    }
}

impl Drop for ContextWatch {
    fn drop(&mut self) {
        let listener = self.on_lost.as_ref().unchecked_ref();
        let _ = self.canvas.remove_event_listener_with_callback(Self::EVENT, listener);
    }
}
