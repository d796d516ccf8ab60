//! FBX as its files have it: a tree of records with values, in binary or as text, and no meaning.
//!
//! ```text
//! binary = "Kaydara FBX Binary  " 00 1A 00 version:u32 { record } end
//! record = end:uN values:uN bytes:uN name-length:u8 name { value } [ { record } end ]     N = 32; 64 from version 7500 on
//! end    = 3 uN and a byte, all 0
//! value  = "C" u8 | "Y" i16 | "I" i32 | "L" i64 | "F" f32 | "D" f64 | ("S" | "R") length:u32 bytes
//!        | ("b" | "c" | "i" | "l" | "f" | "d") count:u32 is-deflated:u32 length:u32 bytes
//!
//! text   = { record }                           `;` begins a comment up to the end of its line
//! record = name ":" [ value { "," value } ] [ "{" { record } "}" ]
//! value  = number | word | '"' text '"' | "*" count "{" "a:" number { "," number } "}"
//! ```
//!
//! Both forms give the same [`Document`]. Sources: the files that exporters write, and what is said of them at
//! <https://code.blender.org/2013/08/fbx-binary-file-format-specification/>. Numbers are little-endian.

mod array;
mod binary;
mod text;

use std::borrow::Cow;

pub use array::{Array, Budget};

use crate::diagnostic::{Code, Diagnostic, Fault, Position, codes};
use crate::slices::{Slices, at_once};

/// What no file of people has more of, one in the other.
const MOST_DEPTH: usize = 64;

/// A file as it was read. It borrows from its bytes.
#[derive(Clone, Debug)]
pub struct Document<'a> {
    /// Such as 6100, 7400 or 7700.
    pub version: u32,
    /// Whether it is binary.
    pub is_binary: bool,
    /// What stands at the top, in its order.
    pub records: Vec<Record<'a>>,
}

/// A name with values, and what is in it.
#[derive(Clone, Debug, Default)]
pub struct Record<'a> {
    /// `Objects`, `Vertices`, `P`, …
    pub name: Cow<'a, str>,
    /// In their order.
    pub values: Vec<Value<'a>>,
    /// In their order.
    pub records: Vec<Record<'a>>,
    /// Where it begins.
    pub place: Place,
}

/// A value of a record.
#[derive(Clone, Debug)]
pub enum Value<'a> {
    /// A whole number, or whether something is so.
    Integer(i64),
    /// Any other number.
    Number(f64),
    /// A text or a word, as the file has it.
    Text(Cow<'a, [u8]>),
    /// Numbers of one kind. Those of version 6.1 stand in the record itself and are collected.
    Array(Array<'a>),
}

/// Where something is in the file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// In a binary one: bytes from its start.
    Offset(u64),
    /// In one of text.
    At(Position),
}

impl Default for Place {
    fn default() -> Self {
        Self::Offset(0)
    }
}

impl Place {
    /// A diagnostic here.
    pub(crate) fn says(self, code: &Code, message: impl Into<String>) -> Diagnostic {
        let diagnostic = code.says(message);
        match self {
            Self::At(position) => diagnostic.at(position, 0),
            Self::Offset(offset) => Diagnostic {
                byte_offset: Some(offset),
                ..diagnostic
            },
        }
    }

    fn damaged(self, message: impl Into<String>) -> Fault {
        Box::new(self.says(&codes::FBX_DAMAGED, message))
    }
}

