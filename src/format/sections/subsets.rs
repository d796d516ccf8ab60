//! `SubsetID: i VertexStart: a VertexCount: b FaceStart: c FaceCount: d`

use crate::diagnostic::Fault;
use crate::format::document::Subset;
use crate::format::error::{Value, quoted};
use crate::format::kind::DiagnosticKind;
use crate::format::label::{Section, is_ruler, same, same_as_any};
use crate::format::likeness::Stranger;
use crate::format::reader::{Reader, looks_like_number};

/// The labels of a row, in order.
const LABELS: [&str; 5] = ["SubsetID", "VertexStart", "VertexCount", "FaceStart", "FaceCount"];

/// Labels of tables that count indices; they belong to relatives of the format.
const OF_RELATIVES: [&str; 5] = ["MtlIndex", "VertexBase", "IndexStart", "IndexCount", "MaterialIndex"];

/// Reads the subset table, with the line of each row.
pub(in crate::format) async fn subsets(reader: &mut Reader<'_>, count: u32) -> Result<(Vec<Subset>, Vec<u32>), Fault> {
    /// Five labels of a letter and five digits, with blanks.
    const SMALLEST: usize = 20;
    reader.begin_rows(Section::SubsetTable)?;
    let room = reader.room_for(count, SMALLEST);
    let (mut subsets, mut lines) = (Vec::with_capacity(room), Vec::with_capacity(room));
    for row in 0..count {
        reader.pause_every(row as usize).await;
        let Some((label, _)) = reader.peek_label() else {
            return Err(reader.end(format!("subset {} of {count}", row + 1)));
        };
        if is_ruler(label.text) || same_as_any(label.text, &["position", "p"]) {
            return Err(reader.section_row_count("subsets", count, subsets.len()));
        }
        lines.push(label.position.line);
        subsets.push(subset(reader)?);
    }
    if reader
        .peek_label()
        .is_some_and(|(label, _)| same(label.text, LABELS[0]))
    {
        let surplus = reader
            .count_lines(|label| same(label.split(|&byte| byte == b':').next().unwrap_or(label), LABELS[0]))
            .await;
        return Err(reader.section_row_count("subsets", count, subsets.len() + surplus));
    }
    Ok((subsets, lines))
}

fn subset(reader: &mut Reader<'_>) -> Result<Subset, Fault> {
    let mut values = [0; 5];
    for (place, value) in values.iter_mut().enumerate() {
        let label = LABELS[place];
        let Some((found, behind)) = reader.peek_label() else {
            return Err(reader.end(format!("{label}:")));
        };
        if OF_RELATIVES.iter().any(|relative| same(found.text, relative)) {
            let stranger = Stranger::Relative("a table of index ranges (MtlIndex, VertexBase, IndexStart, IndexCount)");
            return Err(Reader::error_at(found, stranger.diagnostic()));
        }
        if !same(found.text, label) {
            // A misspelt label has a number behind it all the same; another one's label means that one is left out.
            let other = LABELS.iter().any(|other| same(found.text, other));
            if other || is_ruler(found.text) || looks_like_number(found.text) {
                return Err(Reader::wrong_label(found, label));
            }
            reader.note(found, DiagnosticKind::SubsetLabel(quoted(found.text)));
        }
        reader.cursor = behind;
        let what = Value::Subset(label);
        let token = reader.value_token(what)?;
        *value = match reader.whole_of(token, what, 0, i64::from(u32::MAX)) {
            Ok(number) => u32::try_from(number).unwrap_or(u32::MAX),
            // Nothing reads the vertex range.
            Err(_) if (1..=2).contains(&place) => {
                reader.note(token, DiagnosticKind::SubsetVertexRange);
                0
            }
            Err(error) => return Err(error),
        };
    }
    reader.pass_surplus_numbers();
    let [id, vertex_start, vertex_count, face_start, face_count] = values;
    Ok(Subset {
        id,
        vertex_start,
        vertex_count,
        face_start,
        face_count,
    })
}
