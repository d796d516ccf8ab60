//! What is open: a model with its maps, edited materials, names of joints and diagnostics, the files it came with, and the sky.

use std::sync::Arc;

use super::changes::Changes;
use super::files::FileSet;
use super::load::LoadError;
use super::maps::Maps;
use super::materials::Materials;
use super::open_model::OpenModel;
use super::sky::Sky;
use crate::diagnostic::Diagnostic;
use crate::model::{Clip, JointNames};

/// A model is replaced together with all that belongs to it; the sky belongs to no model.
#[derive(Clone, Debug, Default)]
pub(super) struct Content {
    /// Shared with the copy that [`Session::go_back`](super::Session::go_back) returns to.
    pub(super) open: Option<Arc<OpenModel>>,
    /// Files of the last drop that had a model.
    pub(super) files: Arc<FileSet>,
    pub(super) maps: Maps,
    pub(super) materials: Materials,
    /// What joints are called.
    pub(super) names: Arc<JointNames>,
    pub(super) sky: Sky,
    /// Why the last load failed.
    pub(super) error: Option<LoadError>,
    /// What changed since the last [`Changes::take`].
    pub(super) changes: Changes,
}

impl Content {
    pub(super) fn clips(&self) -> &[Clip] {
        self.open.as_ref().map_or(&[], |open| &open.model.clips)
    }

    pub(super) fn clip_count(&self) -> usize {
        self.clips().len()
    }

    /// What was mended or is worth knowing about the model, its maps and the sky.
    pub(super) fn diagnostics(&self) -> impl Iterator<Item = &Diagnostic> {
        let of_file = self.open.iter().flat_map(|open| &open.diagnostics);
        let of_joined = self.open.iter().flat_map(|open| open.joined_diagnostics());
        of_file
            .chain(of_joined)
            .chain(self.maps.diagnostics())
            .chain(self.sky.diagnostics())
    }
}
