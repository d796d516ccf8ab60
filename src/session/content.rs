//! What is open: a model with its maps, edited materials, names of joints and diagnostics, the files it came with, and the sky.

use std::sync::Arc;

use super::changes::Changes;
use super::files::FileSet;
use super::load::LoadError;
use super::maps::Maps;
use super::materials::Materials;
use super::open_model::OpenModel;
use super::sky::Sky;
use super::verdicts::Verdicts;
use crate::diagnostic::Diagnostic;
use crate::model::{Clip, JointNames};

/// Files that can be opened again, with the pictures that were found for them.
#[derive(Clone, Debug)]
pub(super) struct OtherFiles {
    pub(super) files: Arc<FileSet>,
    pub(super) maps: Maps,
}

/// A model is replaced together with all that belongs to it; the sky belongs to no model.
#[derive(Clone, Debug, Default)]
pub(super) struct Content {
    /// Shared with the copy that [`Session::go_back`](super::Session::go_back) returns to.
    pub(super) open: Option<Arc<OpenModel>>,
    /// Files of the last drop that had a model.
    pub(super) files: Arc<FileSet>,
    /// What was open before that drop, or the drop while what was open before it is open again.
    pub(super) others: Option<Arc<OtherFiles>>,
    pub(super) maps: Maps,
    pub(super) materials: Materials,
    /// What joints are called.
    pub(super) names: Arc<JointNames>,
    pub(super) sky: Sky,
    /// Of the file and its maps.
    pub(super) verdicts: Verdicts,
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

    /// What stands beside the files of the next drop: the model that was open, or the one before it if the drop has this one too.
    pub(super) fn others_of(&self, next: &Arc<FileSet>) -> Option<Arc<OtherFiles>> {
        let beside = |others: &&Arc<OtherFiles>| {
            let models = others.files.models();
            !models.iter().any(|file| next.get(&file.path).is_some())
        };
        if Arc::ptr_eq(next, &self.files) {
            return self.others.clone();
        }
        let swaps = |others: &&Arc<OtherFiles>| Arc::ptr_eq(next, &others.files);
        let files = match (&self.open, self.others.iter().find(swaps)) {
            (None, _) => return None,
            (_, Some(_)) => Arc::clone(&self.files),
            (Some(open), None) if next.get(&open.file.path).is_none() => {
                Arc::new(self.files.with_one_model(&open.file))
            }
            (Some(_), None) => return self.others.as_ref().filter(beside).cloned(),
        };
        // They can be decoded again; until then their memory is free.
        let maps = self.maps.undecoded();
        Some(Arc::new(OtherFiles { files, maps }))
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
