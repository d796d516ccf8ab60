//! Why a picture could not be read.

use std::fmt;

use crate::diagnostic::{Code, Diagnostic, codes};

use super::format::MAX_SIDE;

/// A picture that could not be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{name}: {kind}")]
pub struct ImageError {
    /// The file, as it was named.
    pub name: String,
    /// What is wrong with it.
    pub kind: ImageErrorKind,
}

impl ImageError {
    /// The row of the table of codes.
    pub fn code(&self) -> &'static Code {
        self.kind.code()
    }

    /// The diagnostic for the panel. A model shows on without a map, so it is a warning.
    pub fn diagnostic(&self) -> Diagnostic {
        self.code().says(self.to_string())
    }
}

/// What is wrong with a picture. Offsets and lengths are in bytes.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ImageErrorKind {
    /// No bytes at all.
    #[error("the file is empty")]
    Empty,
    /// Neither the first bytes nor the name say what it is.
    #[error("this is none of DDS, PNG, JPEG, WebP, TGA and BMP")]
    Unrecognized,
    /// A picture of high range.
    #[error("Radiance (.hdr) and OpenEXR (.exr) cannot be read yet; a cube map as .dds can")]
    HighRange,
    /// Named `.dds`, but it does not begin like one.
    #[error("a DDS file begins with \"DDS \", and this one with \"{}\"", .0.escape_ascii())]
    DdsSignature([u8; 4]),
    /// The file ends within its header.
    #[error("the DDS header takes {needed} bytes, and the file has {found}")]
    DdsHeaderCut {
        /// Bytes that the header takes.
        needed: usize,
        /// Bytes of the file.
        found: usize,
    },
    /// A field of the header that can have one value only has another.
    #[error("the DDS header gives {field} as {found}; it must be {expected}")]
    DdsHeaderField {
        /// What the field means.
        field: &'static str,
        /// What it must be.
        expected: u32,
        /// What it is.
        found: u32,
    },
    /// A four-character code that names no layout that is read.
    #[error("DDS pixels of the kind {} are not supported", four_cc(*.0))]
    DdsFourCc(u32),
    /// A DXGI format number that names no layout that is read.
    #[error("DDS pixels of the DXGI format {0} are not supported")]
    DdsDxgiFormat(u32),
    /// Flags of the pixel format that name no layout that is read: palette, YUV, bump maps, or none at all.
    #[error(
        "DDS pixels with the flags {0:#x} are not supported; there must be a four-character code, colour, grey or alpha"
    )]
    DdsPixelFlags(u32),
    /// A pixel of so many bits.
    #[error("DDS pixels of {0} bits are not supported; there must be 8, 16, 24 or 32")]
    DdsBitCount(u32),
    /// A mask that is empty, has gaps or reaches over the pixel.
    #[error("the mask {mask:#x} for {channel} does not fit a pixel of {bits} bits")]
    DdsMask {
        /// Which channel.
        channel: &'static str,
        /// Its mask.
        mask: u32,
        /// Bits of a pixel.
        bits: u32,
    },
    /// A texture with one or three dimensions.
    #[error("a texture with {0} is not supported, only flat ones and cubes are")]
    Dimension(&'static str),
    /// A cube that lacks faces.
    #[error("a cube has 6 faces, and this one {0}")]
    PartialCube(u32),
    /// A cube whose faces are no squares.
    #[error("the faces of a cube must be square, and these are {width} × {height}")]
    CubeNotSquare {
        /// Texels in a row.
        width: u32,
        /// Rows.
        height: u32,
    },
    /// An array of nothing.
    #[error("the array has no slices")]
    NoSlices,
    /// A side of no texels or too many.
    #[error("a picture of {width} × {height} cannot be shown; a side may have 1 to {MAX_SIDE} texels")]
    Size {
        /// Texels in a row.
        width: u32,
        /// Rows.
        height: u32,
    },
    /// More mips than halvings.
    #[error("the header gives {found} mips, and a picture of {width} × {height} has at most {most}")]
    MipCount {
        /// Mips of the header.
        found: u32,
        /// Mips down to 1 × 1.
        most: u32,
        /// Texels in a row.
        width: u32,
        /// Rows.
        height: u32,
    },
    /// The file ends before its last texel.
    #[error("the file ends {missing} bytes early, in mip {level} ({width} × {height}) of {layer} at byte {offset}")]
    Cut {
        /// Bytes that lack to the end of what the header promises.
        missing: u64,
        /// The first level that is not whole, from 0.
        level: u32,
        /// Texels in a row of that level.
        width: u32,
        /// Rows of that level.
        height: u32,
        /// The face or slice that is not whole.
        layer: Layer,
        /// Where that level begins.
        offset: u64,
    },
    /// A header that promises more than its bytes can hold even when packed as tightly as can be.
    #[error("the header says {width} × {height}, which cannot fit into the {bytes} bytes of the file")]
    Implausible {
        /// Texels in a row.
        width: u32,
        /// Rows.
        height: u32,
        /// Bytes of the file.
        bytes: usize,
    },
    /// Texels whose count is not that of their size.
    #[error("{found} bytes of texels are not the {expected} of {width} × {height}")]
    DataLength {
        /// Texels in a row.
        width: u32,
        /// Rows.
        height: u32,
        /// Bytes that this takes.
        expected: u64,
        /// Bytes that are there.
        found: u64,
    },
    /// A JPEG that stops in the middle.
    #[error("the JPEG file has no end marker: its last part is missing")]
    JpegCut,
    /// PNG, JPEG, WebP, TGA or BMP that its decoder refuses.
    #[error("the {kind} file could not be read: {reason}")]
    Undecodable {
        /// What the file is.
        kind: FileKind,
        /// Words of the decoder.
        reason: String,
    },
}

