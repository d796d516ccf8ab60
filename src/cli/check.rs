//! `bindpose check`: all that is wrong with files, or was mended.

use std::io::Write;
use std::path::PathBuf;

use serde::Serialize;

use super::failure::{Failure, Outcome};
use super::finding::write_finding;
use super::input;
use crate::anim::CompiledClip;
use crate::check;
use crate::diagnostic::{Diagnostic, Severity};
use crate::format::{self, LineIndex};
use crate::import::m3d;
use crate::session::summary::Finding;

/// List what is wrong with files, or was mended while reading them.
///
/// One line for each finding, with the lines of the file that it is about. A file without findings prints nothing.
#[derive(Debug, clap::Args)]
#[command(after_long_help = JSON)]
pub(super) struct Arguments {
    /// Files to read.
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// Print JSON; see below for its keys.
    #[arg(long)]
    json: bool,
}

const JSON: &str = "\
Output:
  FILE:LINE:COLUMN: SEVERITY[CODE]: MESSAGE
  and the line of the file with a mark under the place; without :LINE:COLUMN when it is about the whole file.
  Findings come in the order of the file. Many alike are one, with the lines of the next few below it.

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

A file that cannot be read is named on standard error; the others are still checked.

Exit codes:
  0  no errors; notes and warnings are fine
  1  a file has errors
  2  wrong use, or a file cannot be read";

/// What is known of one file.
#[derive(Debug, Serialize)]
struct Checked<'a> {
    file: String,
    findings: Vec<Finding<'a>>,
}

pub(super) fn run(arguments: &Arguments, out: &mut dyn Write, err: &mut dyn Write) -> Result<Outcome, Failure> {
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
        let findings = findings(&file.bytes);
        if findings.iter().any(|finding| finding.severity == Severity::Error) {
            outcome = outcome.max(Outcome::FileHasErrors);
        }
        if !arguments.json && !findings.is_empty() {
            let lines = LineIndex::new(&file.bytes);
            for finding in &findings {
                let excerpt = finding.position.map(|position| lines.excerpt(position, finding.length));
                write_finding(out, path, finding, excerpt.as_ref())?;
            }
        }
        all.push((path, findings));
    }
    if arguments.json {
        let checked: Vec<Checked<'_>> = all
            .iter()
            .map(|(path, findings)| Checked {
                file: path.display().to_string(),
                findings: findings.iter().map(Finding::from).collect(),
            })
            .collect();
        serde_json::to_writer_pretty(&mut *out, &checked)?;
        writeln!(out)?;
    }
    Ok(outcome)
}

/// All findings of both stages, in the order of the file; those without a place come first.
fn findings(bytes: &[u8]) -> Vec<Diagnostic> {
    let parsed = match format::parse(bytes) {
        Ok(parsed) => parsed,
        Err(error) => return vec![error.diagnostic()],
    };
    let of_model = match m3d::from_document(&parsed.document, &parsed.lines) {
        Ok((model, mut findings)) => {
            let compiled = CompiledClip::all(&model.clips);
            findings.extend(check::motion(&model, &compiled, &parsed.lines.clip_lines()));
            findings
        }
        Err(error) => vec![error.diagnostic()],
    };
    let mut findings = parsed.diagnostics;
    findings.extend(of_model);
    findings.sort_by_key(|finding| finding.position);
    findings
}
