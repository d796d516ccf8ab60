//! The `.m3d` text format, as the books of Frank Luna and those who export to them write it.
//!
//! [`parse`] turns bytes into a [`Document`] in the file's own words, or says where it stopped and why; [`write()`] is its
//! inverse; [`excerpt()`] shows the lines around a diagnostic, [`LineIndex`] finds those of many.
//!
//! # Grammar
//!
//! There is no specification; this is what is read. Tokens are parted by blanks, and `{` and `}` are tokens of their own.
//! Lines end in LF, CRLF or CR. Blank lines and indentation mean nothing, except that blank lines help to part materials.
//! Labels and rulers are compared by their letters and digits only, without case. A byte order mark is passed.
//!
//! ```text
//! file      = { comment } header materials subsets vertices triangles [offsets hierarchy clips]
//! comment   = "#" rest-of-line                                  that is no count
//! ruler     = ("***" | "---") any line-end                      its letters name the section
//! header    = ruler { ["#"] ("Materials" | "Subsets" | "Vertices" | "Triangles" | "Bones" | "AnimationClips") [":"] count }
//! materials = ruler { label ":" rest-of-line }                  one label a line, in any order
//! subsets   = ruler { "SubsetID:" n "VertexStart:" n "VertexCount:" n "FaceStart:" n "FaceCount:" n }
//! vertices  = ruler { "Position:" x y z "Tangent:" x y z [w] "Normal:" x y z "Tex-Coords:" u v [blend] }
//! blend     = "BlendWeights:" a b c d "BlendIndices:" i j k l   in files with bones
//! triangles = ruler { i j k line-end }
//! offsets   = ruler { "BoneOffset" n [word] 16 * number }       row vectors, row by row
//! hierarchy = ruler { "ParentIndexOfBone" n ":" parent }        -1 for a root
//! clips     = ruler { "AnimationClip" rest-of-line "{" { bone } "}" }
//! bone      = "Bone" n "#Keyframes:" count "{" { "Time:" t "Pos:" x y z "Scale:" x y z "Quat:" x y z w } "}"
//! ```
//!
//! The static models of the books' demos, `car.txt` and `skull.txt`, have a grammar of their own: `text_model`.
//!
//! The imm dialect says `P: T: N: T: W: I:` for the lines of a vertex, `B0:` and `P0:` for bones, `B0 #K:` and `T: P: S: Q:`
//! for keys. All spellings are understood everywhere. Rows come in the number that the header announces, no fewer and no more.
//!
//! # Three kinds of answer
//!
//! What a token says is settled here: it is read, or mended with a diagnostic, or it is an error. What the values mean together
//! (sums of weights, order of keys, subsets against triangles) is for [`import`](crate::import); only indices are held against
//! their counts here, since only here the column is known.
//!
//! The codes of errors and diagnostics are [`codes::OF_PARSER`].

mod cursor;
mod document;
mod error;
mod excerpt;
mod kind;
mod label;
mod likeness;
mod number;
pub(crate) mod quick;
mod reader;
mod sections;
mod text_model;
mod write;

pub(crate) use cursor::Cursor;
pub use document::*;
pub use excerpt::{Excerpt, LineIndex, excerpt, is_printable};
pub use label::Section;
pub use likeness::{begins_like_another, begins_like_model};
pub use quick::QuickRows;
pub(crate) use quick::QuickRun;
pub use write::{write, write_in};

use self::reader::Reader;
use crate::diagnostic::{Diagnostic, Entry, Fault, Places, Position, codes};
use crate::slices::{Slices, Stage, at_once};
use kind::DiagnosticKind;
use likeness::Stranger;

/// A file that was understood.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Parsed {
    /// What it says.
    pub document: Document,
    /// Where it says it.
    pub lines: LineMap,
    /// What was mended or is worth knowing, in the order of the file.
    pub diagnostics: Vec<Diagnostic>,
    /// Which rows a second reader can pass over.
    pub quick: QuickRows,
}

impl Places for Parsed {
    fn line(&self, entry: Entry) -> Option<u32> {
        self.lines.line(entry)
    }

    fn entry_on(&self, line: u32) -> Option<Entry> {
        self.lines.entry_on(line)
    }
}

/// Reads a file. It need not be UTF-8: names are decoded as well as can be.
///
/// Bytes of value 0 at the end, as a disk or a transfer pads a file with, are no part of the text. A file that holds more of
/// them than of anything else is damaged, and refused.
///
/// Never panics, reads the bytes once from front to back, and makes room for no more than the bytes can hold.
pub fn parse(bytes: &[u8]) -> Result<Parsed, Fault> {
    at_once(parse_in(bytes, &Slices::ENDLESS))
}

