//! Diagnostics as lines.

use std::io::{self, Write};
use std::path::Path;

use super::text::OneLine;
use crate::diagnostic::Diagnostic;
use crate::format::Excerpt;

/// Writes `file:line:column: severity[code]: message`, the lines that it is about, and the lines of others like it.
pub(super) fn write_diagnostic(
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
