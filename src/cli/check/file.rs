//! What is found in one file, and its three forms.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use clap::ValueEnum;
use serde::Serialize;

use super::maps;
use crate::anim::CompiledClip;
use crate::check::book::{self, Book, Known, Verdict};
use crate::check::report::{self, CheckedFile};
use crate::check::sarif;
use crate::cli::diagnostic::Colors;
use crate::cli::failure::{Failure, Outcome};
use crate::cli::textures::Folders;
use crate::cli::{input, paths};
use crate::diagnostic::{Code, Diagnostic, Severity, codes};
use crate::import::{self, Imported};
use crate::session::summary::{self, Finding};

/// What, besides errors, fails.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Deny {
    /// Warnings too.
    Warnings,
    /// A book that does not read a file, or whose demo ends before it shows anything, as it does where --textures lacks a map.
    Book,
}

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
}

/// Reads and checks a file. `textures` are folders to look for its maps in; `is_only` as for [`maps::find`].
pub(super) fn check(
    path: &Path,
    books: Option<WhichBooks>,
    textures: Option<&Folders>,
    is_only: bool,
) -> Result<Checked, Failure> {
    let bytes = paths::read(path)?;
    let imported = import::import_beside(&bytes, &|name| input::beside(path, name));
    let mut diagnostics = Vec::new();
    let mut missing_maps = None;
    if let Ok(imported) = &imported
        && let Some(textures) = textures
    {
        let found = maps::find(imported, textures, is_only);
        missing_maps = Some(found.missing);
        diagnostics = found.diagnostics;
    }
    let verdicts = verdicts(books, &bytes, imported.as_ref().ok(), missing_maps.as_deref());
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
            let checked = crate::check::model(&imported.model, &compiled, &imported.lines);
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
    let known = Known {
        document: imported.and_then(|imported| imported.document.as_ref()),
        handedness: imported.map(|imported| imported.model.handedness),
        missing_maps,
    };
    books.iter().map(|&book| book::verdict(book, bytes, &known)).collect()
}

/// What --json prints of a file.
#[derive(Serialize)]
pub(super) struct Report<'a> {
    file: String,
    findings: Vec<Explained<'a>>,
    book: Option<summary::Books<'a>>,
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
    pub(super) fn outcome(&self, deny: &[Deny]) -> Outcome {
        let worst = self.diagnostics.iter().map(|diagnostic| diagnostic.severity).max();
        let is_denied =
            |severity| severity == Severity::Error || (severity == Severity::Warning && deny.contains(&Deny::Warnings));
        let lacks_maps = |verdict: &Verdict| {
            let mut limits = verdict.limits.iter();
            limits.any(|limit| limit.code == codes::MAP_MISSING.name)
        };
        let is_shown = |verdict: &Verdict| verdict.is_shown() && !lacks_maps(verdict);
        let book_fails = deny.contains(&Deny::Book) && !self.verdicts.iter().all(is_shown);
        if book_fails || worst.is_some_and(is_denied) {
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
        }
    }

    pub(super) fn report(&self, books: Option<WhichBooks>) -> Report<'_> {
        // A file that is not opened cannot be exported.
        let is_opened = self
            .diagnostics
            .iter()
            .all(|diagnostic| diagnostic.severity < Severity::Error);
        Report {
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
            book: books.map(|_| summary::Books::of(&self.verdicts)),
        }
    }

    pub(super) fn sarif_results(&self) -> sarif::Results {
        sarif::Results::of(&self.file(&self.path.to_string_lossy()))
    }
}
