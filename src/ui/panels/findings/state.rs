//! What of the findings is open, chosen and typed.

use super::filter::Filter;
use crate::check::book::Verdict;
use crate::diagnostic::Diagnostic;
use crate::format::Excerpt;
use crate::session::{OpenModel, Session};
use crate::ui::kit::Kept;

/// Of one model.
#[derive(Debug, Default)]
pub(in crate::ui) struct FindingsState {
    pub(super) filter: Filter,
    /// Books whose lines are unfolded, in the order of the verdicts, with the lines of the file.
    pub(super) books: [Option<BookLines>; 2],
    pub(super) shown: Option<ShownDiagnostic>,
    /// Heights of the rows in some width, by a hash of it and of their words.
    pub(super) heights: Kept<u64, Vec<f32>>,
}

/// The lines of the file around the place at which a book's program goes wrong.
#[derive(Debug)]
pub(super) struct BookLines {
    pub(super) excerpt: Option<Excerpt>,
}

impl BookLines {
    /// Reads them from the file.
    pub(super) fn of(open: &OpenModel, verdict: &Verdict) -> Self {
        let trouble = verdict.trouble.as_ref();
        Self {
            excerpt: trouble.map(|trouble| open.excerpt_at(trouble.position, trouble.length)),
        }
    }
}

/// The diagnostic whose lines are shown. They are read from the file once, when it is unfolded or another of its places is chosen.
#[derive(Debug)]
pub(super) struct ShownDiagnostic {
    pub(super) diagnostic: Diagnostic,
    pub(super) occurrence: usize,
    pub(super) excerpt: Option<Excerpt>,
    /// The height of what is unfolded, as it was last drawn.
    pub(super) height: f32,
}

impl ShownDiagnostic {
    /// Shows the first occurrence.
    pub(super) fn new(open: &OpenModel, diagnostic: &Diagnostic) -> Self {
        Self {
            diagnostic: diagnostic.clone(),
            occurrence: 0,
            excerpt: open.excerpt(diagnostic),
            height: 0.0,
        }
    }

    /// Shows the lines of an occurrence.
    pub(super) fn choose(&mut self, open: &OpenModel, occurrence: usize) {
        let place = self.diagnostic.occurrences().nth(occurrence);
        self.occurrence = occurrence;
        self.excerpt = open.excerpt(&Diagnostic {
            position: place.map_or(self.diagnostic.position, |(_, position, _)| position),
            ..self.diagnostic.clone()
        });
    }
}

impl FindingsState {
    /// The file was read again. What is unfolded stays so where it is found again, with the lines of now.
    pub(in crate::ui) fn find_again(&mut self, session: &Session) {
        let Some(open) = session.open_model() else { return };
        for (lines, verdict) in self.books.iter_mut().zip(session.verdicts()) {
            *lines = lines.take().map(|_| BookLines::of(open, verdict));
        }
        let shown = self.shown.take();
        self.shown = shown.filter(|shown| session.diagnostics().any(|found| *found == shown.diagnostic));
        if let Some(shown) = &mut self.shown {
            shown.choose(open, shown.occurrence);
        }
    }

    /// Whether a diagnostic is the one whose lines are shown.
    pub(super) fn is_shown(&self, diagnostic: &Diagnostic) -> bool {
        self.shown.as_ref().is_some_and(|shown| shown.diagnostic == *diagnostic)
    }

    /// The height of what is unfolded below the row of a diagnostic.
    pub(super) fn unfolded_height_of(&self, diagnostic: &Diagnostic) -> f32 {
        let shown = self.shown.as_ref().filter(|_| self.is_shown(diagnostic));
        shown.map_or(0.0, |shown| shown.height)
    }
}
