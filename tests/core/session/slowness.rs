//! What a device that is too slow is spared, with a clock and GPU times made up.

use std::collections::VecDeque;

use bindpose::scene::{Detail, FrameCost, Pass, Passes, TimedPass};
use bindpose::session::{CameraCommand, Command, LookCommand, PassChoice, QualityCommand, QualityMode, Session};

use super::models::{moving, still};
use super::{opened, orbit};

/// A slow frame with all its pixels, s.
const SLOW: f32 = 0.2;
/// A pass of the window in which nothing is drawn.
const QUICK: f32 = 1.0 / 60.0;

/// The GPU's times come so many frames later.
const GPU_LAG: usize = 3;

/// The window: draws when the picture changed and goes on while it is told to, as the application does.
struct Window {
    session: Session,
    drawn: u64,
    /// How long drawing the whole picture takes.
    frame_secs: f32,
    /// What else each pass takes.
    page_secs: f32,
    /// What the GPU tells of each pass of the whole picture, if it tells.
    gpu_secs: Option<f32>,
    /// Times of the GPU that are under way, the newest first.
    untold: VecDeque<f32>,
    /// How long the pass that is over took.
    pass_secs: f32,
    /// The next pass begins at once, without waiting for the pointer.
    goes_on: bool,
}

impl Window {
    fn new(session: Session, frame_secs: f32) -> Self {
        Self {
            session,
            drawn: 0,
            frame_secs,
            page_secs: 0.0,
            gpu_secs: None,
            untold: VecDeque::new(),
            pass_secs: 0.0,
            goes_on: false,
        }
    }

    /// One pass, after the pointer rested for `rest_secs`, with what the pointer does in it.
    fn pass(&mut self, rest_secs: f32, commands: &[Command]) {
        self.session.begin_pass(self.pass_secs + rest_secs);
        for command in commands {
            self.session.apply(command.clone());
        }
        self.session.follow_motion();
        let draws = self.session.picture_revision() != self.drawn;
        self.drawn = self.session.picture_revision();
        let scale = self.session.quality().scale_now();
        let mut cost = FrameCost::default();
        if let (true, Some(secs)) = (draws, self.gpu_secs) {
            let told = self.untold.get(GPU_LAG - 1);
            let passes = TimedPass::ALL.len();
            cost.gpu_secs = told.map(|secs| [secs / passes as f32; TimedPass::ALL.len()]);
            self.untold.push_front(secs * scale * scale);
        }
        self.goes_on = draws && self.session.frame_drawn(cost);
        self.pass_secs = self.page_secs + if draws { self.frame_secs * scale * scale } else { QUICK };
    }

    /// A pointer event, and the passes that follow until the window waits again.
    fn event(&mut self, rest_secs: f32, commands: &[Command]) {
        self.pass(rest_secs, commands);
        while self.goes_on && !self.session.is_moving() {
            self.pass(0.0, &[]);
        }
    }

    /// Holds the camera and moves it in each of some passes that follow each other.
    fn drag(&mut self, moves: u32) {
        self.pass(0.0, &[CameraCommand::BeginDrag.into()]);
        for _ in 0..moves {
            self.pass(0.0, &[turn()]);
        }
        self.event(0.0, &[CameraCommand::EndDrag.into()]);
    }

    /// How much of the picture is drawn while it moves.
    fn moving_scale(&self) -> f32 {
        self.session.quality().lowered().map_or(1.0, |lowered| lowered.scale)
    }
}

fn turn() -> Command {
    orbit(0.01, 0.0).into()
}

#[test]
fn a_held_drag_of_a_still_model_is_measured() {
    let mut window = Window::new(opened(still("a.m3d")), SLOW);
    window.pass(0.0, &[]);
    window.drag(4);
    assert_eq!(window.moving_scale(), 1.0, "a few slow frames are forgiven");
    window.drag(8);
    assert_eq!(window.moving_scale(), 0.5);
    window.drag(100);
    let quality = window.session.quality();
    assert!(quality.lowered().is_some_and(|lowered| lowered.without_occlusion));
    let without_occlusion = Passes::all().with(Pass::AmbientOcclusion, false);
    assert_eq!(quality.passes(), without_occlusion, "nothing else is left out");
}

#[test]
fn a_picture_that_rests_has_all_its_detail_a_moment_later() {
    let mut window = Window::new(opened(still("a.m3d")), SLOW);
    window.pass(0.0, &[]);
    window.drag(100);
    let quality = window.session.quality();
    assert!(quality.scale_now() < 1.0, "a pointer that hesitates is not waited for");
    let due_secs = quality.rests_in_secs().expect("a finer picture is due");
    let drawn = window.drawn;
    window.pass(due_secs, &[]);
    let quality = window.session.quality();
    assert_eq!((quality.scale_now(), quality.passes()), (1.0, Passes::all()));
    assert!(window.drawn != drawn, "it is drawn again");
    assert_eq!(quality.rests_in_secs(), None, "and then no more");
    let drawn = window.drawn;
    window.pass(10.0, &[]);
    assert_eq!(window.drawn, drawn);
}

#[test]
fn a_quick_device_keeps_everything_however_long_the_pointer_rests() {
    let mut window = Window::new(opened(still("a.m3d")), QUICK);
    for _ in 0..10 {
        window.drag(3);
        // Between two drags, and in one.
        window.event(5.0, &[CameraCommand::BeginDrag.into()]);
        for _ in 0..5 {
            window.event(2.0, &[turn()]);
        }
        window.event(2.0, &[CameraCommand::EndDrag.into()]);
    }
    assert_eq!(window.session.quality().lowered(), None);
    assert_eq!(
        window.session.quality().rests_in_secs(),
        None,
        "no frame is drawn once more"
    );
}

