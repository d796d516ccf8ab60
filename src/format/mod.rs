//! The `.m3d` text format.

mod cursor;
mod document;
mod error;
mod label;
mod notice;
mod number;
mod quick;
mod reader;
mod relatives;
mod sections;
mod write;

pub use document::*;
pub use error::{ParseError, ParseErrorKind, Value};
pub use label::Section;
pub use relatives::Stranger;
pub use write::write;

use self::reader::Reader;
use crate::diagnostic::{Diagnostic, Position};
use notice::Notice;

/// A file that was understood.
#[derive(Clone, Debug, PartialEq)]
pub struct Parsed {
    /// What it says.
    pub document: Document,
    /// Where it says it.
    pub lines: LineMap,
    /// What was mended or is worth knowing, in the order of the file.
    pub notices: Vec<Diagnostic>,
}

/// Reads a file. It need not be UTF-8: names are decoded as well as can be.
///
/// Never panics, reads the bytes once from front to back, and makes room for no more than the bytes can hold.
pub fn parse(bytes: &[u8]) -> Result<Parsed, ParseError> {
    let mut reader = Reader::new(bytes);
    let start = Position { line: 1, column: 1 };
    if reader.cursor.peek_token().is_none() {
        return Err(ParseError {
            position: start,
            length: 0,
            kind: ParseErrorKind::Empty,
        });
    }
    if let Some(stranger) = relatives::recognise(bytes) {
        return Err(ParseError {
            position: start,
            length: 0,
            kind: ParseErrorKind::Stranger(stranger),
        });
    }
    let counts = sections::header(&mut reader)?;
    let (materials, material_lines) = sections::materials(&mut reader, counts.materials)?;
    let (subsets, subset_lines) = sections::subsets(&mut reader, counts.subsets)?;
    let vertices = sections::vertices(&mut reader, counts.vertices, counts.bones)?;
    let (triangles, triangle_lines) = sections::triangles(&mut reader, counts.triangles, counts.vertices)?;
    let mut document = Document {
        materials,
        subsets,
        vertices: vertices.vertices,
        triangles,
        ..Document::default()
    };
    let mut lines = LineMap {
        materials: material_lines,
        subsets: subset_lines,
        vertices: vertices.lines,
        triangles: triangle_lines,
        ..LineMap::default()
    };
    // A file without bones has all of the last three sections, empty, or none of them.
    let mut skinned = counts.bones > 0;
    if reader.begin_optional(Section::BoneOffsets, counts.bones, skinned)? {
        skinned = true;
        (document.bone_offsets, lines.bone_offsets) = sections::offsets(&mut reader, counts.bones)?;
    }
    if reader.begin_optional(Section::BoneHierarchy, counts.bones, skinned)? {
        skinned = true;
        (document.bone_parents, lines.bone_parents) = sections::hierarchy(&mut reader, counts.bones)?;
    }
    if reader.begin_optional(Section::AnimationClips, counts.clips, skinned)? {
        (document.clips, lines.clips) = sections::clips(&mut reader, counts.clips, counts.bones)?;
    }
    if let Some(token) = reader.cursor.peek_token() {
        reader.note(token, Notice::TextSurplus);
    }
    document.dialect = dialect(&document, &reader, vertices.short_labels);
    Ok(Parsed {
        document,
        lines,
        notices: reader.notices.into_diagnostics(),
    })
}

/// The vertices' labels tell imm, or its rulers where there are no vertices; the first material tells the books apart.
fn dialect(document: &Document, reader: &Reader<'_>, short_labels: bool) -> Dialect {
    let imm = if document.vertices.is_empty() {
        reader.dashes
    } else {
        short_labels
    };
    match document.materials.first().map(|material| material.reflectance) {
        _ if imm => Dialect::Imm,
        Some(Reflectance::Phong { .. }) => Dialect::D3d11,
        Some(Reflectance::Fresnel { .. }) | None => Dialect::D3d12,
    }
}
