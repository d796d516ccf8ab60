//! Triangles: three vertex indices on a line.

use crate::diagnostic::Fault;
use crate::format::error::Value;
use crate::format::label::{Section, is_ruler};
use crate::format::quick::{self, QuickRun};
use crate::format::reader::{Reader, looks_like_number};

pub(in crate::format) struct Triangles {
    pub(in crate::format) triangles: Vec<[u32; 3]>,
    /// Line of each.
    pub(in crate::format) lines: Vec<u32>,
    pub(in crate::format) quick: Option<QuickRun>,
}

/// Reads the triangles. All indices are below `vertices`.
pub(in crate::format) async fn triangles(
    reader: &mut Reader<'_>,
    count: u32,
    vertices: u32,
) -> Result<Triangles, Fault> {
    /// Three digits, two blanks, a line end.
    const SMALLEST: usize = 6;
    reader.begin_rows(Section::Triangles)?;
    let room = reader.room_for(count, SMALLEST);
    let (mut triangles, mut lines) = (Vec::with_capacity(room), Vec::with_capacity(room));
    let (first, mut all_quick) = (reader.cursor, true);
    for row in 0..count {
        reader.pause_every(row as usize).await;
        let (triangle, line) = match quick::triangle(&mut reader.cursor, vertices) {
            Some(read) => read,
            None => {
                all_quick = false;
                triangle(reader, row, count, vertices)?
            }
        };
        triangles.push(triangle);
        lines.push(line);
    }
    let end = reader.cursor;
    if reader
        .cursor
        .peek_token()
        .is_some_and(|token| looks_like_number(token.text))
    {
        let surplus = reader.count_lines(looks_like_number).await;
        return Err(reader.section_row_count("triangles", count, triangles.len() + surplus));
    }
    Ok(Triangles {
        triangles,
        lines,
        quick: all_quick.then(|| QuickRun::between(first, end)),
    })
}

fn triangle(reader: &mut Reader<'_>, row: u32, count: u32, vertices: u32) -> Result<([u32; 3], u32), Fault> {
    let Some(token) = reader.cursor.peek_token() else {
        return Err(reader.end(format!("triangle {} of {count}", row + 1)));
    };
    if is_ruler(token.text) {
        return Err(reader.section_row_count("triangles", count, row as usize));
    }
    reader.cursor.skip_space();
    let mut triangle = [0; 3];
    for index in &mut triangle {
        let number = reader.whole(Value::VertexIndex, 0, i64::from(vertices) - 1)?;
        // In range, so the conversion holds.
        *index = u32::try_from(number).unwrap_or(0);
    }
    reader.pass_surplus_numbers();
    Ok((triangle, token.position.line))
}
