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
mod document;
mod place;
mod text;

pub use array::{Array, Budget};
pub use document::{Document, Record, Value};
pub use place::Place;

use crate::diagnostic::Fault;
use crate::slices::{Slices, at_once};

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
