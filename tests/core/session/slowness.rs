//! What a device that is too slow is spared, with a clock made up.

use bindpose::scene::{FrameCost, Pass, Passes};
use bindpose::session::{CameraCommand, Command, LookCommand, PassChoice, QualityCommand, QualityMode, Session};

use super::models::{moving, still};
use super::opened;

/// A slow frame with all its pixels, s.
const SLOW: f32 = 0.2;
/// A pass of the window in which nothing is drawn.
const QUICK: f32 = 1.0 / 60.0;

/// The window: draws when the picture changed and goes on while it is told to, as the application does.
struct Window {
    session: Session,
    drawn: u64,
    /// How long drawing the whole picture takes.
    frame_secs: f32,
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
        self.goes_on = draws && self.session.frame_drawn(FrameCost::default());
        let scale = self.session.quality().scale_now();
        self.pass_secs = if draws { self.frame_secs * scale * scale } else { QUICK };
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
            self.pass(0.0, &[orbit()]);
        }
        self.event(0.0, &[CameraCommand::EndDrag.into()]);
    }

    /// How much of the picture is drawn while it moves.
    fn moving_scale(&self) -> f32 {
        self.session.quality().lowered().map_or(1.0, |lowered| lowered.scale)
    }
}

fn orbit() -> Command {
    Command::Camera(CameraCommand::Orbit {
        yaw_radians: 0.01,
        pitch_radians: 0.0,
    })
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
            window.event(2.0, &[orbit()]);
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
        window.event(0.0, &[orbit()]);
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
}
