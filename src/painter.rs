//! Draws a session on a GPU, for whoever has a surface: what changed is uploaded, what the GPU refuses is taken back, and a picture is drawn
//! when it would differ. It knows no window and no interface; a lost GPU takes it along, and another one brings all of it back.

mod at_rest;
mod passes;

pub use passes::{NextPass, Pass};

use std::cell::Cell;
use std::rc::Rc;
use std::task::{Context, Poll, Waker};

use crate::render::{
    Accumulator, Compositor, GpuAnswer, Picture, PictureError, PictureTarget, Renderer, RendererOptions, SampleCount,
    Target, UploadError, device, watched,
};
use crate::scene::{FrameCost, FrameOptions, RenderFrame};
use crate::session::{Quality, Session};
use crate::slices::Slices;
use at_rest::AtRest;

/// Texels along each edge of the shadow map where fingers are the pointer: a phone has less memory to write to.
const SMALL_SHADOW_MAP_SIDE: u32 = 1024;

/// A picture with depth of field is the mean of so many at least.
const LENS_SAMPLES: u32 = 16;
/// How long what lights the model is worked on between two passes of the window, seconds.
const REFINING_SECS: f64 = 0.006;

#[derive(Clone, Copy, PartialEq, Eq)]
struct Drawn {
    scene: u64,
    picture: u64,
    size: [u32; 2],
}

/// Sizes of the picture, pixels.
#[derive(Clone, Copy)]
struct Sizes {
    now: [u32; 2],
    /// Before its mean is drawn.
    at_rest: [u32; 2],
    mean: [u32; 2],
}

/// What a painter is told of where it runs.
#[derive(Clone, Copy, Debug)]
pub struct PainterOptions {
    /// As many as [`device::sample_count`] says of the adapter.
    pub samples: SampleCount,
    pub coarse_pointer: bool,
    /// Whether the device can draw the mean of many pictures: see [`device::draws_means`].
    pub draws_means: bool,
    /// Seconds since some moment.
    pub now_secs: fn() -> f64,
}

impl PainterOptions {
    /// Those of an adapter.
    pub fn new(adapter: &wgpu::Adapter, coarse_pointer: bool, now_secs: fn() -> f64) -> Self {
        Self {
            samples: device::sample_count(adapter),
            coarse_pointer,
            draws_means: device::draws_means(adapter),
            now_secs,
        }
    }
}

/// Draws a session: the renderer, the targets, and the revisions of what was uploaded and drawn.
pub struct SessionPainter {
    device: wgpu::Device,
    queue: wgpu::Queue,
    samples: SampleCount,
    now_secs: fn() -> f64,
    renderer: Renderer,
    target: Target,
    /// With one sample a pixel, for pictures without smooth edges.
    plain_target: Target,
    at_rest: AtRest,
    model: Option<u64>,
    maps: Option<u64>,
    materials: Option<u64>,
    sky: Option<u64>,
    drawn: Option<Drawn>,
    frames_rendered: u64,
    /// Whether something moved when the last pass ended.
    was_moving: bool,
    /// For what lights the model; they are over at this time.
    refining: (Slices, Rc<Cell<f64>>),
    /// Uploads that the GPU has not confirmed yet.
    answers: Vec<GpuAnswer>,
    /// A resized target that the GPU has not confirmed yet.
    target_answer: Option<GpuAnswer>,
    pixels_per_point: f32,
    /// Height of the last window in points of the screen.
    points_high: Option<f32>,
    /// Asks for another picture when an answer arrives.
    waker: Waker,
}

impl SessionPainter {
    /// `waker` is woken when the GPU has answered: then [`SessionPainter::draw`] is due.
    pub fn new(device: &wgpu::Device, queue: &wgpu::Queue, options: PainterOptions, waker: Waker) -> Self {
        let samples = options.samples;
        let mut of_renderer = RendererOptions {
            samples,
            ..RendererOptions::default()
        };
        if options.coarse_pointer {
            of_renderer.shadow_map_side = SMALL_SHADOW_MAP_SIDE;
        }
        let (now_secs, end_secs) = (options.now_secs, Rc::new(Cell::new(0.0)));
        let end = Rc::clone(&end_secs);
        Self {
            refining: (Slices::new(move || now_secs() >= end.get()), end_secs),
            renderer: Renderer::new(device, queue, of_renderer),
            target: Target::with_samples(device, 1, 1, samples).with_layer(),
            plain_target: Target::with_samples(device, 1, 1, SampleCount::One).with_layer(),
            at_rest: AtRest::new(options.draws_means),
            device: device.clone(),
            queue: queue.clone(),
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
            pixels_per_point: 1.0,
            points_high: None,
            waker,
        }
    }

