//! Order of calls in one pass of the window: time, interface, commands, picture.

mod sheet_job;

pub use sheet_job::{SheetFailure, SheetJob};

use std::cell::RefCell;
use std::rc::Rc;
use std::sync::Arc;
use std::task::{Context, Poll, Wake, Waker};

use egui_wgpu::{CallbackResources, CallbackTrait, RenderState, wgpu};

use crate::render::{
    Compositor, GpuAnswer, Picture, PictureError, Renderer, RendererOptions, SampleCount, Target, UploadError, device,
    watched,
};
use crate::scene::{FrameCost, FrameOptions};
use crate::session::{ExportedFile, Quality, Session};
use crate::ui::{self, Contrast, Request, SheetRequest, UiState};

/// Longest step of time: a window that was asleep goes on where it was.
const MAX_STEP_SECS: f32 = 0.25;

/// Between two pipelines that are built while nothing moves, so that input comes first.
const PREPARE_PAUSE_SECS: f32 = 0.05;
/// What is exported goes on for so long at a time: at least this, for input and frames of a quick machine come in between, and at most
/// this, so that a slow one still answers.
const EXPORT_SECS: [f64; 2] = [0.008, 0.25];
/// Texels along each edge of the shadow map where fingers are the pointer: a phone has less memory to write to.
const SMALL_SHADOW_MAP_SIDE: u32 = 1024;

/// What an app is told of where it runs.
#[derive(Clone, Copy, Debug)]
pub struct AppOptions {
    pub coarse_pointer: bool,
    /// Seconds since some moment.
    pub now_secs: fn() -> f64,
}

/// The viewer in a window. The session and the state of the panels belong to whoever made them, so that they outlive a lost GPU.
pub struct App {
    session: Rc<RefCell<Session>>,
    state: Rc<RefCell<UiState>>,
    painter: SessionPainter,
    picture_alone: bool,
    /// When the last part of an export ended, if there is more of it.
    exported_secs: Option<f64>,
}

impl App {
    /// Shows a session, which may have a model open already, with panels as they were before.
    pub fn new(
        ctx: &egui::Context,
        gpu: &RenderState,
        session: Rc<RefCell<Session>>,
        state: Rc<RefCell<UiState>>,
        options: AppOptions,
    ) -> Self {
        ui::install(ctx);
        state.borrow_mut().change_context(options.coarse_pointer);
        gpu.renderer
            .write()
            .callback_resources
            .insert(Compositor::new(&gpu.device, gpu.target_format));
        Self {
            session,
            state,
            painter: SessionPainter::new(ctx, gpu, options),
            picture_alone: false,
            exported_secs: None,
        }
    }

    /// One pass. Returns what only the page around can do.
    pub fn ui(&mut self, ui: &mut egui::Ui) -> Vec<Request> {
        let mut session = self.session.borrow_mut();
        let mut state = self.state.borrow_mut();
        // All passes of a frame are at one time.
        if ui.ctx().current_pass_index() == 0 {
            let dt_secs = ui.input(|input| input.unstable_dt);
            session.begin_pass(dt_secs);
            session.advance(if self.painter.was_moving {
                dt_secs.min(MAX_STEP_SECS)
            } else {
                0.0
            });
        }

        let window = ui.max_rect();
        ui.painter()
            .add(egui_wgpu::Callback::new_paint_callback(window, ShowTarget));
        let marked = session.joints().marked();
        for command in ui::show(ui, &mut session, &mut state) {
            session.apply(command);
        }
        if self.picture_alone {
            // The panels live on behind it: what is open and what has the focus stays.
            let top = ui.ctx().layer_painter(egui::LayerId::debug());
            top.add(egui_wgpu::Callback::new_paint_callback(window, ShowTarget));
        }
        if session.joints().marked() != marked {
            // A panel that moved under the pointer may have done that, and no input follows that would update the other panels.
            ui.ctx().request_repaint();
        }

        if ui.ctx().will_discard() {
            // Only the frame's last pass draws.
            return state.take_requests();
        }
        state.announce(&session);
        let requests = state.take_requests();
        session.follow_motion();
        let size = self
            .painter
            .sizes(session.quality(), window.size() * ui.pixels_per_point());
        let told = (session.model_revision(), session.error().is_some());
        let cost = self.painter.draw(&mut session, size);
        let goes_on = cost.is_some_and(|cost| session.frame_drawn(cost));

        self.painter.was_moving = session.is_moving();
        if goes_on
            || self.painter.was_moving
            || session.picture_revision() != self.painter.drawn.map_or(0, |drawn| drawn.picture)
            // The GPU refused something: the panels of this pass do not tell of it yet.
            || (session.model_revision(), session.error().is_some()) != told
        {
            ui.ctx().request_repaint();
        } else if let Some(secs) = session.quality().rests_in_secs() {
            ui.ctx().request_repaint_after_secs(secs);
        } else {
            let lowered = session.quality().lowered();
            let is_plain = lowered.is_some_and(|lowered| lowered.without_smooth_edges);
            let samples = &[SampleCount::One, self.painter.samples][usize::from(!is_plain)..];
            let is_idle = cost.is_none() && ui.input(|input| input.events.is_empty());
            let renderer = &mut self.painter.renderer;
            if !renderer.is_prepared(samples) && (!is_idle || renderer.prepare_next(samples)) {
                ui.ctx().request_repaint_after_secs(PREPARE_PAUSE_SECS);
            }
        }
        requests
    }

