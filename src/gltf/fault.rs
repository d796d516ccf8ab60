//! What stops the reading.

use crate::diagnostic::{Code, Fault};

/// A fault at a place in the JSON.
pub(crate) fn fault(code: &Code, pointer: impl Into<String>, message: impl Into<String>) -> Fault {
    Box::new(code.says(message).pointing_at(pointer))
}
