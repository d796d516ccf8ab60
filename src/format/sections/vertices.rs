//! Vertices: `Position`, `Tangent`, `Normal`, `Tex-Coords` and, with bones, `BlendWeights` and `BlendIndices`.

use crate::diagnostic::Fault;
use crate::format::document::Vertex;
use crate::format::error::Value;
use crate::format::kind::DiagnosticKind;
use crate::format::label::{Section, is_ruler, same, same_as_any};
use crate::format::quick::{self, QuickRun};
use crate::format::reader::{Reader, looks_like_number};

/// The lines of a vertex, in order, with their other spellings. `T` is the tangent and then the texture coordinate.
const FIELDS: [(&str, &[&str]); 6] = [
    ("Position", &["position", "pos", "p"]),
    ("Tangent", &["tangent", "tangentu", "t"]),
    ("Normal", &["normal", "n"]),
    ("Tex-Coords", &["texcoords", "texcoord", "texc", "uv", "t"]),
    ("BlendWeights", &["blendweights", "weights", "w"]),
    ("BlendIndices", &["blendindices", "indices", "i"]),
];

pub(in crate::format) struct Vertices {
    pub(in crate::format) vertices: Vec<Vertex>,
    /// Line of each position.
    pub(in crate::format) lines: Vec<u32>,
    /// The vertices whose fields are not on lines that follow one another, and the lines of these.
    pub(in crate::format) apart: Vec<(u32, [u32; 6])>,
    pub(in crate::format) short_labels: bool,
    pub(in crate::format) quick: Option<QuickRun>,
}

pub(in crate::format) async fn vertices(reader: &mut Reader<'_>, count: u32, bones: u32) -> Result<Vertices, Fault> {
    /// Four labels of a letter, twelve digits, blanks and line ends.
    const SMALLEST: usize = 32;
    reader.begin_rows(Section::Vertices)?;
    let short_labels = reader.peek_label().is_some_and(|(label, _)| same(label.text, "p"));
    let room = reader.room_for(count, SMALLEST);
    let (mut vertices, mut lines) = (Vec::with_capacity(room), Vec::with_capacity(room));
    let mut apart = Vec::new();
    let mut all_quick = !short_labels;
    let first = reader.cursor;
    for row in 0..count {
        reader.pause_every(row as usize).await;
        let quick = if short_labels {
            quick::vertex::<true>(&mut reader.cursor, bones)
        } else {
            quick::vertex::<false>(&mut reader.cursor, bones)
        };
        let (vertex, line) = match quick {
            Some(read) => read,
            None => {
                all_quick = false;
                let (vertex, lines) = vertex(reader, row, count, bones)?;
                if !lines.is_sorted_by(|before, line| before + 1 == *line) {
                    apart.push((row, lines));
                }
                (vertex, lines[0])
            }
        };
        vertices.push(vertex);
        lines.push(line);
    }
    let end = reader.cursor;
    pass_blend_data(reader, count, bones);
    if is_field(reader, 0) {
        let (_, names) = FIELDS[0];
        let first_word = |label: &[u8]| same_as_any(label.split(|&byte| byte == b':').next().unwrap_or(label), names);
        let surplus = reader.count_lines(first_word).await;
        return Err(reader.section_row_count("vertices", count, vertices.len() + surplus));
    }
    Ok(Vertices {
        vertices,
        lines,
        apart,
        short_labels,
        quick: all_quick.then(|| QuickRun::between(first, end)),
    })
}

fn is_field(reader: &Reader<'_>, field: usize) -> bool {
    let (_, names) = FIELDS[field];
    reader
        .peek_label()
        .is_some_and(|(label, _)| same_as_any(label.text, names))
}

