//! What comes out of a file of any format.

use std::sync::Arc;

use crate::diagnostic::Diagnostic;
use crate::format::{Dialect, Document, LineMap};
use crate::gltf::Effort;
use crate::model::Model;

/// Why a file makes no model.
#[derive(Clone, Debug)]
pub struct Refused {
    /// What is wrong. It has a place in the file where there is one.
    pub error: Diagnostic,
    /// What was mended or is worth knowing of the part that was read before.
    pub diagnostics: Vec<Diagnostic>,
}

/// What came out of a file.
#[derive(Clone, Debug)]
pub struct Imported {
    /// What kind of file it was.
    pub format: FileFormat,
    /// The model, in the file's space.
    pub model: Model,
    /// What was mended or is worth knowing, in the order of the file.
    pub diagnostics: Vec<Diagnostic>,
    /// What the file says, where it is of the books' format.
    pub document: Option<Document>,
    /// Where its parts stand in the file; empty for a format without lines.
    pub lines: LineMap,
    /// Pictures inside the file, and those beside it that were given, as its materials name them.
    pub pictures: Vec<Picture>,
    /// What reading took, where the format keeps account of it.
    pub effort: Effort,
}

/// The kinds of files that are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileFormat {
    /// The books' text, in one of its spellings.
    M3d(Dialect),
    /// glTF in one binary file.
    Glb,
    /// glTF as JSON text.
    Gltf,
}

impl FileFormat {
    /// The name that outputs use: `d3d12`, `d3d11`, `imm`, `glb` or `gltf`.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::M3d(dialect) => dialect.as_str(),
            Self::Glb => "glb",
            Self::Gltf => "gltf",
        }
    }

    /// The name that a person knows.
    pub fn label(self) -> &'static str {
        match self {
            Self::M3d(Dialect::D3d12) => "D3D12 book",
            Self::M3d(Dialect::D3d11) => "D3D11 book",
            Self::M3d(Dialect::Imm) => "imm exporter",
            Self::Glb => "GLB",
            Self::Gltf => "glTF",
        }
    }

    /// Whether it is glTF, in either form.
    pub fn is_gltf(self) -> bool {
        matches!(self, Self::Glb | Self::Gltf)
    }
}

/// A picture that came with a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// The name that materials give it, with its extension; unique in the file.
    pub name: String,
    /// Its bytes, as a file of its kind has them.
    pub bytes: Arc<[u8]>,
}
