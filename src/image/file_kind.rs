//! What kind of picture a file is.

use std::fmt;

/// Kinds of files that are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum FileKind {
    Dds,
    Png,
    Jpeg,
    WebP,
    Tga,
    Bmp,
    Radiance,
}

impl FileKind {
    /// What the first bytes say, and where they say nothing, the extension of the name.
    pub(super) fn of(bytes: &[u8], name: &str) -> Option<Self> {
        const SIGNATURES: [(&[u8], FileKind); 6] = [
            (b"DDS ", FileKind::Dds),
            (b"\x89PNG\r\n\x1a\n", FileKind::Png),
            (b"\xff\xd8\xff", FileKind::Jpeg),
            (b"BM", FileKind::Bmp),
            (b"#?RADIANCE", FileKind::Radiance),
            (b"#?RGBE", FileKind::Radiance),
        ];
        let signed = SIGNATURES.iter().find(|(signature, _)| bytes.starts_with(signature));
        if let Some((_, kind)) = signed {
            return Some(*kind);
        }
        if bytes.starts_with(b"RIFF") && bytes.get(8..12) == Some(b"WEBP") {
            return Some(Self::WebP);
        }
        let extension = name
            .rsplit_once('.')
            .map(|(_, extension)| extension.to_ascii_lowercase());
        match extension.as_deref() {
            _ if bytes.is_empty() => None,
            Some("dds") => Some(Self::Dds),
            Some("tga") => Some(Self::Tga),
            _ => None,
        }
    }
}

impl fmt::Display for FileKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Dds => "DDS",
            Self::Png => "PNG",
            Self::Jpeg => "JPEG",
            Self::WebP => "WebP",
            Self::Tga => "TGA",
            Self::Bmp => "BMP",
            Self::Radiance => "Radiance",
        })
    }
}
