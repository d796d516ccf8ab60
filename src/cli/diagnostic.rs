//! Diagnostics as lines, in colours where they go to a terminal.

use std::io::{self, Write};
use std::path::Path;

use anstyle::{AnsiColor, Style};

use super::text::OneLine;
use crate::diagnostic::{Diagnostic, Severity};
use crate::format::Excerpt;

/// Whether text goes out in colours.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Colors(pub(super) bool);

impl Colors {
    /// The text in a style.
    pub(super) fn paint(self, style: Style, text: &str) -> String {
        if self.0 {
            format!("{}{text}{}", style.render(), style.render_reset())
        } else {
            text.to_owned()
        }
    }

    /// The style of a severity's word.
    pub(super) fn of(severity: Severity) -> Style {
        let color = match severity {
            Severity::Error => AnsiColor::Red,
            Severity::Warning => AnsiColor::Yellow,
            Severity::Note => AnsiColor::Cyan,
        };
        color.on_default().bold()
    }
}

/// Writes `file:line:column: severity[code]: message`, the lines that it is about, and the lines of others like it.
pub(super) fn write_diagnostic(
    out: &mut dyn Write,
    path: &Path,
    diagnostic: &Diagnostic,
    excerpt: Option<&Excerpt>,
) -> io::Result<()> {
    write_in_colors(out, Colors(false), path, diagnostic, excerpt)
}

/// The same in colours.
pub(super) fn write_in_colors(
    out: &mut dyn Write,
    colors: Colors,
    path: &Path,
    diagnostic: &Diagnostic,
    excerpt: Option<&Excerpt>,
) -> io::Result<()> {
    let place = diagnostic.position.map_or_else(
        || path.display().to_string(),
        |at| format!("{}:{}:{}", path.display(), at.line, at.column),
    );
    let place = colors.paint(Style::new().bold(), &OneLine(&place).to_string());
    let severity = format!("{}[{}]", diagnostic.severity, diagnostic.code);
    let severity = colors.paint(Colors::of(diagnostic.severity), &severity);
    writeln!(out, "{place}: {severity}: {}", OneLine(&diagnostic.message))?;
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
