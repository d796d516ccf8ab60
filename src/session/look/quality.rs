//! How finely the picture in the window is drawn: what the person chose, or else what the device keeps up with. A picture that rests
//! has all its detail; so have pictures that are saved.

use super::pacing::{Pacer, Step};
use crate::modes::modes;
use crate::scene::{Detail, FrameCost, Pass, Passes};

/// A picture rests when it did not move for so long. Short enough not to be waited for, long enough for a pointer that hesitates.
const REST_SECS: f32 = 0.15;

modes! {
    /// How much detail is drawn while the picture moves.
    #[derive(Default)]
    pub enum QualityMode {
        /// As much as the device keeps up with.
        #[default]
        Auto = "auto", "Auto";
        Full = "full", "Full";
        Low = "low", "Low";
    }
}

/// Whether a pass is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum PassChoice {
    #[default]
    Auto,
    On,
    Off,
}

/// What became of a pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PassState {
    Drawn,
    /// The person left it out.
    Off,
    /// Left out while the picture moves, since frames took too long.
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
    /// How much detail is drawn while the picture moves.
    SetMode(QualityMode),
    SetPass(Pass, PassChoice),
    /// How fine the picture in the window is at most.
    SetRenderScale(RenderScale),
    /// How often the display shows a picture, seconds.
    SetDisplayInterval(f32),
    /// Whether the device draws with its CPU.
    SetSlowDevice(bool),
    /// Of how many pictures one at rest, or one that is saved, is the mean.
    SetSamples(Option<u32>),
    /// Whether energy is to be saved: a battery drives the device, or the person wants less motion.
    SetSparing(bool),
}

/// Of so many pictures one at rest is the mean, where nothing else is asked for …
const SAMPLES: u32 = 64;
/// … and of so many where energy is saved.
const FEW_SAMPLES: u32 = 16;
/// More are not asked for.
pub const MOST_SAMPLES: u32 = 4096;

/// What is drawn less finely than it could be, while the picture moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lowered {
    /// Fraction of the picture's width and height.
    pub scale: f32,
    /// Whether edges are not smooth.
    pub without_smooth_edges: bool,
    /// Samples of ambient occlusion.
    pub occlusion: Detail,
    /// Taps of shadows.
    pub shadow: Detail,
    /// Whether ambient occlusion is left out.
    pub without_occlusion: bool,
    /// How long three of four frames took when that was last looked at, by the GPU where it tells, seconds; 0 before.
    pub frame_secs: f32,
}

/// What a picture shows of it: what is drawn, what the person chose, and how fine it is.
pub(in crate::session) type QualityNow = (Step, Passes, PassChoice, RenderScale, bool);

/// The passes of a session, and how fine its picture is.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Quality {
    mode: QualityMode,
    render_scale: RenderScale,
    choices: [PassChoice; Pass::ALL.len()],
    pacer: Pacer,
    /// The picture moves, or did a moment ago.
    in_motion: bool,
    /// There are several instances of the model.
    has_crowd: bool,
    /// Since it moved last.
    rested_secs: f32,
    /// The last pass of the window drew a frame of a motion, so the time until the next is that frame's.
    times_frame: bool,
    /// What the GPU took for a frame of late, if it tells.
    gpu_secs: Option<f32>,
    samples: Option<u32>,
    sparing: bool,
}

impl Quality {
    /// What was chosen.
    pub fn mode(&self) -> QualityMode {
        self.mode
    }

    /// What was chosen for a pass.
    pub fn choice(&self, pass: Pass) -> PassChoice {
        self.choices[pass as usize]
    }

    /// What became of a pass.
    pub fn state(&self, pass: Pass) -> PassState {
        match self.choice(pass) {
            PassChoice::On => PassState::Drawn,
            PassChoice::Off => PassState::Off,
            PassChoice::Auto if pass == Pass::AmbientOcclusion && !self.moving_step().draws_occlusion => {
                PassState::TooSlow
            }
            PassChoice::Auto => PassState::Drawn,
        }
    }

    /// Those that are drawn now.
    pub fn passes(&self) -> Passes {
        let step = self.step();
        let wanted = self.wanted();
        let is_left_out = !step.draws_occlusion && self.choice(Pass::AmbientOcclusion) == PassChoice::Auto;
        if is_left_out {
            wanted.with(Pass::AmbientOcclusion, false)
        } else {
            wanted
        }
    }

    /// Those that the person did not leave out, however long they take.
    pub fn wanted(&self) -> Passes {
        Pass::ALL.into_iter().fold(Passes::none(), |passes, pass| {
            passes.with(pass, self.choice(pass) != PassChoice::Off)
        })
    }

    /// How fine the picture in the window is at rest.
    pub fn render_scale(&self) -> RenderScale {
        self.render_scale
    }

    /// The fraction of the window's width and height in pixels that is drawn now.
    pub fn scale_now(&self) -> f32 {
        self.render_scale.fraction() * self.step().scale
    }

    /// Of how many pictures one that is saved is the mean. A device that draws with its CPU draws one, unless more are asked for.
    pub fn samples(&self) -> u32 {
        self.samples
            .unwrap_or_else(|| match (self.pacer.is_slow_device(), self.sparing) {
                (true, _) => 1,
                (false, true) => FEW_SAMPLES,
                (false, false) => SAMPLES,
            })
    }

