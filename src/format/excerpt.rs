//! The lines around a place in a file, safe to print.

use std::fmt;

use crate::diagnostic::Position;

/// A line and the one before it, with a mark under a part of the last one. Of a file that is no text: rows of its bytes.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Excerpt {
    /// Line numbers from 1, and texts without control characters. Tabs have become blanks. The last line is the marked one.
    /// With `in_hex`: the offset of a row's first byte in the file, from 0; up to 16 bytes in hex, and beside them those that
    /// are ASCII characters.
    pub lines: Vec<(u32, String)>,
    /// Whether the file is no text.
    pub in_hex: bool,
    /// First marked character of the last line, from 1. It may stand one behind the end.
    pub mark_column: u32,
    /// Marked characters, at least 1.
    pub mark_length: u32,
}

impl Excerpt {
    /// The lines with their numbers as they are shown: aligned at the right, offsets in hex.
    pub fn numbered_lines(&self) -> impl ExactSizeIterator<Item = (String, &str)> {
        let in_words = |number: u32| {
            if self.in_hex {
                format!("{number:02x}")
            } else {
                number.to_string()
            }
        };
        let width = self.lines.last().map_or(0, |&(number, _)| in_words(number).len());
        let lines = self.lines.iter();
        lines.map(move |(number, line)| (format!("{:>width$}", in_words(*number)), line.as_str()))
    }

    /// The last line before, at and after the mark.
    pub fn marked_parts(&self) -> (&str, &str, &str) {
        let line = self.lines.last().map_or("", |(_, line)| line.as_str());
        let byte_of = |column: u32| {
            line.char_indices()
                .nth(column as usize)
                .map_or(line.len(), |(byte, _)| byte)
        };
        let first = self.mark_column.saturating_sub(1);
        let (before, rest) = line.split_at(byte_of(first));
        let (marked, after) = rest.split_at(byte_of(first.saturating_add(self.mark_length)) - before.len());
        (before, marked, after)
    }
}

/// Lines with their numbers, and carets under the mark.
impl fmt::Display for Excerpt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut width = 0;
        for (number, line) in self.numbered_lines() {
            writeln!(f, "{number} | {line}")?;
            width = number.len();
        }
        let indent = self.mark_column.saturating_sub(1) as usize;
        writeln!(
            f,
            "{:width$} | {:indent$}{}",
            "",
            "",
            "^".repeat(self.mark_length as usize)
        )
    }
}

/// Columns of a tab.
const TAB: usize = 4;

/// Bytes that are shown of a longer line.
const LONGEST: usize = 160;

/// Bytes that stay visible before the mark.
const BEFORE_MARK: usize = 60;

/// Bytes at the beginning of a file among which text has no NUL.
const HEAD: usize = 1024;

/// Bytes in a row of a file that is no text.
const ROW: usize = 16;

/// Where the lines of a file begin, found once, so that many excerpts of one file do not read it from its start each.
#[derive(Clone, Debug)]
pub struct LineIndex<'a> {
    bytes: &'a [u8],
    /// Where every [`LineIndex::STEP`]th line begins, from the first line on.
    starts: Vec<usize>,
}

impl<'a> LineIndex<'a> {
    /// Lines from one kept start to the next: a file of nothing but line ends needs little room, and a line is near.
    const STEP: usize = 256;

    /// Reads the bytes once.
    pub fn new(bytes: &'a [u8]) -> Self {
        let ends = memchr::memchr2_iter(b'\n', b'\r', bytes);
        // Of a carriage return with a line feed only the second ends the line.
        let ends = ends.filter(|&end| bytes.get(end..end + 2) != Some(b"\r\n"));
        let starts = std::iter::once(first_line(bytes)).chain(ends.map(|end| end + 1));
        Self {
            bytes,
            starts: starts.step_by(Self::STEP).collect(),
        }
    }

