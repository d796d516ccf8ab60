//! What stops the reading.

use crate::diagnostic::{Code, Diagnostic};

/// Something that stops the reading.
pub type Fault = Box<Diagnostic>;

/// A fault at a place in the JSON.
pub(crate) fn fault(code: &Code, pointer: impl Into<String>, message: impl Into<String>) -> Fault {
    Box::new(code.says(message).pointing_at(pointer))
}
