//! The books' text format.

use super::imported::Imported;
use crate::diagnostic::Diagnostic;
use crate::format;
use crate::model::Model;

pub(super) use crate::format::begins_like_model;

pub(super) fn import(bytes: &[u8]) -> Result<Imported, Box<Diagnostic>> {
    let parsed = format::parse(bytes).map_err(|error| Box::new(error.diagnostic()))?;
    let (model, of_model) =
        Model::from_document(&parsed.document, &parsed.lines).map_err(|error| Box::new(error.diagnostic()))?;
    let mut diagnostics = parsed.diagnostics;
    diagnostics.extend(of_model);
    diagnostics.sort_by_key(|diagnostic| diagnostic.position);
    Ok(Imported {
        dialect: parsed.document.dialect,
        model,
        diagnostics,
        clip_lines: parsed.lines.clip_lines(),
    })
}
