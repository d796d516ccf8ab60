//! Why a command did not do what was asked.

use std::io::{self, Write};
use std::path::PathBuf;

use super::Outcome;
use super::finding::write_finding;
use super::text::Plain;
use crate::image::EncodeError;
use crate::render::device::DeviceError;
use crate::render::{GpuError, PictureError, UploadError};
use crate::session::LoadError;

/// A failure, in words for standard error.
#[derive(Debug, thiserror::Error)]
pub(super) enum Failure {
    #[error("{} cannot be read: {reason}", path.display())]
    Unreadable { path: PathBuf, reason: io::Error },
    /// Shown as a finding, see [`Failure::report`].
    #[error("{} has an error", path.display())]
    Refused { path: PathBuf, error: Box<LoadError> },
    #[error("there is no clip \"{asked}\" in {}; {}", path.display(), listed(known))]
    UnknownClip {
        path: PathBuf,
        asked: String,
        known: Vec<String>,
    },
    #[error("{} has several clips; say which one with --clip; {}", path.display(), listed(known))]
    ClipNotNamed { path: PathBuf, known: Vec<String> },
    #[error("{0}")]
    NoDevice(#[from] DeviceError),
    #[error("{vulkan}\n       {gl}")]
    NoDeviceAtAll { vulkan: DeviceError, gl: DeviceError },
    #[error("{0}")]
    Upload(#[from] UploadError),
    #[error("the model could not be brought to the GPU: {0}")]
    Gpu(#[from] GpuError),
    #[error("{0}")]
    Picture(#[from] PictureError),
    #[error("{0}")]
    Encode(#[from] EncodeError),
    #[error("{} cannot be written: {reason}", path.display())]
    Unwritable { path: PathBuf, reason: io::Error },
    #[error("the result cannot be written: {0}")]
    Output(#[from] io::Error),
    #[error("the result cannot be written: {0}")]
    Json(#[from] serde_json::Error),
}

impl Failure {
    /// Tells it, and says how bad it is.
    pub(super) fn report(&self, err: &mut dyn Write) -> Outcome {
        // When standard error is closed too, the exit code is all that is left to say it.
        match self {
            Self::Refused { path, error } => {
                let _ = write_finding(err, path, &error.diagnostic, error.excerpt.as_ref());
                Outcome::FileHasErrors
            }
            _ => {
                let _ = writeln!(err, "error: {}", Plain(&self.to_string()));
                Outcome::Failed
            }
        }
    }
}

/// `it has "Walk", "Run"`.
fn listed(clips: &[String]) -> String {
    if clips.is_empty() {
        return "it has none".into();
    }
    let quoted: Vec<String> = clips.iter().map(|name| format!("\"{name}\"")).collect();
    format!("it has {}", quoted.join(", "))
}
