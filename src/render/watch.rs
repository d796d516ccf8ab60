//! What a device has to say of work that it was given.

use std::future::Future;
use std::pin::Pin;
use std::task::{Context, Poll, Waker};

/// Why a device could not do what it was asked for.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum GpuError {
    /// Of its own memory, not of the program's.
    #[error("the GPU has too little free memory for it")]
    OutOfMemory,
    /// In the device's words.
    #[error("the GPU refused it: {0}")]
    Refused(String),
}

/// Comes when the device has done the work, or could not. Natively it is there at once.
pub type GpuAnswer = Pin<Box<dyn Future<Output = Result<(), GpuError>>>>;

/// Does something with a device, and asks it whether all of that could be done. Errors then reach nobody else.
pub fn watched<T>(device: &wgpu::Device, work: impl FnOnce() -> T) -> (T, GpuAnswer) {
    let memory = device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
    let validation = device.push_error_scope(wgpu::ErrorFilter::Validation);
    let internal = device.push_error_scope(wgpu::ErrorFilter::Internal);
    let done = work();
    let others = [Box::pin(internal.pop()) as Answer, Box::pin(validation.pop())];
    let memory = memory.pop();
    let answer = async move {
        // First, since what could not be made is not valid either.
        if memory.await.is_some() {
            return Err(GpuError::OutOfMemory);
        }
        for other in others {
            if let Some(error) = other.await {
                return Err(GpuError::Refused(error.to_string()));
            }
        }
        Ok(())
    };
    (done, Box::pin(answer))
}

type Answer = Pin<Box<dyn Future<Output = Option<wgpu::Error>>>>;

/// The answer of a native device, which never lets anybody wait.
pub(super) fn answer_at_once(mut answer: GpuAnswer) -> Result<(), GpuError> {
    match answer.as_mut().poll(&mut Context::from_waker(Waker::noop())) {
        Poll::Ready(answer) => answer,
        Poll::Pending => Ok(()),
    }
}
