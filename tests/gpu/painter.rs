//! A session on a surface without a window and without an interface, as a page has it that brings its own controls.

use std::cell::Cell;
use std::ops::RangeInclusive;
use std::task::Waker;

use bindpose::model::JointIndex;
use bindpose::painter::{PainterOptions, SessionPainter};
use bindpose::render::{Compositor, Renderer, SampleCount, Target};
use bindpose::scene::{Background, FrameCost, Overlay};
use bindpose::session::{
    CameraCommand, Command, File, FileCommand, JointCommand, LookCommand, QualityCommand, Session, SubmeshCommand,
};

use crate::gpu::{Gpu, Picture, without_blocks};
use crate::picture::{SURFACE_FORMAT, on_surface};

struct Easel {
    gpu: Gpu,
    painter: SessionPainter,
    compositor: Compositor,
    /// Of the last frame that was drawn.
    cost: FrameCost,
}

/// Clocks that go on each time that somebody looks at them, each test's its own.
fn looked_at_secs(step: f64) -> f64 {
    thread_local! {
        static SECS: Cell<f64> = const { Cell::new(0.0) };
    }
    SECS.with(|secs| {
        secs.set(secs.get() + step);
        secs.get()
    })
}

impl Easel {
    /// On a device of its own.
    fn new(gpu: &Gpu) -> Self {
        Self::with_clock(gpu, true, || 0.0)
    }

    fn with_clock(gpu: &Gpu, draws_means: bool, now_secs: fn() -> f64) -> Self {
        let gpu = without_blocks(gpu.backend);
        let options = PainterOptions {
            samples: gpu.open.samples,
            coarse_pointer: false,
            draws_means,
            now_secs,
        };
        Self {
            painter: SessionPainter::new(&gpu.open.device, &gpu.open.queue, options, Waker::noop().clone()),
            compositor: Compositor::new(&gpu.open.device, SURFACE_FORMAT),
            cost: FrameCost::default(),
            gpu,
        }
    }