    /// The bytes of a line, by its number from 1, without its end. Empty behind the last line.
    pub fn line(&self, number: u32) -> &'a [u8] {
        let index = number.saturating_sub(1) as usize;
        let Some(&start) = self.starts.get(index / Self::STEP) else {
            return &[];
        };
        let mut line = next_line(&self.bytes[start..]);
        for _ in 0..index % Self::STEP {
            let Some(rest) = line.rest else { return &[] };
            line = next_line(rest);
        }
        line.text
    }

    /// Shows the line of `position` and the one before it. A position outside of the file gives the nearest line. Of a file
    /// that is no text it shows the row of 16 bytes that the position is in, and the one before it.
    pub fn excerpt(&self, position: Position, length: u32) -> Excerpt {
        // From the line before the wanted one on. Behind the end that is the last but one, which is not before the last but one
        // of these starts.
        let steps = (position.line.saturating_sub(2) as usize / Self::STEP).min(self.starts.len().saturating_sub(2));
        // A file has no more lines than this type counts, or its last ones have no position.
        let first = as_u32(steps * Self::STEP).saturating_add(1);
        excerpt_from(self.bytes, self.starts[steps], first, position, length)
    }
}

/// The one excerpt of a file of which no other is wanted: [`LineIndex::excerpt`] without an index.
pub fn excerpt(bytes: &[u8], position: Position, length: u32) -> Excerpt {
    excerpt_from(bytes, first_line(bytes), 1, position, length)
}

/// Where the first line begins: behind a byte order mark.
fn first_line(bytes: &[u8]) -> usize {
    let mark = b"\xEF\xBB\xBF";
    if bytes.starts_with(mark) { mark.len() } else { 0 }
}

/// The excerpt of a position at or behind `start`, where line `first` begins.
fn excerpt_from(bytes: &[u8], start: usize, first: u32, position: Position, length: u32) -> Excerpt {
    let mut ahead = bytes.get(start..).unwrap_or_default();
    let (mut number, mut line, mut before) = (first, next_line(ahead), None);
    while number < position.line
        && let Some(rest) = line.rest
    {
        before = Some(line.text);
        ahead = rest;
        line = next_line(ahead);
        number += 1;
    }
    let start = (position.column as usize).saturating_sub(1).min(line.text.len());
    if bytes.iter().take(HEAD).any(|&byte| byte == 0) {
        return in_hex(bytes, bytes.len() - ahead.len() + start, length as usize);
    }
    let start = match line.text[start..].iter().position(|byte| !byte.is_ascii_whitespace()) {
        // A whole row is meant: its first word is marked, not what stands before it.
        Some(blanks) if length == 0 && line.text[..start].trim_ascii().is_empty() => start + blanks,
        _ => start,
    };
    let end = start.saturating_add(length as usize).min(line.text.len());
    let cut = if line.text.len() > LONGEST {
        start.saturating_sub(BEFORE_MARK)
    } else {
        0
    };
    let marked = shown(line.text, cut);
    let (mark_start, mark_end) = (marked.column_of(start), marked.column_of(end));
    let mut lines = Vec::new();
    if let Some(before) = before {
        lines.push((number - 1, shown(before, cut.min(before.len())).text));
    }
    lines.push((number, marked.text));
    Excerpt {
        lines,
        in_hex: false,
        mark_column: as_u32(mark_start) + 1,
        mark_length: as_u32(mark_end - mark_start).max(1),
    }
}

