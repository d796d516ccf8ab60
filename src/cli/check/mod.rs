//! `bindpose check`: all that is wrong with files, or was mended, and what the books' programs make of them.

mod counts;
mod explain;
mod file;
mod maps;

use std::io::{self, IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::ValueEnum;

use super::codes;
use super::diagnostic::Colors;
use super::failure::{Failure, Outcome};
use super::in_order::in_order;
use super::paths;
use super::progress::progress;
use super::textures::Folders;
use crate::check::sarif;
use counts::Counts;
use file::{BOOK, WARNINGS, WhichBooks};

/// List what is wrong with files, or was mended while reading them.
///
/// One line for each finding, with the lines of the file that it is about. A file without findings prints nothing.
#[derive(Debug, clap::Args)]
#[command(after_long_help = OUTPUT)]
pub(super) struct Arguments {
    /// Files to read, folders with models in them, or - for standard input.
    ///
    /// Links to files are followed in a folder, links to folders are not. Pipes and devices in it are skipped with a word.
    #[arg(required_unless_present = "explain", value_name = "PATH")]
    paths: Vec<PathBuf>,
    /// How findings are printed; see below.
    #[arg(long, value_name = "FORMAT", default_value = "text")]
    format: Format,
    /// The same as --format json.
    #[arg(long, conflicts_with = "format")]
    json: bool,
    /// What, besides errors, makes the exit code 1: warnings, book, or codes, with commas between; see below.
    #[arg(long, value_name = "WHAT", value_delimiter = ',', value_parser = denied)]
    deny: Vec<&'static str>,
    /// Codes that --deny does not count, with commas between.
    #[arg(long, value_name = "CODES", value_delimiter = ',', value_parser = codes::known, requires = "deny")]
    allow: Vec<&'static str>,
    /// Whether the programs of Frank Luna's books read the files, and what they show.
    #[arg(long, value_name = "BOOK")]
    book: Option<WhichBooks>,
    /// Look for maps in this folder and in those in it, links to folders included; may be given more than once.
    #[arg(long, value_name = "DIR")]
    textures: Vec<PathBuf>,
    /// Say what a code means, instead of reading files.
    #[arg(long, value_name = "CODE", conflicts_with_all = ["paths", "json", "format", "deny", "allow", "book", "textures"])]
    explain: Option<String>,
    /// Colours: auto is on a terminal that has them, or where CLICOLOR_FORCE is set, but not where NO_COLOR is.
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
enum When {
    Auto,
    Always,
    Never,
}

const OUTPUT: &str = "\
Text:
  FILE:LINE:COLUMN: SEVERITY[CODE]: MESSAGE
  and the line of the file with a mark under the place; in a binary file @BYTE for :LINE:COLUMN, and neither when it is about the whole file.
  Findings come in the order of the file. Many alike are one, with the lines of the next few below it.
  Last stands how to write the file without what was mended, or can be.
  Of a folder every .m3d, .glb, .gltf and .fbx file below it is read, by path. After several files, or none, comes a line with counts.
  --explain CODE tells what a finding of this code means, what is done about it, and how to mend it in the exporter.
  The viewer has the same of all codes, with an example of each, as the page web/codes.html.

JSON: an array with one object for each file
  schemaVersion       1; it grows when a key changes its meaning or goes
  file                the path as given
  findings            array, empty when there is nothing to say
    severity          \"note\", \"warning\" or \"error\"
    code              stable name of the kind of finding, for example \"weights-not-normalized\"
    message           one sentence
    line, column      place, both from 1, the column in bytes; null when it is about the whole file
    json_pointer      what of a glTF file's JSON it is about, or null
    byte_offset       place in a .glb or binary .fbx file, in bytes from its start, or null
    expected, found   what belonged there and what stood there, in a few words, or null
    subject           the part of the model that it is about, or null: kind (\"material\", \"subset\", \"vertex\",
                      \"triangle\", \"bone\", \"clip\" or \"map\") and index, its number in the file from 0; maps
                      are counted as `info --json` lists them
    time_secs, bone   of a finding about a clip: when it is, in the clip's own time, and the bone's number; or null
    count             how many alike things it tells of, 1 or more
    places            line and column of the first four of them; empty when it is about the whole file
    help              what the code means, and how to mend it
    permanent         how to write a file without it, where it is mended on reading or can be; or null
  book                what the books' programs make of it, or null without --book
    d3d11, d3d12      null when not asked for
      reads           whether its loader reads the file as it is meant
      line, column    where it goes wrong, or null
      why             what happens there, or null
      shows           what one then sees
      ends            whether its demo ends before it shows anything
      limits          what the demo cannot show as it is meant: code and message of each
    converted         of a glTF or FBX file, which the books' programs do not read; else null
      fits            whether `convert --for-book` makes one of it that the demos have room for
      limits          what it exceeds there: code and message of each
  error               why the file could not be read, or null

SARIF: version 2.1.0, with columns in UTF-16 code units; what books make of a file are results too. What could not be read
is told in invocations, with executionSuccessful false.

--textures DIR adds a finding for each map that is missing or cannot be read, and, when one file is read, for
pictures that no material names.

A file that cannot be read is named on standard error; the others are still checked.

--deny warnings counts warnings, and a folder without a model. --deny book counts, with --book, a file that the book's
program does not read or with which its demo ends, also where --textures lacks a map; of a glTF or FBX file, one that does not fit
once it is converted. --deny CODE counts a finding of this code, also of a book. --allow CODE takes findings out of all that.

Exit codes:
  0  no errors; notes and warnings are fine
  1  a file has errors, or there is what --deny names
  2  wrong use, an unknown code, or a file cannot be read";

fn denied(text: &str) -> Result<&'static str, String> {
    codes::known_or(text, &[WARNINGS, BOOK])
}

/// Whether standard output is for colours: <https://no-color.org>, <https://bixense.com/clicolors>, and a terminal that can.
fn wants_colors() -> bool {
    let variable = |name| std::env::var_os(name).filter(|value| !value.is_empty());
    let is_forced = variable("CLICOLOR_FORCE").is_some_and(|value| value != "0");
    let can = || io::stdout().is_terminal() && variable("TERM").is_none_or(|value| value != "dumb");
    variable("NO_COLOR").is_none() && (is_forced || can())
}

pub(super) fn run(arguments: &Arguments, out: &mut dyn Write, err: &mut dyn Write) -> Result<Outcome, Failure> {
    if let Some(name) = &arguments.explain {
        explain::explain(name, out)?;
        return Ok(Outcome::Fine);
    }
    let format = if arguments.json { Format::Json } else { arguments.format };
    let colors = Colors(match arguments.color {
        When::Auto => wants_colors(),
        When::Always => true,
        When::Never => false,
    });
    let with_textures = !arguments.textures.is_empty();
    let textures = with_textures
        .then(|| Folders::walk(&arguments.textures, err))
        .transpose()?;
    let models = paths::models(&arguments.paths, err)?.into_iter();
    let models: Vec<_> = models.map(|model| model.map_err(Arc::new)).collect();
    let is_only = models.len() == 1;
    let progress = progress(models.len(), "checking {pos} of {len} files, {eta} left");
    let mut outcome = match models.is_empty() && arguments.deny.contains(&WARNINGS) {
        true => Outcome::FileHasErrors,
        false => Outcome::Fine,
    };
    let mut unread = Vec::new();
    let mut counts = Counts::default();
    let mut json = Vec::new();
    let mut results = Vec::new();
    let done = in_order(
        &models,
        |model| match model {
            Ok(path) => file::check(path, arguments.book, textures.as_ref(), is_only).map_err(Arc::new),
            Err(failure) => Err(Arc::clone(failure)),
        },
        |checked| -> Result<(), Failure> {
            progress.inc(1);
            let checked = match checked {
                Ok(checked) => checked,
                Err(failure) => {
                    // Keeps the order of the files where both streams go to one terminal.
                    out.flush()?;
                    outcome = outcome.max(progress.suspend(|| failure.report(err)));
                    let path = failure.unread().unwrap_or(Path::new("")).to_string_lossy().into_owned();
                    if format == Format::Json {
                        json.push(serde_json::to_value(file::Report::unread(&path, failure.to_string()))?);
                    }
                    unread.push((path, failure.to_string()));
                    return Ok(());
                }
            };
            counts.add(&checked.diagnostics);
            outcome = outcome.max(checked.outcome(&arguments.deny, &arguments.allow));
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
        Format::Text if models.len() != 1 => writeln!(out, "{counts}")?,
        Format::Text => {}
        Format::Json => {
            serde_json::to_writer_pretty(&mut *out, &json)?;
            writeln!(out)?;
        }
        Format::Sarif => {
            serde_json::to_writer_pretty(&mut *out, &sarif::log(results, &unread))?;
            writeln!(out)?;
        }
    }
    Ok(outcome)
}