    /// Goes on with what is exported, for as long as all else took since the last time, however many frames that were. Returns whether
    /// there was something to do, and the file once it is written.
    pub fn step_export(&mut self) -> (bool, Option<ExportedFile>) {
        let now_secs = self.painter.now_secs;
        let begun_secs = now_secs();
        let [least, most] = EXPORT_SECS;
        let lasts_secs = self
            .exported_secs
            .map_or(least, |ended| (begun_secs - ended).clamp(least, most));
        let mut session = self.session.borrow_mut();
        let mut had_work = false;
        while session.step_export() {
            had_work = true;
            if now_secs() - begun_secs > lasts_secs {
                break;
            }
        }
        self.exported_secs = had_work.then(now_secs);
        let file = session.take_exported();
        if let Some(file) = &file {
            self.state.borrow_mut().messages.say_exported(file);
        }
        (had_work, file)
    }

    /// Draws the interface with the contrast that the person asks for, from the next pass on.
    pub fn set_contrast(&mut self, contrast: Contrast) {
        self.state.borrow_mut().contrast = contrast;
    }

    /// Whether the picture covers the panels, from the next pass on.
    pub fn set_picture_alone(&mut self, alone: bool) {
        self.picture_alone = alone;
    }

    /// Follows [`Session::start_over`]: every panel is as at first, and the GPU gets anew what it draws.
    pub fn start_over(&mut self, ctx: &egui::Context) {
        self.state.borrow_mut().start_over();
        self.painter.forget();
        ctx.memory_mut(|memory| {
            let options = std::mem::take(&mut memory.options);
            *memory = egui::Memory::default();
            memory.options = options;
        });
        ctx.set_theme(egui::ThemePreference::System);
    }

    /// Says that a picture of this size was saved under this name.
    pub fn picture_was_saved(&mut self, name: &str, size: [u32; 2]) {
        self.state.borrow_mut().messages.say_saved(name, size);
    }

    /// Says that a report was saved under this name.
    pub fn report_was_saved(&mut self, name: &str) {
        self.state.borrow_mut().messages.say(format!("Saved {name}"));
    }

    /// How many pictures of the model were drawn: stands still while nothing changes.
    pub fn frames_rendered(&self) -> u64 {
        self.painter.frames_rendered
    }

    /// The longest side of a picture that this device can draw, in pixels.
    pub fn longest_picture_side(&self) -> u32 {
        let of_device = self.painter.gpu.device.limits().max_texture_dimension_2d;
        of_device.min(ui::MAX_PICTURE_SIDE)
    }

    /// Draws the session's view into a target of its own, for a picture of any size. A picture may take its time: passes that
    /// the window leaves out for speed are drawn. `adjust` may change how it looks.
    ///
    /// # Errors
    /// When the device draws no picture of this size; whether it could draw this one comes with its pixels.
    pub fn draw_snapshot(
        &mut self,
        size: [u32; 2],
        adjust: impl FnOnce(&mut FrameOptions),
    ) -> Result<Picture, PictureError> {
        let mut session = self.session.borrow_mut();
        self.painter.draw_snapshot(&mut session, size, adjust)
    }

    /// Begins a contact sheet of what the session shows.
    ///
    /// # Errors
    /// When there is no room for so many pictures.
    pub fn begin_sheet(&self, wanted: &SheetRequest) -> Result<SheetJob, SheetFailure> {
        SheetJob::new(&self.session.borrow(), wanted)
    }

    /// Draws the next picture of a contact sheet. What its session shows must be what the window's shows, but for the view.
    ///
    /// # Errors
    /// When another model or other maps are open now, or the device draws no picture of this size.
    pub fn draw_next(&mut self, job: &mut SheetJob) -> Result<Picture, SheetFailure> {
        self.painter.update(&mut self.session.borrow_mut());
        if self.painter.is_behind(job.session()) {
            return Err(SheetFailure::Changed);
        }
        let (frame, target) = job.next();
        Ok(self.painter.renderer.picture_into(&frame, target)?)
    }

