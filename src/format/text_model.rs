//! The static models that the books' demos read themselves, `car.txt` and `skull.txt`: positions, normals and triangles, and nothing else.
//!
//! ```text
//! file = "VertexCount:" n "TriangleCount:" n
//!        "VertexList" rest-of-line "{" { x y z nx ny nz line-end } "}"
//!        "TriangleList" rest-of-line "{" { i j k line-end } "}"
//! ```

use super::cursor::Token;
use super::document::{Dialect, Document, LineMap, Vertex};
use super::error::Value;
use super::kind::DiagnosticKind;
use super::label::{Section, same};
use super::quick;
use super::reader::{Reader, looks_like_number};
use super::sections::{close, open};
use crate::diagnostic::Fault;

/// The labels in their order.
const LABELS: [&str; 4] = ["VertexCount", "TriangleCount", "VertexList", "TriangleList"];

/// Whether a file begins so.
pub(super) fn begins(reader: &Reader<'_>) -> bool {
    reader
        .peek_label()
        .is_some_and(|(label, _)| same(label.text, LABELS[0]))
}

/// Whether a line is the first one of such a file.
pub(super) fn is_first_line(line: &[u8]) -> bool {
    let label = line.trim_ascii().split(|byte| *byte == b':').next();
    label.is_some_and(|label| same(label, LABELS[0]))
}

/// Reads such a file.
pub(super) async fn read(reader: &mut Reader<'_>) -> Result<(Document, LineMap), Fault> {
    let vertex_count = count(reader, LABELS[0], &["vertices"])?;
    let triangle_count = count(reader, LABELS[1], &["triangles"])?;
    let mut document = Document {
        dialect: Dialect::Text,
        ..Document::default()
    };
    let mut lines = LineMap {
        vertices_on_one_line: true,
        ..LineMap::default()
    };

    /// Six digits, five blanks and a line end.
    const SMALLEST_VERTEX: usize = 12;
    begin(reader, LABELS[2], Section::Vertices)?;
    let room = reader.room_for(vertex_count, SMALLEST_VERTEX);
    document.vertices.reserve(room);
    lines.vertices.reserve(room);
    for row in 0..vertex_count {
        reader.pause_every(row as usize).await;
        let token = row_token(reader, "vertices", row, vertex_count)?;
        reader.cursor.skip_space();
        let ([x, y, z, nx, ny, nz], _) = reader.numbers(Value::Number(LABELS[2]), 6, [0.0; 6])?;
        document.vertices.push(Vertex {
            position: [x, y, z],
            normal: [nx, ny, nz],
            ..Vertex::default()
        });
        lines.vertices.push(token.position.line);
    }
    end(reader, "vertices", vertex_count).await?;

    /// Three digits, two blanks and a line end.
    const SMALLEST_TRIANGLE: usize = 6;
    begin(reader, LABELS[3], Section::Triangles)?;
    let room = reader.room_for(triangle_count, SMALLEST_TRIANGLE);
    document.triangles.reserve(room);
    lines.triangles.reserve(room);
    for row in 0..triangle_count {
        reader.pause_every(row as usize).await;
        let (triangle, line) = match quick::triangle(&mut reader.cursor, vertex_count) {
            Some(read) => read,
            None => {
                let token = row_token(reader, "triangles", row, triangle_count)?;
                (triangle(reader, vertex_count)?, token.position.line)
            }
        };
        document.triangles.push(triangle);
        lines.triangles.push(line);
    }
    end(reader, "triangles", triangle_count).await?;
    if let Some(token) = reader.cursor.peek_token() {
        reader.note(token, DiagnosticKind::TextSurplus);
    }
    Ok((document, lines))
}

fn count(reader: &mut Reader<'_>, label: &'static str, rows: &'static [&'static str]) -> Result<u32, Fault> {
    reader.label(label, &[label])?;
    let number = reader.cursor.peek_token();
    let count = reader.count(Value::Count(rows[0]))?;
    reader.counts.extend(number.map(|number| (rows, number)));
    reader.pass_surplus_numbers();
    Ok(count)
}

/// Passes the label of a list, what else is on its line, and its brace.
fn begin(reader: &mut Reader<'_>, label: &'static str, section: Section) -> Result<(), Fault> {
    reader.label(label, &[label])?;
    reader.section = section;
    let mut rest = reader.cursor;
    rest.skip_blanks();
    // `VertexList (pos, normal) {` opens on its line.
    let line = rest.rest_of_line();
    if line.text.ends_with(b"{") {
        reader.cursor = rest;
        return Ok(());
    }
    reader.cursor = rest;
    open(reader)
}

/// The token that a row begins with.
fn row_token<'a>(reader: &Reader<'a>, rows: &'static str, row: u32, count: u32) -> Result<Token<'a>, Fault> {
    match reader.cursor.peek_token() {
        None => Err(reader.end(format!("row {} of {count} {rows}", row + 1))),
        Some(token) if token.text == b"}" => Err(reader.section_row_count(rows, count, row as usize)),
        Some(token) => Ok(token),
    }
}

/// Passes the brace behind a list, which has as many rows as announced.
async fn end(reader: &mut Reader<'_>, rows: &'static str, count: u32) -> Result<(), Fault> {
    let mut surplus = 0;
    while reader
        .cursor
        .peek_token()
        .is_some_and(|token| looks_like_number(token.text))
    {
        reader.pause_every(surplus).await;
        reader.cursor.skip_space();
        reader.cursor.rest_of_line();
        surplus += 1;
    }
    if surplus > 0 {
        return Err(reader.section_row_count(rows, count, count as usize + surplus));
    }
    close(reader)
}

fn triangle(reader: &mut Reader<'_>, vertices: u32) -> Result<[u32; 3], Fault> {
    reader.cursor.skip_space();
    let mut triangle = [0; 3];
    for index in &mut triangle {
        let number = reader.whole(Value::VertexIndex, 0, i64::from(vertices) - 1)?;
        // In range, so the conversion holds.
        *index = u32::try_from(number).unwrap_or(0);
    }
    reader.pass_surplus_numbers();
    Ok(triangle)
}
