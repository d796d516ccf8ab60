//! What is found in one file, and its three forms.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use clap::ValueEnum;
use serde::Serialize;

use super::maps;
use crate::anim::CompiledClip;
use crate::check::book::{self, Book, Known, Limit, Verdict};
use crate::check::report::{self, CheckedFile};
use crate::check::sarif;
use crate::cli::codes::SCHEMA_VERSION;
use crate::cli::diagnostic::Colors;
use crate::cli::failure::{Failure, Outcome};
use crate::cli::textures::Folders;
use crate::cli::{input, paths};
use crate::diagnostic::{Code, Diagnostic, Severity, codes};
use crate::import::{self, Imported};
use crate::session::limits_once_converted;
use crate::session::summary::{self, Finding};

/// What --deny calls all warnings, and what the books' programs do not show.
pub(super) const WARNINGS: &str = "warnings";
pub(super) const BOOK: &str = "book";

/// Whose programs are asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum WhichBooks {
    D3d11,
    D3d12,
    All,
}

/// What is known of one file.
pub(super) struct Checked {
    path: PathBuf,
    bytes: Vec<u8>,
    pub(super) diagnostics: Vec<Diagnostic>,
    verdicts: Vec<Verdict>,
    /// Of a file of another format, what it exceeds even converted for the books that are asked for.
    converted: Option<Vec<Limit>>,
}

/// Reads and checks a file. `textures` are folders to look for its maps in; `is_only` as for [`maps::find`].
pub(super) fn check(
    path: &Path,
    books: Option<WhichBooks>,
    textures: Option<&Folders>,
    is_only: bool,
) -> Result<Checked, Failure> {
    let bytes = paths::read(path)?;
    let extension = path
        .extension()
        .map(|extension| extension.to_string_lossy().to_lowercase());
    let imported = import::import_beside(&bytes, &|name| input::beside(path, name))
        .map_err(|refused| Box::new(refused.of_extension(&extension.unwrap_or_default())));
    let mut diagnostics = Vec::new();
    let mut missing_maps = None;
    if let Ok(imported) = &imported
        && let Some(textures) = textures
    {
        let found = maps::find(imported, textures, is_only);
        missing_maps = Some(found.missing);
        diagnostics = found.diagnostics;
    }
    let books: &[Book] = match books {
        None => &[],
        Some(WhichBooks::D3d11) => &[Book::D3d11],
        Some(WhichBooks::D3d12) => &[Book::D3d12],
        Some(WhichBooks::All) => &Book::ALL,
    };
    // The books' programs know no other format than theirs.
    let (verdicts, converted) = match &imported {
        _ if books.is_empty() => (Vec::new(), None),
        Ok(imported) if imported.source.format.dialect().is_none() => {
            (Vec::new(), Some(limits_once_converted(&imported.model, books)))
        }
        Err(_) if import::is_of_others(&bytes) => (Vec::new(), None),
        _ => {
            let imported = imported.as_ref().ok();
            let parsed = imported.and_then(|imported| imported.source.parsed(&bytes));
            let known = Known {
                document: parsed.as_ref().map(|parsed| &parsed.document),
                quick: parsed.as_ref().map(|parsed| &parsed.quick),
                handedness: imported.map(|imported| imported.model.handedness),
                missing_maps: missing_maps.as_deref(),
            };
            let verdict = |&book| book::verdict(book, &bytes, &known);
            (books.iter().map(verdict).collect(), None)
        }
    };
    diagnostics.extend(diagnostics_of(imported, &bytes));
    diagnostics.sort_by_key(|diagnostic| diagnostic.position);
    Ok(Checked {
        path: path.to_owned(),
        bytes,
        diagnostics,
        verdicts,
        converted,
    })
}