#[test]
fn single_pictures_are_not_measured() {
    let mut window = Window::new(opened(still("a.m3d")), SLOW);
    for _ in 0..40 {
        window.event(0.0, &[turn()]);
        window.event(0.5, &[LookCommand::ToggleLight.into()]);
    }
    assert_eq!(window.session.quality().lowered(), None);
}

#[test]
fn a_clip_that_plays_is_measured() {
    let mut window = Window::new(opened(moving("a.m3d")), SLOW);
    for _ in 0..16 {
        window.session.advance(window.pass_secs);
        window.pass(0.0, &[]);
    }
    assert_eq!(window.moving_scale(), 0.5);
    assert_eq!(window.session.quality().scale_now(), 0.5);
}

/// A clip that plays for so many frames. Returns how much of the picture is drawn in the end.
fn play(window: &mut Window, frames: u32) -> f32 {
    for _ in 0..frames {
        window.session.advance(window.pass_secs);
        window.pass(0.0, &[]);
    }
    window.moving_scale()
}

#[test]
fn a_quick_gpu_under_a_slow_page_draws_all() {
    let mut window = Window::new(opened(moving("a.m3d")), 0.003);
    window.page_secs = 0.047;
    assert!(play(&mut window, 60) < 1.0, "20 frames a second, and nobody tells why");
    let mut window = Window::new(opened(moving("a.m3d")), 0.003);
    (window.page_secs, window.gpu_secs) = (0.047, Some(0.003));
    assert_eq!(play(&mut window, 600), 1.0);
    assert_eq!(window.session.quality().lowered(), None);
}

#[test]
fn a_slow_gpu_draws_fewer_pixels() {
    let mut window = Window::new(opened(moving("a.m3d")), 0.03);
    (window.page_secs, window.gpu_secs) = (0.02, Some(0.03));
    assert_eq!(play(&mut window, 60), 0.7, "half of the pixels take 15 ms");
    let lowered = window.session.quality().lowered().expect("lowered");
    assert!(
        (lowered.frame_secs - 0.0147).abs() < 1e-4,
        "what the GPU took: {lowered:?}"
    );
}

#[test]
fn a_gpu_that_is_a_little_too_slow_for_the_display_is_noticed() {
    // Frames come in time, nearly: nobody could tell by them.
    let mut window = Window::new(opened(moving("a.m3d")), 0.018);
    assert_eq!(play(&mut window, 60), 1.0);
    let mut window = Window::new(opened(moving("a.m3d")), 0.018);
    window.gpu_secs = Some(0.018);
    assert_eq!(play(&mut window, 30), 0.85);
}

#[test]
fn a_time_longer_than_between_frames_is_no_time_of_a_gpu() {
    let mut window = Window::new(opened(moving("a.m3d")), 0.003);
    window.gpu_secs = Some(7.0);
    assert_eq!(play(&mut window, 120), 1.0);
}

#[test]
fn gpu_times_of_a_still_picture_are_not_taken_for_those_of_a_motion() {
    let mut window = Window::new(opened(still("a.m3d")), 0.03);
    (window.page_secs, window.gpu_secs) = (0.02, Some(0.03));
    window.pass(0.0, &[]);
    window.drag(30);
    let moving = window.moving_scale();
    assert_eq!(moving, 0.7);
    for _ in 0..20 {
        // At rest the whole picture is drawn, and its times come with the next frames.
        for _ in 0..GPU_LAG {
            window.pass(1.0, &[LookCommand::ToggleLight.into()]);
        }
        window.drag(4);
    }
    assert_eq!(window.moving_scale(), moving);
}

#[test]
fn what_was_chosen_stands_above_what_the_device_keeps_up_with() {
    let mut window = Window::new(opened(moving("a.m3d")), SLOW);
    let play = |window: &mut Window| {
        for _ in 0..120 {
            window.session.advance(window.pass_secs);
            window.pass(0.0, &[]);
        }
        let quality = window.session.quality();
        (quality.scale_now(), quality.passes().has(Pass::AmbientOcclusion))
    };
    assert_eq!(play(&mut window), (0.5, false));
    let occlusion = |choice| QualityCommand::SetPass(Pass::AmbientOcclusion, choice);
    window.session.apply(occlusion(PassChoice::On));
    assert_eq!(play(&mut window), (0.5, true));
    window.session.apply(occlusion(PassChoice::Auto));
    window.session.apply(QualityCommand::SetMode(QualityMode::Full));
    assert_eq!(play(&mut window), (1.0, true));
    let mut quick = Window::new(opened(moving("a.m3d")), QUICK);
    quick.session.apply(QualityCommand::SetMode(QualityMode::Low));
    assert_eq!(play(&mut quick), (0.5, false));
}

#[test]
fn a_device_that_draws_with_its_cpu_begins_with_few_pixels() {
    let mut window = Window::new(opened(moving("a.m3d")), SLOW);
    window.session.apply(QualityCommand::SetSlowDevice(true));
    window.session.advance(0.01);
    window.pass(0.0, &[]);
    assert_eq!(window.session.quality().scale_now(), 0.5, "from its first frame");
    let options = window.session.frame().options;
    assert_eq!(
        (options.shadow_detail, options.occlusion_detail),
        (Detail::Low, Detail::Full)
    );
    window.session.apply(QualityCommand::SetMode(QualityMode::Full));
    assert_eq!(
        window.session.frame().options.shadow_detail,
        Detail::Full,
        "all of it was asked for"
    );
}