/// The row of bytes in which a mark begins and the one before it. The mark ends with the row.
fn in_hex(bytes: &[u8], mark_start: usize, mark_length: usize) -> Excerpt {
    let row_start = mark_start.min(bytes.len().saturating_sub(1)) / ROW * ROW;
    let first = row_start.saturating_sub(ROW);
    let rows = bytes.get(first..).unwrap_or_default().chunks(ROW);
    let rows: Vec<&[u8]> = rows.take((row_start - first) / ROW + 1).collect();
    // What stands beside the bytes begins at one column.
    let hex_width = 3 * rows.first().map_or(0, |row| row.len());
    let line = |row: &[u8]| {
        let hex: String = row.iter().map(|byte| format!("{byte:02x} ")).collect();
        let is_shown = |byte: u8| byte == b' ' || byte.is_ascii_graphic();
        let ascii: String = row
            .iter()
            .map(|&byte| if is_shown(byte) { char::from(byte) } else { '.' })
            .collect();
        format!("{hex:hex_width$} {ascii}")
    };
    let row_length = rows.last().map_or(0, |row| row.len());
    let in_row = (mark_start - row_start).min(row_length);
    let marked = mark_length.clamp(1, (row_length - in_row).max(1));
    Excerpt {
        lines: (0..)
            .map(|row| as_u32(first + row * ROW))
            .zip(rows.iter().map(|row| line(row)))
            .collect(),
        in_hex: true,
        mark_column: as_u32(in_row * 3) + 1,
        mark_length: as_u32(marked * 3 - 1),
    }
}

/// A line without its end, and what follows when there was an end.
struct Line<'a> {
    text: &'a [u8],
    rest: Option<&'a [u8]>,
}

fn next_line(bytes: &[u8]) -> Line<'_> {
    let Some(end) = memchr::memchr2(b'\n', b'\r', bytes) else {
        return Line {
            text: bytes,
            rest: None,
        };
    };
    let (text, rest) = bytes.split_at(end);
    let rest = rest.strip_prefix(b"\r\n").or_else(|| rest.get(1..)).unwrap_or_default();
    Line { text, rest: Some(rest) }
}

/// A printable part of a line.
struct Shown {
    text: String,
    /// For each character: the byte of the line it begins at, and its column from 0.
    starts: Vec<(usize, usize)>,
    columns: usize,
}

impl Shown {
    /// Column of the first character at or behind `byte`.
    fn column_of(&self, byte: usize) -> usize {
        self.starts
            .iter()
            .find(|(start, _)| *start >= byte)
            .map_or(self.columns, |(_, column)| *column)
    }
}

/// The part of `line` from byte `cut` on, with dots where something was left out.
fn shown(line: &[u8], cut: usize) -> Shown {
    let part = line.get(cut..).unwrap_or_default();
    let part = part.get(..LONGEST).unwrap_or(part);
    let mut shown = Shown {
        text: String::new(),
        starts: Vec::new(),
        columns: 0,
    };
    if cut > 0 {
        shown.text.push('…');
        shown.columns += 1;
    }
    let mut at = cut;
    for chunk in part.utf8_chunks() {
        for character in chunk.valid().chars() {
            shown.starts.push((at, shown.columns));
            at += character.len_utf8();
            if character == '\t' {
                let width = TAB - shown.columns % TAB;
                shown.text.extend(std::iter::repeat_n(' ', width));
                shown.columns += width;
            } else {
                shown.text.push(if is_printable(character) {
                    character
                } else {
                    char::REPLACEMENT_CHARACTER
                });
                shown.columns += 1;
            }
        }
        if !chunk.invalid().is_empty() {
            shown.starts.push((at, shown.columns));
            at += chunk.invalid().len();
            shown.text.push(char::REPLACEMENT_CHARACTER);
            shown.columns += 1;
        }
    }
    if cut + part.len() < line.len() {
        shown.text.push('…');
    }
    shown
}

/// False for control characters, and for those that turn or hide the text around them.
pub fn is_printable(character: char) -> bool {
    let hidden =
        matches!(character, '\u{200B}'..='\u{200F}' | '\u{2028}'..='\u{202E}' | '\u{2060}'..='\u{2069}' | '\u{FEFF}');
    !character.is_control() && !hidden
}

fn as_u32(columns: usize) -> u32 {
    u32::try_from(columns).unwrap_or(u32::MAX - 1)
}
