//! What the books' programs make of the open file.

use std::sync::OnceLock;

use super::maps::Maps;
use super::open_model::OpenModel;
use crate::check::book::{self, Book, Known, Verdict};
use crate::format;

/// The verdict of each book. [`LoadJob`](super::LoadJob) works them out in a step of its own, since each program reads the file anew.
#[derive(Clone, Debug, Default)]
pub(super) struct Verdicts(OnceLock<Vec<Verdict>>);

impl Verdicts {
    /// Those of the open model with its maps, in the order of [`Book::ALL`]. They are worked out at the first call.
    pub(super) fn of(&self, open: &OpenModel, maps: &Maps) -> &[Verdict] {
        self.0.get_or_init(|| {
            if open.format.is_gltf() {
                // The books' programs know no other format than theirs.
                return Vec::new();
            }
            let bytes = &open.file.bytes;
            let parsed = if open.document.is_some() {
                None
            } else {
                format::parse(bytes).ok()
            };
            let known = Known {
                document: open
                    .document
                    .as_ref()
                    .or(parsed.as_ref().map(|parsed| &parsed.document)),
                handedness: Some(open.model.handedness),
                // Without any picture nobody meant to bring maps.
                missing_maps: (!maps.pictures().is_empty()).then_some(&maps.checklist().missing),
            };
            Book::ALL.map(|book| book::verdict(book, bytes, &known)).into()
        })
    }

    /// The maps are others.
    pub(super) fn forget(&mut self) {
        *self = Self::default();
    }
}
