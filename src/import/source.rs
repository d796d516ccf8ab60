//! What only the format of a file knows of it: what it says in its own words, and where.

use std::sync::Arc;

use super::fbx::places::Places as FbxPlaces;
use super::gltf::places::Places as GltfPlaces;
use crate::diagnostic::Places;
use crate::format::{self, Dialect, Parsed};
use crate::gltf::Effort;
use crate::slices::{Slices, at_once};

/// The kinds of files that are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileFormat {
    /// The books' text, in one of its spellings.
    M3d(Dialect),
    /// glTF in one binary file.
    Glb,
    /// glTF as JSON text.
    Gltf,
    /// FBX.
    Fbx {
        /// Or text.
        is_binary: bool,
    },
}

impl FileFormat {
    /// The name that outputs use: `d3d12`, `d3d11`, `imm`, `txt`, `glb`, `gltf`, `fbx` or `fbx-text`.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::M3d(dialect) => dialect.as_str(),
            Self::Glb => "glb",
            Self::Gltf => "gltf",
            Self::Fbx { is_binary: true } => "fbx",
            Self::Fbx { is_binary: false } => "fbx-text",
        }
    }

    /// The name that a person knows.
    pub fn label(self) -> &'static str {
        match self {
            Self::M3d(Dialect::D3d12) => "D3D12 book",
            Self::M3d(Dialect::D3d11) => "D3D11 book",
            Self::M3d(Dialect::Imm) => "imm exporter",
            Self::M3d(Dialect::Text) => "the books' text",
            Self::Glb => "GLB",
            Self::Gltf => "glTF",
            Self::Fbx { is_binary: true } => "FBX",
            Self::Fbx { is_binary: false } => "FBX as text",
        }
    }

    /// How it is spelled, where it is a `.m3d`.
    pub fn dialect(self) -> Option<Dialect> {
        match self {
            Self::M3d(Dialect::Text) | Self::Glb | Self::Gltf | Self::Fbx { .. } => None,
            Self::M3d(dialect) => Some(dialect),
        }
    }
}

/// A file beside the model that was made of it. It does not hold the bytes: what is asked of it anew is read from them.
#[derive(Clone, Debug)]
pub struct Source {
    /// What kind of file it was.
    pub format: FileFormat,
    kind: Kind,
}

#[derive(Clone, Debug)]
enum Kind {
    /// As it was parsed, until that is forgotten.
    M3d(Option<Arc<Parsed>>),
    Gltf(Arc<GltfPlaces>),
    Fbx(Arc<FbxPlaces>),
}

impl Source {
    pub(super) fn m3d(parsed: Parsed) -> Self {
        Self {
            format: FileFormat::M3d(parsed.document.dialect),
            kind: Kind::M3d(Some(Arc::new(parsed))),
        }
    }

    pub(super) fn gltf(is_binary: bool, places: GltfPlaces) -> Self {
        Self {
            format: if is_binary { FileFormat::Glb } else { FileFormat::Gltf },
            kind: Kind::Gltf(Arc::new(places)),
        }
    }

    pub(super) fn fbx(is_binary: bool, places: FbxPlaces) -> Self {
        Self {
            format: FileFormat::Fbx { is_binary },
            kind: Kind::Fbx(Arc::new(places)),
        }
    }

    /// What the file says and where, if it is of the books' format. `bytes` are the file's; they are parsed again if that was forgotten.
    pub fn parsed(&self, bytes: &[u8]) -> Option<Arc<Parsed>> {
        at_once(self.parsed_in(bytes, &Slices::ENDLESS))
    }

    /// [`Source::parsed`] in slices.
    pub async fn parsed_in(&self, bytes: &[u8], slices: &Slices) -> Option<Arc<Parsed>> {
        match &self.kind {
            Kind::M3d(Some(parsed)) => Some(Arc::clone(parsed)),
            Kind::M3d(None) => format::parse_in(bytes, slices).await.ok().map(Arc::new),
            Kind::Gltf(_) | Kind::Fbx(_) => None,
        }
    }

    /// Where the parts of the model stand in the file, of these bytes.
    pub fn places(&self, bytes: &[u8]) -> Arc<dyn Places> {
        match &self.kind {
            Kind::Gltf(places) => Arc::clone(places) as Arc<dyn Places>,
            Kind::Fbx(places) => Arc::clone(places) as Arc<dyn Places>,
            Kind::M3d(_) => self.parsed(bytes).unwrap_or_default(),
        }
    }

    /// What reading took, where the format keeps account of it.
    pub fn effort(&self) -> Effort {
        match &self.kind {
            Kind::Gltf(places) => places.effort,
            Kind::M3d(_) | Kind::Fbx(_) => Effort::default(),
        }
    }

    /// Gives the memory of what can be read again.
    pub(crate) fn forget(&mut self) {
        if let Kind::M3d(parsed) = &mut self.kind {
            *parsed = None;
        }
    }
}
