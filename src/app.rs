//! Order of calls in one pass of the window: time, interface, commands, picture.

use std::cell::RefCell;
use std::rc::Rc;

use egui_wgpu::{CallbackResources, CallbackTrait, RenderState, wgpu};

use crate::render::{Compositor, MaterialImages, Renderer, SampleCount, Target, device};
use crate::scene::{FrameOptions, Theme};
use crate::session::Session;
use crate::ui::{self, Request, UiState};

/// Longest step of time: a window that was asleep goes on where it was.
const MAX_STEP_SECS: f32 = 0.25;

/// The viewer in a window. The session belongs to whoever made it, so that it outlives a lost GPU.
pub struct App {
    session: Rc<RefCell<Session>>,
    state: UiState,
    stage: Stage,
}

impl App {
    /// Takes up a session, which may have a model open already. `coarse_pointer`: fingers are the device's pointer.
    pub fn new(ctx: &egui::Context, gpu: &RenderState, session: Rc<RefCell<Session>>, coarse_pointer: bool) -> Self {
        ui::install(ctx);
        gpu.renderer
            .write()
            .callback_resources
            .insert(Compositor::new(&gpu.device, gpu.target_format));
        Self {
            session,
            state: UiState::new(coarse_pointer),
            stage: Stage::new(gpu),
        }
    }

    /// One pass. Returns what only the page around can do.
    pub fn ui(&mut self, ui: &mut egui::Ui) -> Vec<Request> {
        let mut session = self.session.borrow_mut();
        // All passes of a frame are at one time.
        let begins_frame = ui.ctx().current_pass_index() == 0;
        if begins_frame && self.stage.was_moving {
            let dt_secs = ui.input(|input| input.unstable_dt);
            session.note_frame(dt_secs);
            session.advance(dt_secs.min(MAX_STEP_SECS));
        } else {
            session.advance(0.0);
        }

        let window = ui.max_rect();
        ui.painter()
            .add(egui_wgpu::Callback::new_paint_callback(window, ShowTarget));
        let marked = session.joints().marked();
        for command in ui::show(ui, &mut session, &mut self.state) {
            session.apply(command);
        }
        if session.joints().marked() != marked {
            // A panel that moved under the pointer may have done that: no input follows by which the others would be told.
            ui.ctx().request_repaint();
        }

        let requests = self.state.take_requests();
        for request in &requests {
            if let Request::UseTheme(theme) = request {
                ui.ctx().set_theme(match theme {
                    Theme::Dark => egui::ThemePreference::Dark,
                    Theme::Light => egui::ThemePreference::Light,
                });
            }
        }

        if ui.ctx().will_discard() {
            // The frame's last pass draws.
            return requests;
        }
        let points_to_pixels = ui.pixels_per_point();
        let pixels = |points: f32| (points * points_to_pixels).round().max(1.0) as u32;
        self.stage
            .draw(&mut session, [pixels(window.width()), pixels(window.height())]);

        self.stage.was_moving = session.is_moving();
        if self.stage.was_moving || session.picture_revision() != self.stage.drawn.map_or(0, |drawn| drawn.picture) {
            ui.ctx().request_repaint();
        }
        requests
    }

    /// How many pictures of the model were drawn: stands still while nothing changes.
    pub fn frames_rendered(&self) -> u64 {
        self.stage.frames_rendered
    }

    /// Why the open model could not be brought to the GPU, if it could not.
    pub fn upload_error(&self) -> Option<&str> {
        self.stage.upload_error.as_deref()
    }

    /// Whether Esc would shut something, end what is being typed or let go of a selection.
    pub fn escape_shuts(&self, ctx: &egui::Context) -> bool {
        ui::escape_shuts(ctx, &self.session.borrow(), &self.state)
    }

    /// Draws the session's view into a target of its own, for a picture of any size. A picture may take its time: passes that
    /// were given up for speed are drawn.
    /// `adjust` may have it looked at in another way than the window shows.
    pub fn draw_snapshot(&mut self, size: [u32; 2], adjust: impl FnOnce(&mut FrameOptions)) -> Target {
        let mut session = self.session.borrow_mut();
        self.stage.draw_snapshot(&mut session, size, adjust)
    }
}

/// What a drawn picture showed.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Drawn {
    picture: u64,
    size: [u32; 2],
}

/// Renderer and target of the window, and what is on them.
struct Stage {
    gpu: RenderState,
    samples: SampleCount,
    renderer: Renderer,
    target: Target,
    model: Option<u64>,
    maps: Option<u64>,
    materials: Option<u64>,
    sky: Option<u64>,
    drawn: Option<Drawn>,
    frames_rendered: u64,
    was_moving: bool,
    upload_error: Option<String>,
}

impl Stage {
    fn new(gpu: &RenderState) -> Self {
        let samples = device::sample_count(&gpu.adapter);
        Self {
            samples,
            renderer: Renderer::with_samples(&gpu.device, &gpu.queue, samples),
            target: Target::with_samples(&gpu.device, 1, 1, samples),
            gpu: gpu.clone(),
            model: None,
            maps: None,
            materials: None,
            sky: None,
            drawn: None,
            frames_rendered: 0,
            was_moving: false,
            upload_error: None,
        }
    }

    /// Draws when the picture would be another one than the last.
    fn draw(&mut self, session: &mut Session, size: [u32; 2]) {
        self.take_up(session);
        let wanted = Drawn {
            picture: session.picture_revision(),
            size,
        };
        if self.drawn == Some(wanted) {
            return;
        }
        if self.target.size() != size {
            self.target.resize(&self.gpu.device, size[0], size[1]);
        }
        self.renderer.render(&session.frame(), &mut self.target);
        if let Some(compositor) = self.gpu.renderer.write().callback_resources.get_mut::<Compositor>() {
            compositor.prepare(&self.gpu.device, &self.target);
        }
        self.drawn = Some(wanted);
        self.frames_rendered += 1;
    }

    fn draw_snapshot(
        &mut self,
        session: &mut Session,
        [width, height]: [u32; 2],
        adjust: impl FnOnce(&mut FrameOptions),
    ) -> Target {
        self.take_up(session);
        let mut target = Target::with_samples(&self.gpu.device, width, height, self.samples);
        let passes = session.quality().wanted();
        let mut frame = session.frame();
        frame.options.passes = passes;
        adjust(&mut frame.options);
        self.renderer.render(&frame, &mut target);
        target
    }

    /// Brings to the GPU what is not there yet.
    fn take_up(&mut self, session: &Session) {
        let sky = session.sky_revision();
        if self.sky != Some(sky) {
            self.renderer.set_sky(session.sky().map(|image| &**image));
            self.sky = Some(sky);
            self.drawn = None;
        }
        let Some(open) = session.open_model() else { return };
        let (model, maps) = (session.model_revision(), session.maps_revision());
        if self.model != Some(model) {
            let uploaded = self.renderer.set_model(&open.model);
            self.upload_error = uploaded.err().map(|error| error.to_string());
            self.model = Some(model);
            self.maps = None;
            self.materials = None;
            self.drawn = None;
        }
        if self.maps != Some(maps) {
            let images = session.maps().images();
            let images: Vec<_> = images
                .map(|[diffuse, normal]| MaterialImages { diffuse, normal })
                .collect();
            self.renderer.set_maps(&images);
            self.maps = Some(maps);
            self.drawn = None;
        }
        let materials = session.materials_revision();
        if self.materials != Some(materials) {
            self.renderer.set_materials(session.materials());
            self.materials = Some(materials);
            self.drawn = None;
        }
    }
}

/// Paints the target behind the panels.
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
