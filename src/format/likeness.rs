//! What a file is, by its beginning: whether it may be a model, and what it is instead, so that the message can say so.

use super::cursor::is_space;
use super::label::{Section, is_ruler, same, whole};
use super::text_model;
use crate::diagnostic::{Diagnostic, codes};

/// What a file is instead.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Stranger {
    /// Another format, by name with its article: `a PNG image`.
    Other(&'static str),
    /// bzt's "Model 3D", which has the same extension: `a binary` or `an ASCII`.
    Model3d(&'static str),
    /// A variant of this format that the books' loaders do not read either, by what gave it away.
    Relative(&'static str),
    /// Text in two or four bytes a character: `UTF-16` or `UTF-32`.
    Text(&'static str),
    /// Bytes that are no text.
    Binary,
}

impl Stranger {
    /// The same as what stops the reading.
    pub(super) fn diagnostic(self) -> Diagnostic {
        let (code, name, message) = match self {
            Self::Other(name) => (
                &codes::OTHER_FORMAT,
                name.into(),
                format!("This is {name}, not an .m3d file."),
            ),
            Self::Model3d(kind) => (
                &codes::OTHER_FORMAT,
                format!("{kind} Model 3D file"),
                format!("This is {kind} \"Model 3D\" file by bzt. It has a similar name, but is another format."),
            ),
            Self::Relative(mark) => (
                &codes::RELATIVE_FORMAT,
                mark.into(),
                format!("This file is a relative of the .m3d format with {mark}, which cannot be read."),
            ),
            Self::Text(encoding) => (
                &codes::OTHER_FORMAT,
                format!("{encoding} text"),
                format!("This file is {encoding} text. Save it as UTF-8 or ASCII."),
            ),
            Self::Binary => (
                &codes::OTHER_FORMAT,
                "binary data".into(),
                "This file is binary data: no .m3d file, which is text, and no .glb file, which begins with the letters glTF."
                    .into(),
            ),
        };
        code.says(message).expected("an m3d file header").found(name)
    }
}

/// First bytes of formats that are dropped by mistake.
const SIGNATURES: &[(&[u8], Stranger)] = &[
    (b"3DMO", Stranger::Model3d("a binary")),
    (b"\x89PNG", Stranger::Other("a PNG image")),
    (b"\xFF\xD8\xFF", Stranger::Other("a JPEG image")),
    (b"GIF8", Stranger::Other("a GIF image")),
    (b"DDS ", Stranger::Other("a DDS texture")),
    (b"\xABKTX", Stranger::Other("a KTX texture")),
    (b"8BPS", Stranger::Other("a Photoshop image")),
    (b"glTF", Stranger::Other("a binary glTF model (GLB)")),
    (b"BLENDER", Stranger::Other("a Blender file")),
    (
        b"\x28\xB5\x2F\xFD",
        Stranger::Other("a Zstandard archive or a Blender file"),
    ),
    (b"xof 0", Stranger::Other("a DirectX .x model")),
    (b"ply\n", Stranger::Other("a PLY model")),
    (b"ply\r\n", Stranger::Other("a PLY model")),
    (b"solid ", Stranger::Other("an STL model")),
    (b"INTERQUAKEMODEL", Stranger::Other("an IQM model")),
    (b"MD5Version", Stranger::Other("an MD5 model")),
    (b"MS3D000000", Stranger::Other("a MilkShape model")),
    (
        b"PK\x03\x04",
        Stranger::Other("a ZIP archive (unpack it, and open what is in it)"),
    ),
    (b"\x1F\x8B", Stranger::Other("a gzip archive")),
    (b"7z\xBC\xAF", Stranger::Other("a 7-Zip archive")),
    (b"Rar!", Stranger::Other("a RAR archive")),
    (b"%PDF", Stranger::Other("a PDF document")),
    (b"RIFF", Stranger::Other("a RIFF file (sound, video or WebP)")),
    (b"\0asm", Stranger::Other("a WebAssembly module")),
    (b"MZ", Stranger::Other("a Windows program")),
    (b"\x7FELF", Stranger::Other("a program")),
    (
        b"version https://git-lfs",
        Stranger::Other("a Git LFS pointer (the file itself was not downloaded)"),
    ),
    // Before the mark of UTF-16, which it begins with.
    (b"\xFF\xFE\0\0", Stranger::Text("UTF-32")),
    (b"\0\0\xFE\xFF", Stranger::Text("UTF-32")),
    (b"\xFF\xFE", Stranger::Text("UTF-16")),
    (b"\xFE\xFF", Stranger::Text("UTF-16")),
];

/// Beginnings of texts, compared behind blanks and without case.
const TEXT_SIGNATURES: &[(&[u8], Stranger)] = &[
    (b"3dmodel ", Stranger::Model3d("an ASCII")),
    (b"<!doctype html", Stranger::Other("a web page (HTML)")),
    (b"<html", Stranger::Other("a web page (HTML)")),
    (b"<svg", Stranger::Other("an SVG image")),
    (b"mtllib ", Stranger::Other("a Wavefront OBJ model")),
    (b"newmtl ", Stranger::Other("a Wavefront material library")),
];

/// What the file is, when that can be told from its beginning and it is not this format.
pub(super) fn recognise(bytes: &[u8]) -> Option<Stranger> {
    /// Enough for every signature and for a guess at binary data.
    const HEAD: usize = 1024;
    if let Some((_, stranger)) = SIGNATURES.iter().find(|(signature, _)| bytes.starts_with(signature)) {
        return Some(*stranger);
    }
    let bytes = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    let start = bytes.iter().position(|&byte| !is_space(byte)).unwrap_or(bytes.len());
    let text = bytes.get(start..).unwrap_or_default();
    let head = text.get(..HEAD).unwrap_or(text);
    let begins = |signature: &[u8]| {
        head.get(..signature.len())
            .is_some_and(|beginning| beginning.eq_ignore_ascii_case(signature))
    };
    if let Some((_, stranger)) = TEXT_SIGNATURES.iter().find(|(signature, _)| begins(signature)) {
        return Some(*stranger);
    }
    let contains = |word: &[u8]| memchr::memmem::find(head, word).is_some();
    match head.first() {
        Some(b'<') if contains(b"<COLLADA") => Some(Stranger::Other("a COLLADA model")),
        Some(b'<') if contains(b"<html") => Some(Stranger::Other("a web page (HTML)")),
        Some(b'<') if contains(b"<svg") => Some(Stranger::Other("an SVG image")),
        Some(b'<') => Some(Stranger::Other("an XML file")),
        Some(b'{') if contains(b"\"asset\"") || contains(b"\"accessors\"") => Some(Stranger::Other("a glTF model")),
        Some(b'{') => Some(Stranger::Other("a JSON file")),
        _ if head.contains(&0) => Some(Stranger::Binary),
        _ => None,
    }
}

/// Whether a file begins as one of another format does, so that [`parse`](super::parse) refuses it whatever follows. A look at its first
/// kilobyte, blanks before it aside.
pub fn begins_like_another(bytes: &[u8]) -> bool {
    recognise(bytes).is_some()
}

/// Bytes in which a model has begun if it ever does: room for a page of blank lines or comment above its header.
const BEGINNING_LEN: usize = 4096;

/// Whether a file begins as a model does: its first lines have the ruler of the header, or a count of materials; or the first one
/// counts the vertices of a text model.
///
/// A quick look for files of any name and content. What it accepts [`parse`](super::parse) may still refuse.
pub fn begins_like_model(bytes: &[u8]) -> bool {
    let beginning = &bytes[..bytes.len().min(BEGINNING_LEN)];
    let mut lines = beginning.split(|byte| matches!(byte, b'\n' | b'\r'));
    text_model::is_first_line(without_mark(beginning).trim_ascii_start())
        || lines.any(|line| is_header_ruler(line) || is_material_count(line))
}

fn is_header_ruler(line: &[u8]) -> bool {
    let ruler = without_mark(line).trim_ascii();
    is_ruler(ruler) && Section::of_ruler(ruler) == Some(Section::Header)
}

/// `#Materials 5`, with the sign apart or a colon. Without its number it is a heading of some other text.
fn is_material_count(line: &[u8]) -> bool {
    let Some(count) = without_mark(line).trim_ascii().strip_prefix(b"#") else {
        return false;
    };
    let digits = count.iter().rev().take_while(|byte| byte.is_ascii_digit()).count();
    let (label, number) = count.split_at(count.len() - digits);
    whole(number).is_some() && same(label, "Materials")
}

/// The line without the byte order mark that only the first one can have.
fn without_mark(line: &[u8]) -> &[u8] {
    line.strip_prefix(b"\xef\xbb\xbf").unwrap_or(line)
}
