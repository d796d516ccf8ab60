//! Collects what was mended while a document becomes a model.

use crate::diagnostic::{Diagnostic, Position, Severity, Subject};

/// The start of a line.
pub(super) fn line_start(line: u32) -> Position {
    Position { line, column: 1 }
}

/// Findings in the order of the stages.
#[derive(Default)]
pub(super) struct Notes(pub(super) Vec<Diagnostic>);

impl Notes {
    /// Something worth knowing; nothing was changed.
    pub(super) fn note(&mut self, code: &'static str, place: Place, message: String) {
        self.push(Severity::Note, code, place, message);
    }

    /// Something was mended or left out.
    pub(super) fn warn(&mut self, code: &'static str, place: Place, message: String) {
        self.push(Severity::Warning, code, place, message);
    }

    fn push(&mut self, severity: Severity, code: &'static str, place: Place, message: String) {
        self.0.push(Diagnostic {
            severity,
            code,
            message,
            expected: None,
            found: None,
            position: place.line.map(line_start),
            length: 0,
            subject: place.subject,
        });
    }
}

/// Where a finding belongs: a line of the file when there is one, and a part of the model.
#[derive(Clone, Copy, Default)]
pub(super) struct Place {
    line: Option<u32>,
    subject: Option<Subject>,
}

impl Place {
    /// A part of the model, with its line in a list that runs beside the document's.
    pub(super) fn of(subject: Subject, lines: &[u32]) -> Self {
        let (Subject::Material(index)
        | Subject::Subset(index)
        | Subject::Vertex(index)
        | Subject::Triangle(index)
        | Subject::Bone(index)
        | Subject::Clip(index)) = subject;
        Self::on(subject, lines.get(index as usize).copied())
    }

    /// A part of the model on a given line.
    pub(super) fn on(subject: Subject, line: Option<u32>) -> Self {
        Self {
            line,
            subject: Some(subject),
        }
    }
}

/// Counts the rows that needed the same mending and remembers the first, so that a thousand rows make one finding.
#[derive(Clone, Copy, Default)]
pub(super) struct Tally {
    pub(super) count: usize,
    pub(super) first: u32,
}

impl Tally {
    /// One more row.
    pub(super) fn add(&mut self, row: u32) {
        if self.count == 0 {
            self.first = row;
        }
        self.count += 1;
    }
}

/// `1 vertex`, `2 vertices`.
pub(super) fn counted(count: usize, one: &str, many: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { many })
}
