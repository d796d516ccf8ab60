//! Order of calls in one pass of the window: time, interface, commands, picture.

mod contact_sheet_job;

pub use contact_sheet_job::{ContactSheetFailure, ContactSheetJob};

use std::cell::RefCell;
use std::rc::Rc;
use std::sync::Arc;
use std::task::{Wake, Waker};

use egui_wgpu::{CallbackResources, CallbackTrait, RenderState, wgpu};

use crate::painter::{NextPass, PainterOptions, SessionPainter};
use crate::render::{Compositor, Picture, PictureError};
use crate::scene::FrameOptions;
use crate::session::{ExportedFile, Session};
use crate::ui::{self, ContactSheetRequest, Contrast, Request, UiState};

/// What is exported goes on for so long at a time: at least this, for input and frames of a quick machine come in between, and at most
/// this, so that a slow one still answers.
const EXPORT_SECS: [f64; 2] = [0.008, 0.25];

/// What an app is seen_by_panels of where it runs.
#[derive(Clone, Copy, Debug)]
pub struct AppOptions {
    pub coarse_pointer: bool,
    /// Seconds since some moment.
    pub now_secs: fn() -> f64,
}

/// The viewer in a window. The session and the state of the panels belong to whoever made them, so that they outlive a lost GPU.
pub struct App {
    ctx: egui::Context,
    session: Rc<RefCell<Session>>,
    state: Rc<RefCell<UiState>>,
    painter: SessionPainter,
    /// Has the compositor among what its callbacks use.
    gpu: RenderState,
    now_secs: fn() -> f64,
    picture_alone: bool,
    /// When the last part of an export ended, if there is more of it.
    exported_secs: Option<f64>,
    /// Whether nothing was left to be exported at the last turn: the next pass brings what is.
    export_rests: bool,
    /// After the last pass or turn; none where there is nothing to prepare, or a pass has to come first.
    prepare_in_secs: Option<f32>,
    /// Whether a pass came since the last turn.
    passed: bool,
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
        let of_painter = PainterOptions::new(&gpu.adapter, options.coarse_pointer, options.now_secs);
        Self {
            ctx: ctx.clone(),
            session,
            state,
            painter: SessionPainter::new(&gpu.device, &gpu.queue, of_painter, waker(ctx)),
            gpu: gpu.clone(),
            now_secs: options.now_secs,
            picture_alone: false,
            exported_secs: None,
            export_rests: false,
            prepare_in_secs: None,
            passed: false,
        }
    }

    /// One pass. Returns what only the page around can do.
    pub fn ui(&mut self, ui: &mut egui::Ui) -> Vec<Request> {
        let mut session = self.session.borrow_mut();
        let mut state = self.state.borrow_mut();
        // All passes of a frame are at one time.
        if ui.ctx().current_pass_index() == 0 {
            let dt_secs = ui.input(|input| input.unstable_dt);
            self.painter.begin_pass(&mut session, dt_secs);
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
            // The panels were shown before these commands: those about a new selection show in the next pass. It may also have been a
            // panel that moved under the pointer, which no input follows.
            ui.ctx().request_repaint();
        }

        if ui.ctx().will_discard() {
            // Only the frame's last pass draws.
            return state.take_requests();
        }
        state.announce(&session);
        let requests = state.take_requests();
        let size = window.size() * ui.pixels_per_point();
        self.painter.set_pixels_per_point(ui.pixels_per_point());
        let seen_by_panels = (session.model_revision(), session.error().is_some());
        let had_input = ui.input(|input| !input.events.is_empty());
        let pass = {
            let mut renderer = self.gpu.renderer.write();
            let compositor = renderer.callback_resources.get_mut::<Compositor>();
            compositor.map(|shown| self.painter.end_pass(&mut session, size.into(), shown, had_input))
        };
        // The GPU refused something: the panels of this pass do not tell of it yet.
        let refused = (session.model_revision(), session.error().is_some()) != seen_by_panels;
        match pass.map(|pass| pass.next) {
            _ if refused => ui.ctx().request_repaint(),
            Some(NextPass::AtOnce) => ui.ctx().request_repaint(),
            Some(NextPass::After { secs }) => ui.ctx().request_repaint_after_secs(secs),
            Some(NextPass::ToPrepare { .. } | NextPass::WhenAsked) | None => {}
        }
        self.prepare_in_secs = match pass.map(|pass| pass.next) {
            Some(NextPass::ToPrepare { secs }) => Some(secs),
            _ => None,
        };
        (self.passed, self.export_rests) = (true, false);
        requests
    }

    /// In how many seconds [`Self::take_turn`] can go on between passes: with what is exported at once, with what may be asked for next when
    /// nothing moves. None where a pass has to come first, or there is nothing to do.
    pub fn next_turn_in_secs(&self) -> Option<f32> {
        if self.is_exporting() {
            Some(0.0)
        } else {
            self.prepare_in_secs
        }
    }

    fn is_exporting(&self) -> bool {
        !self.export_rests && self.session.borrow().export().is_some()
    }

    /// A turn of what goes on between passes: tasks export while frames take long and where none comes, and prepare without the panels, which a
    /// pass would draw. Returns a file that is written.
    pub fn take_turn(&mut self) -> Option<ExportedFile> {
        if !self.is_exporting() {
            self.prepare();
            return None;
        }
        let (had_work, file) = self.step_export();
        self.export_rests = !had_work;
        if had_work {
            self.ctx.request_repaint();
        }
        file
    }

    /// Prepares something of what may be asked for next. The turn after a pass does nothing, since passes come first. While something opens or
    /// is to be drawn there is no other turn before the next pass. Where the picture is another one for what is prepared, a pass is asked for.
    fn prepare(&mut self) {
        if std::mem::take(&mut self.passed) {
            return;
        }
        let session = self.session.borrow();
        let waits = session.is_opening() || !self.painter.is_current(&session);
        if waits || !self.painter.prepares(&session, true) {
            self.prepare_in_secs = None;
        }
        if !waits && !self.painter.is_current(&session) {
            self.ctx.request_repaint();
        }
    }

    /// The device is lost: there is nothing to prepare on it.
    pub fn stop_preparing(&mut self) {
        self.prepare_in_secs = None;
    }

    /// Goes on with what is exported, for as long as all else took since the last time, however many frames that were. Returns whether
    /// there was something to do, and the file once it is written.
    pub fn step_export(&mut self) -> (bool, Option<ExportedFile>) {
        let now_secs = self.now_secs;
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
    pub fn start_over(&mut self) {
        self.state.borrow_mut().start_over();
        self.painter.forget();
        self.ctx.memory_mut(|memory| {
            let options = std::mem::take(&mut memory.options);
            *memory = egui::Memory::default();
            memory.options = options;
        });
        self.ctx.set_theme(egui::ThemePreference::System);
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
        self.painter.frames_rendered()
    }

    /// How many pictures the one in the window is the mean of.
    pub fn samples(&self) -> u32 {
        self.painter.samples()
    }

    /// Whether what lights the model is as fine as it will be.
    pub fn is_refined(&self) -> bool {
        self.painter.is_refined(&self.session.borrow())
    }

    /// The longest side of a picture that this device can draw, in pixels.
    pub fn longest_picture_side(&self) -> u32 {
        self.painter.longest_side().min(ui::MAX_PICTURE_SIDE)
    }

    /// Draws the session's view into a target of its own, for a picture of any size. A picture may take its time: passes that
    /// the window leaves out for speed are drawn. It is the mean of so many `samples`, or of as many as the session says. `adjust` may change
    /// how it looks.
    ///
    /// # Errors
    /// When the device draws no picture of this size; whether it could draw this one comes with its pixels.
    pub fn draw_snapshot(
        &mut self,
        size: [u32; 2],
        samples: Option<u32>,
        adjust: impl FnOnce(&mut FrameOptions),
    ) -> Result<Picture, PictureError> {
        let mut session = self.session.borrow_mut();
        self.painter.draw_snapshot(&mut session, size, samples, adjust)
    }

    /// Begins a contact sheet of what the session shows.
    ///
    /// # Errors
    /// When there is no room for so many pictures.
    pub fn begin_contact_sheet(&self, wanted: &ContactSheetRequest) -> Result<ContactSheetJob, ContactSheetFailure> {
        let session = self.session.borrow();
        ContactSheetJob::new(&session, wanted, self.painter.samples_of_pictures(&session))
    }

    /// Draws the next picture of a contact sheet. What its session shows must be what the window's shows, but for the view.
    ///
    /// # Errors
    /// When another model or other maps are open now, or the device draws no picture of this size.
    pub fn draw_next(&mut self, job: &mut ContactSheetJob) -> Result<Picture, ContactSheetFailure> {
        let mut session = self.session.borrow_mut();
        if !self.painter.has_uploaded(&mut session, job.session()) {
            return Err(ContactSheetFailure::Changed);
        }
        let (frame, target) = job.next();
        Ok(self.painter.picture_into(&frame, target)?)
    }

    /// Shows how far the contact sheet is that a person asked for, as [`ContactSheetJob::progress`] says. False when it was cancelled.
    pub fn show_sheet_progress(&mut self, progress: [usize; 2]) -> bool {
        self.state.borrow_mut().show_sheet_progress(progress)
    }

    /// The contact sheet has come to its end, or never will.
    pub fn end_contact_sheet(&mut self) {
        self.state.borrow_mut().end_contact_sheet();
    }
}

/// Asks for another pass of the window when it is woken.
pub fn waker(ctx: &egui::Context) -> Waker {
    Waker::from(Arc::new(Repaint(ctx.clone())))
}

struct Repaint(egui::Context);

impl Wake for Repaint {
    fn wake(self: Arc<Self>) {
        self.0.request_repaint();
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