/// Reads a vertex of any layout. Also gives the lines of its fields; without bones the last two are those that would follow.
fn vertex(reader: &mut Reader<'_>, row: u32, count: u32, bones: u32) -> Result<(Vertex, [u32; 6]), Fault> {
    pass_blend_data(reader, row, bones);
    let mut lines = [0; 6];
    lines[0] = field(reader, 0, row, count)?;
    let mut vertex = Vertex {
        position: reader.numbers(Value::Number("Position"), 3, [0.0; 3])?.0,
        ..Vertex::default()
    };
    lines[1] = field(reader, 1, row, count)?;
    let place = reader.cursor.position();
    let (tangent, given) = reader.numbers(Value::Number("Tangent"), 3, [0.0, 0.0, 0.0, 1.0])?;
    if given < 4 {
        reader.kinds.add(DiagnosticKind::TangentSignMissing, place, 0);
    }
    vertex.tangent = tangent;
    lines[2] = field(reader, 2, row, count)?;
    vertex.normal = reader.numbers(Value::Number("Normal"), 3, [0.0; 3])?.0;
    lines[3] = field(reader, 3, row, count)?;
    vertex.tex_coords = reader.numbers(Value::Number("Tex-Coords"), 2, [0.0; 2])?.0;
    [lines[4], lines[5]] = [1, 2].map(|more| lines[3].saturating_add(more));
    if bones > 0 {
        lines[4] = field(reader, 4, row, count)?;
        vertex.blend_weights = reader.numbers(Value::Number("BlendWeights"), 4, [0.0; 4])?.0;
        lines[5] = field(reader, 5, row, count)?;
        for (index, weight) in vertex.blend_indices.iter_mut().zip(vertex.blend_weights) {
            *index = blend_index(reader, weight, bones)?;
        }
        reader.pass_surplus_numbers();
    }
    Ok((vertex, lines))
}

/// Passes the label of a field, and unknown lines before it. Gives the label's line.
fn field(reader: &mut Reader<'_>, field: usize, row: u32, count: u32) -> Result<u32, Fault> {
    let (expected, names) = FIELDS[field];
    loop {
        let Some((label, behind)) = reader.peek_label() else {
            let vertex = format!("vertex {} of {count}", row + 1);
            return Err(reader.end(if field == 0 {
                vertex
            } else {
                format!("{expected} of {vertex}")
            }));
        };
        if same_as_any(label.text, names) {
            reader.cursor = behind;
            return Ok(label.position.line);
        }
        let ruler = is_ruler(label.text);
        if ruler && field == 0 {
            return Err(reader.section_row_count("vertices", count, row as usize));
        }
        let ours = FIELDS.iter().any(|(_, names)| same_as_any(label.text, names));
        let brace = matches!(label.text, b"{" | b"}");
        if ruler || ours || brace || looks_like_number(label.text) {
            return Err(Reader::wrong_label(label, expected));
        }
        reader.pass_unknown_line(label);
    }
}

/// A bone index. One that names no bone is forgiven when it has no weight.
fn blend_index(reader: &mut Reader<'_>, weight: f32, bones: u32) -> Result<u32, Fault> {
    let token = reader.value_token(Value::BlendIndex)?;
    let largest = i64::from(bones) - 1;
    let unused = weight == 0.0
        && std::str::from_utf8(token.text)
            .ok()
            .and_then(|text| text.parse::<i64>().ok())
            .is_some_and(|index| index < 0 || index > largest);
    if unused {
        reader.note(token, DiagnosticKind::BlendIndexUnused);
        return Ok(0);
    }
    let index = reader.whole_of(token, Value::BlendIndex, 0, largest)?;
    Ok(u32::try_from(index).unwrap_or(0))
}

/// Without bones, passes the blend data behind a vertex that has been read.
fn pass_blend_data(reader: &mut Reader<'_>, rows_before: u32, bones: u32) {
    if bones > 0 || rows_before == 0 {
        return;
    }
    while is_field(reader, 4) || is_field(reader, 5) {
        if let Some((label, _)) = reader.peek_label() {
            reader.note(label, DiagnosticKind::BlendDataUnused);
        }
        reader.cursor.skip_space();
        reader.cursor.rest_of_line();
    }
}
