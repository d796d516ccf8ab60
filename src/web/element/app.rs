//! Order of calls in one frame: time, size, picture, surface. It is what [`crate::app`] is with panels.

use std::cell::RefCell;
use std::rc::Rc;
use std::task::Waker;

use super::surface::CanvasSurface;
use crate::painter::{NextPass, PainterOptions, SessionPainter};
use crate::render::{Compositor, Picture, PictureError};
use crate::scene::{FrameOptions, Insets};
use crate::session::{CameraCommand, Session};
use crate::web::{coarse_pointer, now_secs};

/// The viewer on a canvas. The session belongs to whoever made it, so that it outlives a lost GPU.
pub(in crate::web) struct App {
    session: Rc<RefCell<Session>>,
    painter: SessionPainter,
    compositor: Compositor,
    surface: CanvasSurface,
    /// The size and the model that the camera was told of.
    framed: Option<([u32; 2], u64)>,
    /// Whether the canvas shows what the compositor has.
    is_presented: bool,
    /// When the last frame began.
    begun_secs: f64,
}

impl App {
    /// `waker` is woken when the GPU has answered: then a frame is due.
    pub(super) fn new(session: Rc<RefCell<Session>>, surface: CanvasSurface, waker: Waker) -> Self {
        let gpu = &surface.gpu;
        let options = PainterOptions::new(&gpu.adapter, coarse_pointer(), now_secs);
        Self {
            session,
            painter: SessionPainter::new(&gpu.device, &gpu.queue, options, waker),
            compositor: Compositor::new(&gpu.device, surface.format()),
            surface,
            framed: None,
            is_presented: false,
            begun_secs: now_secs(),
        }
    }

    /// Draws where something changed, and says when the next frame is due. One that `had_input` leaves for later what can wait.
    pub(super) fn frame(&mut self, had_input: bool) -> NextPass {
        let session = &mut *self.session.borrow_mut();
        let begun_secs = now_secs();
        let dt_secs = begun_secs - std::mem::replace(&mut self.begun_secs, begun_secs);
        self.painter.begin_pass(session, dt_secs as f32);
        self.is_presented &= !self.surface.follow_canvas();
        let size = self.surface.size();
        let [width, height] = size.map(|side| side as f32);
        let pixels_per_point = web_sys::window().map_or(1.0, |window| window.device_pixel_ratio());
        self.painter.set_pixels_per_point(pixels_per_point as f32);
        let framed = Some((size, session.model_revision()));
        if std::mem::replace(&mut self.framed, framed) != framed {
            session.apply(CameraCommand::SetViewport {
                aspect: width / height,
                insets: Insets::default(),
            });
        }
        let pass = self
            .painter
            .end_pass(session, [width, height], &mut self.compositor, had_input);
        self.is_presented &= !pass.is_new;
        self.is_presented = self.is_presented || self.surface.present(&self.compositor);
        if self.is_presented { pass.next } else { NextPass::AtOnce }
    }

    /// Follows [`Session::start_over`]: the GPU gets anew what it draws.
    pub(in crate::web) fn start_over(&mut self) {
        self.painter.forget();
        self.framed = None;
    }

    /// How many pictures of the model were drawn: stands still while nothing changes.
    pub(in crate::web) fn frames_rendered(&self) -> u64 {
        self.painter.frames_rendered()
    }

    /// How many pictures the one on the canvas is the mean of.
    pub(in crate::web) fn samples(&self) -> u32 {
        self.painter.samples()
    }

    /// Whether what lights the model is as fine as it will be.
    pub(in crate::web) fn is_refined(&self) -> bool {
        self.painter.is_refined(&self.session.borrow())
    }

    /// The longest side of a picture that this device can draw, in pixels.
    pub(in crate::web) fn longest_picture_side(&self) -> u32 {
        self.painter.longest_side()
    }

    /// A picture of any size; see [`SessionPainter::draw_snapshot`].
    ///
    /// # Errors
    /// When the device draws no picture of this size; whether it could draw this one comes with its pixels.
    pub(in crate::web) fn draw_snapshot(
        &mut self,
        size: [u32; 2],
        samples: Option<u32>,
        adjust: impl FnOnce(&mut FrameOptions),
    ) -> Result<Picture, PictureError> {
        let session = &mut *self.session.borrow_mut();
        self.painter.draw_snapshot(session, size, samples, adjust)
    }
}
