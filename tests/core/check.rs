//! Tests of `check`, but for the books' programs.

mod many;
mod mesh;
mod real_files;
mod rig;
mod texture;
mod told;

use bindpose::diagnostic::Diagnostic;
use bindpose::format::{Document, LineMap};

use crate::documents::checked;

/// The codes of all that is found about a document.
fn codes_of(document: &Document) -> Vec<&'static str> {
    let (_, findings) = checked(document, &LineMap::default());
    findings.iter().map(|finding| finding.code).collect()
}

/// The one finding about a document.
fn only(document: &Document, lines: &LineMap) -> Diagnostic {
    let (_, findings) = checked(document, lines);
    let [one] = findings.try_into().expect("one finding");
    one
}
