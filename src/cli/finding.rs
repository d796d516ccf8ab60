//! Findings as lines and as JSON.

use std::io::{self, Write};
use std::path::Path;

use serde::Serialize;

use super::text::OneLine;
use crate::diagnostic::{Diagnostic, Position};
use crate::format::Excerpt;

/// What every output says of a finding. Line and column are `null` for a finding about the whole file.
#[derive(Debug, Serialize)]
pub(super) struct Notice<'a> {
    severity: &'static str,
    code: &'static str,
    message: &'a str,
    line: Option<u32>,
    column: Option<u32>,
}

impl<'a> From<&'a Diagnostic> for Notice<'a> {
    fn from(diagnostic: &'a Diagnostic) -> Self {
        Self {
            severity: diagnostic.severity.as_str(),
            code: diagnostic.code,
            message: &diagnostic.message,
            line: diagnostic.position.map(|position| position.line),
            column: diagnostic.position.map(|position| position.column),
        }
    }
}

/// A finding with what belonged in its place, where that can be said.
#[derive(Debug, Serialize)]
pub(super) struct Finding<'a> {
    #[serde(flatten)]
    notice: Notice<'a>,
    expected: Option<&'a str>,
    found: Option<&'a str>,
    count: u32,
    places: Vec<Place>,
}

/// One of the places that a finding is about.
#[derive(Debug, Serialize)]
struct Place {
    line: u32,
    column: u32,
}

impl<'a> From<&'a Diagnostic> for Finding<'a> {
    fn from(diagnostic: &'a Diagnostic) -> Self {
        Self {
            notice: diagnostic.into(),
            expected: diagnostic.expected.as_deref(),
            found: diagnostic.found.as_deref(),
            count: diagnostic.count,
            places: diagnostic
                .places
                .iter()
                .map(|&Position { line, column }| Place { line, column })
                .collect(),
        }
    }
}

/// `file:line:column: severity[code]: message`, then the lines it is about, and where others alike stand.
pub(super) fn write_finding(
    out: &mut dyn Write,
    path: &Path,
    diagnostic: &Diagnostic,
    excerpt: Option<&Excerpt>,
) -> io::Result<()> {
    let separator = if diagnostic.position.is_some() { ":" } else { ": " };
    let line = format!("{}{separator}{}", path.display(), worded_place(diagnostic));
    writeln!(out, "{}", OneLine(&line))?;
    if let Some(excerpt) = excerpt {
        write!(out, "{excerpt}")?;
    }
    match also_on(diagnostic) {
        Some(lines) => writeln!(out, "   = also on {lines}"),
        None => Ok(()),
    }
}

/// The other lines of a finding: `line 12`, `lines 12, 16, 20, …`.
fn also_on(diagnostic: &Diagnostic) -> Option<String> {
    let mut lines: Vec<u32> = diagnostic.places.iter().map(|place| place.line).collect();
    lines.dedup();
    let others: Vec<String> = lines.iter().skip(1).map(u32::to_string).collect();
    let more = diagnostic.count as usize > diagnostic.places.len();
    match (others.as_slice(), more) {
        ([], _) => None,
        ([line], false) => Some(format!("line {line}")),
        _ => Some(format!("lines {}{}", others.join(", "), if more { ", …" } else { "" })),
    }
}

/// `line:column: severity[code]: message`; without the numbers when there is no place.
pub(super) fn worded_place(diagnostic: &Diagnostic) -> String {
    let place = diagnostic
        .position
        .map(|position| format!("{}:{}: ", position.line, position.column))
        .unwrap_or_default();
    format!(
        "{place}{}[{}]: {}",
        diagnostic.severity, diagnostic.code, diagnostic.message
    )
}
