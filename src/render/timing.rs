//! How long the GPU takes for each pass, in its own time. Nobody waits for an answer: it comes some frames later, and a frame that
//! finds no room for its own is not timed.

use std::sync::mpsc::{Receiver, TryRecvError, channel};

use super::buffers::buffer;
use crate::scene::TimedPass;

/// Seconds for each of [`TimedPass::ALL`].
pub(super) type PassSecs = [f32; TimedPass::ALL.len()];

/// Frames whose answers may be under way at once: browsers have two or three in flight.
const FRAMES: usize = 3;
/// More passes than a frame has. Those beyond are not timed.
const MOST_PASSES: usize = 32;
/// When a pass begins and when it ends.
const STAMPS_PER_PASS: u32 = 2;
const BYTES: u64 = MOST_PASSES as u64 * STAMPS_PER_PASS as u64 * wgpu::QUERY_SIZE as u64;

/// Commands of a frame. Its passes note when they begin and end, where somebody asked for it.
pub(super) struct FrameEncoder {
    pub(super) commands: wgpu::CommandEncoder,
    queries: Option<wgpu::QuerySet>,
    /// Those that were timed.
    passes: Vec<TimedPass>,
}

impl FrameEncoder {
    /// With the times of a timer, where there is one.
    pub(super) fn timed(device: &wgpu::Device, label: &str, timer: &mut Option<FrameTimer>) -> Self {
        let mut encoder = Self::new(device, label);
        if let Some(timer) = timer {
            timer.begin_frame(&mut encoder);
        }
        encoder
    }

    /// Submits it, and tells the latest times of its timer.
    pub(super) fn submit(self, queue: &wgpu::Queue, timer: &mut Option<FrameTimer>) -> Option<PassSecs> {
        let Some(timer) = timer else {
            queue.submit([self.commands.finish()]);
            return None;
        };
        timer.submit(queue, self);
        timer.latest
    }

    /// Without times.
    pub(super) fn new(device: &wgpu::Device, label: &str) -> Self {
        Self {
            commands: device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some(label) }),
            queries: None,
            passes: Vec::new(),
        }
    }

    pub(super) fn begin_pass(
        &mut self,
        pass: TimedPass,
        descriptor: &wgpu::RenderPassDescriptor<'_>,
    ) -> wgpu::RenderPass<'_> {
        let queries = self.queries.as_ref().filter(|_| self.passes.len() < MOST_PASSES);
        let timestamp_writes = queries.map(|query_set| {
            let begin = self.passes.len() as u32 * STAMPS_PER_PASS;
            self.passes.push(pass);
            wgpu::RenderPassTimestampWrites {
                query_set,
                beginning_of_pass_write_index: Some(begin),
                end_of_pass_write_index: Some(begin + 1),
            }
        });
        self.commands.begin_render_pass(&wgpu::RenderPassDescriptor {
            timestamp_writes,
            ..descriptor.clone()
        })
    }
}

/// Times frames on a device that can.
pub(super) struct FrameTimer {
    queries: wgpu::QuerySet,
    resolved: wgpu::Buffer,
    secs_per_tick: f64,
    answers: [Answer; FRAMES],
    /// The times of the last frame that was answered; none before.
    latest: Option<PassSecs>,
}

/// A buffer for the times of one frame.
struct Answer {
    buffer: wgpu::Buffer,
    pending: Option<Pending>,
}

struct Pending {
    /// Those whose times are to come, in their order.
    passes: Vec<TimedPass>,
    outcome: Receiver<Result<(), wgpu::BufferAsyncError>>,
}

