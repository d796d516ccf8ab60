//! Collects the diagnostics of one stage, so that many alike become one.
//!
//! A [`Subject`] is a part of the model. An [`Entry`](super::Entry) is what the file says of it, and [`Places`](super::Places) tells where in the file
//! that stands. A [`Place`] is what a diagnostic is told of both; [`Tally`] gathers one for many parts alike.

use std::borrow::Cow;
use std::collections::{HashMap, HashSet};
use std::fmt;

use super::{Code, Diagnostic, Moment, Position, Subject};

pub(crate) fn line_start(line: u32) -> Position {
    Position { line, column: 1 }
}

/// Diagnostics in the order in which they are added. A few of one code are kept apart; many become one, so that a file
/// with the same flaw in each of its clips does not bury everything else.
#[derive(Default)]
pub(crate) struct Diagnostics {
    list: Vec<Diagnostic>,
    /// How often each code was met.
    met: HashMap<&'static str, u32>,
}

impl Diagnostics {
    /// Up to this many diagnostics of one code are kept apart.
    pub(crate) const MOST_APART: u32 = 4;

    pub(crate) fn add(&mut self, code: &Code, place: Place, message: String) {
        let met = self.met.entry(code.name).or_default();
        *met = met.saturating_add(1);
        if *met as usize > Diagnostic::MOST_PLACES {
            return;
        }
        let places: Vec<Position> = place.lines.into_iter().map(line_start).collect();
        self.list.push(Diagnostic {
            position: places.first().copied(),
            subject: place.subjects.first().copied(),
            count: place.count,
            pointer: place.pointer,
            places,
            subjects: place.subjects,
            moments: place.moments,
            ..code.says(message)
        });
    }

    /// All diagnostics. Of a code that was met too often the first one stands for all.
    pub(crate) fn into_vec(self) -> Vec<Diagnostic> {
        let mut all: Vec<Diagnostic> = Vec::with_capacity(self.list.len());
        for diagnostic in self.list {
            let met = self.met.get(diagnostic.code).copied().unwrap_or_default();
            if met <= Self::MOST_APART {
                all.push(diagnostic);
            } else if let Some(first) = all.iter_mut().find(|first| first.code == diagnostic.code) {
                first.places.extend(diagnostic.position);
                first.subjects.extend(diagnostic.subject);
                if !first.moments.is_empty() {
                    first.moments.push(diagnostic.moment());
                }
            } else {
                all.push(standing_for(met, diagnostic));
            }
        }
        all
    }
}

/// The diagnostic of the first of `count` parts of the model, reworded for all of them.
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
        subjects: first.subject.into_iter().collect(),
        moments: first.moments.first().copied().into_iter().collect(),
        count,
        ..first
    }
}

/// Where a diagnostic belongs: lines of the file when there are any, and parts of the model.
#[derive(Clone)]
pub(crate) struct Place {
    lines: Vec<u32>,
    count: u32,
    subjects: Vec<Subject>,
    moments: Vec<Moment>,
    pointer: Option<String>,
}

impl Default for Place {
    fn default() -> Self {
        Self {
            lines: Vec::new(),
            count: 1,
            subjects: Vec::new(),
            moments: Vec::new(),
            pointer: None,
        }
    }
}

impl Place {
    pub(crate) fn pointer(pointer: impl Into<String>) -> Self {
        Self {
            pointer: Some(pointer.into()),
            ..Self::default()
        }
    }

    /// The same place, and the part of the model that it is about.
    #[must_use]
    pub(crate) fn about(self, subject: Subject) -> Self {
        Self {
            subjects: vec![subject],
            ..self
        }
    }

    /// The same place, for so many occurrences.
    #[must_use]
    pub(crate) fn counting(self, count: usize) -> Self {
        Self {
            count: u32::try_from(count).unwrap_or(u32::MAX),
            ..self
        }
    }

    /// The same place, and when and on which bones of a clip the first occurrences are.
    #[must_use]
    pub(crate) fn at(self, moments: impl IntoIterator<Item = Moment>) -> Self {
        Self {
            moments: moments.into_iter().take(Diagnostic::MOST_PLACES).collect(),
            ..self
        }
    }

    /// A part of the model. `lines` has the line of each part of this kind.
    pub(crate) fn of(subject: Subject, lines: &[u32]) -> Self {
        let (Subject::Material(index)
        | Subject::Subset(index)
        | Subject::Vertex(index)
        | Subject::Triangle(index)
        | Subject::Bone(index)
        | Subject::Clip(index)
        | Subject::Map(index)) = subject;
        Self::on(subject, lines.get(index as usize).copied())
    }

    /// A part of the model on a given line.
    pub(crate) fn on(subject: Subject, line: Option<u32>) -> Self {
        Self {
            lines: line.into_iter().collect(),
            subjects: vec![subject],
            ..Self::default()
        }
    }

    /// Rows that needed the same mending. `subject` turns the number of a row into a part of the model; `lines` has the
    /// line of each row.
    pub(crate) fn of_rows(rows: &Tally, subject: impl Fn(u32) -> Subject, lines: &[u32]) -> Self {
        Self::of_rows_on(rows, subject, |row| lines.get(row as usize).copied())
    }

