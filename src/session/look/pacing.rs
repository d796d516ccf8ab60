//! Which detail a device keeps up with while the picture moves. Frames that take too long lower it step by step; frames that are quick
//! enough for a while raise it again, and a step that was too much is tried later each time.
//!
//! Where the GPU tells how long it took for a frame, that is judged: a page that is slow for other reasons is not helped by a coarser
//! picture. The time between frames then only bounds it, as a clock of the GPU may be wrong. Elsewhere the time between frames is judged.

use crate::scene::Detail;

/// Frames are to come this often where the display shows as many: more than 60 a second are not asked for.
pub(in crate::session) const TARGET_SECS: f32 = 1.0 / 60.0;
/// Frames that take so much longer than the target are too late.
const TOLERANCE: f32 = 1.25;
/// The GPU's times are to be this much of the target: the panels, and bringing all onto the page, are not timed.
const GPU_SHARE: f32 = 0.9;
/// Frames are judged together: so many, or as many as fit this time when each takes long.
const WINDOW_FRAMES: usize = 12;
const WINDOW_SECS: f32 = 1.0;
const LEAST_FRAMES: usize = 3;
/// Three of four frames are to come in time.
const PERCENTILE: f32 = 0.75;
/// The first frames with another detail make textures and pipelines: they are not judged.
const SETTLING_FRAMES: u32 = 2;
/// The GPU's times are those of a frame so many frames ago, or fewer.
const GPU_LAG_FRAMES: u32 = 3;
/// A frame that took so much longer than the others was held up by something else: files load, a tab was hidden.
const STALL: f32 = 4.0;
const LEAST_STALL_SECS: f32 = 0.25;
const LONGEST_FRAME_SECS: f32 = 4.0;
/// How long frames come in time before more detail is tried; each try that fails doubles it.
const FIRST_WAIT_SECS: f32 = 2.0;
const LONGEST_WAIT_SECS: f32 = 60.0;
/// When even the least detail saves less of a frame than this, something else than drawing takes the time.
const LEAST_SAVING: f32 = 0.1;

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// Fraction of the picture's width and height.
    pub scale: f32,
    pub occlusion: Detail,
    pub shadow: Detail,
    pub draws_occlusion: bool,
    /// Whether pixels at edges are made of several samples.
    pub smooths_edges: bool,
}

const FULL: Step = Step {
    scale: 1.0,
    occlusion: Detail::Full,
    shadow: Detail::Full,
    draws_occlusion: true,
    smooths_edges: true,
};
const PLAIN: Step = Step {
    smooths_edges: false,
    ..FULL
};
const HALF: Step = Step { scale: 0.5, ..PLAIN };

/// From the finest to the coarsest: first one sample a pixel, which halves what is written, then fewer pixels, which the compositor filters,
/// then fewer samples of ambient occlusion, fewer taps of shadows, no ambient occlusion. Reflections stay: they are one lookup a pixel.
const STEPS: [Step; 9] = [
    FULL,
    PLAIN,
    Step { scale: 0.85, ..PLAIN },
    Step { scale: 0.7, ..PLAIN },
    Step { scale: 0.6, ..PLAIN },
    HALF,
    Step {
        occlusion: Detail::Low,
        ..HALF
    },
    Step {
        occlusion: Detail::Low,
        shadow: Detail::Low,
        ..HALF
    },
    Step {
        occlusion: Detail::Low,
        shadow: Detail::Low,
        draws_occlusion: false,
        ..HALF
    },
];
/// The last step that has fewer pixels than the one before.
const COARSEST_SCALE: usize = 5;

/// Judges how long frames of a moving picture take.
#[derive(Clone, Debug, PartialEq)]
pub struct Pacer {
    step: usize,
    /// The step of another model, or of a device that is known to be slow.
    first_step: usize,
    target_secs: f32,
    /// Intervals of frames that are not judged yet, and the GPU's times for them.
    window: Vec<f32>,
    gpu_window: Vec<f32>,
    /// Frames that are not judged at all.
    settling: u32,
    /// Frames whose GPU times are still those of before.
    gpu_lag: u32,
    stalled: bool,
    /// How long frames came in time, and how long they have to before a finer step is tried.
    in_time_secs: f32,
    wait_secs: f32,
    /// The step before was coarser, and nobody knows yet whether this one is too fine.
    tries: bool,
    /// How long frames took when the first of the steps was taken down that led here.
    before_secs: Option<f32>,
    /// How long frames took in the last window, by the GPU or by the time between them.
    frame_secs: f32,
    by_gpu: bool,
}

impl Default for Pacer {
    fn default() -> Self {
        Self {
            step: 0,
            first_step: 0,
            target_secs: TARGET_SECS,
            window: Vec::new(),
            gpu_window: Vec::new(),
            settling: SETTLING_FRAMES,
            gpu_lag: GPU_LAG_FRAMES,
            stalled: false,
            in_time_secs: 0.0,
            wait_secs: FIRST_WAIT_SECS,
            tries: false,
            before_secs: None,
            frame_secs: 0.0,
            by_gpu: false,
        }
    }
}

impl Pacer {
    /// What is drawn at the coarsest step.
    pub const COARSEST: Step = STEPS[STEPS.len() - 1];
    pub const FINEST: Step = FULL;

    /// What to draw while the picture moves. A device that draws with its CPU has few taps of shadows at every step.
    pub fn step(&self) -> Step {
        let mut step = STEPS[self.step];
        if self.is_slow_device() {
            step.shadow = Detail::Low;
        }
        step
    }

