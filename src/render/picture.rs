//! A picture by itself, of any size that the device can draw: complete, or an error.

use std::future::poll_fn;
use std::ops::Range;
use std::task::Poll;

use super::accumulator::Accumulator;
use super::affordable::{bytes_of_drawn, bytes_of_mean};
use super::band::Band;
use super::buffers::Queue;
use super::composite::Compositor;
use super::device::{GpuAnswer, GpuError, answer_at_once, watched};
use super::read_back::{Pending, ReadBackError};
use super::target::{SampleCount, Target, pixels};
use super::timing::FrameEncoder;
use super::uniforms::map_band;
use crate::scene::RenderFrame;

/// Why there is no picture.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PictureError {
    /// It has more pixels than the device takes.
    #[error("a picture of {width} × {height} pixels is too large: this GPU draws {largest}")]
    TooLarge {
        /// Pixels.
        width: u32,
        /// Pixels.
        height: u32,
        /// The largest that it draws, in words.
        largest: String,
    },
    /// The device has too little memory for it.
    #[error(
        "a picture of {width} × {height} pixels needs about {megabytes} MB of the GPU's memory, and less is free: a smaller \
         one may be drawn"
    )]
    OutOfMemory {
        /// Pixels.
        width: u32,
        /// Pixels.
        height: u32,
        megabytes: u64,
    },
    /// Something else went wrong.
    #[error("the picture could not be drawn: {0}")]
    Gpu(GpuError),
    /// It was drawn, and could not be read.
    #[error(transparent)]
    ReadBack(#[from] ReadBackError),
}

/// Pixels of all the pictures that a mean is made of: 64 of 3840 × 2160.
const MOST_SAMPLED: u64 = 64 * 3840 * 2160;
/// Of a large picture the mean is made of so many.
const LEAST_SAMPLES: u64 = 8;
/// Pixels of a picture that has a layer over it as well. A larger one is drawn in bands, by who can wait for them.
pub const MOST_UNDER_LAYER: u64 = 4096 * 4096;
/// Of a mean, what each pixel of the maps takes that its band has above and below it: normals, depth, ambient occlusion.
const BYTES_PER_MAP_PIXEL: u64 = 3 * 4;

/// What pictures of one size are drawn into, one after another: it is allocated once.
pub struct PictureTarget {
    size: [u32; 2],
    /// Those that are drawn next.
    rows: Range<u32>,
    samples: u32,
    waits: bool,
    /// `None` until the first picture.
    target: Option<Target>,
    /// `None` until the first mean.
    mean: Option<PictureMean>,
}

/// What the mean of many pictures is made with.
pub(super) struct PictureMean {
    pub(super) accumulator: Accumulator,
    /// Has the layer with what lies over the model.
    pub(super) over: Target,
    /// Brings both together.
    pub(super) compositor: Compositor,
}

impl PictureTarget {
    /// Of a size in pixels.
    pub fn new(size: [u32; 2]) -> Self {
        Self {
            rows: 0..size[1],
            size,
            samples: 1,
            waits: false,
            target: None,
            mean: None,
        }
    }

    /// Draws the mean of so many pictures with one sample a pixel each, as a window shows it at rest; with 1 a single one, as a window
    /// shows it that moves.
    #[must_use]
    pub fn with_mean_of(mut self, samples: u32) -> Self {
        self.samples = samples;
        self
    }

    /// Draws as many of a large picture too, and waits for the device between groups of them: for where a thread may
    /// wait, not on the web.
    #[must_use]
    pub fn waiting(mut self) -> Self {
        self.waits = true;
        self
    }

    /// Whether a device can draw the rows that come next, and hand them over.
    ///
    /// # Errors
    /// When it can not.
    pub fn check(&self, device: &wgpu::Device) -> Result<(), PictureError> {
        fits(&device.limits(), self.band())
    }

    /// Draws these rows of the picture next, and not all. The first is even.
    pub fn show(&mut self, rows: Range<u32>) {
        let has_room = |target: &Target| target.capacity()[1] as usize >= rows.len();
        if !self.target.as_ref().is_some_and(has_room) {
            (self.target, self.mean) = (None, None);
        }
        self.rows = rows;
    }

    fn band(&self) -> Band {
        Band {
            whole: self.size,
            first_row: self.rows.start,
            rows: self.rows.len() as u32,
        }
    }

    /// About how much it takes of the GPU's memory.
    pub(super) fn bytes(&self, frame: &RenderFrame<'_>, per_pixel: SampleCount) -> u64 {
        let (is_mean, own) = (self.samples_of(frame) > 1, pixels(self.band().size()));
        let sample = RenderFrame {
            sample: Some(0),
            ..frame.clone()
        };
        let beside = pixels(map_band(&sample, self.band()).size()) - own;
        own * bytes_per_pixel(per_pixel, is_mean) + beside * u64::from(is_mean) * BYTES_PER_MAP_PIXEL
    }

    /// How many pictures its next one is the mean of: of a large one fewer, so that the device answers in time,
    /// unless it waits.
    pub fn samples_of(&self, frame: &RenderFrame<'_>) -> u32 {
        let pixels = pixels(self.band().size());
        // A layer takes as much memory as the picture.
        let is_too_large = frame.has_overlays().contains(&true) && pixels > MOST_UNDER_LAYER;
        let most = (MOST_SAMPLED / pixels.max(1)).max(LEAST_SAMPLES) as u32;
        match is_too_large {
            true => 1,
            false if self.waits => self.samples,
            false => self.samples.min(most),
        }
    }

    /// After how many of them the device is waited for: as many as are drawn at once of a large one.
    pub(super) fn group(&self) -> u32 {
        let group = MOST_SAMPLED / LEAST_SAMPLES / pixels(self.band().size()).max(1);
        if self.waits { group.max(1) as u32 } else { u32::MAX }
    }
}

