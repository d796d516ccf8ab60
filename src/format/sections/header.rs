//! `#Materials N` and the other counts.

use crate::diagnostic::{Fault, codes};
use crate::format::cursor::{Cursor, Token};
use crate::format::error::{Value, quoted};
use crate::format::kind::DiagnosticKind;
use crate::format::label::{Section, is_ruler, same, same_as_any};
use crate::format::likeness::Stranger;
use crate::format::reader::{Beginning, Reader, looks_like_number};

/// What the header announces. Nothing is reserved for these numbers before they are held against the bytes left.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::format) struct Counts {
    pub(in crate::format) materials: u32,
    pub(in crate::format) subsets: u32,
    pub(in crate::format) vertices: u32,
    pub(in crate::format) triangles: u32,
    pub(in crate::format) bones: u32,
    pub(in crate::format) clips: u32,
}

/// Labels of counts, and labels by which relatives of the format give themselves away.
const COUNTS: [(&str, &[&str]); 6] = [
    ("Materials", &["materials", "material"]),
    ("Subsets", &["subsets", "subset"]),
    ("Vertices", &["vertices", "vertex"]),
    ("Triangles", &["triangles", "faces"]),
    ("Bones", &["bones"]),
    ("AnimationClips", &["animationclips", "animations", "clips"]),
];

/// Reads the header, which must be there, up to the ruler or the first line of the next section.
pub(in crate::format) async fn header(reader: &mut Reader<'_>) -> Result<Counts, Fault> {
    let comment = pass_comments(reader);
    let beginning = reader.begin(Section::Header)?;
    let not_m3d = |label: Token<'_>| {
        let found = quoted(label.text);
        let message = format!("This is not an .m3d file: it begins with \"{found}\" instead of an m3d-File-Header.");
        let fault = codes::NOT_M3D.says(message).found(found);
        Reader::error_at(label, fault.expected("an m3d file header"))
    };
    if let (Beginning::End, Some(comment)) = (beginning, comment) {
        return Err(not_m3d(comment));
    }
    let bare = beginning == Beginning::Bare;
    let mut found: [Option<u32>; 6] = [None; 6];
    let mut start = None;
    while let Some((label, behind)) = peek_count_label(reader) {
        if is_ruler(label.text) {
            break;
        }
        let Some(index) = COUNTS.iter().position(|(_, names)| same_as_any(label.text, names)) else {
            if same_as_any(label.text, &["indices", "indexes"]) {
                let stranger = Stranger::Relative("a list of indices (#Indices)");
                return Err(Reader::error_at(label, stranger.diagnostic()));
            }
            if begins_next_section(label) {
                break;
            }
            if bare && start.is_none() {
                return Err(not_m3d(comment.unwrap_or(label)));
            }
            reader.pass_unknown_line(label);
            continue;
        };
        if bare && start.is_none() {
            reader.ruler_missing(Section::Header);
        }
        start = start.or(Some(label));
        reader.cursor = behind;
        let (name, names) = COUNTS[index];
        let number = reader.cursor.peek_token();
        let count = reader.count(Value::Count(name))?;
        reader.counts.extend(number.map(|number| (names, number)));
        if found[index].replace(count).is_some() {
            reader.note(label, DiagnosticKind::LabelRepeated(name.into()));
        }
        pass_surplus(reader);
    }
    let counts = counts(reader, found).await?;
    if let Some(start) = start.filter(|_| counts == Counts::default()) {
        reader.note(start, DiagnosticKind::CountsAllZero);
    }
    Ok(counts)
}

/// The label of the next count, and where its number begins. In `# Materials 5` the sign stands apart and is left out.
fn peek_count_label<'a>(reader: &Reader<'a>) -> Option<(Token<'a>, Cursor<'a>)> {
    let (label, behind) = reader.peek_label()?;
    if label.text != b"#" {
        return Some((label, behind));
    }
    let mut ahead = reader.clone();
    ahead.cursor = behind;
    ahead.peek_label().or(Some((label, behind)))
}

/// Passes the lines above the header that begin with `#` and are no counts. Gives the first word of the first one.
fn pass_comments<'a>(reader: &mut Reader<'a>) -> Option<Token<'a>> {
    let mut first = None;
    loop {
        reader.cursor.skip_space();
        if reader.cursor.peek() != Some(b'#') {
            return first;
        }
        let (label, behind) = peek_count_label(reader)?;
        if is_count(label, behind) {
            return first;
        }
        first = first.or(Some(label));
        let comment = reader.cursor.rest_of_line();
        reader.note(comment, DiagnosticKind::Comment);
    }
}

/// True for one of our labels with a number behind it on its line.
fn is_count(label: Token<'_>, mut behind: Cursor<'_>) -> bool {
    behind.skip_blanks();
    !behind.at_line_end()
        && COUNTS.iter().any(|(_, names)| same_as_any(label.text, names))
        && behind.token().is_some_and(|number| looks_like_number(number.text))
}

/// Turns what was found into counts; those that may be zero may be missing.
async fn counts(reader: &mut Reader<'_>, found: [Option<u32>; 6]) -> Result<Counts, Fault> {
    let [materials, subsets, vertices, triangles, bones, clips] = found;
    if reader.cursor.peek_token().is_none() {
        return Err(reader.end("the Materials section"));
    }
    let position = reader.next_position();
    let are_nowhere = triangles.is_none() && !has_triangles(reader).await;
    let missing = |count| {
        let fault = if count == "Triangles" && are_nowhere {
            Stranger::Relative("vertices but no triangles").diagnostic()
        } else {
            let message = format!("The header does not say how many {count} there are.");
            codes::COUNT_MISSING.says(message).expected(format!("#{count}"))
        };
        Fault::from(fault.at(position, 0))
    };
    let materials = materials.ok_or_else(|| missing("Materials"))?;
    let vertices = vertices.ok_or_else(|| missing("Vertices"))?;
    let triangles = triangles.ok_or_else(|| missing("Triangles"))?;
    let mut assumed = |count: Option<u32>, name| {
        count.unwrap_or_else(|| {
            reader.kinds.add(DiagnosticKind::CountAssumed(name), position, 0);
            0
        })
    };
    let bones = assumed(bones, "Bones");
    let clips = assumed(clips, "AnimationClips");
    Ok(Counts {
        materials,
        subsets: subsets.unwrap_or(materials),
        vertices,
        triangles,
        bones,
        clips,
    })
}

/// True when a ruler further down announces triangles.
async fn has_triangles(reader: &Reader<'_>) -> bool {
    let mut ahead = reader.clone();
    let mut line = 0;
    while ahead.cursor.peek_token().is_some() {
        reader.pause_every(line).await;
        line += 1;
        if let Some(ruler) = ahead.peek_ruler()
            && Section::of_ruler(ruler.text) == Some(Section::Triangles)
        {
            return true;
        }
        ahead.cursor.skip_space();
        ahead.cursor.rest_of_line();
    }
    false
}

/// True for labels that a material or a later section begins with: the ruler before it is missing.
fn begins_next_section(label: Token<'_>) -> bool {
    ["Name", "Ambient", "Diffuse", "SubsetID", "Position"]
        .into_iter()
        .any(|name| same(label.text, name))
}

fn pass_surplus(reader: &mut Reader<'_>) {
    reader.cursor.skip_blanks();
    if !reader.cursor.at_line_end() {
        let rest = reader.cursor.rest_of_line();
        reader.note(rest, DiagnosticKind::ValuesSurplus);
    }
}