    /// How long three of four of the frames took that were judged last, seconds; 0 before.
    pub(in crate::session) fn frame_secs(&self) -> f32 {
        self.frame_secs
    }

    /// Learns how often the display shows a picture, seconds. Frames cannot come more often.
    pub fn set_display_secs(&mut self, display_secs: f32) {
        if display_secs.is_finite() {
            self.target_secs = display_secs.max(TARGET_SECS);
        }
    }

    /// Learns that the device draws with its CPU: it begins with few pixels.
    pub fn set_slow_device(&mut self, slow: bool) {
        self.first_step = if slow { COARSEST_SCALE } else { 0 };
        self.restart();
    }

    /// Whether it does.
    pub(in crate::session) fn is_slow_device(&self) -> bool {
        self.first_step > 0
    }

    /// Begins anew, as for another model.
    pub fn restart(&mut self) {
        *self = Self {
            step: self.first_step,
            first_step: self.first_step,
            target_secs: self.target_secs,
            ..Self::default()
        };
    }

    /// The picture begins to move. Its first frame may have to wait for the device.
    pub fn begin_motion(&mut self) {
        self.settling = self.settling.max(1);
        self.gpu_lag = GPU_LAG_FRAMES;
    }

    /// Learns the time between two frames of a moving picture, and the GPU's time for a frame if it tells any, seconds.
    pub fn note_frame(&mut self, frame_secs: f32, gpu_secs: Option<f32>) {
        if frame_secs.is_nan() || frame_secs > LONGEST_FRAME_SECS {
            return;
        }
        let settles = self.settling > 0 || (gpu_secs.is_some() && self.gpu_lag > 0);
        self.settling = self.settling.saturating_sub(1);
        self.gpu_lag = self.gpu_lag.saturating_sub(1);
        if settles {
            return;
        }
        let usual_secs = percentile(&self.window, 0.5);
        let is_stall = self.window.len() >= LEAST_FRAMES && frame_secs > (STALL * usual_secs).max(LEAST_STALL_SECS);
        // What comes after a stall is late because of it. Stalls one after another are the device's pace.
        if std::mem::replace(&mut self.stalled, is_stall) != is_stall {
            return;
        }
        self.window.push(frame_secs);
        self.gpu_window.extend(gpu_secs);
        let window_secs: f32 = self.window.iter().sum();
        let is_long = window_secs >= WINDOW_SECS && self.window.len() >= LEAST_FRAMES;
        if is_long || self.window.len() >= WINDOW_FRAMES {
            self.frame_secs = percentile(&self.window, PERCENTILE);
            self.by_gpu = !self.gpu_window.is_empty();
            if self.by_gpu {
                self.frame_secs = self.frame_secs.min(percentile(&self.gpu_window, PERCENTILE));
            }
            self.window.clear();
            self.gpu_window.clear();
            self.judge(window_secs);
        }
    }

    fn judge(&mut self, window_secs: f32) {
        let most = if self.by_gpu { GPU_SHARE } else { TOLERANCE };
        if self.frame_secs > self.target_secs * most {
            self.lower();
            return;
        }
        if std::mem::take(&mut self.tries) {
            // The finer step holds.
            self.wait_secs = FIRST_WAIT_SECS;
        }
        self.before_secs = None;
        self.in_time_secs += window_secs;
        if self.in_time_secs >= self.wait_secs && self.step > 0 {
            self.tries = true;
            self.go_to(self.step - 1);
        }
    }

    fn lower(&mut self) {
        let failed = std::mem::take(&mut self.tries);
        self.in_time_secs = 0.0;
        let before_secs = *self.before_secs.get_or_insert(self.frame_secs);
        if failed {
            self.wait_secs = (self.wait_secs * 2.0).min(LONGEST_WAIT_SECS);
        }
        let last = STEPS.len() - 1;
        if self.step < last {
            self.go_to(self.coarser());
        } else if self.step > self.first_step && self.frame_secs > before_secs * (1.0 - LEAST_SAVING) {
            // The picture was made coarser for nothing.
            self.before_secs = None;
            self.go_to(self.first_step);
            self.settling = (LONGEST_WAIT_SECS / self.frame_secs) as u32;
        }
    }

    /// The next step, or the first whose pixels are few enough if their number decides.
    fn coarser(&self) -> usize {
        let next = self.step + 1;
        let share = if self.by_gpu { GPU_SHARE } else { 1.0 };
        // One sample a pixel takes half of the time of four, or more.
        let faster = if self.step == 0 { 2.0 } else { 1.0 };
        let part = self.target_secs * share * faster / self.frame_secs;
        if next > COARSEST_SCALE || (self.step == 0 && part >= 1.0) {
            return next;
        }
        let wanted = self.step().scale * part.sqrt();
        let fits = (next..COARSEST_SCALE).find(|&step| STEPS[step].scale <= wanted);
        fits.unwrap_or(COARSEST_SCALE)
    }

    fn go_to(&mut self, step: usize) {
        self.step = step;
        self.in_time_secs = 0.0;
        self.settling = SETTLING_FRAMES;
        self.gpu_lag = GPU_LAG_FRAMES;
    }
}

/// The value that this fraction of all does not exceed; 0 without any.
fn percentile(values: &[f32], fraction: f32) -> f32 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f32::total_cmp);
    let index = (fraction * sorted.len() as f32).ceil() as usize;
    sorted.get(index.saturating_sub(1)).copied().unwrap_or(0.0)
}