impl ImageErrorKind {
    /// The row of the table of codes.
    pub fn code(&self) -> &'static Code {
        match self {
            Self::Empty => &codes::IMAGE_EMPTY,
            Self::Unrecognized | Self::HighRange => &codes::IMAGE_UNRECOGNIZED,
            Self::DdsSignature(_) => &codes::DDS_SIGNATURE,
            Self::DdsHeaderCut { .. } => &codes::DDS_HEADER_CUT,
            Self::DdsHeaderField { .. } => &codes::DDS_HEADER_FIELD,
            Self::DdsFourCc(_) | Self::DdsDxgiFormat(_) | Self::DdsPixelFlags(_) | Self::DdsBitCount(_) => {
                &codes::DDS_UNSUPPORTED
            }
            Self::DdsMask { .. } => &codes::DDS_MASK,
            Self::Dimension(_) => &codes::IMAGE_DIMENSION,
            Self::PartialCube(_) | Self::CubeNotSquare { .. } => &codes::IMAGE_CUBE,
            Self::NoSlices => &codes::IMAGE_NO_SLICES,
            Self::Size { .. } => &codes::IMAGE_SIZE,
            Self::MipCount { .. } => &codes::IMAGE_MIP_COUNT,
            Self::Cut { .. } | Self::JpegCut => &codes::IMAGE_CUT,
            Self::Implausible { .. } => &codes::IMAGE_IMPLAUSIBLE,
            Self::DataLength { .. } => &codes::IMAGE_DATA_LENGTH,
            Self::Undecodable { .. } => &codes::IMAGE_UNDECODABLE,
        }
    }
}

/// A part of a texture that is a flat picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layer {
    /// The only one.
    Only,
    /// A face of a cube: +x, −x, +y, −y, +z, −z.
    Face(u32),
    /// A slice of an array, from 0; of an array of cubes, a face.
    Slice(u32),
}

impl fmt::Display for Layer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        const FACES: [&str; 6] = ["+x", "-x", "+y", "-y", "+z", "-z"];
        match *self {
            Self::Only => f.write_str("the picture"),
            Self::Face(face) => match FACES.get(face as usize) {
                Some(name) => write!(f, "face {name}"),
                None => write!(f, "face {face}"),
            },
            Self::Slice(slice) => write!(f, "slice {slice}"),
        }
    }
}

/// Kinds of files that are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileKind {
    /// DirectDraw surface.
    Dds,
    /// Portable network graphics.
    Png,
    /// JPEG.
    Jpeg,
    /// WebP.
    WebP,
    /// Truevision.
    Tga,
    /// Windows bitmap.
    Bmp,
}

impl FileKind {
    /// What the first bytes say, and where they say nothing, the extension of the name.
    pub(super) fn of(bytes: &[u8], name: &str) -> Option<Self> {
        const SIGNATURES: [(&[u8], FileKind); 4] = [
            (b"DDS ", FileKind::Dds),
            (b"\x89PNG\r\n\x1a\n", FileKind::Png),
            (b"\xff\xd8\xff", FileKind::Jpeg),
            (b"BM", FileKind::Bmp),
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
        })
    }
}

/// The letters of a four-character code, or its number where it is one.
fn four_cc(code: u32) -> String {
    let letters = code.to_le_bytes();
    if letters.iter().all(u8::is_ascii_graphic) {
        letters.escape_ascii().to_string()
    } else {
        code.to_string()
    }
}
