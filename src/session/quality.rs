//! Which costly passes are drawn: what the person chose, or else what the device keeps up with.

use crate::scene::{Pass, Passes};

/// A frame that takes longer than this is a slow one: below 24 a second, motion stops looking like motion.
const SLOW_FRAME_SECS: f32 = 1.0 / 24.0;
/// Slow frames in a row after which the costliest pass is given up. A few are forgiven: shaders compile, files load.
const SLOW_FRAMES: u32 = 12;
/// Nobody waits for twelve frames of a second each: so few are enough when they take as long as the next constant says.
const LEAST_SLOW_FRAMES: u32 = 6;
const SLOW_SECS: f32 = 1.5;

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
    /// Given up, since frames took too long.
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

/// The passes of a session, and how fine its picture is.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Quality {
    pub(super) render_scale: RenderScale,
    choices: [PassChoice; Pass::ALL.len()],
    given_up: Vec<Pass>,
    slow_frames: u32,
    /// What the slow frames took together.
    slow_secs: f32,
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
            PassChoice::Auto if self.given_up.contains(&pass) => PassState::TooSlow,
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

    /// Chooses. A new choice of [`PassChoice::Auto`] gives the device another try.
    pub(super) fn choose(&mut self, pass: Pass, choice: PassChoice) {
        self.choices[pass as usize] = choice;
        self.given_up.retain(|&given_up| given_up != pass);
        self.forgive();
    }

    /// Another model may be drawn faster: what was given up for the one before is tried again.
    pub(super) fn take_up_model(&mut self) {
        self.given_up.clear();
        self.forgive();
    }

    /// Learns how long a frame took while the picture moved. Gives up one pass at a time, and waits to see what that brought.
    pub(super) fn note_frame(&mut self, frame_secs: f32) {
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
        let costliest = Pass::ALL
            .into_iter()
            .rev()
            .find(|&pass| self.choice(pass) == PassChoice::Auto && !self.given_up.contains(&pass));
        self.given_up.extend(costliest);
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
            quality.note_frame(0.1);
        }
    }

    #[test]
    fn passes_are_given_up_one_by_one_and_the_shadow_last() {
        let mut quality = Quality::default();
        let mut given_up = Vec::new();
        for _ in 0..Pass::ALL.len() {
            slow_frames(&mut quality, SLOW_FRAMES - 1);
            assert_eq!(quality.given_up, given_up, "a few slow frames are forgiven");
            slow_frames(&mut quality, 1);
            given_up.clone_from(&quality.given_up);
        }
        assert_eq!(
            given_up,
            [
                Pass::AmbientOcclusion,
                Pass::ContactShadow,
                Pass::Environment,
                Pass::Shadow
            ]
        );
        slow_frames(&mut quality, 3 * SLOW_FRAMES);
        assert_eq!(quality.passes(), Passes::none());
    }

    #[test]
    fn frames_that_are_quick_in_between_keep_everything() {
        let mut quality = Quality::default();
        for _ in 0..100 {
            slow_frames(&mut quality, SLOW_FRAMES - 1);
            quality.note_frame(0.01);
        }
        assert_eq!(quality.passes(), Passes::all());
    }

    #[test]
    fn very_slow_frames_are_not_waited_for() {
        let mut quality = Quality::default();
        // A tab that was out of sight, then shaders that compile.
        for secs in [60.0, 1.0, 1.0, 0.01] {
            quality.note_frame(secs);
        }
        assert_eq!(quality.passes(), Passes::all());
        for frame in 1..=2 * LEAST_SLOW_FRAMES {
            quality.note_frame(0.5);
            assert_eq!(quality.given_up.len() as u32, frame / LEAST_SLOW_FRAMES);
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
