//! A picture at rest: while nothing moves, samples of it are drawn, a few in each pass of the window, until their mean is good.

use std::task::{Context, Poll};

use super::SessionPainter;
use crate::render::{Accumulator, Compositor, GpuAnswer, SampleCount, Target, watched};
use crate::session::Session;

/// The mean is of as many samples as a second has room for, but of so many at least. From there on it is shown.
const LEAST_SAMPLES: u32 = 8;
const SAMPLING_SECS: f64 = 1.0;
/// So many are drawn in a pass of the window.
const SAMPLES_A_PASS: u32 = 2;
/// Where the device has too little memory for the mean, the next try has this part of its width and height.
const SMALLER: f32 = 0.75;

/// The mean of a picture at rest, and what its samples are drawn into.
pub(super) struct Mean {
    pub(super) accumulator: Accumulator,
    target: Target,
    /// What the GPU has not confirmed yet.
    answer: Option<GpuAnswer>,
    /// When the first sample was drawn.
    since_secs: f64,
    /// It is shown from so many on.
    least: u32,
}

impl Mean {
    fn new(device: &wgpu::Device, [width, height]: [u32; 2]) -> Self {
        let ((accumulator, target), answer) = watched(device, || {
            let target = Target::with_samples(device, width, height, SampleCount::One);
            (Accumulator::new(device, &target), target)
        });
        Self {
            accumulator,
            target,
            answer: Some(answer),
            since_secs: 0.0,
            least: LEAST_SAMPLES,
        }
    }

    fn resize(&mut self, device: &wgpu::Device, size: [u32; 2]) {
        let ((), answer) = watched(device, || {
            self.target.resize(device, size, size);
            self.accumulator.follow(device, &self.target);
        });
        self.answer = Some(answer);
    }
}

/// The mean, once the device has memory for it and it is of enough samples to be shown.
pub(super) fn shown(mean: Option<&Mean>) -> Option<&Accumulator> {
    let mean = mean.filter(|mean| mean.answer.is_none() && mean.accumulator.count() >= mean.least)?;
    Some(&mean.accumulator)
}

impl SessionPainter {
    /// Whether the picture of now rests, and its mean is not of enough samples yet, or the GPU has not confirmed it.
    pub fn is_sampling(&self, session: &Session) -> bool {
        let quality = session.quality();
        let rests = self.is_current(session) && quality.is_at_rest() && !session.is_moving();
        let can = self.draws_means && quality.samples() > 1 && session.open_model().is_some();
        let Some(mean) = &self.mean else {
            return rests && can;
        };
        let count = mean.accumulator.count();
        let is_late = !quality.samples_are_chosen() && (self.now_secs)() - mean.since_secs > SAMPLING_SECS;
        let least = quality.samples().min(LEAST_SAMPLES);
        let lacks_samples = count < quality.samples() && (count < least || !is_late);
        rests && can && (lacks_samples || mean.answer.is_some())
    }

    /// How many samples the picture in the window is the mean of.
    pub fn samples(&self) -> u32 {
        shown(self.mean.as_ref()).map_or(1, Accumulator::count)
    }

    /// Adds some samples to the mean of a picture that rests.
    pub(super) fn draw_samples(&mut self, session: &mut Session, size: [u32; 2], compositor: &mut Compositor) {
        if !self.is_sampling(session) {
            return;
        }
        let device = self.device.clone();
        let mean = self.mean.get_or_insert_with(|| Mean::new(&device, size));
        if mean.target.size() != size {
            mean.resize(&device, size);
        }
        if let Some(mut answer) = mean.answer.take() {
            match answer.as_mut().poll(&mut Context::from_waker(&self.waker)) {
                Poll::Ready(Ok(())) => {}
                Poll::Ready(Err(_)) => {
                    // It has too little memory: the picture stays as it is, and a smaller one is tried.
                    self.affordable_at_rest *= SMALLER;
                    self.mean = None;
                    self.renderer.forget_samples();
                    return;
                }
                Poll::Pending => mean.answer = Some(answer),
            }
        }
        if mean.accumulator.count() == 0 {
            mean.since_secs = (self.now_secs)();
        }
        let samples = session.quality().samples();
        mean.least = samples.min(LEAST_SAMPLES);
        let frame = session.frame();
        for _ in 0..SAMPLES_A_PASS.min(samples.saturating_sub(mean.accumulator.count())) {
            self.renderer
                .accumulate(&frame, &mut mean.target, &mut mean.accumulator);
        }
        let drawn = if session.quality().smooths_edges_now() {
            &self.target
        } else {
            &self.plain_target
        };
        compositor.prepare(&device, &self.queue, drawn, shown(self.mean.as_ref()));
    }
}
