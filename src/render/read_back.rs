//! A target's picture as bytes.

use std::sync::mpsc::{Receiver, RecvTimeoutError, TryRecvError, channel};
use std::time::Duration;

use super::buffers::buffer;
use super::target::Target;
use crate::scene::{linear_from_srgb8, srgb8_from_linear};

const BYTES_PER_PIXEL: u32 = 4;

/// Why a picture could not be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ReadBackError {
    /// The device is gone or out of memory.
    #[error("the picture could not be read back from the GPU: {0}")]
    Gpu(String),
}

/// Reads a target's picture: RGBA, 8 bits a channel, sRGB, straight alpha, rows from the top without padding.
///
/// `pause` is awaited until the GPU is done. A page must give its event loop a turn there, since WebGL reports nothing within one;
/// a native caller can use [`read_back_blocking`].
pub async fn read_back(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    target: &Target,
    pause: impl AsyncFn(),
) -> Result<Vec<u8>, ReadBackError> {
    Pending::start(device, queue, target, target.size()).wait(&pause).await
}

/// As [`read_back`], for where a thread may wait: not on the web.
///
/// Several threads may read from one device. One thread's wait on the device may then collect another thread's answer and hand it
/// over a moment later. So this waits for the answer itself, not for the device alone.
pub fn read_back_blocking(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    target: &Target,
) -> Result<Vec<u8>, ReadBackError> {
    Pending::start(device, queue, target, target.size()).wait_blocking()
}

/// How long to wait for the answer before the device is asked again.
const ANSWER_WAIT: Duration = Duration::from_millis(10);

const NO_ANSWER: &str = "it gave no answer";

type Outcome = Result<(), wgpu::BufferAsyncError>;

/// A copy from the GPU that is under way.
pub(super) struct Pending {
    device: wgpu::Device,
    buffer: wgpu::Buffer,
    row_bytes: usize,
    padded_row_bytes: usize,
    outcome: Receiver<Outcome>,
}

impl Pending {
    /// Starts to copy a rectangle of this size from the target's top left corner.
    pub(super) fn start(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        target: &Target,
        [width, height]: [u32; 2],
    ) -> Self {
        let row_bytes = width * BYTES_PER_PIXEL;
        let padded_row_bytes = row_bytes.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let bytes = u64::from(padded_row_bytes) * u64::from(height);
        let buffer = buffer(device, "read back", bytes, wgpu::BufferUsages::MAP_READ);
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor {
            label: Some("read back"),
        });
        encoder.copy_texture_to_buffer(
            target.texture().as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &buffer,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(padded_row_bytes),
                    rows_per_image: None,
                },
            },
            wgpu::Extent3d {
                width,
                height,
                depth_or_array_layers: 1,
            },
        );
        queue.submit([encoder.finish()]);
        let (answer, outcome) = channel();
        buffer.map_async(wgpu::MapMode::Read, .., move |result| {
            // Fails when the caller gave up waiting.
            let _ = answer.send(result);
        });
        Self {
            device: device.clone(),
            buffer,
            row_bytes: row_bytes as usize,
            padded_row_bytes: padded_row_bytes as usize,
            outcome,
        }
    }

    /// See [`read_back`].
    pub(super) async fn wait(&self, pause: &impl AsyncFn()) -> Result<Vec<u8>, ReadBackError> {
        loop {
            match self.poll() {
                Some(pixels) => return pixels,
                None => pause().await,
            }
        }
    }

    /// The pixels, if they have come.
    pub(super) fn poll(&self) -> Option<Result<Vec<u8>, ReadBackError>> {
        if let Err(error) = self.device.poll(wgpu::PollType::Poll) {
            return Some(Err(gpu_error(error)));
        }
        match self.outcome.try_recv() {
            Ok(outcome) => Some(self.finish(outcome)),
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => Some(Err(gpu_error(NO_ANSWER))),
        }
    }

    /// See [`read_back_blocking`].
    pub(super) fn wait_blocking(&self) -> Result<Vec<u8>, ReadBackError> {
        loop {
            let wait = wgpu::PollType::wait_indefinitely();
            self.device.poll(wait).map_err(gpu_error)?;
            match self.outcome.recv_timeout(ANSWER_WAIT) {
                Ok(outcome) => return self.finish(outcome),
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => return Err(gpu_error(NO_ANSWER)),
            }
        }
    }

    fn finish(&self, outcome: Outcome) -> Result<Vec<u8>, ReadBackError> {
        outcome.map_err(gpu_error)?;
        let mapped = self.buffer.get_mapped_range(..).map_err(gpu_error)?;
        let rows = mapped.chunks_exact(self.padded_row_bytes);
        let mut pixels: Vec<u8> = rows.flat_map(|row| &row[..self.row_bytes]).copied().collect();
        for pixel in pixels.chunks_exact_mut(BYTES_PER_PIXEL as usize) {
            make_alpha_straight(pixel);
        }
        Ok(pixels)
    }
}

fn gpu_error(error: impl std::fmt::Display) -> ReadBackError {
    ReadBackError::Gpu(error.to_string())
}

/// Divides a pixel's colour by its alpha, in linear light as it was multiplied.
pub fn make_alpha_straight(pixel: &mut [u8]) {
    if let [red, green, blue, alpha @ 1..=254] = pixel {
        let opacity = f32::from(*alpha) / 255.0;
        for channel in [red, green, blue] {
            *channel = srgb8_from_linear(linear_from_srgb8(*channel) / opacity);
        }
    }
}