/// A picture that the device is drawing.
pub struct Picture {
    size: [u32; 2],
    /// What it takes of the GPU's memory.
    bytes: u64,
    answer: GpuAnswer,
    /// A pixel of the same target, read after the target was filled with white. GL does not report when it has no memory for a
    /// target: what is drawn into it is lost, and so is the white.
    proof: Pending,
    pixels: Pending,
}

impl Picture {
    /// Has `draw` draw into a target, watches the device meanwhile, and begins to read the pixels. So many `bytes` are needed.
    pub(super) fn start(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        (samples, bytes): (SampleCount, u64),
        into: &mut PictureTarget,
        draw: impl FnOnce(&mut Target, &mut Option<PictureMean>),
    ) -> Result<Self, PictureError> {
        let (size, band) = (into.size, into.band());
        into.check(device)?;
        let PictureTarget { target, mean, .. } = into;
        let ((proof, pixels), answer) = watched(device, || {
            let target = target.get_or_insert_with(|| Target::with_samples(device, size[0], band.rows, samples));
            target.show(band);
            target.fill(device, queue, wgpu::Color::WHITE);
            let proof = Pending::start(device, queue, target, [1, 1]);
            draw(target, mean);
            (proof, Pending::start(device, queue, target, band.size()))
        });
        Ok(Self {
            size,
            bytes,
            answer,
            proof,
            pixels,
        })
    }

    /// RGBA, 8 bits a channel, sRGB, straight alpha, rows from the top without padding. `pause` as in
    /// [`read_back`](super::read_back).
    ///
    /// # Errors
    /// When the device could not draw all of it.
    pub async fn pixels(mut self, pause: impl AsyncFn()) -> Result<Vec<u8>, PictureError> {
        let answer = self.answer.as_mut().await;
        self.check(answer)?;
        let proof = self.proof.wait(&pause).await?;
        self.check_proof(&proof)?;
        Ok(self.pixels.wait(&pause).await?)
    }

    /// As [`Picture::pixels`], for where a thread may wait: not on the web.
    ///
    /// # Errors
    /// When the device could not draw all of it.
    pub fn pixels_blocking(mut self) -> Result<Vec<u8>, PictureError> {
        let done: GpuAnswer = Box::pin(async { Ok(()) });
        let answer = answer_at_once(std::mem::replace(&mut self.answer, done));
        self.check(answer)?;
        self.check_proof(&self.proof.wait_blocking()?)?;
        Ok(self.pixels.wait_blocking()?)
    }

    fn check(&self, answer: Result<(), GpuError>) -> Result<(), PictureError> {
        answer.map_err(|error| match error {
            GpuError::OutOfMemory => self.out_of_memory(),
            GpuError::Refused(_) => PictureError::Gpu(error),
        })
    }

    fn check_proof(&self, proof: &[u8]) -> Result<(), PictureError> {
        if proof == [255; 4] {
            Ok(())
        } else {
            Err(self.out_of_memory())
        }
    }

    fn out_of_memory(&self) -> PictureError {
        let [width, height] = self.size;
        PictureError::OutOfMemory {
            width,
            height,
            megabytes: self.bytes.div_ceil(1_000_000),
        }
    }
}

/// Whether the device has memory for a mean and the target of its pictures. GL does not report when it has none, but
/// what is drawn is then lost: white goes through all of them, and a pixel of it is read back. Who waits asks again
/// and again.
pub fn prove(device: &wgpu::Device, queue: &wgpu::Queue, target: &Target, mean: &mut Accumulator) -> GpuAnswer {
    target.fill(device, queue, wgpu::Color::WHITE);
    let submit = |draw: &mut dyn FnMut(&mut FrameEncoder)| {
        let mut encoder = FrameEncoder::new(device, "proof");
        draw(&mut encoder);
        queue.submit([encoder.commands.finish()]);
    };
    for _ in 0..2 {
        submit(&mut |encoder| mean.add(device, &Queue::new(queue), encoder, target, false));
    }
    let mut compositor = Compositor::into_picture(device);
    compositor.prepare(device, queue, target, Some(mean));
    submit(&mut |encoder| compositor.paint(&mut target.begin_picture(encoder)));
    mean.restart();
    let pixel = Pending::start(device, queue, target, [1; 2]);
    Box::pin(poll_fn(move |_| match pixel.poll() {
        None => Poll::Pending,
        Some(Ok(pixel)) if pixel == [255; 4] => Poll::Ready(Ok(())),
        Some(_) => Poll::Ready(Err(GpuError::OutOfMemory)),
    }))
}

/// All that is drawn into, and the bytes that are read.
fn bytes_per_pixel(samples: SampleCount, is_mean: bool) -> u64 {
    let drawn = if is_mean {
        bytes_of_mean()
    } else {
        bytes_of_drawn(samples)
    };
    drawn + 4
}

/// Whether a device can draw this band of a picture and hand it over.
fn fits(limits: &wgpu::Limits, band: Band) -> Result<(), PictureError> {
    let [width, height] = band.whole;
    let too_large = |largest| PictureError::TooLarge { width, height, largest };
    let side = limits.max_texture_dimension_2d;
    if width.max(height) > side {
        return Err(too_large(format!("at most {side} pixels a side")));
    }
    let row_bytes = (u64::from(width) * 4).next_multiple_of(u64::from(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT));
    if row_bytes * u64::from(band.rows) > limits.max_buffer_size {
        let pixels = limits.max_buffer_size / 4;
        return Err(too_large(format!("at most {pixels} pixels in all")));
    }
    Ok(())
}
