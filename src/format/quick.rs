//! The quick reader: rows exactly as the books' exporter writes them, blanks aside.
//!
//! Each function reads one row and moves the cursor behind it, or leaves the cursor alone and gives `None`: then the thorough
//! [`reader`](super::reader) has a look, and says what is odd. So nothing here makes an error or a diagnostic, and nothing
//! here mends.

use super::cursor::Cursor;
use super::document::{Keyframe, Vertex};
use super::number;

/// Labels of a vertex's lines, in order.
type VertexLabels = [&'static [u8]; 6];

/// As in the books.
const LONG: VertexLabels = [
    b"Position:",
    b"Tangent:",
    b"Normal:",
    b"Tex-Coords:",
    b"BlendWeights:",
    b"BlendIndices:",
];

/// As imm_engine writes them.
const SHORT: VertexLabels = [b"P:", b"T:", b"N:", b"T:", b"W:", b"I:"];

/// Labels of a key, in order: as in the books, and as imm_engine writes them.
const KEY: [[&[u8]; 4]; 2] = [[b"Time:", b"Pos:", b"Scale:", b"Quat:"], [b"T:", b"P:", b"S:", b"Q:"]];

/// Which rows of a file all stand as the books' exporter writes them: who reads the same bytes with this reader comes to the same, and can
/// pass over them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct QuickRows {
    /// The vertices, which have weights where there are bones.
    pub(crate) vertices: Option<QuickRun>,
    /// The triangles.
    pub(crate) triangles: Option<QuickRun>,
    /// Of each clip the keys of each bone.
    pub(crate) tracks: Vec<Vec<Option<QuickRun>>>,
}

impl QuickRows {
    /// Whether all vertices, all triangles and the keys of all bones are so.
    pub fn are_all(&self) -> bool {
        let tracks = self.tracks.iter().flatten();
        self.vertices.is_some() && self.triangles.is_some() && tracks.into_iter().all(Option::is_some)
    }
}

/// Rows that follow one another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct QuickRun {
    /// Offset of the first, and behind the last.
    bytes: [usize; 2],
    /// Line behind the last, and its offset.
    end_line: u32,
    end_line_start: usize,
}

impl QuickRun {
    /// What lies between two places.
    pub(super) fn between(mut first: Cursor<'_>, end: Cursor<'_>) -> Self {
        first.pass_empty_lines();
        Self {
            bytes: [first.at, end.at],
            end_line: end.line,
            end_line_start: end.line_start,
        }
    }

    /// Goes from the first row behind the last. False, and nothing is passed, where they do not begin here.
    pub(crate) fn pass(&self, cursor: &mut Cursor<'_>) -> bool {
        let mut ahead = *cursor;
        ahead.pass_empty_lines();
        let begins_here = ahead.at == self.bytes[0];
        if begins_here {
            ahead.at = self.bytes[1];
            (ahead.line, ahead.line_start) = (self.end_line, self.end_line_start);
            *cursor = ahead;
        }
        begins_here
    }
}

/// Reads a vertex; with bones, its blend indices are below `bones`. Also gives the line of its position.
#[inline]
pub(crate) fn vertex<const SHORT_LABELS: bool>(cursor: &mut Cursor<'_>, bones: u32) -> Option<(Vertex, u32)> {
    let [position, tangent, normal, tex_coords, blend_weights, blend_indices] =
        const { if SHORT_LABELS { SHORT } else { LONG } };
    let mut ahead = *cursor;
    ahead.pass_empty_lines();
    let line = ahead.line;
    let mut vertex = Vertex::default();
    ahead.label(position)?;
    vertex.position = ahead.three()?;
    ahead.line_end()?;
    ahead.label(tangent)?;
    vertex.tangent = ahead.four()?;
    ahead.line_end()?;
    ahead.label(normal)?;
    vertex.normal = ahead.three()?;
    ahead.line_end()?;
    ahead.label(tex_coords)?;
    vertex.tex_coords = ahead.two()?;
    ahead.line_end()?;
    if bones > 0 {
        ahead.label(blend_weights)?;
        vertex.blend_weights = ahead.four()?;
        ahead.line_end()?;
        ahead.label(blend_indices)?;
        vertex.blend_indices = ahead.four_below(bones)?;
        ahead.line_end()?;
    }
    *cursor = ahead;
    Some((vertex, line))
}

/// Reads a triangle whose indices are below `vertices`. Also gives its line.
#[inline(always)]
pub(crate) fn triangle(cursor: &mut Cursor<'_>, vertices: u32) -> Option<([u32; 3], u32)> {
    let mut ahead = *cursor;
    let line = ahead.line;
    let triangle = ahead.three_below(vertices)?;
    ahead.line_end()?;
    *cursor = ahead;
    Some((triangle, line))
}