    /// Shows how far the contact sheet is that a person asked for, as [`SheetJob::progress`] says. False when it was cancelled.
    pub fn show_sheet_progress(&mut self, progress: [usize; 2]) -> bool {
        self.state.borrow_mut().show_sheet_progress(progress)
    }

    /// The contact sheet has come to its end, or never will.
    pub fn end_sheet(&mut self) {
        self.state.borrow_mut().end_sheet();
    }
}

#[derive(Clone, Copy, PartialEq, Eq)]
struct Drawn {
    picture: u64,
    size: [u32; 2],
}

/// Sizes of the picture in the window, pixels.
#[derive(Clone, Copy)]
struct Sizes {
    now: [u32; 2],
    at_rest: [u32; 2],
}

/// Draws the session: the renderer, the window's target, and the revisions of what was uploaded and drawn.
struct SessionPainter {
    gpu: RenderState,
    samples: SampleCount,
    now_secs: fn() -> f64,
    renderer: Renderer,
    target: Target,
    /// With one sample a pixel, for pictures without smooth edges.
    plain_target: Target,
    model: Option<u64>,
    maps: Option<u64>,
    materials: Option<u64>,
    sky: Option<u64>,
    drawn: Option<Drawn>,
    frames_rendered: u64,
    was_moving: bool,
    /// Uploads that the GPU has not confirmed yet.
    answers: Vec<GpuAnswer>,
    /// A resized target that the GPU has not confirmed yet.
    target_answer: Option<GpuAnswer>,
    /// Asks for another pass of the window when an answer arrives.
    waker: Waker,
}

/// Asks for another pass of the window.
struct Repaint(egui::Context);

impl Wake for Repaint {
    fn wake(self: Arc<Self>) {
        self.0.request_repaint();
    }
}

impl SessionPainter {
    fn new(ctx: &egui::Context, gpu: &RenderState, options: AppOptions) -> Self {
        let samples = device::sample_count(&gpu.adapter);
        let mut of_renderer = RendererOptions {
            samples,
            ..RendererOptions::default()
        };
        if options.coarse_pointer {
            of_renderer.shadow_map_side = SMALL_SHADOW_MAP_SIDE;
        }
        Self {
            renderer: Renderer::new(&gpu.device, &gpu.queue, of_renderer),
            target: Target::with_samples(&gpu.device, 1, 1, samples),
            plain_target: Target::with_samples(&gpu.device, 1, 1, SampleCount::One),
            gpu: gpu.clone(),
            samples,
            now_secs: options.now_secs,
            model: None,
            maps: None,
            materials: None,
            sky: None,
            drawn: None,
            frames_rendered: 0,
            was_moving: false,
            answers: Vec::new(),
            target_answer: None,
            waker: Waker::from(Arc::new(Repaint(ctx.clone()))),
        }
    }

    /// How large the picture is to be now, and at rest, in a window of this size in pixels.
    fn sizes(&self, quality: &Quality, window: egui::Vec2) -> Sizes {
        let affordable = Target::affordable_scale([window.x as u32, window.y as u32], self.samples);
        let scaled = |scale: f32| [window.x, window.y].map(|side| (side * scale * affordable).round().max(1.0) as u32);
        Sizes {
            now: scaled(quality.scale_now()),
            at_rest: scaled(quality.render_scale().fraction()),
        }
    }

    /// Draws if the picture would differ from the last one. Returns what that cost, if it drew.
    fn draw(&mut self, session: &mut Session, sizes: Sizes) -> Option<FrameCost> {
        self.update(session);
        let wanted = Drawn {
            picture: session.picture_revision(),
            size: sizes.now,
        };
        self.poll_target(session);
        if self.drawn == Some(wanted) {
            return None;
        }
        let (target, largest) = if session.quality().smooths_edges_now() {
            (&mut self.target, sizes.at_rest)
        } else {
            (&mut self.plain_target, sizes.now)
        };
        let start_secs = (self.now_secs)();
        let mut cost;
        if target.size() == sizes.now {
            cost = self.renderer.render(&session.frame(), target);
        } else {
            let device = self.gpu.device.clone();
            let stayed;
            let answer;
            ((stayed, cost), answer) = watched(&device, || {
                let stayed = target.resize(&device, sizes.now, largest);
                (stayed, self.renderer.render(&session.frame(), target))
            });
            // Maps of the light go with the picture's size, but they are small.
            if !stayed {
                self.target_answer = Some(answer);
            }
        }
        cost.cpu_secs = Some(((self.now_secs)() - start_secs) as f32);
        if let Some(compositor) = self.gpu.renderer.write().callback_resources.get_mut::<Compositor>() {
            compositor.prepare(&self.gpu.device, &self.gpu.queue, target);
        }
        self.poll_target(session);
        self.drawn = Some(wanted);
        self.frames_rendered += 1;
        Some(cost)
    }

