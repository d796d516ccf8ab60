//! The books' text format: [`from_document`] translates what a file says.
//!
//! Bones become joints with parents first, weights sum to 1, keys are sorted and finite, missing normals and tangents are
//! computed, ranges lie inside the mesh. What was mended comes back as diagnostics; what names something that does not exist is
//! a [`Fault`].
//!
//! The codes of both are [`codes::OF_MODEL`](crate::diagnostic::codes::OF_MODEL).

mod bones;
mod clips;
mod influences;
mod mesh;
mod surfaces;

use super::{Imported, Refused, Source};
use crate::diagnostic::collect::Diagnostics;
use crate::diagnostic::{Diagnostic, Fault};
use crate::format::{self, Dialect, Document, LineMap, Parsed};
use crate::model::{Front, Model, UpAxis};
use crate::slices::{Slices, Stage, at_once};
use crate::sorting;

pub(super) use crate::format::begins_like_model;

pub(super) async fn import(bytes: &[u8], slices: &Slices) -> Result<Imported, Box<Refused>> {
    let refused = |error, diagnostics| Box::new(Refused { error, diagnostics });
    let parsed = format::parse_in(bytes, slices)
        .await
        .map_err(|fault| refused(*fault, Vec::new()))?;
    let (model, of_model) = from_document_in(&parsed.document, &parsed.lines, slices)
        .await
        .map_err(|fault| refused(*fault, parsed.diagnostics.clone()))?;
    let mut diagnostics = [&parsed.diagnostics[..], &of_model].concat();
    sorting::sort_by_key(&mut diagnostics, |diagnostic| diagnostic.position);
    Ok(Imported {
        model,
        diagnostics,
        pictures: Vec::new(),
        source: Source::m3d(parsed),
    })
}

/// The model of a parsed file, and the diagnostics of both stages, the parser's first.
///
/// # Errors
/// As [`from_document`].
pub fn from_parsed(parsed: &Parsed) -> Result<(Model, Vec<Diagnostic>), Fault> {
    let (model, diagnostics) = from_document(&parsed.document, &parsed.lines)?;
    let all = parsed.diagnostics.iter().cloned().chain(diagnostics).collect();
    Ok((model, all))
}

/// What a document means, and what had to be mended for it. `lines` gives the diagnostics their places; it may be empty.
///
/// # Errors
/// When a parent, a triangle's vertex or an influence names what does not exist, or the bones form a circle.
pub fn from_document(document: &Document, lines: &LineMap) -> Result<(Model, Vec<Diagnostic>), Fault> {
    at_once(from_document_in(document, lines, &Slices::ENDLESS))
}

/// [`from_document`] in slices.
///
/// # Errors
/// As [`from_document`].
pub async fn from_document_in(
    document: &Document,
    lines: &LineMap,
    slices: &Slices,
) -> Result<(Model, Vec<Diagnostic>), Fault> {
    let mut diagnostics = Diagnostics::default();
    let mut materials = surfaces::materials_from_document(document, lines, &mut diagnostics);
    slices.pause_at(Stage::Building, 0, 4).await;
    let submeshes = surfaces::submeshes_from_document(document, lines, &mut materials, &mut diagnostics);
    let skeleton = bones::skeleton_from_document(document, lines, &mut diagnostics)?;
    slices.pause_at(Stage::Building, 1, 4).await;
    let (mut mesh, handedness) = mesh::mesh_from_document(document, lines, &skeleton, &mut diagnostics, slices).await?;
    mesh.submeshes = submeshes;
    slices.pause_at(Stage::Building, 3, 4).await;
    let clips = clips::clips_from_document(document, lines, &skeleton, &mut diagnostics, slices).await?;
    let up_axis = match document.dialect {
        Dialect::Imm => UpAxis::Z,
        Dialect::D3d11 | Dialect::D3d12 | Dialect::Text => UpAxis::Y,
    };
    let model = Model {
        materials,
        mesh,
        objects: Vec::new(),
        skeleton,
        clips,
        handedness,
        up_axis,
        front: Front::Negative,
        copyright: None,
    };
    slices.pause().await;
    Ok((model.checked()?, diagnostics.into_vec()))
}
