//! What the books' programs make of the open file, and the report of all that was found in it.

use crate::check::book::{Limit, Verdict};
use crate::check::report::{self, CheckedFile};
use crate::check::sarif;
use crate::diagnostic::Diagnostic;
use crate::session::Session;

impl Session {
    /// What the books' programs make of the open file, in the order of [`Book::ALL`](crate::check::book::Book::ALL); empty without a
    /// model. They come with the model; after new maps they are worked out at the first call.
    pub fn verdicts(&self) -> &[Verdict] {
        self.open_model()
            .map_or(&[], |open| self.content.verdicts.of(open, self.maps()))
    }

    /// Of an open file of another format than the books', what it exceeds in their demos even converted for them; `None` for others.
    pub fn limits_once_converted(&self) -> Option<&[Limit]> {
        self.content.verdicts.converted(self.open_model()?)
    }

    /// All that was found in the open file, as `bindpose check --book all` prints it, and what the table of codes says of it; empty without a model.
    pub fn report(&self) -> String {
        let found = self.found();
        self.checked_file(&found)
            .map_or_else(String::new, |file| report::text(&file, true, &report::plain))
    }

    /// The same as a SARIF document; `None` without a model.
    pub fn sarif(&self) -> Option<serde_json::Value> {
        let found = self.found();
        let results = sarif::Results::of(&self.checked_file(&found)?);
        Some(sarif::log([results], &[]))
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
            converted: self.limits_once_converted(),
        })
    }
}
