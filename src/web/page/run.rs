//! A viewer on a canvas: what eframe is told, its frames, and what the page hears of them.

use std::cell::{Cell, RefCell};
use std::rc::{Rc, Weak};
use std::sync::{Arc, mpsc};

use egui_wgpu::{WgpuConfiguration, WgpuSetup, WgpuSetupCreateNew, WgpuSetupExisting};
use wasm_bindgen::prelude::*;
use web_sys::HtmlCanvasElement;

use super::canvas::{fit_canvas, focused_element, leave_focus};
use super::contrast::{ContrastWatch, contrast};
use super::frames::Frames;
use super::joint_names::JointNames;
use super::saving::Saving;
use crate::app::{self, App, AppOptions};
use crate::render::device;
use crate::ui::{Announcement, Request};
use crate::web::backend::Chosen;
use crate::web::canvas::watch_device;
use crate::web::picture::{AppSlot, Drawn};
use crate::web::shared::{Shared, Started};
use crate::web::{coarse_pointer, next_task, now_secs, object, sleep, text_of};

/// Starts on a canvas. `start` is the number of the start.
pub(in crate::web) async fn run(
    canvas: HtmlCanvasElement,
    chosen: Chosen,
    shared: &Rc<Shared>,
    start: u32,
) -> Result<Started, String> {
    let web_options = eframe::WebOptions {
        renderer: eframe::Renderer::Wgpu,
        wgpu_options: configuration(chosen),
        // The page's own listeners take drops; keys of the browser stay with the browser.
        should_stop_propagation: Box::new(|_| false),
        should_prevent_default: Box::new(owns_event),
        ..Default::default()
    };
    // In an element of somebody's page, not a part of the page.
    let is_guest = !canvas.get_root_node().is_instance_of::<web_sys::Document>();
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
        goes_on: Rc::default(),
        drawn: Rc::clone(&drawn),
        names: (!is_guest).then(JointNames::default),
        saving: Saving::new(Rc::clone(&app), Rc::clone(shared)),
    };
    let made = Rc::new(RefCell::new(None));
    let made_out = Rc::clone(&made);
    let runner = eframe::WebRunner::new();
    let had_focus = focused_element();
    // What is inert cannot take the focus, even for a moment.
    let around = canvas.parent_element().filter(|_| is_guest);
    if let Some(around) = &around {
        let _ = around.set_attribute("inert", "");
    }
    let started = runner
        .start(
            canvas.clone(),
            web_options,
            Box::new(move |creation| {
                let gpu = creation.wgpu_render_state.clone().ok_or("the viewer needs wgpu")?;
                watch_device(&gpu.device, app::waker(&creation.egui_ctx), tell_of_loss);
                let face = &shell.shared.face;
                face.mirror.begin();
                let (session, state) = (Rc::clone(&shell.shared.session), Rc::clone(&face.ui));
                let options = AppOptions {
                    coarse_pointer: coarse_pointer(),
                    now_secs,
                };
                let app = App::new(&creation.egui_ctx, &gpu, session, state, options);
                shell.app.replace(Some(app));
                *made_out.borrow_mut() = Some((creation.egui_ctx.clone(), gpu.adapter, gpu.device, gpu.queue));
                Ok(Box::new(shell))
            }),
        )
        .await;
    if let Some(around) = around {
        let _ = around.remove_attribute("inert");
    } else if let Some(element) = had_focus {
        leave_focus(&canvas, &element);
    }
    if let Err(error) = started {
        runner.destroy();
        return Err(text_of(&error));
    }
    let (ctx, adapter, device, queue) = made.take().ok_or("the viewer did not start")?;
    let contrast_watch = ContrastWatch::new(&ctx);
    take_prints(&runner, &canvas, &app)?;
    Ok(Started {
        app,
        frames: Frames {
            ctx,
            runner,
            _contrast_watch: contrast_watch,
        },
        adapter,
        device,
        queue,
        drawn,
    })
}

