//! Bones: `BoneOffset0` with sixteen numbers, and `ParentIndexOfBone0: -1`.

use crate::diagnostic::Fault;
use crate::format::cursor::Token;
use crate::format::error::Value;
use crate::format::kind::DiagnosticKind;
use crate::format::label::{Section, is_ruler, same, same_as_any, split_number};
use crate::format::quick;
use crate::format::reader::{Reader, looks_like_number};

/// Reads the bone offsets, with the line of each.
pub(in crate::format) async fn offsets(
    reader: &mut Reader<'_>,
    bones: u32,
) -> Result<(Vec<[f32; 16]>, Vec<u32>), Fault> {
    /// A label and sixteen digits with blanks.
    const SMALLEST: usize = 34;
    const NAMES: &[&str] = &["boneoffset", "b"];
    let room = reader.room_for(bones, SMALLEST);
    let (mut offsets, mut lines) = (Vec::with_capacity(room), Vec::with_capacity(room));
    for bone in 0..bones {
        reader.pause_every(bone as usize).await;
        let label = bone_label(reader, "BoneOffset", NAMES, bone, bones)?;
        lines.push(label.position.line);
        offsets.push(offset(reader, bone)?);
    }
    surplus_rows(reader, NAMES, bones).await?;
    Ok((offsets, lines))
}

/// Reads the parents, with the line of each: −1 or a bone.
pub(in crate::format) async fn hierarchy(reader: &mut Reader<'_>, bones: u32) -> Result<(Vec<i32>, Vec<u32>), Fault> {
    /// `P0: 0` and a line end.
    const SMALLEST: usize = 6;
    const NAMES: &[&str] = &["parentindexofbone", "parentofbone", "p"];
    let room = reader.room_for(bones, SMALLEST);
    let (mut parents, mut lines) = (Vec::with_capacity(room), Vec::with_capacity(room));
    for bone in 0..bones {
        reader.pause_every(bone as usize).await;
        let label = bone_label(reader, "ParentIndexOfBone", NAMES, bone, bones)?;
        let parent = reader.whole(Value::Parent, -1, (i64::from(bones) - 1).min(i64::from(i32::MAX)))?;
        lines.push(label.position.line);
        // In range, so the conversion holds.
        parents.push(i32::try_from(parent).unwrap_or(-1));
        reader.pass_surplus_numbers();
    }
    surplus_rows(reader, NAMES, bones).await?;
    Ok((parents, lines))
}

/// Passes the label of a bone's row. Its number should be the bone's; the place in the file is what counts.
fn bone_label<'a>(
    reader: &mut Reader<'a>,
    expected: &'static str,
    names: &[&str],
    bone: u32,
    bones: u32,
) -> Result<Token<'a>, Fault> {
    let Some((label, behind)) = reader.peek_label() else {
        return Err(reader.end(format!("{expected}{bone}")));
    };
    if is_ruler(label.text) {
        return Err(reader.section_row_count("bones", bones, bone as usize));
    }
    let (name, number) = split_number(label.text);
    if !same_as_any(name, names) {
        return Err(Reader::wrong_label(label, expected));
    }
    if number.is_some_and(|number| number != bone) {
        reader.note(label, DiagnosticKind::BoneNumber);
    }
    reader.cursor = behind;
    Ok(label)
}

/// Sixteen numbers, on one line or more. A second word of the label, or the bone's number, may stand before them.
fn offset(reader: &mut Reader<'_>, bone: u32) -> Result<[f32; 16], Fault> {
    if let Some(offset) = quick::offset(&mut reader.cursor) {
        return Ok(offset);
    }
    reader.cursor.skip_blanks();
    if !reader.cursor.at_line_end()
        && let Some(word) = reader.cursor.peek_token()
        && !looks_like_number(word.text)
    {
        let letters = word
            .text
            .iter()
            .all(|&byte| byte.is_ascii_alphabetic() || b":=_#".contains(&byte));
        if !letters {
            return Err(Reader::error_at(
                word,
                Value::Number("a bone offset").not_a_number(word.text),
            ));
        }
        reader.cursor.token();
        reader.note(word, DiagnosticKind::BoneOffsetLabel);
    }
    // Seventeen numbers, the first of which is the bone's: a label of two words.
    if let Some(number) = reader.cursor.peek_token()
        && same(number.text, &bone.to_string())
        && numbers_follow(reader) == 17
    {
        reader.cursor.token();
        reader.note(number, DiagnosticKind::BoneOffsetLabel);
    }
    Ok(reader.numbers(Value::Number("a bone offset"), 16, [0.0; 16])?.0)
}

/// How many numbers come next, up to 18.
fn numbers_follow(reader: &Reader<'_>) -> usize {
    let mut ahead = reader.cursor;
    let mut count = 0;
    while count < 18
        && let Some(token) = ahead.token()
        && looks_like_number(token.text)
    {
        count += 1;
    }
    count
}

/// An error when more rows follow than there are bones.
async fn surplus_rows(reader: &mut Reader<'_>, names: &[&str], bones: u32) -> Result<(), Fault> {
    let ours = |label: &[u8]| {
        same_as_any(
            split_number(label.split(|&b| b == b':').next().unwrap_or(label)).0,
            names,
        )
    };
    if !reader.peek_label().is_some_and(|(label, _)| ours(label.text)) {
        return Ok(());
    }
    let surplus = reader.count_lines(ours).await;
    Err(reader.section_row_count("bones", bones, bones as usize + surplus))
}

/// Enters a section of bones or clips. With rows it must come; without, it may be there, empty, or not at all.
impl Reader<'_> {
    /// True when there is something to read.
    pub(in crate::format) fn begin_optional(
        &mut self,
        section: Section,
        rows: u32,
        rest_present: bool,
    ) -> Result<bool, Fault> {
        if rows > 0 {
            self.begin_rows(section)?;
            return Ok(true);
        }
        let Some(ruler) = self.peek_ruler() else {
            if rest_present && self.cursor.peek_token().is_none() {
                let position = self.cursor.end_position();
                self.kinds.add(DiagnosticKind::SectionMissing(section), position, 0);
            }
            return Ok(false);
        };
        let named = Section::of_ruler(ruler.text);
        if named.is_some_and(|found| found > section) {
            self.note(ruler, DiagnosticKind::SectionMissing(section));
            return Ok(false);
        }
        self.begin(section).map(|_| self.section == section)
    }
}
