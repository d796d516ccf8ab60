//! `bindpose check`: all that is wrong with files, or was mended.

use std::io::Write;
use std::path::PathBuf;

use serde::Serialize;

use super::diagnostic::write_diagnostic;
use super::failure::{Failure, Outcome};
use super::input;
use crate::anim::CompiledClip;
use crate::check;
use crate::diagnostic::{Diagnostic, Severity, codes};
use crate::format::LineIndex;
use crate::import;
use crate::session::summary::Finding;

/// List what is wrong with files, or was mended while reading them.
///
/// One line for each finding, with the lines of the file that it is about. A file without findings prints nothing.
#[derive(Debug, clap::Args)]
#[command(after_long_help = JSON)]
pub(super) struct Arguments {
    /// Files to read.
    #[arg(required_unless_present = "explain", value_name = "FILE")]
    files: Vec<PathBuf>,
    /// Print JSON; see below for its keys.
    #[arg(long)]
    json: bool,
    /// Say what a code means, instead of reading files.
    #[arg(long, value_name = "CODE", conflicts_with_all = ["files", "json"])]
    explain: Option<String>,
}

const JSON: &str = "\
Output:
  FILE:LINE:COLUMN: SEVERITY[CODE]: MESSAGE
  and the line of the file with a mark under the place; without :LINE:COLUMN when it is about the whole file.
  Findings come in the order of the file. Many alike are one, with the lines of the next few below it.
  --explain CODE tells what a finding of this code means for the model, or what can be done.

JSON: an array with one object for each file that could be read
  file                the path as given
  findings            array, empty when there is nothing to say
    severity          \"note\", \"warning\" or \"error\"
    code              stable name of the kind of finding, for example \"weights-not-normalized\"
    message           one sentence
    line, column      place, both from 1, the column in bytes; null when it is about the whole file
    expected, found   what belonged there and what stood there, in a few words, or null
    subject           the part of the model that it is about, or null: kind (\"material\", \"subset\", \"vertex\",
                      \"triangle\", \"bone\" or \"clip\") and index, its number in the file from 0
    count             how many alike things it tells of, 1 or more
    places            line and column of the first four of them; empty when it is about the whole file
    help              what --explain tells of the code

A file that cannot be read is named on standard error; the others are still checked.

Exit codes:
  0  no errors; notes and warnings are fine
  1  a file has errors
  2  wrong use, an unknown code, or a file cannot be read";

/// What is known of one file.
#[derive(Debug, Serialize)]
struct Checked<'a> {
    file: String,
    findings: Vec<Explained<'a>>,
}

/// A finding and what its code means.
#[derive(Debug, Serialize)]
struct Explained<'a> {
    #[serde(flatten)]
    finding: Finding<'a>,
    help: Option<&'static str>,
}

impl<'a> From<&'a Diagnostic> for Explained<'a> {
    fn from(diagnostic: &'a Diagnostic) -> Self {
        Self {
            finding: diagnostic.into(),
            help: codes::named(diagnostic.code).map(|code| code.explanation),
        }
    }
}

pub(super) fn run(arguments: &Arguments, out: &mut dyn Write, err: &mut dyn Write) -> Result<Outcome, Failure> {
    if let Some(name) = &arguments.explain {
        explain(name, out)?;
        return Ok(Outcome::Fine);
    }
    let mut outcome = Outcome::Fine;
    let mut all = Vec::new();
    for path in &arguments.files {
        let file = match input::read(path) {
            Ok(file) => file,
            Err(failure) => {
                // Keeps the order of the files where both streams go to one terminal.
                out.flush()?;
                outcome = outcome.max(failure.report(err));
                continue;
            }
        };
        let diagnostics = diagnostics_of(&file.bytes);
        if diagnostics
            .iter()
            .any(|diagnostic| diagnostic.severity == Severity::Error)
        {
            outcome = outcome.max(Outcome::FileHasErrors);
        }
        if !arguments.json && !diagnostics.is_empty() {
            let lines = LineIndex::new(&file.bytes);
            for diagnostic in &diagnostics {
                let excerpt = diagnostic
                    .position
                    .map(|position| lines.excerpt(position, diagnostic.length));
                write_diagnostic(out, path, diagnostic, excerpt.as_ref())?;
            }
        }
        all.push((path, diagnostics));
    }
    if arguments.json {
        let checked: Vec<Checked<'_>> = all
            .iter()
            .map(|(path, diagnostics)| Checked {
                file: path.display().to_string(),
                findings: diagnostics.iter().map(Explained::from).collect(),
            })
            .collect();
        serde_json::to_writer_pretty(&mut *out, &checked)?;
        writeln!(out)?;
    }
    Ok(outcome)
}

/// Prints the row of the table of codes.
fn explain(name: &str, out: &mut dyn Write) -> Result<(), Failure> {
    let code = codes::named(name).ok_or_else(|| Failure::UnknownCode {
        asked: name.to_owned(),
        nearest: codes::all()
            .map(|code| code.name)
            .min_by_key(|known| edits(name, known))
            .unwrap_or_default(),
    })?;
    writeln!(out, "{}[{}]: {}", code.severity, code.name, code.sentence)?;
    writeln!(out, "{}", code.explanation)?;
    Ok(())
}

/// How many letters must be put in, left out or changed to make one word of another (Levenshtein's distance).
fn edits(from: &str, to: &str) -> usize {
    let to: Vec<char> = to.chars().collect();
    // Of each beginning of `to`, from as much of `from` as was read.
    let mut row: Vec<usize> = (0..=to.len()).collect();
    for (read, letter) in from.chars().enumerate() {
        let mut before = std::mem::replace(&mut row[0], read + 1);
        for (place, &other) in to.iter().enumerate() {
            let changed = before + usize::from(letter != other);
            before = row[place + 1];
            row[place + 1] = changed.min(before + 1).min(row[place] + 1);
        }
    }
    row[to.len()]
}

/// All diagnostics of a file, in its order; those without a place come first.
fn diagnostics_of(bytes: &[u8]) -> Vec<Diagnostic> {
    let mut diagnostics = match import::import(bytes) {
        Ok(imported) => {
            let compiled = CompiledClip::all(&imported.model.clips);
            let checked = check::model(&imported.model, &compiled, &imported.lines);
            imported.diagnostics.into_iter().chain(checked).collect::<Vec<_>>()
        }
        Err(refused) => refused.diagnostics.into_iter().chain([refused.error]).collect(),
    };
    diagnostics.sort_by_key(|diagnostic| diagnostic.position);
    diagnostics
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edits_are_counted_one_by_one() {
        for (from, to, count) in [
            ("", "", 0),
            ("", "abc", 3),
            ("abc", "", 3),
            ("same", "same", 0),
            ("weights-not-normalised", "weights-not-normalized", 1),
            ("empy-file", "empty-file", 1),
            ("kitten", "sitting", 3),
        ] {
            assert_eq!(edits(from, to), count, "{from} {to}");
        }
    }
}
