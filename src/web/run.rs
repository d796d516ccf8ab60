//! A viewer on a canvas: starting, frames, the loss of the GPU, and giving the canvas back.

use std::cell::{Cell, RefCell};
use std::rc::Rc;
use std::sync::mpsc;

use wasm_bindgen::prelude::*;
use web_sys::HtmlCanvasElement;

use super::backend::{self, Chosen, Preference};
use super::canvas::{ContextWatch, fit_canvas, focused_element, leave_focus, lose_context, watch_device};
use super::contrast::{ContrastWatch, contrast};
use super::joint_names::JointNames;
use super::picture::AppSlot;
use super::saving::Saving;
use super::shared::{Running, Shared};
use super::state::Drawn;
use super::{coarse_pointer, next_task, now_secs, object, sleep, text_of};
use crate::app::{App, AppOptions};
use crate::render::device;
use crate::session::QualityCommand;
use crate::ui::{Announcement, Request};

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
    running.ctx.request_repaint();
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

/// Whether the page is in a tab that is not shown.
fn is_hidden() -> bool {
    let document = web_sys::window().and_then(|window| window.document());
    document.is_some_and(|document| document.hidden())
}

async fn run(canvas: HtmlCanvasElement, chosen: Chosen, shared: &Rc<Shared>, start: u32) -> Result<Running, JsError> {
    let backend = chosen.name();
    let told = Rc::downgrade(shared);
    let context_watch = ContextWatch::new(&canvas, move || {
        if let Some(shared) = told.upgrade() {
            shared.emit_loss(start, "the WebGL context was lost");
        }
    })?;
    let web_options = eframe::WebOptions {
        renderer: eframe::Renderer::Wgpu,
        wgpu_options: chosen.into_configuration(),
        // The page's own listeners take drops; keys of the browser stay with the browser.
        should_stop_propagation: Box::new(|_| false),
        should_prevent_default: Box::new(owns_event),
        ..Default::default()
    };
    let app = Rc::new(RefCell::new(None));
    let drawn = Rc::new(Cell::new(Drawn::NOTHING));
    let (tell_of_loss, loss) = mpsc::channel();
    let shell = Shell {
        canvas: canvas.clone(),
        app: Rc::clone(&app),
        shared: Rc::clone(shared),
        start,
        loss,
        is_lost: false,
        exports: Rc::default(),
        drawn: Rc::clone(&drawn),
        names: JointNames::default(),
        is_busy: Cell::default(),
        saving: Saving::new(Rc::clone(&app), Rc::clone(shared)),
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
        drawn,
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
    drawn: Rc<Cell<Drawn>>,
    names: JointNames,
    saving: Saving,
    /// Whether what is seen changed by itself, or something was held, in the frame before.
    is_busy: Cell<bool>,
}

impl Shell {
    /// Tells the page after each frame that may have changed what is seen, and once when that goes on by itself or something is held: a
    /// link to it waits until it rests.
    fn tell_settling(&self, ctx: &egui::Context) {
        let is_busy = self.shared.session.borrow().is_moving() || ctx.input(|input| input.pointer.any_down());
        let was_busy = self.is_busy.replace(is_busy);
        // Frames that make the picture of a view at rest finer change nothing.
        if !is_busy && self.drawn.get().samples <= 1 {
            self.shared.emit("settling", &JsValue::UNDEFINED);
        } else if is_busy && !was_busy {
            self.shared.emit("moving", &JsValue::UNDEFINED);
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
            let drawn = Drawn {
                frames: app.frames_rendered(),
                samples: app.samples(),
                refined: app.is_refined(),
            };
            if self.drawn.replace(drawn).frames != drawn.frames {
                self.shared.timings.note_drawn();
            }
        }
        for request in requests {
            match request {
                Request::PickFiles => self.shared.emit("pickfiles", &JsValue::UNDEFINED),
                Request::ReadAgain => self.shared.emit("readagain", &JsValue::UNDEFINED),
                Request::PickClips => self.shared.emit("pickclips", &JsValue::UNDEFINED),
                Request::SavePicture {
                    size,
                    transparent,
                    aperture,
                } => {
                    self.saving.save_picture(ui.ctx(), size, transparent, aperture);
                }
                Request::SaveContactSheet(wanted) => self.saving.save_contact_sheet(ui.ctx(), wanted),
                Request::SavePictureAs => self.saving.save_picture_as(),
                Request::SaveReport => self.saving.save_report(),
                Request::ExplainCode(code) => self.shared.emit("explain", &object([("code", code.into())])),
                Request::CopyLink { embed } => self.shared.emit("copylink", &object([("embed", embed.into())])),
                Request::CloseGreeting => self.shared.emit("greetingclosed", &JsValue::UNDEFINED),
                Request::Announce(Announcement { text, assertive }) => {
                    let detail = object([("text", text.into()), ("assertive", assertive.into())]);
                    self.shared.emit("announce", &detail);
                }
            }
        }
        self.tell_settling(ui.ctx());
        self.go_on_exporting(ui.ctx());
        self.shared.go_on_opening();
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