/// All diagnostics of a file and of its model.
fn diagnostics_of(imported: Result<Imported, Box<import::Refused>>, bytes: &[u8]) -> Vec<Diagnostic> {
    match imported {
        Ok(imported) => {
            let compiled = CompiledClip::all(&imported.model.clips);
            let checked = crate::check::model(&imported.model, &compiled, &*imported.source.places(bytes));
            imported.diagnostics.into_iter().chain(checked).collect()
        }
        Err(refused) => refused.diagnostics.into_iter().chain([refused.error]).collect(),
    }
}

/// What --json prints of a file.
#[derive(Serialize)]
pub(super) struct Report<'a> {
    #[serde(rename = "schemaVersion")]
    schema_version: u32,
    file: String,
    findings: Vec<Explained<'a>>,
    book: Option<summary::Books<'a>>,
    error: Option<String>,
}

impl Report<'_> {
    /// Of a file that could not be read.
    pub(super) fn unread(path: &str, error: String) -> Self {
        Self {
            schema_version: SCHEMA_VERSION,
            file: path.to_owned(),
            findings: Vec::new(),
            book: None,
            error: Some(error),
        }
    }
}

/// A finding and what its code means.
#[derive(Serialize)]
struct Explained<'a> {
    #[serde(flatten)]
    finding: Finding<'a>,
    help: Option<String>,
    permanent: Option<&'static str>,
}

impl Checked {
    /// How it went: `deny` has words and codes, of which `allow` takes codes out. Errors count always.
    pub(super) fn outcome(&self, deny: &[&str], allow: &[&str]) -> Outcome {
        let counts = |code: &str| !allow.contains(&code);
        let is_named = |code: &str| deny.contains(&code) && counts(code);
        let is_denied = |diagnostic: &Diagnostic| match diagnostic.severity {
            Severity::Error => true,
            Severity::Warning if deny.contains(&WARNINGS) => counts(diagnostic.code),
            _ => is_named(diagnostic.code),
        };
        let lacks_maps = |verdict: &Verdict| {
            let mut limits = verdict.limits.iter();
            limits.any(|limit| limit.code == codes::MAP_MISSING.name) && counts(codes::MAP_MISSING.name)
        };
        let is_shown = |verdict: &Verdict| verdict.is_shown() && !lacks_maps(verdict);
        let of_books = |diagnostic: Diagnostic| is_named(diagnostic.code);
        let exceeded = || self.converted.iter().flatten().map(|limit| limit.code);
        let book_fails = deny.contains(&BOOK) && (exceeded().any(counts) || !self.verdicts.iter().all(is_shown));
        if book_fails
            || self.diagnostics.iter().any(is_denied)
            || self.verdicts.iter().flat_map(Verdict::diagnostics).any(of_books)
            || exceeded().any(is_named)
        {
            Outcome::FileHasErrors
        } else {
            Outcome::Fine
        }
    }

    pub(super) fn write(&self, out: &mut dyn Write, colors: Colors) -> io::Result<()> {
        let text = report::text(&self.file(&self.path.to_string_lossy()), false, &|ink, text| {
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
            converted: self.converted.as_deref(),
        }
    }

    pub(super) fn report(&self, books: Option<WhichBooks>) -> Report<'_> {
        // A file that is not opened cannot be exported.
        let is_opened = self
            .diagnostics
            .iter()
            .all(|diagnostic| diagnostic.severity < Severity::Error);
        Report {
            schema_version: SCHEMA_VERSION,
            file: self.path.display().to_string(),
            findings: self
                .diagnostics
                .iter()
                .map(|diagnostic| {
                    let code = codes::named(diagnostic.code);
                    Explained {
                        finding: diagnostic.into(),
                        help: code.map(Code::help),
                        permanent: code.filter(|_| is_opened).and_then(Code::permanent),
                    }
                })
                .collect(),
            book: books.map(|_| summary::Books::of(&self.verdicts, self.converted.as_deref())),
            error: None,
        }
    }

    pub(super) fn sarif_results(&self) -> sarif::Results {
        sarif::Results::of(&self.file(&self.path.to_string_lossy()))
    }
}
