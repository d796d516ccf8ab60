//! What was found in a file, as lines of text: for terminals and for the clipboard.

use std::collections::HashSet;
use std::fmt;

use super::book::{Limit, Verdict, converted_in_words};
use crate::diagnostic::{Code, Diagnostic, Severity, codes};
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
    /// Of a file of another format than theirs, what it would exceed there even converted; `None` where nobody asked.
    pub converted: Option<&'a [Limit]>,
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

/// All findings of a file with the lines of the file that they are about, then the verdicts, and how to keep what was mended. Empty without
/// any. `with_help`: the first finding of a code, and each limit of a book, has what the table of codes says of it.
pub fn text(file: &CheckedFile<'_>, with_help: bool, paint: Paint<'_>) -> String {
    let CheckedFile {
        path,
        bytes,
        diagnostics,
        verdicts,
        converted,
    } = *file;
    if diagnostics.is_empty() && verdicts.is_empty() && converted.is_none() {
        return String::new();
    }
    let lines = LineIndex::new(bytes);
    let excerpt = |diagnostic: &Diagnostic| Some(lines.excerpt(diagnostic.position?, diagnostic.length));
    let mut helped = HashSet::new();
    let mut text = String::new();
    for diagnostic in diagnostics {
        text += &finding(path, diagnostic, excerpt(diagnostic).as_ref(), paint);
        if with_help
            && helped.insert(diagnostic.code)
            && let Some(code) = codes::named(diagnostic.code)
        {
            text += &format!("   = {}\n   = to mend it: {}\n", code.explanation, code.mending);
        }
    }
    let of_books = verdicts
        .iter()
        .map(|of_book| verdict(path, of_book, &lines, with_help, paint));
    text.extend(of_books);
    if let Some(limits) = converted {
        let severity = [Severity::Warning, Severity::Note][usize::from(limits.is_empty())];
        let place = paint(Ink::Place, &OneLine(path).to_string());
        let word = paint(Ink::Severity(severity), "Book demos");
        text += &format!("{place}: {word}: {}\n", OneLine(&converted_in_words(limits)));
    }
    text + &permanent(file, paint)
}

/// How to keep what is mended, or can be: one line for each way, with the codes that it is true of. Empty for a file that is not opened.
fn permanent(file: &CheckedFile<'_>, paint: Paint<'_>) -> String {
    if file
        .diagnostics
        .iter()
        .any(|diagnostic| diagnostic.severity == Severity::Error)
    {
        return String::new();
    }
    let of_books: Vec<Diagnostic> = file.verdicts.iter().flat_map(Verdict::diagnostics).collect();
    let mut ways: Vec<(&str, Vec<&str>)> = Vec::new();
    for diagnostic in file.diagnostics.iter().chain(&of_books) {
        let Some(way) = codes::named(diagnostic.code).and_then(Code::permanent) else {
            continue;
        };
        match ways.iter_mut().find(|(known, _)| *known == way) {
            Some((_, codes)) if codes.contains(&diagnostic.code) => {}
            Some((_, codes)) => codes.push(diagnostic.code),
            None => ways.push((way, vec![diagnostic.code])),
        }
    }
    let place = paint(Ink::Place, &OneLine(file.path).to_string());
    let line = |(way, codes): (&str, Vec<&str>)| format!("{place}: {}: {way}\n", codes.join(", "));
    ways.into_iter().map(line).collect()
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
fn verdict(path: &str, verdict: &Verdict, lines: &LineIndex<'_>, with_help: bool, paint: Paint<'_>) -> String {
    let (shows, outcome) = (OneLine(&verdict.shows), verdict.outcome);
    let severity = if verdict.is_bad() {
        Severity::Warning
    } else {
        Severity::Note
    };
    let word = paint(Ink::Severity(severity), verdict.book.label());
    let mut text = match &verdict.trouble {
        Some(trouble) => {
            let at = trouble.position;
            let place = format!("{path}:{}:{}", at.line, at.column);
            let place = paint(Ink::Place, &OneLine(&place).to_string());
            let (why, excerpt) = (OneLine(&trouble.why), lines.excerpt(at, trouble.length));
            format!("{place}: {word}: {outcome}. {why}\n{excerpt}   = one sees: {shows}\n")
        }
        None => {
            let place = paint(Ink::Place, &OneLine(path).to_string());
            format!("{place}: {word}: {outcome}. One sees: {shows}\n")
        }
    };
    for limit in &verdict.limits {
        let help = codes::named(limit.code).filter(|_| with_help);
        let help = help.map(|code| format!(" {}", code.mending)).unwrap_or_default();
        text += &format!("   = {}: {}{help}\n", limit.code, OneLine(&limit.message));
    }
    text
}

/// Up to this many places of a finding are named one by one.
const MOST_NAMED: usize = 10;

/// The other lines of a diagnostic: `line 12`, `lines 12, 16, 20`, `lines 12, 16, 20 and 88 more places`.
fn also_on(diagnostic: &Diagnostic) -> Option<String> {
    let named = diagnostic.places.iter().take(MOST_NAMED);
    let more = (diagnostic.count as usize).saturating_sub(named.len());
    let mut lines: Vec<u32> = named.map(|place| place.line).collect();
    lines.dedup();
    let others: Vec<String> = lines.iter().skip(1).map(u32::to_string).collect();
    match (others.as_slice(), more) {
        ([], _) => None,
        ([line], 0) => Some(format!("line {line}")),
        (_, 0) => Some(format!("lines {}", others.join(", "))),
        _ => Some(format!("lines {} and {more} more places", others.join(", "))),
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
