//! A session on a surface without a window and without an interface, as a page has it that brings its own controls.

use std::task::Waker;

use bindpose::painter::{PainterOptions, SessionPainter};
use bindpose::render::Compositor;
use bindpose::session::{File, FileCommand, LookCommand, Session};

use crate::gpu::{Gpu, Picture, without_blocks};
use crate::picture::{SURFACE_FORMAT, on_surface};

struct Easel {
    gpu: Gpu,
    painter: SessionPainter,
    compositor: Compositor,
}

impl Easel {
    /// On a device of its own.
    fn new(gpu: &Gpu) -> Self {
        let gpu = without_blocks(gpu.backend);
        let options = PainterOptions {
            samples: gpu.open.samples,
            coarse_pointer: false,
            now_secs: || 0.0,
        };
        Self {
            painter: SessionPainter::new(&gpu.open.device, &gpu.open.queue, options, Waker::noop().clone()),
            compositor: Compositor::new(&gpu.open.device, SURFACE_FORMAT),
            gpu,
        }
    }

    /// What is on a surface of this size, and whether it was drawn for that.
    fn show(&mut self, session: &mut Session, size: [u32; 2]) -> (Picture, bool) {
        let window = size.map(|side| side as f32);
        let drawn = self.painter.draw(session, window, &mut self.compositor).is_some();
        assert!(session.error().is_none());
        assert!(self.painter.is_current(session));
        (on_surface(&self.gpu, &self.compositor, size), drawn)
    }

    /// The device goes away, with all that was on it.
    fn lose(self) {
        self.gpu.open.device.destroy();
    }
}

fn opened() -> Session {
    let mut session = Session::new(true);
    let path = format!("{}/tests/fixtures/good/d3d12_skinned.m3d", env!("CARGO_MANIFEST_DIR"));
    let bytes = std::fs::read(path).expect("a fixture");
    session.apply(FileCommand::Add(vec![File::new("d3d12_skinned.m3d", bytes)]));
    session
}

fn is_something(picture: &Picture) -> bool {
    picture.rgba.chunks(4).any(|pixel| pixel != &picture.rgba[..4])
}

on_both_backends! {
    fn a_session_is_drawn_resized_and_drawn_anew_after_a_loss(gpu) {
        let mut session = opened();
        let (small, large) = ([96, 64], [160, 120]);
        let mut easel = Easel::new(gpu);
        let (first, drawn) = easel.show(&mut session, small);
        assert!(drawn && is_something(&first));
        let (resized, drawn) = easel.show(&mut session, large);
        assert!(drawn && is_something(&resized));
        let (same, drawn) = easel.show(&mut session, large);
        assert!(!drawn && same.rgba == resized.rgba, "nothing is drawn for what is there");
        easel.lose();

        let mut easel = Easel::new(gpu);
        let (again, drawn) = easel.show(&mut session, large);
        assert!(drawn && again.rgba == resized.rgba, "what was open is there");
        let (again, _) = easel.show(&mut session, small);
        assert_eq!(again.rgba, first.rgba);
        session.apply(LookCommand::ToggleLight);
        let (other, drawn) = easel.show(&mut session, small);
        assert!(drawn && other.rgba != first.rgba, "and goes on");
        assert_eq!(easel.painter.frames_rendered(), 3);
    }
}
