//! What was found in a file, as lines of text: for terminals and for the clipboard.

use std::fmt;

use super::book::Verdict;
use crate::diagnostic::{Diagnostic, Severity};
use crate::format::{Excerpt, LineIndex, is_printable};

/// A file and what was found in it.
#[derive(Clone, Copy, Debug)]
pub struct CheckedFile<'a> {
    /// Path or name, as the person gave it.
    pub path: &'a str,
    /// What it holds.
    pub bytes: &'a [u8],
    /// What was found.
    pub diagnostics: &'a [Diagnostic],
    /// What books' programs make of it.
    pub verdicts: &'a [Verdict],
}

/// A part of a line that may have a colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ink {
    /// File, line and column.
    Place,
    /// The word of a severity, or of a book.
    Severity(Severity),
}

/// Gives a part of a line its colour.
pub type Paint<'a> = &'a dyn Fn(Ink, &str) -> String;

/// Leaves all text without colours.
pub fn plain(_: Ink, text: &str) -> String {
    text.to_owned()
}

/// All findings of a file with the lines of the file that they are about, then the verdicts. Empty without any.
pub fn text(file: &CheckedFile<'_>, paint: Paint<'_>) -> String {
    let CheckedFile {
        path,
        bytes,
        diagnostics,
        verdicts,
    } = *file;
    if diagnostics.is_empty() && verdicts.is_empty() {
        return String::new();
    }
    let lines = LineIndex::new(bytes);
    let excerpt = |diagnostic: &Diagnostic| Some(lines.excerpt(diagnostic.position?, diagnostic.length));
    let of_findings = diagnostics
        .iter()
        .map(|diagnostic| finding(path, diagnostic, excerpt(diagnostic).as_ref(), paint));
    let of_books = verdicts.iter().map(|of_book| verdict(path, of_book, &lines, paint));
    of_findings.chain(of_books).collect()
}

/// `file:line:column: severity[code]: message`, the lines that it is about, and the numbers of others like it.
pub fn finding(path: &str, diagnostic: &Diagnostic, excerpt: Option<&Excerpt>, paint: Paint<'_>) -> String {
    let place = format!("{path}{}", diagnostic.place_in_file());
    let place = paint(Ink::Place, &OneLine(&place).to_string());
    let severity = format!("{}[{}]", diagnostic.severity, diagnostic.code);
    let severity = paint(Ink::Severity(diagnostic.severity), &severity);
    let lines = excerpt.map(Excerpt::to_string).unwrap_or_default();
    let others = also_on(diagnostic).map(|others| format!("   = also on {others}\n"));
    format!(
        "{place}: {severity}: {}\n{lines}{}",
        OneLine(&diagnostic.message),
        others.unwrap_or_default()
    )
}

/// Where a book's program goes wrong, what one sees, and the limits.
fn verdict(path: &str, verdict: &Verdict, lines: &LineIndex<'_>, paint: Paint<'_>) -> String {
    let book = verdict.book.label();
    let shows = OneLine(&verdict.shows);
    let mut text = match &verdict.trouble {
        Some(trouble) => {
            let at = trouble.position;
            let place = format!("{path}:{}:{}", at.line, at.column);
            let place = paint(Ink::Place, &OneLine(&place).to_string());
            let word = paint(Ink::Severity(Severity::Warning), book);
            let (why, excerpt) = (OneLine(&trouble.why), lines.excerpt(at, trouble.length));
            format!("{place}: {word}: {why}\n{excerpt}   = one sees: {shows}\n")
        }
        None => {
            let place = paint(Ink::Place, &OneLine(path).to_string());
            let word = paint(Ink::Severity(Severity::Note), book);
            format!("{place}: {word}: It reads the file. One sees: {shows}\n")
        }
    };
    let limits = verdict.limits.iter();
    text.extend(limits.map(|limit| format!("   = {}: {}\n", limit.code, OneLine(&limit.message))));
    text
}

/// The other lines of a diagnostic: `line 12`, `lines 12, 16, 20, …`.
fn also_on(diagnostic: &Diagnostic) -> Option<String> {
    let mut lines: Vec<u32> = diagnostic.few_places().iter().map(|place| place.line).collect();
    lines.dedup();
    let others: Vec<String> = lines.iter().skip(1).map(u32::to_string).collect();
    let more = diagnostic.count as usize > diagnostic.few_places().len();
    match (others.as_slice(), more) {
        ([], _) => None,
        ([line], false) => Some(format!("line {line}")),
        _ => Some(format!("lines {}{}", others.join(", "), if more { ", …" } else { "" })),
    }
}

/// Text from outside on one line: characters that end the line or control a terminal are written as escapes, such as `\n`.
#[derive(Clone, Copy, Debug)]
pub struct OneLine<'a>(pub &'a str);

impl fmt::Display for OneLine<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        use fmt::Write as _;
        self.0.chars().try_for_each(|character| {
            if is_printable(character) {
                f.write_char(character)
            } else {
                write!(f, "{}", character.escape_default())
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_stays_one_line() {
        let name = "a\nb\r\u{85}\u{1b}[31m\u{202e}ä";
        assert_eq!(OneLine(name).to_string(), "a\\nb\\r\\u{85}\\u{1b}[31m\\u{202e}ä");
    }
}
