//! What can stop a command, in words that say what to do next.

use std::fmt;
use std::io;

/// Why a command stopped.
#[derive(Debug)]
pub(crate) enum Failure {
    /// The command line was not understood.
    Usage(String),
    /// A program could not be started or ended with an error. `shown` is the line to repeat it with.
    Command { shown: String, why: String },
    /// A file or a socket refused.
    Io { doing: String, source: io::Error },
    /// Something stands in the way that a person can remove. `remedy` is the exact command.
    Remedy { what: String, remedy: String },
    /// The built wasm could not be bound to JavaScript.
    Bind(String),
    /// The files of the site do not fit together.
    Site(String),
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Usage(what) => write!(f, "{what}\nTry `cargo xtask --help`."),
            Self::Command { shown, why } => write!(f, "{why}\nTo repeat it:\n\n    {shown}\n"),
            Self::Io { doing, source } => write!(f, "{doing}: {source}"),
            Self::Remedy { what, remedy } => write!(f, "{what}\nRun this:\n\n    {remedy}\n"),
            Self::Bind(what) => write!(f, "wasm-bindgen: {what}"),
            Self::Site(what) => f.write_str(what),
        }
    }
}

/// Names what was being done when an I/O error came up.
pub(crate) trait Doing<T> {
    /// Turns the error into a [`Failure`] that begins with `doing`.
    fn doing(self, doing: impl Into<String>) -> Result<T, Failure>;
}

impl<T> Doing<T> for io::Result<T> {
    fn doing(self, doing: impl Into<String>) -> Result<T, Failure> {
        self.map_err(|source| Failure::Io {
            doing: doing.into(),
            source,
        })
    }
}
