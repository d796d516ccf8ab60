//! Whether a file is worth reading as a model at all, when its name does not say so.

use super::label::{Section, is_ruler, same, whole};

/// Bytes in which a model has begun if it ever does: room for a page of blank lines or comment above its header.
const BEGINNING_LEN: usize = 4096;

/// Whether a file begins as a model does: its first lines have the ruler of the header, or a count of materials.
///
/// A quick look for files of any name and content. What it accepts [`parse`](super::parse) may still refuse.
pub fn begins_like_model(bytes: &[u8]) -> bool {
    let beginning = &bytes[..bytes.len().min(BEGINNING_LEN)];
    let mut lines = beginning.split(|byte| matches!(byte, b'\n' | b'\r'));
    lines.any(|line| is_header_ruler(line) || is_material_count(line))
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn beginnings_of_models_are_known_however_they_are_spelt() {
        for text in [
            "***************m3d-File-Header***************\n#Materials 1\n",
            "\u{feff}***************m3d-File-Header***************\r\n",
            "\n\n  --- M3D_FILE_HEADER ---\n",
            "#Materials 5\n#Vertices 3\n",
            "\t# materials: 5\r#Vertices 3\r",
        ] {
            assert!(begins_like_model(text.as_bytes()), "{text:?}");
        }
    }

    #[test]
    fn other_texts_and_bytes_do_not_begin_like_one() {
        let late = format!("{}\n#Materials 1\n", " ".repeat(BEGINNING_LEN));
        for text in [
            "",
            "Textures by somebody. Free to use.\n",
            "# Materials\n\nAll of them are PBR.\n",
            "---\ntitle: a page\n---\n",
            "8BPS\0\u{1}\0\0",
            &late,
        ] {
            assert!(!begins_like_model(text.as_bytes()), "{text:?}");
        }
    }
}