    /// Whether idle moments are for what may be asked for next, and for finer light. On a device that draws with its CPU the next frame needs
    /// that time, unless more than one sample is asked for.
    pub fn works_ahead(&self) -> bool {
        !self.pacer.is_slow_device() || self.samples() > 1
    }

    /// Whether that many were asked for, however long they take.
    pub fn samples_are_chosen(&self) -> bool {
        self.samples.is_some()
    }

    /// Whether nothing moves, nor did a moment ago.
    pub fn is_at_rest(&self) -> bool {
        !self.in_motion
    }

    /// Whether pixels at edges are made of several samples now.
    pub fn smooths_edges_now(&self) -> bool {
        self.step().smooths_edges
    }

    /// How finely ambient occlusion and shadows are drawn now.
    pub(in crate::session) fn details_now(&self) -> [Detail; 2] {
        let step = self.step();
        [step.occlusion, step.shadow]
    }

    /// What of it the picture shows now.
    pub(in crate::session) fn now(&self) -> QualityNow {
        (
            self.step(),
            self.wanted(),
            self.choice(Pass::AmbientOcclusion),
            self.render_scale,
            self.poses_all(),
        )
    }

    /// Whether every instance of a crowd is posed anew, be it out of sight or small.
    pub(in crate::session) fn poses_all(&self) -> bool {
        !(self.in_motion && self.has_crowd) || self.mode == QualityMode::Full
    }

    /// What is less fine while the picture moves; none when nothing is.
    pub fn lowered(&self) -> Option<Lowered> {
        let step = self.moving_step();
        (step != Pacer::FINEST).then_some(Lowered {
            scale: step.scale,
            without_smooth_edges: !step.smooths_edges,
            occlusion: step.occlusion,
            shadow: step.shadow,
            without_occlusion: self.state(Pass::AmbientOcclusion) == PassState::TooSlow,
            frame_secs: self.pacer.frame_secs(),
        })
    }

    /// How long three of four frames took at most when that was last looked at, while the picture moved, seconds; 0 before.
    pub fn frame_secs(&self) -> f32 {
        self.pacer.frame_secs()
    }

    /// In how many seconds the picture rests, if nothing moves until then. None when it rests, or when it would be the same.
    pub fn rests_in_secs(&self) -> Option<f32> {
        let is_finer = self.moving_step() != Pacer::FINEST || self.samples() > 1;
        let will_differ = (self.in_motion && is_finer) || !self.poses_all();
        will_differ.then_some((REST_SECS - self.rested_secs).max(0.0))
    }

    /// What is drawn while the picture moves.
    fn moving_step(&self) -> Step {
        match self.mode {
            QualityMode::Auto => self.pacer.step(),
            QualityMode::Full => Pacer::FINEST,
            QualityMode::Low => Pacer::COARSEST,
        }
    }

    fn step(&self) -> Step {
        if self.in_motion {
            self.moving_step()
        } else {
            Pacer::FINEST
        }
    }

    /// As at first, on this device.
    pub(in crate::session) fn on_same_device(&self) -> Self {
        let mut pacer = self.pacer.clone();
        pacer.restart();
        Self {
            pacer,
            sparing: self.sparing,
            ..Self::default()
        }
    }

    pub(in crate::session) fn apply(&mut self, command: QualityCommand) {
        match command {
            QualityCommand::SetMode(mode) => {
                self.mode = mode;
                self.pacer.restart();
            }
            QualityCommand::SetPass(pass, choice) => {
                self.choices[pass as usize] = choice;
                // The device gets another try.
                self.pacer.restart();
            }
            QualityCommand::SetRenderScale(scale) => self.render_scale = scale,
            QualityCommand::SetDisplayInterval(secs) => self.pacer.set_display_secs(secs),
            QualityCommand::SetSlowDevice(slow) => self.pacer.set_slow_device(slow),
            QualityCommand::SetSamples(samples) => self.samples = samples.map(|count| count.clamp(1, MOST_SAMPLES)),
            QualityCommand::SetSparing(sparing) => self.sparing = sparing,
        }
    }

    /// Another model may be drawn faster: it begins with all detail.
    pub(in crate::session) fn reset_for_model(&mut self) {
        self.pacer.restart();
    }

    /// A pass of the window begins, so long after the one before, seconds.
    pub(in crate::session) fn begin_pass(&mut self, dt_secs: f32) {
        if std::mem::take(&mut self.times_frame) {
            self.pacer.note_frame(dt_secs, self.gpu_secs);
        } else if dt_secs > 0.0 {
            self.rested_secs += dt_secs;
        }
    }

    /// The picture, of a crowd or not, is about to be drawn, and moves or not.
    pub(in crate::session) fn follow(&mut self, moves: bool, has_crowd: bool) {
        self.has_crowd = has_crowd;
        if moves {
            self.rested_secs = 0.0;
        }
        let was_in_motion = self.in_motion;
        self.in_motion = moves || (was_in_motion && self.rested_secs < REST_SECS);
        if self.in_motion && !was_in_motion {
            self.pacer.begin_motion();
        }
    }

    /// The window drew a frame, of a motion or not.
    pub(in crate::session) fn frame_drawn(&mut self, of_motion: bool, cost: &FrameCost) {
        self.times_frame = of_motion;
        self.gpu_secs = cost.gpu_secs.map(|passes| passes.iter().sum());
    }
}