/// [`parse`] in slices.
///
/// # Errors
/// As [`parse`].
pub async fn parse_in(bytes: &[u8], slices: &Slices) -> Result<Parsed, Fault> {
    let text_len = text_len(bytes, slices).await;
    let (text, zeros) = bytes.split_at(text_len);
    let mut reader = Reader::new(text, slices);
    let at_start = |fault: Diagnostic| Fault::from(fault.at(Position { line: 1, column: 1 }, 0));
    if reader.cursor.peek_token().is_none() {
        return Err(at_start(if zeros.is_empty() {
            let fault = codes::EMPTY_FILE.says(codes::EMPTY_FILE.sentence);
            fault.expected("an m3d file header")
        } else {
            Stranger::Binary.diagnostic()
        }));
    }
    if let Some(stranger) = likeness::recognise(text) {
        return Err(at_start(stranger.diagnostic()));
    }
    if text_model::begins(&reader) {
        let (document, lines) = text_model::read(&mut reader).await?;
        if !zeros.is_empty() {
            note_zeros(&mut reader, zeros.len())?;
        }
        return Ok(Parsed {
            document,
            lines,
            diagnostics: reader.kinds.into_diagnostics(),
            quick: QuickRows::default(),
        });
    }
    let counts = sections::header(&mut reader).await?;
    let (materials, material_lines) = sections::materials(&mut reader, counts.materials).await?;
    let (subsets, subset_lines) = sections::subsets(&mut reader, counts.subsets).await?;
    let vertices = sections::vertices(&mut reader, counts.vertices, counts.bones).await?;
    let triangles = sections::triangles(&mut reader, counts.triangles, counts.vertices).await?;
    let mut quick = QuickRows {
        vertices: vertices.quick,
        triangles: triangles.quick,
        ..QuickRows::default()
    };
    let mut document = Document {
        materials,
        subsets,
        vertices: vertices.vertices,
        triangles: triangles.triangles,
        ..Document::default()
    };
    let mut lines = LineMap {
        materials: material_lines,
        subsets: subset_lines,
        vertices: vertices.lines,
        vertices_apart: vertices.apart,
        triangles: triangles.lines,
        ..LineMap::default()
    };
    // A file without bones has all of the last three sections, empty, or none of them.
    let mut skinned = counts.bones > 0;
    if reader.begin_optional(Section::BoneOffsets, counts.bones, skinned)? {
        skinned = true;
        (document.bone_offsets, lines.bone_offsets) = sections::offsets(&mut reader, counts.bones).await?;
    }
    if reader.begin_optional(Section::BoneHierarchy, counts.bones, skinned)? {
        skinned = true;
        (document.bone_parents, lines.bone_parents) = sections::hierarchy(&mut reader, counts.bones).await?;
    }
    if reader.begin_optional(Section::AnimationClips, counts.clips, skinned)? {
        let clips = sections::clips(&mut reader, counts.clips, counts.bones).await?;
        (document.clips, lines.clips, quick.tracks) = (clips.clips, clips.lines, clips.quick);
    }
    if let Some(token) = reader.cursor.peek_token() {
        reader.note(token, DiagnosticKind::TextSurplus);
    }
    if !zeros.is_empty() {
        note_zeros(&mut reader, zeros.len())?;
    }
    document.dialect = dialect(&document, &reader, vertices.short_labels);
    Ok(Parsed {
        document,
        lines,
        diagnostics: reader.kinds.into_diagnostics(),
        quick,
    })
}

/// How many bytes there are before those of value 0 at the end.
async fn text_len(bytes: &[u8], slices: &Slices) -> usize {
    let mut end = bytes.len();
    for piece in bytes.rchunks(1 << 20) {
        slices.pause_at(Stage::Reading, 0, bytes.len()).await;
        let last = piece.iter().rposition(|&byte| byte != 0);
        end -= piece.len() - last.map_or(0, |last| last + 1);
        if last.is_some() {
            break;
        }
    }
    end
}

/// Bytes of value 0 behind the text: padding, or an error where they are most of the file.
fn note_zeros(reader: &mut Reader<'_>, zeros: usize) -> Result<(), Fault> {
    while reader.cursor.peek().is_some() {
        reader.cursor.rest_of_line();
    }
    let position = reader.cursor.position();
    if zeros > reader.cursor.bytes.len() {
        let message = format!(
            "The file ends in {zeros} bytes of value 0, more than stand before them: it was not written or copied whole."
        );
        let fault = codes::MOSTLY_ZEROS.says(message).expected("the end of the file");
        let fault = fault.found(format!("{zeros} bytes of value 0"));
        return Err(fault.at(position, 1).into());
    }
    reader.kinds.add(DiagnosticKind::ZerosSurplus(zeros), position, 1);
    Ok(())
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