    /// How many pixels a point of the screen has from the next picture on: lines go with points.
    pub fn set_pixels_per_point(&mut self, pixels: f32) {
        if self.pixels_per_point != pixels && pixels > 0.0 {
            self.pixels_per_point = pixels;
            self.drawn = None;
        }
    }

    /// How large the picture is to be now, and at rest, in a window of this size in pixels.
    fn sizes(&self, quality: &Quality, window: [f32; 2]) -> Sizes {
        let whole = window.map(|side| side as u32);
        let affordable = Target::affordable_scale(whole, self.samples);
        let of_mean = self.at_rest.affordable_scale(whole);
        let scaled = |scale: f32| window.map(|side| (side * scale).round().max(1.0) as u32);
        let at_rest = quality.render_scale().fraction();
        Sizes {
            now: scaled(quality.scale_now() * affordable),
            at_rest: scaled(at_rest * affordable),
            mean: scaled(at_rest * of_mean),
        }
    }

    /// Draws for a window of this size in pixels, if the picture would differ from the last one. Returns what that cost, if it drew; the
    /// compositor then shows it.
    pub fn draw(&mut self, session: &mut Session, window: [f32; 2], compositor: &mut Compositor) -> Option<FrameCost> {
        let sizes = self.sizes(session.quality(), window);
        self.points_high = Some((window[1] / self.pixels_per_point).max(1.0));
        self.update(session);
        let wanted = Drawn {
            scene: session.scene_revision(),
            picture: session.picture_revision(),
            size: sizes.now,
        };
        self.poll_target(session);
        if self.drawn == Some(wanted) {
            self.draw_samples(session, sizes.mean, compositor);
            return None;
        }
        let scene_stays = self
            .drawn
            .is_some_and(|drawn| (drawn.scene, drawn.size) == (wanted.scene, wanted.size));
        if !scene_stays {
            self.at_rest.restart();
        }
        let (target, largest) = if session.quality().smooths_edges_now() {
            (&mut self.target, sizes.at_rest)
        } else {
            (&mut self.plain_target, sizes.now)
        };
        let start_secs = (self.now_secs)();
        let mut cost;
        let mut frame = session.frame();
        frame.options.points_high = self.points_high;
        if target.size() == sizes.now {
            let over_mean = if scene_stays {
                self.at_rest.draw_over(&mut self.renderer, &frame, sizes.now)
            } else {
                None
            };
            cost = over_mean.unwrap_or_else(|| {
                if scene_stays && target.can_draw_over(frame.has_overlays()) {
                    self.renderer.render_over(&frame, target)
                } else {
                    self.renderer.render(&frame, target)
                }
            });
        } else {
            let device = self.device.clone();
            let stayed;
            let answer;
            ((stayed, cost), answer) = watched(&device, || {
                let stayed = target.resize(&device, sizes.now, largest);
                (stayed, self.renderer.render(&frame, target))
            });
            // Maps of the light go with the picture's size, but they are small.
            if !stayed {
                self.target_answer = Some(answer);
            }
        }
        cost.cpu_secs = Some(((self.now_secs)() - start_secs) as f32);
        let (shown, mean) = self.at_rest.shown_over(target);
        compositor.prepare(&self.device, &self.queue, shown, mean);
        self.poll_target(session);
        self.drawn = Some(wanted);
        self.frames_rendered += 1;
        Some(cost)
    }

    /// Whether the picture of now rests, and its mean is not complete.
    pub fn is_sampling(&self, session: &Session) -> bool {
        self.is_current(session) && self.at_rest.lacks_samples(session, (self.now_secs)())
    }

    /// How many samples the picture in the window is the mean of.
    pub fn samples(&self) -> u32 {
        self.at_rest.shown().map_or(1, Accumulator::count)
    }

    /// Whether what lights the model is as fine as it will be.
    pub fn is_refined(&self, session: &Session) -> bool {
        !session.quality().works_ahead() || self.renderer.is_refined()
    }

