//! The line with counts that follows several files.

use std::fmt;

use crate::cli::text::counted;
use crate::diagnostic::{Diagnostic, Severity};

/// How much was found in all files.
#[derive(Default)]
pub(super) struct Counts {
    files: usize,
    errors: usize,
    warnings: usize,
    notes: usize,
}

impl Counts {
    /// Adds a file.
    pub(super) fn add(&mut self, diagnostics: &[Diagnostic]) {
        self.files += 1;
        for diagnostic in diagnostics {
            *match diagnostic.severity {
                Severity::Error => &mut self.errors,
                Severity::Warning => &mut self.warnings,
                Severity::Note => &mut self.notes,
            } += 1;
        }
    }
}

impl fmt::Display for Counts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            files,
            errors,
            warnings,
            notes,
        } = *self;
        write!(
            f,
            "{}: {}, {}, {}",
            counted(files, "file"),
            counted(errors, "error"),
            counted(warnings, "warning"),
            counted(notes, "note")
        )
    }
}