    /// Shows the GPU's error about a resized target in the session, if there is one.
    fn poll_target(&mut self, session: &mut Session) {
        let Some(mut answer) = self.target_answer.take() else {
            return;
        };
        match answer.as_mut().poll(&mut Context::from_waker(&self.waker)) {
            Poll::Ready(Ok(())) => {}
            Poll::Ready(Err(error)) => session.note_undrawn(&error.to_string()),
            Poll::Pending => self.target_answer = Some(answer),
        }
    }

    fn draw_snapshot(
        &mut self,
        session: &mut Session,
        size: [u32; 2],
        adjust: impl FnOnce(&mut FrameOptions),
    ) -> Result<Picture, PictureError> {
        self.update(session);
        let mut frame = session.frame_at_rest();
        adjust(&mut frame.options);
        self.renderer.picture(&frame, size)
    }

    /// Uploads what changed in the session. When that fails, the session goes back to what was open before, and that is uploaded.
    fn update(&mut self, session: &mut Session) {
        // The GPU may refuse what it accepted before. Then the session opens nothing, which always works.
        for _ in 0..3 {
            match self.try_update(session) {
                Err(reason) => {
                    session.go_back(&reason);
                    self.forget();
                }
                Ok(()) => return,
            }
        }
    }

    /// Uploads what changed in the session, and polls the GPU's answers to all uploads. An error is the reason why one failed.
    fn try_update(&mut self, session: &mut Session) -> Result<(), String> {
        let device = self.gpu.device.clone();
        if self.is_behind(session) {
            let (uploaded, answer) = watched(&device, || self.upload(session));
            self.answers.push(answer);
            uploaded.map_err(|error| error.to_string())?;
        }
        if self.answers.is_empty() {
            return Ok(());
        }
        let mut context = Context::from_waker(&self.waker);
        let mut waiting = Vec::new();
        for mut answer in self.answers.drain(..) {
            match answer.as_mut().poll(&mut context) {
                Poll::Ready(Ok(())) => {}
                Poll::Ready(Err(error)) => return Err(error.to_string()),
                Poll::Pending => waiting.push(answer),
            }
        }
        self.answers = waiting;
        if self.answers.is_empty() {
            session.confirm_uploads();
        }
        Ok(())
    }

    /// Forgets all that was uploaded.
    fn forget(&mut self) {
        self.renderer.clear_model();
        self.answers.clear();
        (self.model, self.maps, self.materials, self.sky, self.drawn) = (None, None, None, None, None);
    }

    fn is_behind(&self, session: &Session) -> bool {
        let of_model = [
            (self.model, session.model_revision()),
            (self.maps, session.maps_revision()),
            (self.materials, session.materials_revision()),
        ];
        let lacks_model = session.open_model().is_some() && of_model.iter().any(|&(held, wanted)| held != Some(wanted));
        lacks_model || self.sky != Some(session.sky_revision())
    }

    fn upload(&mut self, session: &Session) -> Result<(), UploadError> {
        self.drawn = None;
        let sky = session.sky_revision();
        if self.sky != Some(sky) {
            self.renderer.set_sky(session.sky().map(|image| &**image));
            self.sky = Some(sky);
        }
        let Some(open) = session.open_model() else {
            return Ok(());
        };
        let (model, maps) = (session.model_revision(), session.maps_revision());
        if self.model != Some(model) {
            self.renderer.set_model(&open.model)?;
            self.model = Some(model);
            self.maps = None;
            self.materials = None;
        }
        if self.maps != Some(maps) {
            self.renderer.set_maps(&session.maps().images().collect::<Vec<_>>());
            self.maps = Some(maps);
        }
        let materials = session.materials_revision();
        if self.materials != Some(materials) {
            self.renderer.set_materials(session.materials());
            self.materials = Some(materials);
        }
        Ok(())
    }
}

struct ShowTarget;

impl CallbackTrait for ShowTarget {
    fn paint(
        &self,
        _info: egui::PaintCallbackInfo,
        render_pass: &mut wgpu::RenderPass<'static>,
        resources: &CallbackResources,
    ) {
        if let Some(compositor) = resources.get::<Compositor>() {
            compositor.paint(render_pass);
        }
    }
}