/// Reads the sixteen numbers behind the label of a bone offset, and the end of their line.
pub(crate) fn offset(cursor: &mut Cursor<'_>) -> Option<[f32; 16]> {
    let mut ahead = *cursor;
    let mut offset = [0.0; 16];
    for number in &mut offset {
        *number = ahead.number()?;
    }
    ahead.line_end()?;
    *cursor = ahead;
    Some(offset)
}

/// Reads a key on its line. Also gives the line.
#[inline]
pub(crate) fn keyframe<const SHORT_LABELS: bool>(cursor: &mut Cursor<'_>) -> Option<(Keyframe, u32)> {
    let mut ahead = *cursor;
    ahead.pass_empty_lines();
    let line = ahead.line;
    let [time, position, scale_label, quaternion] = const { KEY[SHORT_LABELS as usize] };
    ahead.label(time)?;
    let time_secs = ahead.number()?;
    ahead.label(position)?;
    let translation = ahead.three()?;
    ahead.label(scale_label)?;
    let scale = ahead.three()?;
    ahead.label(quaternion)?;
    let rotation = ahead.four()?;
    ahead.line_end()?;
    *cursor = ahead;
    let keyframe = Keyframe {
        time_secs,
        translation,
        scale,
        rotation,
    };
    Some((keyframe, line))
}

impl Cursor<'_> {
    /// Passes a label at the beginning of a line, or of a part of one. A blank follows it.
    #[inline(always)]
    fn label(&mut self, label: &[u8]) -> Option<()> {
        self.blanks();
        self.literal(label)?;
        matches!(self.bytes.get(self.at), Some(b' ' | b'\t')).then_some(())
    }

    // Written out instead of loops, whose ends the processor would have to guess.

    #[inline(always)]
    fn two(&mut self) -> Option<[f32; 2]> {
        Some([self.number()?, self.number()?])
    }

    #[inline(always)]
    fn three(&mut self) -> Option<[f32; 3]> {
        Some([self.number()?, self.number()?, self.number()?])
    }

    #[inline(always)]
    fn four(&mut self) -> Option<[f32; 4]> {
        Some([self.number()?, self.number()?, self.number()?, self.number()?])
    }

    #[inline(always)]
    fn number(&mut self) -> Option<f32> {
        let mut window = self.bytes.get(self.at..)?.first_chunk()?;
        if window[0] != b' ' || window[1] <= b' ' {
            // Not the one blank that is usual. There is always a byte before a number.
            self.blanks();
            self.at = self.at.checked_sub(1)?;
            window = self.bytes.get(self.at..)?.first_chunk()?;
        }
        let (number, length) = number::plain(window)?;
        self.at += length;
        Some(number)
    }

    #[inline(always)]
    fn literal(&mut self, text: &[u8]) -> Option<()> {
        if !self.bytes.get(self.at..)?.starts_with(text) {
            return None;
        }
        self.at += text.len();
        Some(())
    }

    #[inline(always)]
    fn blanks(&mut self) {
        while let Some(b' ' | b'\t') = self.bytes.get(self.at) {
            self.at += 1;
        }
    }

    /// Whole numbers of up to seven digits, below `end`, with one blank between them.
    #[inline(always)]
    fn three_below(&mut self, end: u32) -> Option<[u32; 3]> {
        self.blanks();
        let window = self.bytes.get(self.at..)?.first_chunk()?;
        let (a, next) = number::plain_whole(window, 0, end)?;
        let (b, next) = number::plain_whole(window, next, end)?;
        let (c, next) = number::plain_whole(window, next, end)?;
        self.at += next - 1;
        Some([a, b, c])
    }

    /// The same, four of them.
    #[inline(always)]
    fn four_below(&mut self, end: u32) -> Option<[u32; 4]> {
        let [a, b, c] = self.three_below(end)?;
        let window = self.bytes.get(self.at + 1..)?.first_chunk()?;
        let (d, next) = number::plain_whole(window, 0, end)?;
        self.at += next;
        Some([a, b, c, d])
    }

    #[inline(always)]
    fn line_end(&mut self) -> Option<()> {
        if self.bytes.get(self.at) != Some(&b'\n') {
            self.blanks();
            if self.bytes.get(self.at) == Some(&b'\r') {
                self.at += 1;
            }
            if self.bytes.get(self.at) != Some(&b'\n') {
                return None;
            }
        }
        self.at += 1;
        self.line = self.line.saturating_add(1);
        self.line_start = self.at;
        Some(())
    }

    #[inline(always)]
    pub(crate) fn pass_empty_lines(&mut self) {
        while let Some(b'\n' | b'\r' | b' ' | b'\t') = self.bytes.get(self.at) {
            let before = *self;
            if self.line_end().is_none() {
                *self = before;
                return;
            }
        }
    }
}
