//! A picture at rest: while nothing moves, samples of it are drawn, a few in each pass of the window, until their mean is good.

use std::task::{Context, Poll, Waker};

use crate::render::{Accumulator, GpuAnswer, Renderer, SampleCount, Target, prove, watched};
use crate::scene::{FrameCost, RenderFrame};
use crate::session::Session;

/// The mean is of as many samples as a second has room for, by the GPU's time where it tells any, but of so many at
/// least. From there on it is shown.
const LEAST_SAMPLES: u32 = 8;
const SAMPLING_SECS: f64 = 1.0;
/// So many are drawn in a pass of the window.
const SAMPLES_A_PASS: u32 = 2;
/// Where the device has too little memory for the mean, the next try has this part of its width and height.
const SMALLER: f32 = 0.75;

/// The mean of the picture in the window.
pub(super) struct AtRest {
    /// Whether the device can draw one.
    pub(super) draws_means: bool,
    /// Made when the first picture rests.
    mean: Option<Mean>,
    /// The part of the window's width and height that the device has memory for.
    affordable: f32,
}

/// The mean, and what its samples are drawn into.
struct Mean {
    accumulator: Accumulator,
    target: Target,
    /// What the GPU has not confirmed yet.
    answer: Option<GpuAnswer>,
    /// When the first sample was drawn.
    since_secs: f64,
    /// It is shown from so many on.
    least: u32,
}

impl Mean {
    fn new(device: &wgpu::Device, queue: &wgpu::Queue, [width, height]: [u32; 2]) -> Self {
        let ((accumulator, target, proof), answer) = watched(device, || {
            let target = Target::with_samples(device, width, height, SampleCount::One).with_layer();
            let mut accumulator = Accumulator::new(device, &target);
            let proof = prove(device, queue, &target, &mut accumulator);
            (accumulator, target, proof)
        });
        Self {
            accumulator,
            target,
            answer: Some(both(answer, proof)),
            since_secs: 0.0,
            least: LEAST_SAMPLES,
        }
    }

    fn resize(&mut self, device: &wgpu::Device, queue: &wgpu::Queue, size: [u32; 2]) {
        let (proof, answer) = watched(device, || {
            let stayed = self.target.resize(device, size, size);
            self.accumulator.follow(device, &self.target);
            (!stayed).then(|| prove(device, queue, &self.target, &mut self.accumulator))
        });
        self.answer = proof.map(|proof| both(answer, proof));
    }
}

/// The device reported nothing, and what was drawn is there.
fn both(answer: GpuAnswer, proof: GpuAnswer) -> GpuAnswer {
    Box::pin(async {
        answer.await?;
        proof.await
    })
}

impl AtRest {
    pub(super) fn new(draws_means: bool) -> Self {
        Self {
            draws_means,
            mean: None,
            affordable: 1.0,
        }
    }

    /// By how much the sides of the mean are smaller than those of a window of this size in pixels: at most 1.
    pub(super) fn affordable_scale(&self, window: [u32; 2]) -> f32 {
        Target::affordable_mean_scale(window).min(self.affordable)
    }

    /// Another scene begins.
    pub(super) fn restart(&mut self) {
        if let Some(mean) = &mut self.mean {
            mean.accumulator.restart();
        }
    }

    /// Gives the GPU's memory back.
    pub(super) fn forget(&mut self) {
        self.mean = None;
    }

    /// The mean, once the device has memory for it and it is of enough samples to be shown.
    pub(super) fn shown(&self) -> Option<&Accumulator> {
        let mean = self.mean.as_ref();
        let mean = mean.filter(|mean| mean.answer.is_none() && mean.accumulator.count() >= mean.least)?;
        Some(&mean.accumulator)
    }

    /// The target whose layer lies over what is shown, and the mean in place of its picture, if it is shown. The picture that was drawn by
    /// itself has a layer with smoother shapes, but in a large window its pixels are coarser.
    pub(super) fn shown_over<'a>(&'a self, drawn: &'a Target) -> (&'a Target, Option<&'a Accumulator>) {
        let shown = self.shown();
        match &self.mean {
            Some(mean) if shown.is_some() && mean.target.size() != drawn.size() => (&mean.target, shown),
            _ => (drawn, shown),
        }
    }

    /// Draws what lies over the model over the mean, if the mean is shown and the picture that was drawn by itself has another size.
    pub(super) fn draw_over(
        &mut self,
        renderer: &mut Renderer,
        frame: &RenderFrame<'_>,
        drawn: [u32; 2],
    ) -> Option<FrameCost> {
        let is_shown = self.shown().is_some();
        let mean = self.mean.as_mut()?;
        (is_shown && mean.target.size() != drawn).then(|| renderer.render_over_mean(frame, &mut mean.target))
    }

    /// Whether the session's picture rests, and the mean is not of enough samples yet, or the GPU has not confirmed it.
    pub(super) fn lacks_samples(&self, session: &Session, now_secs: f64) -> bool {
        let quality = session.quality();
        if !self.draws_means
            || quality.samples() < 2
            || !quality.is_at_rest()
            || session.is_moving()
            || session.open_model().is_none()
        {
            return false;
        }
        let Some(mean) = &self.mean else { return true };
        let count = mean.accumulator.count();
        let drawn_secs = mean.accumulator.gpu_secs().map(f64::from);
        let is_late = !quality.samples_are_chosen() && drawn_secs.unwrap_or(now_secs - mean.since_secs) > SAMPLING_SECS;
        let least = quality.samples().min(LEAST_SAMPLES);
        mean.answer.is_some() || (count < quality.samples() && (count < least || !is_late))
    }

    /// Adds some samples of the session's picture, in this size in pixels where the picture by itself has the other, of a window so high in
    /// points. The waker is woken when the GPU has answered.
    pub(super) fn draw(
        &mut self,
        (device, queue, renderer): (&wgpu::Device, &wgpu::Queue, &mut Renderer),
        session: &mut Session,
        ([size, drawn], points_high): ([[u32; 2]; 2], Option<f32>),
        now_secs: f64,
        waker: &Waker,
    ) {
        let mean = self.mean.get_or_insert_with(|| Mean::new(device, queue, size));
        if mean.target.size() != size {
            mean.resize(device, queue, size);
        }
        if let Some(mut answer) = mean.answer.take() {
            match answer.as_mut().poll(&mut Context::from_waker(waker)) {
                Poll::Ready(Ok(())) => {}
                Poll::Ready(Err(_)) => {
                    // It has too little memory: the picture stays as it is, and a smaller one is tried.
                    self.affordable *= SMALLER;
                    self.mean = None;
                    renderer.forget_samples();
                    return;
                }
                Poll::Pending => mean.answer = Some(answer),
            }
        }
        if mean.accumulator.count() == 0 {
            mean.since_secs = now_secs;
        }
        let samples = session.quality().samples();
        mean.least = samples.min(LEAST_SAMPLES);
        let mut frame = session.frame();
        frame.options.points_high = points_high;
        for _ in 0..SAMPLES_A_PASS.min(samples.saturating_sub(mean.accumulator.count())) {
            renderer.accumulate(&frame, &mut mean.target, &mut mean.accumulator);
        }
        if mean.target.lacks_layer(frame.has_overlays()) {
            self.draw_over(renderer, &frame, drawn);
        }
    }
}