/// What eframe is told of the GPU: it takes a device that is open, or makes one together with the canvas's context.
fn configuration(chosen: Chosen) -> WgpuConfiguration {
    let wgpu_setup = match chosen {
        Chosen::WebGpu(gpu) => WgpuSetup::Existing(WgpuSetupExisting {
            instance: gpu.instance,
            adapter: gpu.adapter,
            device: gpu.device,
            queue: gpu.queue,
        }),
        Chosen::WebGl2 => {
            let mut setup = WgpuSetupCreateNew::without_display_handle();
            setup.instance_descriptor.backends = wgpu::Backends::GL;
            setup.device_descriptor = Arc::new(device::descriptor);
            WgpuSetup::CreateNew(setup)
        }
    };
    WgpuConfiguration {
        wgpu_setup,
        ..Default::default()
    }
}

/// At a `beforeprint` event of the canvas the picture is drawn on it without the panels, at once: a print waits for no frame.
fn take_prints(runner: &eframe::WebRunner, canvas: &HtmlCanvasElement, app: &AppSlot) -> Result<(), String> {
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
    listening.map_err(|error| text_of(&error))
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
    /// Whether a task goes on between passes.
    goes_on: Rc<Cell<bool>>,
    drawn: Rc<Cell<Drawn>>,
    /// A guest keeps none in the browser.
    names: Option<JointNames>,
    saving: Saving,
}

impl Shell {
    /// A task goes on between passes, as long as the app is there and has something to do. Out of sight, where no pass comes, it exports.
    fn go_on_between_passes(&self) {
        if of_app(&Rc::downgrade(&self.app), |app| app.next_turn_in_secs()).is_none() || self.goes_on.replace(true) {
            return;
        }
        let (app, shared) = (Rc::downgrade(&self.app), Rc::clone(&self.shared));
        let goes_on = Rc::clone(&self.goes_on);
        wasm_bindgen_futures::spawn_local(async move {
            while let Some(secs) = of_app(&app, |app| app.next_turn_in_secs()) {
                if secs == 0.0 {
                    next_task().await;
                } else if shared.face.is_out_of_sight.get() {
                    // The pass that comes when it is in sight again begins anew.
                    break;
                } else {
                    sleep((secs * 1e3) as i32).await;
                    if shared.face.is_out_of_sight.get() {
                        continue;
                    }
                }
                if let Some(file) = of_app(&app, App::take_turn) {
                    shared.save_export(&file);
                }
            }
            goes_on.set(false);
        });
    }
}

fn of_app<T>(app: &Weak<RefCell<Option<App>>>, act: impl FnOnce(&mut App) -> Option<T>) -> Option<T> {
    act(app.upgrade()?.borrow_mut().as_mut()?)
}

impl eframe::App for Shell {
    fn raw_input_hook(&mut self, ctx: &egui::Context, input: &mut egui::RawInput) {
        fit_canvas(&self.canvas, input);
        // As in a hidden tab: no pass runs.
        let root = input.viewports.entry(egui::ViewportId::ROOT).or_default();
        root.occluded = root
            .occluded
            .map(|hidden| hidden || self.shared.face.is_out_of_sight.get());
        self.shared.face.mirror.begin_frame(ctx, input);
    }

    /// All that runs in a hidden tab, and before each pass elsewhere.
    fn logic(&mut self, _ctx: &egui::Context, _frame: &mut eframe::Frame) {
        if let Ok(reason) = self.loss.try_recv() {
            self.is_lost = true;
            if let Some(app) = self.app.borrow_mut().as_mut() {
                app.stop_preparing();
            }
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
            self.shared.note_drawn(&self.drawn, Drawn::by(app));
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
        let is_held = ui.input(|input| input.pointer.any_down());
        self.shared.follow_frame(is_held);
        self.go_on_between_passes();
        let changed_elsewhere = self.shared.face.names_changed.take();
        let session = &mut *self.shared.session.borrow_mut();
        let names = self.names.as_mut();
        if names.is_some_and(|names| names.follow(session, changed_elsewhere)) {
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
