//! Collects what was mended while a document becomes a model.

use std::collections::HashMap;

use crate::diagnostic::{Code, Diagnostic, Position, Subject};

/// The start of a line.
pub(super) fn line_start(line: u32) -> Position {
    Position { line, column: 1 }
}

/// Findings in the order of the stages. A few of one code are told apart; many become one, so that a file with the same
/// flaw in each of its clips does not bury everything else.
#[derive(Default)]
pub(super) struct Notes {
    findings: Vec<Diagnostic>,
    /// How often each code was met.
    met: HashMap<&'static str, u32>,
}

impl Notes {
    /// Findings of one code up to this many are told apart.
    const MOST_APART: u32 = 4;

    /// Adds a diagnostic.
    pub(crate) fn add(&mut self, code: &Code, place: Place, message: String) {
        let met = self.met.entry(code.name).or_default();
        *met = met.saturating_add(1);
        if *met > Self::MOST_APART {
            return;
        }
        let places: Vec<Position> = place.lines.into_iter().flatten().map(line_start).collect();
        self.findings.push(Diagnostic {
            position: places.first().copied(),
            subject: place.subject,
            count: place.count,
            places,
            ..code.says(message)
        });
    }

    /// All findings. Of a code that was met too often the first one stands for all.
    pub(super) fn into_diagnostics(self) -> Vec<Diagnostic> {
        let mut all: Vec<Diagnostic> = Vec::with_capacity(self.findings.len());
        for finding in self.findings {
            let met = self.met.get(finding.code).copied().unwrap_or_default();
            if met <= Self::MOST_APART {
                all.push(finding);
            } else if let Some(first) = all.iter_mut().find(|first| first.code == finding.code) {
                first.places.extend(finding.position);
            } else {
                all.push(standing_for(met, finding));
            }
        }
        all
    }
}

/// A finding about the first of `count` parts of the model, said of all of them.
fn standing_for(count: u32, first: Diagnostic) -> Diagnostic {
    let parts = match first.subject {
        Some(Subject::Material(_)) => "materials",
        Some(Subject::Subset(_)) => "subsets",
        Some(Subject::Clip(_)) => "clips",
        _ => "places",
    };
    Diagnostic {
        message: format!("{} The same holds for {} more {parts}.", first.message, count - 1),
        places: first.position.into_iter().collect(),
        count,
        ..first
    }
}

/// Where a finding belongs: lines of the file when there are any, and a part of the model.
#[derive(Clone, Copy)]
pub(super) struct Place {
    lines: [Option<u32>; Diagnostic::MOST_PLACES],
    count: u32,
    subject: Option<Subject>,
}

/// The whole file.
impl Default for Place {
    fn default() -> Self {
        Self {
            lines: [None; Diagnostic::MOST_PLACES],
            count: 1,
            subject: None,
        }
    }
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
        let mut place = Self::default();
        place.lines[0] = line;
        place.subject = Some(subject);
        place
    }

    /// Rows that needed the same mending. `subject` makes the part of the model that a row is.
    pub(super) fn of_rows(rows: &Tally, subject: impl FnOnce(u32) -> Subject, lines: &[u32]) -> Self {
        Self {
            lines: rows.first_lines(lines),
            count: rows.count_u32(),
            subject: Some(subject(rows.first())),
        }
    }

    /// Rows inside of a part of the model; `otherwise` is the line where the file does not say the rows'.
    pub(super) fn of_rows_in(subject: Subject, rows: &Tally, lines: &[u32], otherwise: Option<u32>) -> Self {
        let mut place = Self::of_rows(rows, |_| subject, lines);
        place.lines[0] = place.lines[0].or(otherwise);
        place
    }
}

/// Counts the rows that needed the same mending and remembers the first, so that a thousand rows make one finding.
#[derive(Clone, Copy, Default)]
pub(super) struct Tally {
    pub(super) count: usize,
    /// The first different rows.
    rows: [Option<u32>; Diagnostic::MOST_PLACES],
}

impl Tally {
    /// Once more, in the same row as before or in another one.
    pub(super) fn add(&mut self, row: u32) {
        self.count += 1;
        let free = self.rows.iter().position(Option::is_none);
        let before = free.unwrap_or(self.rows.len()).checked_sub(1);
        if let Some(free) = free
            && before.is_none_or(|before| self.rows[before] != Some(row))
        {
            self.rows[free] = Some(row);
        }
    }

    /// The first row; 0 when there is none.
    fn first(&self) -> u32 {
        self.rows[0].unwrap_or_default()
    }

    fn first_lines(&self, lines: &[u32]) -> [Option<u32>; Diagnostic::MOST_PLACES] {
        self.rows.map(|row| lines.get(row? as usize).copied())
    }

    fn count_u32(&self) -> u32 {
        u32::try_from(self.count).unwrap_or(u32::MAX)
    }
}

/// `1 vertex`, `2 vertices`.
pub(super) fn counted(count: usize, one: &str, many: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { many })
}
