//! What the books' programs make of the open file, and the report of all that was found in it.

use std::sync::OnceLock;

use serde::Serialize;

use super::Session;
use crate::check::book::{self, Book, Known, Verdict};
use crate::check::report::{self, CheckedFile};
use crate::check::sarif;
use crate::diagnostic::Diagnostic;
use crate::format;

/// The verdict of each book, once somebody asked for it.
#[derive(Clone, Debug, Default)]
pub(super) struct Verdicts(OnceLock<Vec<Verdict>>);

impl Session {
    /// What the books' programs make of the open file, in the order of [`Book::ALL`]; empty without a model. They are worked out at
    /// the first call, and kept until the model or its maps change.
    pub fn verdicts(&self) -> &[Verdict] {
        let Some(open) = self.open_model() else { return &[] };
        self.caches.verdicts.0.get_or_init(|| {
            let bytes = &open.file.bytes;
            let parsed = format::parse(bytes).ok();
            let maps = self.maps();
            let known = Known {
                document: parsed.as_ref().map(|parsed| &parsed.document),
                handedness: Some(open.model.handedness),
                // Without any picture nobody meant to bring maps.
                missing_maps: (!maps.pictures().is_empty()).then_some(&maps.checklist().missing),
            };
            Book::ALL.map(|book| book::verdict(book, bytes, &known)).into()
        })
    }

    /// The maps or the model are others than those of the verdicts.
    pub(super) fn forget_verdicts(&mut self) {
        self.caches.verdicts = Verdicts::default();
    }

    /// All that was found in the open file, as `bindpose check --book all` prints it; empty without a model.
    pub fn report(&self) -> String {
        let found = self.found();
        self.checked_file(&found)
            .map_or_else(String::new, |file| report::text(&file, &report::plain))
    }

    /// The same as a SARIF document; `None` without a model.
    pub fn sarif(&self) -> Option<impl Serialize + use<>> {
        let found = self.found();
        let results = sarif::Results::of(&self.checked_file(&found)?);
        Some(sarif::log([results]))
    }

    fn found(&self) -> Vec<Diagnostic> {
        self.diagnostics().cloned().collect()
    }

    fn checked_file<'a>(&'a self, diagnostics: &'a [Diagnostic]) -> Option<CheckedFile<'a>> {
        let open = self.open_model()?;
        Some(CheckedFile {
            path: open.file.base_name(),
            bytes: &open.file.bytes,
            diagnostics,
            verdicts: self.verdicts(),
        })
    }
}