    /// The same of rows whose lines are asked for.
    pub(crate) fn of_rows_on(
        rows: &Tally,
        subject: impl Fn(u32) -> Subject,
        line: impl Fn(u32) -> Option<u32>,
    ) -> Self {
        Self {
            lines: rows.rows.into_iter().flatten().filter_map(line).collect(),
            count: rows.count_u32(),
            subjects: rows.rows.into_iter().flatten().map(subject).collect(),
            ..Self::default()
        }
    }

    /// Keys or bones of one clip; `otherwise` is the line to name when they have none.
    pub(crate) fn of_moments(subject: Subject, moments: &Moments, otherwise: Option<u32>) -> Self {
        let lines: Vec<u32> = moments.first.iter().filter_map(|(_, line)| *line).collect();
        let otherwise = otherwise.filter(|_| lines.is_empty());
        Self {
            lines: otherwise.into_iter().chain(lines).collect(),
            count: u32::try_from(moments.count).unwrap_or(u32::MAX),
            subjects: vec![subject],
            moments: moments.first().collect(),
            pointer: None,
        }
    }
}

/// Counts the rows that needed the same mending and remembers the first, so that a thousand rows make one diagnostic.
#[derive(Clone, Copy, Default)]
pub(crate) struct Tally {
    pub(crate) count: usize,
    /// The first different rows.
    rows: [Option<u32>; Diagnostic::MOST_PLACES],
}

impl Tally {
    /// Counts one more, in the same row as before or in another one.
    pub(crate) fn add(&mut self, row: u32) {
        self.count += 1;
        let free = self.rows.iter().position(Option::is_none);
        let before = free.unwrap_or(self.rows.len()).checked_sub(1);
        if let Some(free) = free
            && before.is_none_or(|before| self.rows[before] != Some(row))
        {
            self.rows[free] = Some(row);
        }
    }

    /// Counts rows that follow one another.
    pub(crate) fn add_range(&mut self, rows: std::ops::Range<u32>) {
        let kept = rows.len().min(Diagnostic::MOST_PLACES);
        rows.clone().take(kept).for_each(|row| self.add(row));
        self.count = self.count.saturating_add(rows.len() - kept);
    }

    fn count_u32(&self) -> u32 {
        u32::try_from(self.count).unwrap_or(u32::MAX)
    }
}

/// Counts keys, or bones of a clip, that needed the same mending, and remembers when and where the first are.
#[derive(Default)]
pub(crate) struct Moments {
    pub(crate) count: usize,
    /// The first, with their lines.
    first: Vec<(Moment, Option<u32>)>,
}

impl Moments {
    /// Counts one more. `line` is asked of the first only.
    pub(crate) fn add(&mut self, moment: Moment, line: impl FnOnce() -> Option<u32>) {
        self.count += 1;
        if self.first.len() < Diagnostic::MOST_PLACES {
            self.first.push((moment, line()));
        }
    }

    /// The first for a message: ` (bone 3 at 0.5 s)`, or ` (first: bone 3 at 0.5 s)` of several.
    pub(crate) fn first_in_words(&self) -> String {
        let Some((Moment { time_secs, bone }, _)) = self.first.first() else {
            return String::new();
        };
        let bone = bone.map(|bone| format!("bone {bone}"));
        let time = time_secs.map(|time_secs| format!("at {time_secs} s"));
        let words: Vec<String> = bone.into_iter().chain(time).collect();
        let first = if self.count == 1 { "" } else { "first: " };
        format!(" ({first}{})", words.join(" "))
    }

    /// When and on which bones the first are.
    pub(crate) fn first(&self) -> impl Iterator<Item = Moment> {
        self.first.iter().map(|(moment, _)| *moment)
    }
}

/// `1 vertex`, `2 vertices`.
pub(crate) fn counted(count: usize, one: &str, many: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { many })
}

/// The first few of some names, each once: `"Skin"`, `"Skin", "Hair", "Coat" and 3 more`.
pub(crate) fn named<'a>(names: impl IntoIterator<Item = &'a str>) -> String {
    let mut met = HashSet::new();
    let names = names.into_iter().filter(|name| met.insert(*name));
    few(&names.map(quoted).collect::<Vec<_>>())
}

/// The first few of some words.
pub(crate) fn few(words: &[String]) -> String {
    let mut few = Few::default();
    few.extend(words.iter().cloned());
    few.to_string()
}

/// The first few of some words, and how many they are: no others are kept.
#[derive(Default)]
pub(crate) struct Few {
    first: Vec<String>,
    pub(crate) count: usize,
}

impl Extend<String> for Few {
    fn extend<T: IntoIterator<Item = String>>(&mut self, words: T) {
        const MOST: usize = 3;
        for word in words {
            self.count += 1;
            if self.first.len() < MOST {
                self.first.push(word);
            }
        }
    }
}

impl fmt::Display for Few {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.first.join(", "))?;
        match self.count - self.first.len() {
            0 => Ok(()),
            more => write!(f, " and {more} more"),
        }
    }
}

/// A name between quotation marks. A very long one is cut.
pub(crate) fn quoted(name: &str) -> String {
    format!("\"{}\"", shortened(name))
}

/// The first letters of a name that may be long.
pub(crate) fn shortened(name: &str) -> Cow<'_, str> {
    const MOST_LETTERS: usize = 40;
    match name.char_indices().nth(MOST_LETTERS) {
        Some((end, _)) => Cow::Owned(format!("{}…", &name[..end])),
        None => Cow::Borrowed(name),
    }
}
