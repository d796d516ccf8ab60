//! Where the parts of a model stand in its file, and what stands at a place: one question for all formats.

use super::Subject;
use super::collect::{Place, Tally};

/// What a file has of a part of the model, by the file's numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "named as the parts are")]
pub enum Row {
    Material(u32),
    Subset(u32),
    Vertex(u32),
    /// The tangent of a vertex.
    Tangent(u32),
    Triangle(u32),
    /// A bone, where its parent is said.
    Bone(u32),
    /// The inverse bind matrix of a bone.
    Offset(u32),
    Clip(u32),
    /// The keys of a bone in a clip.
    Track {
        clip: u32,
        bone: u32,
    },
    Key {
        clip: u32,
        bone: u32,
        key: u32,
    },
}

/// What a format can tell of places. A text has lines, glTF has JSON pointers; what a format does not have is `None`.
pub trait Places {
    /// The line on which a row begins, from 1.
    fn line(&self, _row: Row) -> Option<u32> {
        None
    }

    /// What stands on a line: the row that begins there, or the last one before it.
    fn row_on(&self, _line: u32) -> Option<Row> {
        None
    }

    /// The pointer to a row.
    fn pointer(&self, _row: Row) -> Option<String> {
        None
    }

    /// The row that a pointer leads to, or into.
    fn row_at(&self, _pointer: &str) -> Option<Row> {
        None
    }
}

impl dyn Places + '_ {
    /// Rows that are told of together.
    pub(crate) fn of_rows(&self, rows: &Tally, subject: fn(u32) -> Subject, row: fn(u32) -> Row) -> Place {
        Place::of_rows_on(rows, subject, |index| self.line(row(index)))
    }
}