impl<'a> Record<'a> {
    /// The first record of this name in it.
    pub fn find(&self, name: &str) -> Option<&Record<'a>> {
        self.records.iter().find(|record| record.name == name)
    }

    /// The records of this name in it.
    pub fn all<'s>(&'s self, name: &'s str) -> impl Iterator<Item = &'s Record<'a>> {
        self.records.iter().filter(move |record| record.name == name)
    }

    /// The value at this place, if it is a whole number.
    pub fn integer(&self, index: usize) -> Option<i64> {
        match self.values.get(index)? {
            Value::Integer(value) => Some(*value),
            Value::Number(value) if value.fract() == 0.0 && value.abs() < 2f64.powi(53) => Some(*value as i64),
            _ => None,
        }
    }

    /// The value at this place, if it is a number.
    pub fn number(&self, index: usize) -> Option<f64> {
        match self.values.get(index)? {
            Value::Integer(value) => Some(*value as f64),
            Value::Number(value) => Some(*value),
            _ => None,
        }
    }

    /// The value at this place, if it is a text. What is no UTF-8 is replaced.
    pub fn text(&self, index: usize) -> Option<Cow<'_, str>> {
        self.bytes(index).map(String::from_utf8_lossy)
    }

    /// The same as it stands in the file.
    pub fn bytes(&self, index: usize) -> Option<&[u8]> {
        match self.values.get(index)? {
            Value::Text(text) => Some(text),
            _ => None,
        }
    }

    /// The numbers that the record holds: its array, or its values where all are numbers.
    ///
    /// # Errors
    /// When the array is damaged, or `budget` has no room for it.
    pub fn numbers(&self, budget: &Budget) -> Result<Vec<f64>, Fault> {
        match self.values.as_slice() {
            [Value::Array(array)] => array.numbers(budget, self.place),
            values => Ok((0..values.len()).map_while(|index| self.number(index)).collect()),
        }
    }

    /// The same as whole numbers.
    ///
    /// # Errors
    /// As [`numbers`](Self::numbers).
    pub fn integers(&self, budget: &Budget) -> Result<Vec<i64>, Fault> {
        match self.values.as_slice() {
            [Value::Array(array)] => array.integers(budget, self.place),
            values => Ok((0..values.len()).map_while(|index| self.integer(index)).collect()),
        }
    }

    /// Name and class of an object, from its value at this place: `Cube` and `Model`. Binary files part them by two bytes, and have the name first.
    pub fn name_and_class(&self, index: usize) -> Option<(Cow<'_, str>, Cow<'_, str>)> {
        let text = self.bytes(index)?;
        let (name, class) = match (memchr::memmem::find(text, b"\0\x01"), memchr::memmem::find(text, b"::")) {
            (Some(at), _) => (&text[..at], &text[at + 2..]),
            (None, Some(at)) => (&text[at + 2..], &text[..at]),
            (None, None) => (text, &text[..0]),
        };
        Some((String::from_utf8_lossy(name), String::from_utf8_lossy(class)))
    }
}

impl<'a> Document<'a> {
    /// The first record of this name at the top.
    pub fn find(&self, name: &str) -> Option<&Record<'a>> {
        self.records.iter().find(|record| record.name == name)
    }
}

/// Whether a file begins as FBX does, in either form, whatever its version.
pub fn begins_like_fbx(bytes: &[u8]) -> bool {
    bytes.starts_with(binary::MAGIC) || text::begins(bytes)
}

/// Reads a file.
///
/// # Errors
/// When it is damaged, or of a version before 6.1.
pub fn parse(bytes: &[u8]) -> Result<Document<'_>, Fault> {
    at_once(parse_in(bytes, &Slices::ENDLESS))
}

/// The same in slices.
///
/// # Errors
/// As [`parse`].
pub async fn parse_in<'a>(bytes: &'a [u8], slices: &Slices) -> Result<Document<'a>, Fault> {
    if bytes.starts_with(binary::MAGIC) {
        binary::parse(bytes, slices).await
    } else {
        text::parse(bytes, slices).await
    }
}

/// Whether a version is one that is read.
fn check_version(version: u32, place: Place) -> Result<(), Fault> {
    if (6000..8000).contains(&version) {
        return Ok(());
    }
    let message = format!(
        "The file is of FBX version {}.{}; 6.1 and 7.0 to 7.7 are read.",
        version / 1000,
        version / 100 % 10
    );
    Err(Box::new(place.says(&codes::FBX_VERSION, message)))
}

/// Records that are open, the outermost first, and those that are done.
#[derive(Debug, Default)]
struct Growing<'a> {
    open: Vec<Record<'a>>,
    done: Vec<Record<'a>>,
}

impl<'a> Growing<'a> {
    fn open(&mut self, record: Record<'a>) -> Result<(), Fault> {
        if self.open.len() == MOST_DEPTH {
            return Err(record
                .place
                .damaged(format!("More than {MOST_DEPTH} records lie one in the other.")));
        }
        self.open.push(record);
        Ok(())
    }

    fn add(&mut self, record: Record<'a>) {
        match self.open.last_mut() {
            Some(parent) => parent.records.push(record),
            None => self.done.push(record),
        }
    }

    /// Ends the innermost one. Whether there was one.
    fn close(&mut self) -> bool {
        let Some(record) = self.open.pop() else { return false };
        self.add(record);
        true
    }
}