impl FrameTimer {
    /// None where the device tells no times.
    pub(super) fn new(device: &wgpu::Device, queue: &wgpu::Queue) -> Option<Self> {
        if !device.features().contains(wgpu::Features::TIMESTAMP_QUERY) {
            return None;
        }
        let of_times = |label, usage| buffer(device, label, BYTES, usage);
        Some(Self {
            queries: device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("times of passes"),
                ty: wgpu::QueryType::Timestamp,
                count: MOST_PASSES as u32 * STAMPS_PER_PASS,
            }),
            resolved: of_times(
                "times of passes",
                wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC,
            ),
            secs_per_tick: f64::from(queue.get_timestamp_period()) * 1e-9,
            answers: std::array::from_fn(|_| Answer {
                buffer: of_times("times of passes, read back", wgpu::BufferUsages::MAP_READ),
                pending: None,
            }),
            latest: None,
        })
    }

    /// Takes up the answers that have come, and has the frame timed if there is room for its own.
    fn begin_frame(&mut self, encoder: &mut FrameEncoder) {
        for answer in &mut self.answers {
            if let Some(secs) = answer.take(self.secs_per_tick) {
                self.latest = Some(secs);
            }
        }
        if self.answers.iter().any(|answer| answer.pending.is_none()) {
            encoder.queries = Some(self.queries.clone());
        }
    }

    /// Submits the frame, and asks for its times.
    fn submit(&mut self, queue: &wgpu::Queue, encoder: FrameEncoder) {
        let FrameEncoder {
            mut commands, passes, ..
        } = encoder;
        let free = self.answers.iter_mut().find(|answer| answer.pending.is_none());
        let Some(answer) = free.filter(|_| !passes.is_empty()) else {
            queue.submit([commands.finish()]);
            return;
        };
        let stamps = passes.len() as u32 * STAMPS_PER_PASS;
        let bytes = u64::from(stamps * wgpu::QUERY_SIZE);
        commands.resolve_query_set(&self.queries, 0..stamps, &self.resolved, 0);
        commands.copy_buffer_to_buffer(&self.resolved, 0, &answer.buffer, 0, bytes);
        queue.submit([commands.finish()]);
        let (tell, outcome) = channel();
        answer.buffer.map_async(wgpu::MapMode::Read, ..bytes, move |result| {
            // Fails when the timer is gone.
            let _ = tell.send(result);
        });
        answer.pending = Some(Pending { passes, outcome });
    }
}

impl Answer {
    /// The times, if they have come. Then the buffer is free again.
    fn take(&mut self, secs_per_tick: f64) -> Option<PassSecs> {
        let Pending { passes, outcome } = self.pending.as_ref()?;
        let outcome = outcome.try_recv();
        if outcome == Err(TryRecvError::Empty) {
            return None;
        }
        let mut secs = None;
        // Else the device is lost.
        if outcome == Ok(Ok(())) {
            let bytes = ..passes.len() as u64 * u64::from(STAMPS_PER_PASS * wgpu::QUERY_SIZE);
            if let Ok(mapped) = self.buffer.get_mapped_range(bytes) {
                let (stamps, _) = mapped.as_chunks();
                let stamps: Vec<_> = stamps.iter().map(|stamp| u64::from_le_bytes(*stamp)).collect();
                secs = Some(sums(passes, &stamps, secs_per_tick));
            }
            self.buffer.unmap();
        }
        self.pending = None;
        secs
    }
}

/// Sums the times of each pass. Where a pass begins before the one before it ends, that time is counted once: the sum is never more than
/// the frame took.
pub fn sums(passes: &[TimedPass], stamps: &[u64], secs_per_tick: f64) -> PassSecs {
    let mut sums = PassSecs::default();
    let mut counted_until = 0;
    for (pass, stamps) in passes.iter().zip(stamps.chunks_exact(STAMPS_PER_PASS as usize)) {
        let begin = stamps[0].max(counted_until);
        // Some clocks go backwards when the GPU changes its speed.
        let ticks = stamps[1].saturating_sub(begin);
        counted_until = counted_until.max(stamps[1]);
        sums[*pass as usize] += (ticks as f64 * secs_per_tick) as f32;
    }
    sums
}