    /// Adds some samples to the mean of a picture that rests.
    fn draw_samples(&mut self, session: &mut Session, size: [u32; 2], compositor: &mut Compositor) {
        if !self.is_sampling(session) {
            return;
        }
        let (gpu, now_secs) = ((&self.device, &self.queue, &mut self.renderer), (self.now_secs)());
        let drawn = if session.quality().smooths_edges_now() {
            &self.target
        } else {
            &self.plain_target
        };
        let sizes = [size, drawn.size()];
        self.at_rest
            .draw(gpu, session, (sizes, self.points_high), now_secs, &self.waker);
        let (shown, mean) = self.at_rest.shown_over(drawn);
        compositor.prepare(&self.device, &self.queue, shown, mean);
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

    /// Draws the session's view into a target of its own. A picture may take its time: what the window leaves out for speed is drawn.
    /// It is the mean of so many `samples`, or of as many as the session says. `adjust` may change how it looks.
    ///
    /// # Errors
    /// When the device draws no picture of this size; whether it could draw this one comes with its pixels.
    pub fn draw_snapshot(
        &mut self,
        session: &mut Session,
        size: [u32; 2],
        samples: Option<u32>,
        adjust: impl FnOnce(&mut FrameOptions),
    ) -> Result<Picture, PictureError> {
        self.update(session);
        let asked = samples.filter(|_| self.at_rest.draws_means);
        let mut samples = asked.unwrap_or_else(|| self.samples_of_pictures(session));
        let mut frame = session.frame_at_rest();
        frame.options.points_high = self.points_high;
        adjust(&mut frame.options);
        if frame.options.aperture > 0.0 && self.at_rest.draws_means {
            samples = samples.max(LENS_SAMPLES);
        }
        self.renderer
            .picture_into(&frame, &mut PictureTarget::new(size).with_mean_of(samples))
    }

    /// Of how many pictures one that is saved is the mean.
    pub fn samples_of_pictures(&self, session: &Session) -> u32 {
        if self.at_rest.draws_means {
            session.quality().samples()
        } else {
            1
        }
    }

    /// Brings the GPU up to date with the session. Whether it then has all that another session shows, but for the view.
    pub fn has_uploaded(&mut self, session: &mut Session, other: &Session) -> bool {
        self.update(session);
        !self.is_behind(other)
    }

    /// Draws a frame of what the GPU has into a target of its own.
    ///
    /// # Errors
    /// When the device draws no picture of this size.
    pub fn picture_into(
        &mut self,
        frame: &RenderFrame<'_>,
        target: &mut PictureTarget,
    ) -> Result<Picture, PictureError> {
        self.renderer.picture_into(frame, target)
    }

    /// Whether the picture that was drawn last is of what the session shows.
    pub fn is_current(&self, session: &Session) -> bool {
        session.picture_revision() == self.drawn.map_or(0, |drawn| drawn.picture)
    }

    /// Whether pipelines are left to be built of those that a person may soon ask for, or what lights the model is not as fine as it will be.
    /// When there is nothing else to do, it goes on with it. False where nothing [is worked on ahead](crate::session::Quality::works_ahead).
    pub fn prepares(&mut self, session: &Session, is_idle: bool) -> bool {
        if !session.quality().works_ahead() {
            return false;
        }
        let lowered = session.quality().lowered();
        let is_plain = lowered.is_some_and(|lowered| lowered.without_smooth_edges);
        let samples = &[SampleCount::One, self.samples][usize::from(!is_plain)..];
        if !self.renderer.is_prepared(samples) {
            return !is_idle || self.renderer.prepare_next(samples);
        }
        if self.renderer.is_refined() {
            return false;
        }
        if is_idle {
            let (slices, end_secs) = &self.refining;
            end_secs.set((self.now_secs)() + REFINING_SECS);
            if self.renderer.refine(slices) {
                self.drawn = None;
            }
        }
        true
    }

    /// How many pictures were drawn: stands still while nothing changes.
    pub fn frames_rendered(&self) -> u64 {
        self.frames_rendered
    }

    /// The longest side of a picture that the device can draw, in pixels.
    pub fn longest_side(&self) -> u32 {
        self.device.limits().max_texture_dimension_2d
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
        let device = self.device.clone();
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
    pub fn forget(&mut self) {
        self.at_rest.forget();
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
