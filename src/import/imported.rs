//! What comes out of a file of any format.

use super::source::Source;
use crate::diagnostic::{Diagnostic, codes};
use crate::model::Model;

/// Why a file makes no model.
#[derive(Clone, Debug)]
pub struct Refused {
    /// What is wrong. It has a place in the file where there is one.
    pub error: Diagnostic,
    /// What was mended or is worth knowing of the part that was read before.
    pub diagnostics: Vec<Diagnostic>,
}

impl Refused {
    /// The same of a file whose name ends so, in lower case: what begins like no format is told as not what its name says.
    #[must_use]
    pub fn of_extension(mut self, extension: &str) -> Self {
        let error = &mut self.error;
        if error.code == codes::NOT_M3D.name && ["fbx", "glb", "gltf"].contains(&extension) {
            let found = error.found.as_deref().unwrap_or_default();
            error.message =
                format!("This is no .{extension} file, whatever its name says: it begins with \"{found}\".");
            error.expected = Some(format!("what .{extension} files begin with"));
        }
        self
    }
}

/// What came out of a file, whatever its format.
#[derive(Clone, Debug)]
pub struct Imported {
    /// The model, in the file's space.
    pub model: Model,
    /// What was mended or is worth knowing, in the order of the file.
    pub diagnostics: Vec<Diagnostic>,
    /// Pictures inside the file, and those beside it that were given, as its materials name them.
    pub pictures: Vec<Picture>,
    /// What only its format knows.
    pub source: Source,
}

/// A picture that came with a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// The name that materials give it, with its extension; unique in the file.
    pub name: String,
    /// Its bytes, as a file of its kind has them.
    pub bytes: bytes::Bytes,
}
