//! Which costly passes are drawn: what the person chose, or else what the device keeps up with.

use crate::scene::{Pass, Passes};

/// A frame that takes longer than this is a slow one: below 24 a second, motion stops looking like motion.
const SLOW_FRAME_SECS: f32 = 1.0 / 24.0;
/// Slow frames in a row after which a pass is left out. A few are forgiven: shaders compile, files load.
const SLOW_FRAMES: u32 = 12;
/// Nobody waits for twelve frames of a second each: so few are enough when they take as long as the next constant says.
const LEAST_SLOW_FRAMES: u32 = 6;
const SLOW_SECS: f32 = 1.5;

/// What to leave out first where frames are slow, by what that saves of a frame (`benches/frame.rs`). Reflections are not among
/// them: they are one lookup a pixel, and nothing can be measured to be saved by leaving them out.
const DEGRADE_ORDER: [Pass; 3] = [Pass::AmbientOcclusion, Pass::ContactShadow, Pass::Shadow];

/// Whether a pass is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum PassChoice {
    /// While the device keeps up.
    #[default]
    Auto,
    /// Always.
    On,
    /// Never.
    Off,
}

/// What became of a pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PassState {
    /// It is drawn.
    Drawn,
    /// The person left it out.
    Off,
    /// Left out, since frames took too long.
    TooSlow,
}

impl PassState {
    /// Name for programs.
    pub fn name(self) -> &'static str {
        match self {
            Self::Drawn => "drawn",
            Self::Off => "off",
            Self::TooSlow => "too slow",
        }
    }
}

/// The size of the view's picture in the window, as a fraction of the window's width and height in pixels. What is smaller than 1
/// is drawn faster and looks coarser. Pictures that are saved have the size that they are asked for in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RenderScale(f32);

impl RenderScale {
    /// Coarser than this nobody sees what it is.
    pub const LEAST: f32 = 0.1;

    /// Clamps to [`RenderScale::LEAST`] … 1. NaN is 1.
    pub fn new(fraction: f32) -> Self {
        Self(if fraction.is_nan() {
            1.0
        } else {
            fraction.clamp(Self::LEAST, 1.0)
        })
    }

    /// The fraction.
    pub fn fraction(self) -> f32 {
        self.0
    }
}

impl Default for RenderScale {
    fn default() -> Self {
        Self(1.0)
    }
}

/// A command about quality.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum QualityCommand {
    /// Whether a costly pass is drawn.
    SetPass(Pass, PassChoice),
    /// How fine the picture in the window is.
    SetRenderScale(RenderScale),
}

/// The passes of a session, and how fine its picture is.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Quality {
    render_scale: RenderScale,
    choices: [PassChoice; Pass::ALL.len()],
    /// Left out, since frames took too long.
    degraded: Vec<Pass>,
    /// In a row, and what they took together.
    slow_frames: u32,
    slow_secs: f32,
    /// The last pass of the window drew a frame of a motion, so the time until the next is that frame's.
    times_frame: bool,
}

impl Quality {
    /// What was chosen for a pass.
    pub fn choice(&self, pass: Pass) -> PassChoice {
        self.choices[pass as usize]
    }

    /// What became of a pass.
    pub fn state(&self, pass: Pass) -> PassState {
        match self.choice(pass) {
            PassChoice::On => PassState::Drawn,
            PassChoice::Off => PassState::Off,
            PassChoice::Auto if self.degraded.contains(&pass) => PassState::TooSlow,
            PassChoice::Auto => PassState::Drawn,
        }
    }

    /// Those that are drawn.
    pub fn passes(&self) -> Passes {
        Pass::ALL.into_iter().fold(Passes::none(), |passes, pass| {
            passes.with(pass, self.state(pass) == PassState::Drawn)
        })
    }

    /// Those that the person did not leave out, however long they take.
    pub fn wanted(&self) -> Passes {
        Pass::ALL.into_iter().fold(Passes::none(), |passes, pass| {
            passes.with(pass, self.choice(pass) != PassChoice::Off)
        })
    }

    /// How fine the picture in the window is.
    pub fn render_scale(&self) -> RenderScale {
        self.render_scale
    }

    pub(super) fn apply(&mut self, command: QualityCommand) {
        match command {
            QualityCommand::SetPass(pass, choice) => self.choose(pass, choice),
            QualityCommand::SetRenderScale(scale) => self.render_scale = scale,
        }
    }

    /// Chooses. A new choice of [`PassChoice::Auto`] gives the device another try.
    fn choose(&mut self, pass: Pass, choice: PassChoice) {
        self.choices[pass as usize] = choice;
        self.degraded.retain(|&degraded| degraded != pass);
        self.forgive();
    }

