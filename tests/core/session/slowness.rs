//! What a device that is too slow is spared, with a clock made up.

use bindpose::scene::{Background, Light, Pass, Passes};
use bindpose::session::{CameraCommand, Command, LookCommand, Session};

use super::models::{moving, still};
use super::opened;

/// A slow frame, s.
const SLOW: f32 = 0.1;
/// A pass of the window in which nothing is drawn.
const QUICK: f32 = 1.0 / 60.0;

/// The window: draws when the picture changed and goes on while it is told to, as the application does.
struct Window {
    session: Session,
    drawn: u64,
    /// How long drawing the picture takes.
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
        let draws = self.session.picture_revision() != self.drawn;
        self.drawn = self.session.picture_revision();
        self.goes_on = draws && self.session.frame_drawn();
        self.pass_secs = if draws { self.frame_secs } else { QUICK };
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

    fn degraded(&self) -> Vec<Pass> {
        let passes = self.session.quality().passes();
        Pass::ALL.into_iter().filter(|&pass| !passes.has(pass)).collect()
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
    window.drag(10);
    assert_eq!(window.degraded(), [], "a few slow frames are forgiven");
    window.drag(40);
    assert_eq!(
        window.degraded(),
        [Pass::Shadow, Pass::ContactShadow, Pass::AmbientOcclusion]
    );
    window.drag(40);
    assert!(
        window.session.quality().passes().has(Pass::Environment),
        "reflections cost nothing"
    );
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
    assert_eq!(window.session.quality().passes(), Passes::all());
}

/// Twelve in a row, of which each drag brings five.
#[test]
fn slow_frames_add_up_over_the_pauses_between_drags() {
    let mut window = Window::new(opened(still("a.m3d")), SLOW);
    window.pass(0.0, &[]);
    let mut drags = 0;
    while window.degraded().is_empty() {
        window.drag(5);
        window.pass(3.0, &[]);
        drags += 1;
        assert!(drags < 10);
    }
    assert_eq!(
        (drags, window.degraded().as_slice()),
        (3, [Pass::AmbientOcclusion].as_slice())
    );
}

#[test]
fn single_pictures_are_not_measured() {
    let mut window = Window::new(opened(still("a.m3d")), SLOW);
    for _ in 0..40 {
        window.event(0.0, &[orbit()]);
        window.event(0.5, &[LookCommand::ToggleLight.into()]);
    }
    assert_eq!(window.session.quality().passes(), Passes::all());
}

#[test]
fn a_clip_that_plays_is_measured() {
    let mut window = Window::new(opened(moving("a.m3d")), SLOW);
    for _ in 0..14 {
        window.session.advance(window.pass_secs);
        window.pass(0.0, &[]);
    }
    assert_eq!(window.degraded(), [Pass::AmbientOcclusion]);
}

#[test]
fn only_what_the_picture_has_is_left_out() {
    let contact = |look: LookCommand| {
        let mut session = opened(still("a.m3d"));
        session.apply(look);
        for _ in 0..60 {
            session.note_frame(SLOW);
        }
        !session.quality().passes().has(Pass::ContactShadow)
    };
    assert!(contact(LookCommand::SetLight(Light::Studio)));
    assert!(
        !contact(LookCommand::SetLight(Light::Book)),
        "the book has no contact shadow"
    );
    assert!(
        !contact(LookCommand::SetBackground(Background::None)),
        "nor has a picture without ground"
    );
}
