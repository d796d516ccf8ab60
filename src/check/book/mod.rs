//! Whether the books' own programs read a file, and what they show of it.
//!
//! Frank Luna's books each have a loader for the format and a demo that shows its soldier. Their loaders read words in order and look at no
//! label: a file that a person reads with ease can lead them astray. [`verdict`] reads a file as they do, step by step.

mod demo;
mod limits;
mod loader;
mod number;
mod outcome;
mod shows;
mod stream;

pub use demo::{Book, DEMO_CLIP, DEMO_MATERIALS, DEMO_SCALE, SEEN_HEIGHTS};
pub use limits::{Known, Limit};
pub use loader::{Counts, Reading, read};
pub use outcome::Outcome;
pub use stream::{Stream, Trouble};

pub use crate::diagnostic::limits::{MOST_BONES, MOST_MATERIALS, MOST_VERTICES};
use crate::diagnostic::{Diagnostic, Position, codes};
use crate::format::Dialect;
use crate::slices::{Slices, at_once};

/// What a book's program makes of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Verdict {
    /// Which book's.
    pub book: Book,
    /// What its demo does.
    pub outcome: Outcome,
    /// The file is of the other book's dialect: that this one does not read it is as it should be.
    pub is_foreign: bool,
    /// Where its loader goes wrong, and how. `None` when it reads the file as it is meant.
    pub trouble: Option<Trouble>,
    /// What one sees then, or sees anyway.
    pub shows: String,
    /// Whether the demo ends before it shows anything.
    pub ends: bool,
    /// What the demo cannot show as it is meant.
    pub limits: Vec<Limit>,
}

impl Verdict {
    /// Whether the loader reads the file as it is meant.
    pub fn reads(&self) -> bool {
        self.trouble.is_none()
    }

    /// Whether the demo shows the file once its maps are there.
    pub fn is_shown(&self) -> bool {
        matches!(self.outcome, Outcome::Shows { .. })
    }

    /// Whether it is a fault of the file that the demo does not show it.
    pub fn is_bad(&self) -> bool {
        !self.is_shown() && !self.is_foreign
    }

    /// Where it goes wrong, and the limits, as diagnostics.
    pub fn diagnostics(&self) -> impl Iterator<Item = Diagnostic> {
        let label = self.book.label();
        let stops = self.trouble.iter().map(move |trouble| Diagnostic {
            position: Some(trouble.position),
            length: trouble.length,
            places: vec![trouble.position],
            ..codes::BOOK_STOPS.says(format!("{label}: {} One sees: {}", trouble.why, self.shows))
        });
        let limits = self.limits.iter();
        stops.chain(limits.filter_map(move |limit| limit.diagnostic(label)))
    }

    /// Where it goes wrong.
    pub fn position(&self) -> Option<Position> {
        self.trouble.as_ref().map(|trouble| trouble.position)
    }
}

/// A file of another format as text tells of it: whether it fits the demos once it is converted for them, with what no conversion mends.
pub fn converted_in_words(limits: &[Limit]) -> String {
    let exceeded: Vec<&str> = limits.iter().map(|limit| limit.message.as_str()).collect();
    match exceeded.as_slice() {
        [] => "converted for the book: fits".to_owned(),
        _ => format!("converted for the book: does not fit. {}", exceeded.join(" ")),
    }
}

/// Reads a file as a book's program does.
pub fn verdict(book: Book, bytes: &[u8], known: &Known<'_>) -> Verdict {
    at_once(verdict_in(book, bytes, known, &Slices::ENDLESS))
}

/// [`verdict`] in slices.
pub async fn verdict_in(book: Book, bytes: &[u8], known: &Known<'_>, slices: &Slices) -> Verdict {
    let reading = loader::read_in(book, bytes, known, slices).await;
    slices.pause().await;
    let trouble = trouble(&reading);
    let document = known.document.or(trouble.is_none().then_some(&reading.document));
    let limits = limits::limits(book, document, &reading.document, known);
    let end = shows::ends(book, &reading);
    let outcome = match (&trouble, &end) {
        (Some(_), _) => Outcome::CannotRead,
        (None, Some((outcome, _))) => *outcome,
        (None, None) => Outcome::Shows {
            missing_maps: known
                .missing_maps
                .map_or_else(|| limits::map_count(&reading.document), <[String]>::len),
        },
    };
    let dialect = known.document.map(|document| document.dialect);
    Verdict {
        book,
        outcome,
        is_foreign: dialect.is_some_and(|dialect| (dialect == Dialect::D3d12) != (book == Book::D3d12)),
        ends: end.is_some(),
        shows: end.map_or_else(|| shows::shows(&reading), |(_, words)| words),
        limits,
        trouble,
    }
}

/// The first place at which a loader goes wrong, with what comes of it. None when it reads all as it is meant: a brace that is missing
/// at the end does no harm.
fn trouble(reading: &Reading) -> Option<Trouble> {
    let stop = reading.stop.as_ref().filter(|_| !shows::is_complete(reading));
    match (&reading.mistake, stop) {
        (Some(mistake), Some(stop)) if mistake.position < stop.position => Some(Trouble {
            why: format!(
                "{} In line {} {}",
                mistake.why,
                stop.position.line,
                without_capital(&stop.why)
            ),
            ..mistake.clone()
        }),
        (mistake, stop) => stop.or(mistake.as_ref()).cloned(),
    }
}

/// A sentence as it goes on after other words.
fn without_capital(sentence: &str) -> String {
    let mut letters = sentence.chars();
    let first = letters.next().map(|first| first.to_ascii_lowercase());
    first.into_iter().chain(letters).collect()
}
