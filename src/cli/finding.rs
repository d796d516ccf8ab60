//! Findings as lines and as JSON.

use std::io::{self, Write};
use std::path::Path;

use serde::Serialize;

use super::text::Plain;
use crate::diagnostic::Diagnostic;
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
}

impl<'a> From<&'a Diagnostic> for Finding<'a> {
    fn from(diagnostic: &'a Diagnostic) -> Self {
        Self {
            notice: diagnostic.into(),
            expected: diagnostic.expected.as_deref(),
            found: diagnostic.found.as_deref(),
        }
    }
}

/// `file:line:column: severity[code]: message`, then the lines it is about.
pub(super) fn write_finding(
    out: &mut dyn Write,
    path: &Path,
    diagnostic: &Diagnostic,
    excerpt: Option<&Excerpt>,
) -> io::Result<()> {
    let separator = if diagnostic.position.is_some() { ":" } else { ": " };
    let line = format!("{}{separator}{}", path.display(), worded_place(diagnostic));
    writeln!(out, "{}", Plain(&line))?;
    match excerpt {
        Some(excerpt) => write!(out, "{excerpt}"),
        None => Ok(()),
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