    /// Another model may be drawn faster: all its passes are tried again.
    pub(super) fn reset_for_model(&mut self) {
        self.degraded.clear();
        self.forgive();
    }

    /// The window drew a frame, of a motion or not.
    pub(super) fn frame_drawn(&mut self, of_motion: bool) {
        self.times_frame = of_motion;
    }

    /// Whether the time since the last pass of the window is what a frame took. Asked once a pass.
    pub(super) fn take_times_frame(&mut self) -> bool {
        std::mem::take(&mut self.times_frame)
    }

    /// Learns how long a frame of a motion took. Leaves out one pass at a time of those that were `drawn`, and waits to see what
    /// that brought.
    pub(super) fn note_frame(&mut self, frame_secs: f32, drawn: impl Fn(Pass) -> bool) {
        if frame_secs <= SLOW_FRAME_SECS || frame_secs.is_nan() {
            self.forgive();
            return;
        }
        self.slow_frames += 1;
        self.slow_secs += frame_secs;
        let very_slow = self.slow_frames >= LEAST_SLOW_FRAMES && self.slow_secs >= SLOW_SECS;
        if self.slow_frames < SLOW_FRAMES && !very_slow {
            return;
        }
        self.forgive();
        let mut saving = DEGRADE_ORDER.into_iter();
        let saving =
            saving.find(|&pass| drawn(pass) && self.choice(pass) == PassChoice::Auto && !self.degraded.contains(&pass));
        self.degraded.extend(saving);
    }

    /// Counts slow frames from here on.
    fn forgive(&mut self) {
        self.slow_frames = 0;
        self.slow_secs = 0.0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn slow_frames(quality: &mut Quality, count: u32) {
        for _ in 0..count {
            quality.note_frame(0.1, |_| true);
        }
    }

    #[test]
    fn passes_are_left_out_one_by_one_by_what_they_save_and_never_reflections() {
        let mut quality = Quality::default();
        let mut degraded = Vec::new();
        for _ in 0..DEGRADE_ORDER.len() {
            slow_frames(&mut quality, SLOW_FRAMES - 1);
            assert_eq!(quality.degraded, degraded, "a few slow frames are forgiven");
            slow_frames(&mut quality, 1);
            degraded.clone_from(&quality.degraded);
        }
        assert_eq!(degraded, [Pass::AmbientOcclusion, Pass::ContactShadow, Pass::Shadow]);
        slow_frames(&mut quality, 3 * SLOW_FRAMES);
        assert_eq!(quality.passes(), Passes::none().with(Pass::Environment, true));
    }

    #[test]
    fn what_the_picture_has_not_is_not_left_out() {
        let mut quality = Quality::default();
        for _ in 0..3 * SLOW_FRAMES {
            quality.note_frame(0.1, |pass| pass != Pass::ContactShadow);
        }
        assert_eq!(quality.degraded, [Pass::AmbientOcclusion, Pass::Shadow]);
    }

    #[test]
    fn frames_that_are_quick_in_between_keep_everything() {
        let mut quality = Quality::default();
        for _ in 0..100 {
            slow_frames(&mut quality, SLOW_FRAMES - 1);
            quality.note_frame(0.01, |_| true);
        }
        assert_eq!(quality.passes(), Passes::all());
    }

    #[test]
    fn very_slow_frames_are_not_waited_for() {
        let mut quality = Quality::default();
        // A tab that was out of sight, then shaders that compile.
        for secs in [60.0, 1.0, 1.0, 0.01] {
            quality.note_frame(secs, |_| true);
        }
        assert_eq!(quality.passes(), Passes::all());
        for frame in 1..=2 * LEAST_SLOW_FRAMES {
            quality.note_frame(0.5, |_| true);
            assert_eq!(quality.degraded.len() as u32, frame / LEAST_SLOW_FRAMES);
        }
    }

    #[test]
    fn a_choice_stands_above_what_the_device_keeps_up_with() {
        let mut quality = Quality::default();
        quality.choose(Pass::AmbientOcclusion, PassChoice::On);
        quality.choose(Pass::Shadow, PassChoice::Off);
        slow_frames(&mut quality, 5 * SLOW_FRAMES);
        assert_eq!(quality.state(Pass::AmbientOcclusion), PassState::Drawn);
        assert_eq!(quality.state(Pass::Shadow), PassState::Off);
        assert_eq!(quality.state(Pass::ContactShadow), PassState::TooSlow);
        quality.choose(Pass::ContactShadow, PassChoice::Auto);
        assert_eq!(quality.state(Pass::ContactShadow), PassState::Drawn, "another try");
    }
}
