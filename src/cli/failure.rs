//! How a command went, and why it did not do what was asked.

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use super::diagnostic::write_diagnostic;
use super::text::Plain;
use crate::check::report::OneLine;
use crate::contact_sheet::ContactSheetError;
use crate::edit::EditError;
use crate::export::ExportError;
use crate::image::EncodeError;
use crate::render::device::DeviceError;
use crate::render::{GpuError, PictureError, UploadError};
use crate::session::{ExportRefusal, LoadError};

/// How it went, from best to worst.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Outcome {
    /// All is well.
    Fine,
    /// A file has errors.
    FileHasErrors,
    /// Wrong use, or something is missing.
    Failed,
}

impl From<Outcome> for ExitCode {
    fn from(outcome: Outcome) -> Self {
        Self::from(match outcome {
            Outcome::Fine => 0,
            Outcome::FileHasErrors => 1,
            Outcome::Failed => 2,
        })
    }
}

/// A failure, in words for standard error.
#[derive(Debug, thiserror::Error)]
pub(super) enum Failure {
    #[error("{} cannot be read: {reason}", named(path))]
    Unreadable { path: PathBuf, reason: io::Error },
    /// Shown as a diagnostic, see [`Failure::report`].
    #[error("{} has an error", named(path))]
    Refused { path: PathBuf, error: Box<LoadError> },
    #[error("there is no clip \"{asked}\" in {}; {}", named(path), listed(known))]
    UnknownClip {
        path: PathBuf,
        asked: String,
        known: Vec<String>,
    },
    /// A pose whose numbers overflow.
    #[error(
        "{}: at {time_secs} s of \"{}\" {what} {number} is taken beyond what numbers hold",
        named(path),
        OneLine(clip)
    )]
    Overflows {
        path: PathBuf,
        clip: String,
        time_secs: f32,
        /// `bone` or `vertex`.
        what: &'static str,
        /// Its number in the file.
        number: usize,
    },
    #[error("{} has several clips; say which one with --clip; {}", named(path), listed(known))]
    ClipNotNamed { path: PathBuf, known: Vec<String> },
    #[error("{what} needs a clip, and {} has none", named(path))]
    NoClip { path: PathBuf, what: &'static str },
    /// Arguments that make no sense together.
    #[error("{0}")]
    WrongUse(String),
    #[error("{0}")]
    ContactSheet(#[from] ContactSheetError),
    #[error("{0}")]
    NoDevice(#[from] DeviceError),
    #[error(
        "a picture of {width} × {height} pixels takes {megabytes} MB of memory, and less is free: a smaller one may be drawn"
    )]
    NoRoomForPicture { width: u32, height: u32, megabytes: u64 },
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
    #[error("{}: {}", named(path), OneLine(&error.to_string()))]
    Edit { path: PathBuf, error: EditError },
    #[error("{0}")]
    Export(#[from] ExportError),
    #[error("{} is marked as read-only; --force writes over it", named(path))]
    ReadOnly { path: PathBuf },
    /// A file that was read would be overwritten.
    #[error("{} is read; name another file to write", named(path))]
    OwnInput { path: PathBuf },
    #[error("{} cannot be written: {reason}", named(path))]
    Unwritable { path: PathBuf, reason: io::Error },
    #[error("the result cannot be written: {0}")]
    Output(#[from] io::Error),
    #[error("the result cannot be written: {0}")]
    Json(#[from] serde_json::Error),
}

impl Failure {
    /// An edit of a file that cannot be made.
    fn edit(path: &Path, error: EditError) -> Self {
        let path = path.to_owned();
        match error {
            EditError::UnknownClip { asked, known } => Self::UnknownClip { path, asked, known },
            error => Self::Edit { path, error },
        }
    }

    /// A file that cannot be written as another.
    pub(super) fn export(path: &Path, refusal: ExportRefusal) -> Self {
        match refusal {
            ExportRefusal::Edit(error) => Self::edit(path, error),
            ExportRefusal::Write(error) => Self::Export(error),
            ExportRefusal::Archive(error) => Self::Output(error),
        }
    }

    /// The file that could not be read, if that is the failure.
    pub(super) fn unread(&self) -> Option<&Path> {
        match self {
            Self::Unreadable { path, .. } => Some(path),
            _ => None,
        }
    }

    /// Writes it to `err`, and returns how bad it is.
    pub(super) fn report(&self, err: &mut dyn Write) -> Outcome {
        // When standard error is closed too, only the exit code can tell.
        match self {
            Self::Refused { path, error } => {
                let _ = write_diagnostic(err, path, &error.diagnostic, error.excerpt.as_ref());
                Outcome::FileHasErrors
            }
            _ => {
                // Those of GPUs have several lines; names of files are on one line already.
                let text = self.to_string();
                let lines: Vec<String> = text.lines().map(|line| Plain(line).to_string()).collect();
                let _ = writeln!(err, "error: {}", lines.join("\n"));
                match self {
                    Self::Overflows { .. }
                    | Self::Edit {
                        error: EditError::Overflows(_) | EditError::TooLarge(_),
                        ..
                    } => Outcome::FileHasErrors,
                    _ => Outcome::Failed,
                }
            }
        }
    }
}

/// A path as a message may hold it.
fn named(path: &Path) -> String {
    OneLine(&path.display().to_string()).to_string()
}

/// `it has "Walk", "Run"`.
fn listed(clips: &[String]) -> String {
    if clips.is_empty() {
        return "it has none".into();
    }
    let quoted: Vec<String> = clips.iter().map(|name| format!("\"{}\"", OneLine(name))).collect();
    format!("it has {}", quoted.join(", "))
}
