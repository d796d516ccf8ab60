//! Places in a file, and what is told of them.

use crate::diagnostic::{Code, Diagnostic, Fault, Position, codes};

/// Where something is in the file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Place {
    /// In a binary one: bytes from its start.
    Offset(u64),
    /// In one of text.
    At(Position),
}

impl Default for Place {
    fn default() -> Self {
        Self::Offset(0)
    }
}

impl Place {
    /// A diagnostic here.
    pub(crate) fn says(self, code: &Code, message: impl Into<String>) -> Diagnostic {
        let diagnostic = code.says(message);
        match self {
            Self::At(position) => diagnostic.at(position, 0),
            Self::Offset(offset) => Diagnostic {
                byte_offset: Some(offset),
                ..diagnostic
            },
        }
    }

    pub(super) fn damaged(self, message: impl Into<String>) -> Fault {
        Box::new(self.says(&codes::FBX_DAMAGED, message))
    }
}
