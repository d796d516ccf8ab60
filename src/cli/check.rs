//! `bindpose check`: all that is wrong with files, or was mended, and what the books' programs make of them.

use std::collections::HashMap;
use std::io::{self, IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::ValueEnum;
use indicatif::{ProgressBar, ProgressStyle};
use serde::Serialize;

use super::diagnostic::Colors;
use super::failure::{Failure, Outcome};
use super::in_order::in_order;
use super::input;
use super::paths;
use super::text::counted;
use super::textures::{MapState, Textures, Wanted, by_name, missing, without_name};
use crate::anim::CompiledClip;
use crate::check::book::{self, Book, Known, Verdict};
use crate::check::report::{self, CheckedFile};
use crate::check::{self, sarif};
use crate::diagnostic::{Diagnostic, Severity, Subject, codes};
use crate::format;
use crate::import::{self, Imported};
use crate::session::summary::{self, Finding};
use crate::session::{File, Maps};

/// List what is wrong with files, or was mended while reading them.
///
/// One line for each finding, with the lines of the file that it is about. A file without findings prints nothing.
#[derive(Debug, clap::Args)]
#[command(after_long_help = OUTPUT)]
pub(super) struct Arguments {
    /// Files to read, folders with models in them, or - for standard input.
    #[arg(required_unless_present = "explain", value_name = "PATH")]
    paths: Vec<PathBuf>,
    /// How findings are printed; see below.
    #[arg(long, value_name = "FORMAT", default_value = "text")]
    format: Format,
    /// The same as --format json.
    #[arg(long, conflicts_with = "format")]
    json: bool,
    /// What, besides errors, makes the exit code 1.
    #[arg(long, value_name = "WHAT", value_delimiter = ',')]
    deny: Vec<Deny>,
    /// Whether the programs of Frank Luna's books read the files, and what they show.
    #[arg(long, value_name = "BOOK")]
    book: Option<WhichBooks>,
    /// Look for maps in this folder and in those in it; may be given more than once.
    #[arg(long, value_name = "DIR")]
    textures: Vec<PathBuf>,
    /// Say what a code means, instead of reading files.
    #[arg(long, value_name = "CODE", conflicts_with_all = ["paths", "json", "format", "deny", "book", "textures"])]
    explain: Option<String>,
    /// Colours: auto is on a terminal.
    #[arg(long, value_name = "WHEN", default_value = "auto")]
    color: When,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    Text,
    Json,
    Sarif,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Deny {
    /// Warnings too.
    Warnings,
    /// A book that does not read a file, or whose demo ends before it shows anything.
    Book,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum WhichBooks {
    D3d11,
    D3d12,
    All,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum When {
    Auto,
    Always,
    Never,
}

const OUTPUT: &str = "\
Text:
  FILE:LINE:COLUMN: SEVERITY[CODE]: MESSAGE
  and the line of the file with a mark under the place; without :LINE:COLUMN when it is about the whole file.
  Findings come in the order of the file. Many alike are one, with the lines of the next few below it.
  Of a folder every .m3d file below it is read, by path. After several files comes a line with counts.
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
                      \"triangle\", \"bone\", \"clip\" or \"map\") and index, its number in the file from 0; maps
                      are counted as `info --json` lists them
    count             how many alike things it tells of, 1 or more
    places            line and column of the first four of them; empty when it is about the whole file
    help              what --explain tells of the code
  book                what the books' programs make of it, or null without --book
    d3d11, d3d12      null when not asked for
      reads           whether its loader reads the file as it is meant
      line, column    where it goes wrong, or null
      why             what happens there, or null
      shows           what one then sees
      ends            whether its demo ends before it shows anything
      limits          what the demo cannot show as it is meant: code and message of each

SARIF: version 2.1.0, with columns in UTF-16 code units; what books make of a file are results too.

--textures DIR adds a finding for each map that is missing or cannot be read, and, when one file is read, for
pictures that no material names.

A file that cannot be read is named on standard error; the others are still checked.

Exit codes:
  0  no errors; notes and warnings are fine
  1  a file has errors, or what --deny names: warnings; a book that does not read a file, or whose demo ends
  2  wrong use, an unknown code, or a file cannot be read";

/// What is known of one file.
struct Checked {
    path: PathBuf,
    bytes: Vec<u8>,
    diagnostics: Vec<Diagnostic>,
    verdicts: Vec<Verdict>,
}

pub(super) fn run(arguments: &Arguments, out: &mut dyn Write, err: &mut dyn Write) -> Result<Outcome, Failure> {
    if let Some(name) = &arguments.explain {
        explain(name, out)?;
        return Ok(Outcome::Fine);
    }
    let format = if arguments.json { Format::Json } else { arguments.format };
    let colors = Colors(match arguments.color {
        When::Auto => io::stdout().is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty()),
        When::Always => true,
        When::Never => false,
    });
    let models = paths::models(&arguments.paths).into_iter();
    let models: Vec<_> = models.map(|model| model.map_err(Arc::new)).collect();
    let is_only = models.len() == 1;
    let progress = progress(models.len());
    let mut outcome = Outcome::Fine;
    let mut counts = Counts::default();
    let mut json = Vec::new();
    let mut results = Vec::new();
    let done = in_order(
        &models,
        |model| match model {
            Ok(path) => check_file(path, arguments, is_only).map_err(Arc::new),
            Err(failure) => Err(Arc::clone(failure)),
        },
        |_, checked| -> Result<(), Failure> {
            progress.inc(1);
            let checked = match checked {
                Ok(checked) => checked,
                Err(failure) => {
                    // Keeps the order of the files where both streams go to one terminal.
                    out.flush()?;
                    outcome = outcome.max(progress.suspend(|| failure.report(err)));
                    return Ok(());
                }
            };
            counts.add(&checked);
            outcome = outcome.max(checked.outcome(&arguments.deny));
            match format {
                Format::Text => progress.suspend(|| checked.write(out, colors))?,
                Format::Json => json.push(serde_json::to_value(checked.report(arguments.book))?),
                Format::Sarif => results.push(checked.sarif_results()),
            }
            Ok(())
        },
    );
    progress.finish_and_clear();
    done?;
    match format {
        Format::Text if models.len() > 1 => writeln!(out, "{counts}")?,
        Format::Text => {}
        Format::Json => {
            serde_json::to_writer_pretty(&mut *out, &json)?;
            writeln!(out)?;
        }
        Format::Sarif => {
            serde_json::to_writer_pretty(&mut *out, &sarif::log(results))?;
            writeln!(out)?;
        }
    }
    Ok(outcome)
}

/// A line on standard error that tells how far it is, where that is a terminal and there is more than one file.
fn progress(files: usize) -> ProgressBar {
    if files < 2 {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::new(files as u64);
    if let Ok(style) = ProgressStyle::with_template("checking {pos} of {len} files, {eta} left") {
        bar.set_style(style);
    }
    bar
}

fn check_file(path: &Path, arguments: &Arguments, is_only: bool) -> Result<Checked, Failure> {
    let bytes = paths::read(path)?;
    let imported = import::import_beside(&bytes, &|name| input::beside(path, name));
    let mut diagnostics = Vec::new();
    let mut missing_maps = None;
    if let Ok(imported) = &imported
        && !arguments.textures.is_empty()
    {
        let found = findings_of_maps(imported, &arguments.textures, is_only)?;
        missing_maps = Some(found.missing);
        diagnostics = found.diagnostics;
    }
    let verdicts = verdicts(arguments.book, &bytes, imported.as_ref().ok(), missing_maps.as_deref());
    diagnostics.extend(diagnostics_of(imported));
    diagnostics.sort_by_key(|diagnostic| diagnostic.position);
    Ok(Checked {
        path: path.to_owned(),
        bytes,
        diagnostics,
        verdicts,
    })
}

/// All diagnostics of a file and of its model.
fn diagnostics_of(imported: Result<Imported, Box<import::Refused>>) -> Vec<Diagnostic> {
    match imported {
        Ok(imported) => {
            let compiled = CompiledClip::all(&imported.model.clips);
            let checked = check::model(&imported.model, &compiled, &imported.lines);
            imported.diagnostics.into_iter().chain(checked).collect()
        }
        Err(refused) => refused.diagnostics.into_iter().chain([refused.error]).collect(),
    }
}

fn verdicts(
    books: Option<WhichBooks>,
    bytes: &[u8],
    imported: Option<&Imported>,
    missing_maps: Option<&[String]>,
) -> Vec<Verdict> {
    let books: &[Book] = match books {
        None => return Vec::new(),
        Some(WhichBooks::D3d11) => &[Book::D3d11],
        Some(WhichBooks::D3d12) => &[Book::D3d12],
        Some(WhichBooks::All) => &Book::ALL,
    };
    let parsed = imported.and_then(|_| format::parse(bytes).ok());
    let known = Known {
        document: parsed.as_ref().map(|parsed| &parsed.document),
        handedness: imported.map(|imported| imported.model.handedness),
        missing_maps,
    };
    books.iter().map(|&book| book::verdict(book, bytes, &known)).collect()
}

/// What looking for maps gives.
struct FoundMaps {
    diagnostics: Vec<Diagnostic>,
    /// Names without a file, each once.
    missing: Vec<String>,
}

fn findings_of_maps(imported: &Imported, folders: &[PathBuf], is_only: bool) -> Result<FoundMaps, Failure> {
    let materials = &imported.model.materials;
    let mut textures = Textures::read(folders, materials, Wanted::Maps)?;
    let mut maps = Maps::without_mips();
    let pictures = std::mem::take(&mut textures.pictures).into_iter();
    let own = imported
        .pictures
        .iter()
        .map(|picture| File::new(&picture.name, Arc::clone(&picture.bytes)));
    maps.add(materials, pictures.chain(own));
    let states = textures.states(materials, &maps);
    let mut diagnostics = Vec::new();
    let mut absent = Vec::new();
    let mut indices = HashMap::new();
    for (index, map) in (0..).zip(&states) {
        indices.entry(map.name).or_insert(index);
    }
    // A name that several materials have is told once, with the first.
    for (map, users) in by_name(&states) {
        let diagnostic = match &map.state {
            Some(MapState::Missing) => {
                absent.push(map.name.to_owned());
                missing(map, users)
            }
            Some(MapState::Unreadable(path, diagnostic)) => Diagnostic {
                message: format!("{}: {}", path.display(), without_name(diagnostic, path).message),
                ..diagnostic.clone()
            },
            Some(MapState::Found(_)) | None => continue,
        };
        diagnostics.push(Diagnostic {
            subject: indices.get(map.name).copied().map(Subject::Map),
            ..diagnostic
        });
    }
    if is_only && let Some(first) = textures.unnamed.first() {
        let first = File::new(&first.to_string_lossy(), []);
        let others = match textures.unnamed.len() - 1 {
            0 => String::new(),
            others => format!(" and {}", counted(others, "other picture")),
        };
        diagnostics.push(Diagnostic {
            count: u32::try_from(textures.unnamed.len()).unwrap_or(u32::MAX),
            ..codes::MAP_UNUSED.says(format!("No material names {}{others}.", first.base_name()))
        });
    }
    Ok(FoundMaps {
        diagnostics,
        missing: absent,
    })
}

/// What --json prints of a file.
#[derive(Serialize)]
struct Report<'a> {
    file: String,
    findings: Vec<Explained<'a>>,
    book: Option<summary::Books<'a>>,
}

/// A finding and what its code means.
#[derive(Serialize)]
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

impl Checked {
    fn outcome(&self, deny: &[Deny]) -> Outcome {
        let worst = self.diagnostics.iter().map(|diagnostic| diagnostic.severity).max();
        let is_denied =
            |severity| severity == Severity::Error || (severity == Severity::Warning && deny.contains(&Deny::Warnings));
        let book_fails =
            deny.contains(&Deny::Book) && self.verdicts.iter().any(|verdict| !verdict.reads() || verdict.ends);
        if book_fails || worst.is_some_and(is_denied) {
            Outcome::FileHasErrors
        } else {
            Outcome::Fine
        }
    }

    fn write(&self, out: &mut dyn Write, colors: Colors) -> io::Result<()> {
        let text = report::text(&self.file(&self.path.to_string_lossy()), &|ink, text| {
            colors.paint(ink, text)
        });
        out.write_all(text.as_bytes())
    }

    fn file<'a>(&'a self, path: &'a str) -> CheckedFile<'a> {
        CheckedFile {
            path,
            bytes: &self.bytes,
            diagnostics: &self.diagnostics,
            verdicts: &self.verdicts,
        }
    }

    fn report(&self, books: Option<WhichBooks>) -> Report<'_> {
        Report {
            file: self.path.display().to_string(),
            findings: self.diagnostics.iter().map(Explained::from).collect(),
            book: books.map(|_| summary::Books::of(&self.verdicts)),
        }
    }

    fn sarif_results(&self) -> sarif::Results {
        sarif::Results::of(&self.file(&self.path.to_string_lossy()))
    }
}

/// How much was found in all files.
#[derive(Default)]
struct Counts {
    files: usize,
    errors: usize,
    warnings: usize,
    notes: usize,
}

impl Counts {
    fn add(&mut self, checked: &Checked) {
        self.files += 1;
        for diagnostic in &checked.diagnostics {
            *match diagnostic.severity {
                Severity::Error => &mut self.errors,
                Severity::Warning => &mut self.warnings,
                Severity::Note => &mut self.notes,
            } += 1;
        }
    }
}

impl std::fmt::Display for Counts {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self {
            files,
            errors,
            warnings,
            notes,
        } = *self;
        write!(
            f,
            "{}: {}, {}, {}",
            counted(files, "file"),
            counted(errors, "error"),
            counted(warnings, "warning"),
            counted(notes, "note")
        )
    }
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