    /// What is on a surface of this size, and whether it was drawn for that.
    fn show(&mut self, session: &mut Session, size: [u32; 2]) -> (Picture, bool) {
        let window = size.map(|side| side as f32);
        let cost = self.painter.draw(session, window, &mut self.compositor);
        self.cost = cost.unwrap_or(self.cost);
        let drawn = cost.is_some();
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

    fn what_lies_over_the_model_is_drawn_anew_and_the_model_stays(gpu) {
        let mut session = opened();
        let size = [160, 120];
        let mut easel = Easel::new(gpu);
        let (mut before, _) = easel.show(&mut session, size);
        let wire = |is_on| LookCommand::SetOverlay(Overlay::Wireframe, is_on).into();
        // What is seen through the model needs none of it. The first thing that it can hide needs its depth, which is kept from then on: the
        // model and the highlight, then the highlight alone, with edges, and alone.
        let steps: [(Command, RangeInclusive<u64>); 8] = [
            (LookCommand::SetBonesVisible(true).into(), 0..=0),
            (JointCommand::Select(Some(JointIndex(1))).into(), 0..=0),
            (JointCommand::Hover(Some(JointIndex(0))).into(), 0..=0),
            (SubmeshCommand::Hover(Some(0)).into(), 2..=2),
            (SubmeshCommand::Hover(None).into(), 0..=0),
            (SubmeshCommand::Hover(Some(0)).into(), 1..=1),
            (wire(true), 1..=2),
            (wire(false), 1..=1),
        ];
        for (step, draws_of_model) in steps {
            let words = format!("{step:?}");
            session.apply(step);
            let (picture, drawn) = easel.show(&mut session, size);
            assert!(drawn && draws_of_model.contains(&easel.cost.draws), "{words}: {:?}", easel.cost);
            assert!(picture.rgba != before.rgba, "{words}");
            let (anew, _) = Easel::new(gpu).show(&mut session, size);
            assert!(picture.rgba == anew.rgba, "{words}");
            before = picture;
        }

        // Saved pictures are drawn in one pass.
        let saved = easel.painter.draw_snapshot(&mut session, size, Some(1), |_| ()).expect("it is small");
        let saved = saved.pixels_blocking().expect("it is small");
        let off = saved.iter().zip(&before.rgba).map(|(&a, &b)| a.abs_diff(b));
        let (most, sum) = off.fold((0, 0.0), |(most, sum), off| (most.max(off), sum + f64::from(off)));
        assert!(most < 40 && sum / (saved.len() as f64) < 0.1, "{most}, {sum}");

        session.apply(CameraCommand::Orbit { yaw_radians: 0.5, pitch_radians: 0.0 });
        let (moved, _) = easel.show(&mut session, size);
        assert!(easel.cost.draws > 1 && moved.rgba != before.rgba, "the model is drawn with its depth");
        let gone: [Command; 4] = [
            LookCommand::SetBonesVisible(false).into(),
            JointCommand::Select(None).into(),
            JointCommand::Hover(None).into(),
            SubmeshCommand::Hover(None).into(),
        ];
        for command in gone {
            session.apply(command);
        }
        let (clear, _) = easel.show(&mut session, size);
        assert_eq!(easel.cost.draws, 0);
        let (anew, _) = Easel::new(gpu).show(&mut session, size);
        assert!(clear.rgba == anew.rgba, "nothing of it is left");
    }

    fn a_picture_at_rest_becomes_the_mean_of_many_and_then_nothing_is_drawn(gpu) {
        let mut session = opened();
        session.apply(QualityCommand::SetSamples(Some(20)));
        let size = [160, 120];
        let mut easel = Easel::new(gpu);
        let (first, _) = easel.show(&mut session, size);
        assert_eq!(easel.painter.samples(), 1);
        let mut passes = 0;
        while easel.painter.is_sampling(&session) {
            let (picture, drawn) = easel.show(&mut session, size);
            assert!(!drawn, "the scene stays as it was drawn");
            assert!(easel.painter.samples() > 1 || picture.rgba == first.rgba, "the first is shown until the mean is good");
            passes += 1;
            assert!(passes < 20);
        }
        assert_eq!((easel.painter.samples(), easel.painter.frames_rendered()), (20, 1));
        let (rested, _) = easel.show(&mut session, size);
        assert!(rested.rgba != first.rgba && rested.share_that_differs(&first, 24) < 0.05);
        let (same, _) = easel.show(&mut session, size);
        assert!(same.rgba == rested.rgba, "nothing is drawn any more");

        // What lies over the model is drawn over the mean, which stays.
        session.apply(LookCommand::SetBonesVisible(true));
        let (with_bones, drawn) = easel.show(&mut session, size);
        assert!(drawn && easel.cost.draws == 0 && easel.painter.samples() == 20 && with_bones.rgba != rested.rgba);
        session.apply(LookCommand::SetBonesVisible(false));
        assert!(easel.show(&mut session, size).0.rgba == rested.rgba);

        // What changes the scene begins anew, with a picture of its own.
        session.apply(CameraCommand::Orbit { yaw_radians: 0.5, pitch_radians: 0.0 });
        let (moved, _) = easel.show(&mut session, size);
        assert_eq!(easel.painter.samples(), 1);
        assert!(moved.rgba == Easel::new(gpu).show(&mut session, size).0.rgba);
        while easel.painter.is_sampling(&session) {
            easel.show(&mut session, [200, 90]);
        }
        assert_eq!(easel.painter.samples(), 20, "in a window of another size too");

        // A saved picture is the mean of as many.
        let mut saved = || easel.painter.draw_snapshot(&mut session, size, None, |_| ()).expect("small").pixels_blocking().expect("small");
        let (saved, again) = (saved(), saved());
        assert!(saved == again, "the same bytes every time");
    }

    /// While it moves such a window has fewer pixels. Where nothing is but bones, no sample differs from another.
    fn lines_over_a_mean_have_all_pixels_of_a_large_window(gpu) {
        let mut session = opened();
        session.apply(QualityCommand::SetSamples(Some(2)));
        session.apply(LookCommand::SetBackground(Background::Color([40, 60, 80])));
        session.apply(SubmeshCommand::SetVisible { submesh: 0, visible: false });
        session.apply(LookCommand::SetOverlay(Overlay::Grid, false));
        session.apply(LookCommand::SetBonesVisible(true));
        let size = [2600, 2200];
        let mut easel = Easel::new(gpu);
        let (moving, _) = easel.show(&mut session, size);
        while easel.painter.is_sampling(&session) {
            easel.show(&mut session, size);
        }
        let mut differs_from_own = |session: &mut Session| {
            let (rested, _) = easel.show(session, size);
            assert_eq!(easel.painter.samples(), 2);
            let open = &easel.gpu.open;
            let mut renderer = Renderer::with_samples(&open.device, &open.queue, SampleCount::One);
            let mut target = Target::with_samples(&open.device, size[0], size[1], SampleCount::One).with_layer();
            renderer.set_model(&session.open_model().expect("it is open").model).expect("small");
            let mut frame = session.frame();
            frame.options.points_high = Some(size[1] as f32);
            renderer.render(&frame, &mut target);
            let mut own = Compositor::new(&open.device, SURFACE_FORMAT);
            own.prepare(&open.device, &open.queue, &target, None);
            let own = on_surface(&easel.gpu, &own, size);
            assert!(own.share_that_differs(&moving, 2) > 1e-4);
            rested.share_that_differs(&own, 2)
        };
        assert!(differs_from_own(&mut session) == 0.0);
        session.apply(JointCommand::Hover(Some(JointIndex(0))));
        assert!(differs_from_own(&mut session) == 0.0);
    }

    /// Of a clock that goes on by a millisecond whenever it is looked at, no slice takes 8.
    fn what_lights_the_model_is_refined_in_slices_of_idle_time(gpu) {
        let mut easel = Easel::with_clock(gpu, true, || looked_at_secs(1e-3));
        let mut session = Session::new(true);
        easel.show(&mut session, [96, 64]);
        let mut slices = 0;
        while !easel.painter.is_refined(&session) {
            let before = looked_at_secs(0.0);
            assert!(easel.painter.prepares(&session, false) && looked_at_secs(0.0) == before, "not beside other work");
            easel.painter.prepares(&session, true);
            let took_secs = looked_at_secs(0.0) - before;
            assert!(took_secs < 8e-3, "slice {slices} took {took_secs} s");
            slices += 1;
        }
        assert!(slices > 20, "{slices} slices");
        assert!(easel.show(&mut session, [96, 64]).1, "the finer light is shown");
        assert!(!easel.painter.prepares(&session, true), "and then nothing is left to do");
    }

    fn sampling_ends_after_a_second_but_not_before_8(gpu) {
        for (step_secs, counts) in [(0.4, 8..=8), (0.02, 12..=63), (0.0, 64..=64)] {
            let clock = [|| looked_at_secs(0.4), || looked_at_secs(0.02), || 0.0];
            let clock = if step_secs > 0.1 { clock[0] } else if step_secs > 0.0 { clock[1] } else { clock[2] };
            let mut easel = Easel::with_clock(gpu, true, clock);
            let mut session = opened();
            let mut passes = 0;
            easel.show(&mut session, [32, 24]);
            while easel.painter.is_sampling(&session) {
                easel.show(&mut session, [32, 24]);
                passes += 1;
                assert!(passes < 40);
            }
            let count = easel.painter.samples();
            assert!(counts.contains(&count), "{step_secs} s each time: {count} samples");
        }
    }

    fn where_means_cannot_be_drawn_the_picture_stays_as_it_was_drawn(gpu) {
        let mut easel = Easel::with_clock(gpu, false, || 0.0);
        let mut session = opened();
        session.apply(QualityCommand::SetSamples(Some(20)));
        let size = [96, 64];
        let (first, _) = easel.show(&mut session, size);
        assert!(!easel.painter.is_sampling(&session));
        let (same, drawn) = easel.show(&mut session, size);
        assert!(!drawn && same.rgba == first.rgba && easel.painter.samples() == 1);
        let mut saved = |samples| {
            let picture = easel.painter.draw_snapshot(&mut session, size, samples, |_| ()).expect("small");
            picture.pixels_blocking().expect("small")
        };
        let one = saved(Some(1));
        assert!(saved(None) == one && saved(Some(20)) == one, "saved pictures are of one sample too");
    }

    /// Lines of the grid are a point wide: of a screen with twice the pixels a point they have twice the pixels.
    fn the_grid_goes_with_the_points_of_the_screen(gpu) {
        let mut session = opened();
        let large = [640, 480];
        let drawn_with = |pixels_per_point: f32, session: &mut Session| {
            let mut easel = Easel::new(gpu);
            easel.painter.set_pixels_per_point(pixels_per_point);
            easel.show(session, large).0
        };
        let grid = |is_on| LookCommand::SetOverlay(Overlay::Grid, is_on);
        session.apply(grid(false));
        let bare = drawn_with(1.0, &mut session);
        session.apply(grid(true));
        // How much the grid changes the picture, all in all.
        let ink = |picture: &Picture| {
            let off = picture.rgba.iter().zip(&bare.rgba).map(|(&a, &b)| u64::from(a.abs_diff(b)));
            off.filter(|&off| off > 1).sum::<u64>() as f64
        };
        let [one, two, four] = [1.0, 2.0, 4.0].map(|pixels| ink(&drawn_with(pixels, &mut session)));
        assert!((1.6..2.4).contains(&(two / one)) && (1.6..2.4).contains(&(four / two)), "{one} {two} {four}");
        // What is saved has the window's lines, be it as large or half as large.
        let mut easel = Easel::new(gpu);
        easel.painter.set_pixels_per_point(4.0);
        easel.show(&mut session, large);
        let picture = easel.painter.draw_snapshot(&mut session, large, Some(1), |_| ()).expect("small");
        let rgba = picture.pixels_blocking().expect("small");
        assert!((0.97..1.03).contains(&(ink(&Picture { rgba, ..bare }) / four)));
    }

    fn a_slow_device_does_not_refine_unless_it_is_asked_to(gpu) {
        let mut session = opened();
        session.apply(QualityCommand::SetSlowDevice(true));
        let mut easel = Easel::new(gpu);
        easel.show(&mut session, [96, 64]);
        assert!(!easel.painter.is_sampling(&session));
        assert!(!easel.painter.prepares(&session, true) && easel.painter.is_refined(&session), "nor works on anything ahead");
        session.apply(QualityCommand::SetSamples(Some(4)));
        assert!(easel.painter.is_sampling(&session));
        assert!(easel.painter.prepares(&session, true) && !easel.painter.is_refined(&session));
        session.apply(QualityCommand::SetSamples(None));
        session.apply(QualityCommand::SetSlowDevice(false));
        assert!(easel.painter.is_sampling(&session));
        easel.show(&mut session, [96, 64]);
        session.apply(QualityCommand::SetSparing(true));
        while easel.painter.is_sampling(&session) {
            easel.show(&mut session, [96, 64]);
        }
        assert_eq!(easel.painter.samples(), 16);
    }
}
