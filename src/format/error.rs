//! What is said about a file that cannot be read. Texts that come from it are shortened and made printable.

use crate::diagnostic::{Diagnostic, codes};

/// What a number in the file stands for.
#[derive(Clone, Copy, Debug)]
pub(super) enum Value {
    /// A count of the header, by its name there.
    Count(&'static str),
    /// A whole number of the subset table, by its label.
    Subset(&'static str),
    /// One of the numbers of a row, by its label.
    Number(&'static str),
    BlendIndex,
    VertexIndex,
    Parent,
    KeyframeCount,
}

impl Value {
    /// The beginning of a sentence about it.
    fn subject(self) -> String {
        match self {
            Self::Count(name) => format!("The header's count of {name}"),
            Self::Subset(label) => label.into(),
            Self::Number(label) => format!("A value of {label}"),
            Self::BlendIndex => "A blend index".into(),
            Self::VertexIndex => "A vertex index".into(),
            Self::Parent => "A parent index".into(),
            Self::KeyframeCount => "The number of keyframes".into(),
        }
    }

    /// What it is a part of, to be said behind what was expected.
    fn owner(self) -> String {
        match self {
            Self::Count(name) | Self::Subset(name) | Self::Number(name) => format!(" of {name}"),
            Self::BlendIndex | Self::VertexIndex | Self::Parent | Self::KeyframeCount => String::new(),
        }
    }

    /// What belongs in its place, in a few words.
    pub(super) fn expected(self) -> &'static str {
        match self {
            Self::Count(_) => "a count",
            Self::Subset(_) => "a whole number",
            Self::Number(_) => "a number",
            Self::BlendIndex => "a bone index",
            Self::VertexIndex => "a vertex index",
            Self::Parent => "a parent index",
            Self::KeyframeCount => "a number of keyframes",
        }
    }

    /// The line ends before it.
    pub(super) fn missing(self) -> Diagnostic {
        let expected = self.expected();
        let message = format!("The line ends where {expected}{} was expected.", self.owner());
        let fault = codes::VALUE_MISSING.says(message);
        fault.expected(expected).found("the end of the line")
    }

    /// A word stands in its place.
    pub(super) fn not_a_number(self, word: &[u8]) -> Diagnostic {
        let found = quoted(word);
        let message = format!("{} must be a number, but \"{found}\" was found.", self.subject());
        let fault = codes::NOT_A_NUMBER.says(message);
        fault.expected(self.expected()).found(found)
    }

    /// No whole number stands in its place, or one outside of a range, which is empty where `largest` is less than `smallest`.
    pub(super) fn not_in_range(self, smallest: i64, largest: i64, word: &[u8]) -> Diagnostic {
        let found = quoted(word);
        let must = if largest < smallest {
            "has nothing to point at here".into()
        } else if largest == i64::from(u32::MAX) {
            // A bound that is only what fits would explain nothing.
            format!("must be a whole number, {smallest} or more")
        } else {
            format!("must be a whole number from {smallest} to {largest}")
        };
        let message = format!("{} {must}, but \"{found}\" was found.", self.subject());
        let fault = codes::NOT_IN_RANGE.says(message);
        fault.expected(self.expected()).found(found)
    }
}

/// `announcer` (`The header`) announces a number of rows, and `holder` (`the Vertices section`) has another one. `rows` is in the plural.
pub(super) fn row_count(announcer: &str, rows: &str, holder: &str, announced: u32, counted: usize) -> Diagnostic {
    let counted = u32::try_from(counted).unwrap_or(u32::MAX);
    let expected = counted_rows(announced, rows);
    let message = format!("{announcer} announces {expected}, but {holder} holds {counted}.");
    let fault = codes::ROW_COUNT.says(message);
    fault.expected(expected).found(counted_rows(counted, rows))
}

/// `1 vertex`, `2 vertices`.
fn counted_rows(count: u32, rows: &str) -> String {
    match rows {
        _ if count != 1 => format!("{count} {rows}"),
        "vertices" => "1 vertex".into(),
        _ => format!("1 {}", rows.strip_suffix('s').unwrap_or(rows)),
    }
}

/// `text` as a message may quote it: printable, and no longer than a glance.
pub(super) fn quoted(text: &[u8]) -> String {
    /// Characters of a quote.
    const LONGEST: usize = 32;
    // A character has up to four bytes; what is cut is marked below.
    let start = text.get(..4 * LONGEST).unwrap_or(text);
    let decoded = String::from_utf8_lossy(start);
    let mut quote: String = decoded
        .chars()
        .take(LONGEST)
        .map(|character| {
            if character.is_control() {
                char::REPLACEMENT_CHARACTER
            } else {
                character
            }
        })
        .collect();
    if start.len() < text.len() || decoded.chars().nth(LONGEST).is_some() {
        quote.push('…');
    }
    quote
}
