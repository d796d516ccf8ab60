//! Diagnostics as lines, in colours where they go to a terminal.

use std::io::{self, Write};
use std::path::Path;

use anstyle::{AnsiColor, Style};

use crate::check::report::{self, Ink};
use crate::diagnostic::{Diagnostic, Severity};
use crate::format::Excerpt;

/// Whether text goes out in colours.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Colors(pub(super) bool);

impl Colors {
    /// A part of a line in its colour.
    pub(super) fn paint(self, ink: Ink, text: &str) -> String {
        if !self.0 {
            return text.to_owned();
        }
        let style = match ink {
            Ink::Place => Style::new(),
            Ink::Severity(Severity::Error) => AnsiColor::Red.on_default(),
            Ink::Severity(Severity::Warning) => AnsiColor::Yellow.on_default(),
            Ink::Severity(Severity::Note) => AnsiColor::Cyan.on_default(),
        };
        let style = style.bold();
        format!("{}{text}{}", style.render(), style.render_reset())
    }
}

/// Writes `file:line:column: severity[code]: message`, the lines that it is about, and the lines of others like it.
pub(super) fn write_diagnostic(
    out: &mut dyn Write,
    path: &Path,
    diagnostic: &Diagnostic,
    excerpt: Option<&Excerpt>,
) -> io::Result<()> {
    let text = report::finding(&path.to_string_lossy(), diagnostic, excerpt, &report::plain);
    out.write_all(text.as_bytes())
}

/// `line:column: severity[code]: message`; without the numbers when there is no place.
pub(super) fn worded_place(diagnostic: &Diagnostic) -> String {
    let place = match (diagnostic.position, diagnostic.place_in_file()) {
        (Some(position), _) => format!("{}:{}: ", position.line, position.column),
        (None, place) if place.is_empty() => place,
        (None, place) => format!("{place}: "),
    };
    format!(
        "{place}{}[{}]: {}",
        diagnostic.severity, diagnostic.code, diagnostic.message
    )
}
