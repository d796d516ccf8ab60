//! The layout of a DDS file's texels, from the three ways in which a header can give it.

use super::dds_header::{Dx10, Header, PixelFormat};
use super::format::{Channels, ImageFormat};
use super::masks::Masks;
use crate::diagnostic::{Fault, codes};

/// How the file stores texels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Texels {
    /// As an [`Image`](super::Image) does.
    Verbatim(ImageFormat),
    /// By masks; they become RGBA of 8 bits.
    Masked(Masks),
}

impl Texels {
    /// Bytes of a level.
    pub(super) fn level_len(self, width: u32, height: u32) -> u64 {
        match self {
            Self::Verbatim(format) => format.level_len(width, height),
            Self::Masked(masks) => u64::from(width) * u64::from(height) * masks.pixel_len() as u64,
        }
    }
}

/// What the texels are.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Layout {
    pub(super) texels: Texels,
    pub(super) channels: Channels,
    /// Colour is already multiplied with alpha.
    pub(super) premultiplied: bool,
    pub(super) label: String,
}

impl Layout {
    pub(super) fn of(header: &Header) -> Result<Self, Fault> {
        let pixels = &header.pixels;
        if let Some(dx10) = &header.dx10 {
            Self::of_dxgi(dx10)
        } else if pixels.flags & PixelFormat::FOUR_CC != 0 {
            Self::of_four_cc(pixels.four_cc)
        } else {
            Self::of_masks(pixels)
        }
    }

    fn of_four_cc(code: u32) -> Result<Self, Fault> {
        /// Half floats have a number of Direct3D 9 instead of letters.
        const A16B16G16R16F: u32 = 113;
        if code == A16B16G16R16F {
            return Ok(Self::verbatim(ImageFormat::Rgba16Float));
        }
        let format = match &code.to_le_bytes() {
            b"DXT1" => ImageFormat::Bc1,
            b"DXT2" | b"DXT3" => ImageFormat::Bc2,
            b"DXT4" | b"DXT5" => ImageFormat::Bc3,
            b"ATI1" | b"BC4U" => ImageFormat::Bc4,
            b"BC4S" => ImageFormat::Bc4Signed,
            b"ATI2" | b"BC5U" => ImageFormat::Bc5,
            b"BC5S" => ImageFormat::Bc5Signed,
            _ => return Err(unsupported(&format!("of the kind {}", four_cc(code)))),
        };
        let premultiplied = matches!(&code.to_le_bytes(), b"DXT2" | b"DXT4");
        Ok(Self {
            premultiplied,
            ..Self::verbatim(format)
        })
    }

    /// Formats without a type count as unsigned; sRGB formats are treated like linear ones, since the slot that uses a
    /// map decides how its colours are meant.
    fn of_dxgi(dx10: &Dx10) -> Result<Self, Fault> {
        const R: u32 = 0xff;
        const G: u32 = 0xff00;
        const B: u32 = 0xff_0000;
        const A: u32 = 0xff00_0000;
        let masks = |bits, r, g, b, a| Masks::rgba(bits, [r, g, b, a]).map(Self::masked);
        let layout = match dx10.dxgi_format {
            10 => Self::verbatim(ImageFormat::Rgba16Float),
            24 => masks(32, 0x3ff, 0xf_fc00, 0x3ff0_0000, 0xc000_0000)?,
            27..=29 => masks(32, R, G, B, A)?,
            48 | 49 => masks(16, R, G, 0, 0)?,
            60 | 61 => masks(8, R, 0, 0, 0)?,
            65 => masks(8, 0, 0, 0, R)?,
            70..=72 => Self::verbatim(ImageFormat::Bc1),
            73..=75 => Self::verbatim(ImageFormat::Bc2),
            76..=78 => Self::verbatim(ImageFormat::Bc3),
            79 | 80 => Self::verbatim(ImageFormat::Bc4),
            81 => Self::verbatim(ImageFormat::Bc4Signed),
            82 | 83 => Self::verbatim(ImageFormat::Bc5),
            84 => Self::verbatim(ImageFormat::Bc5Signed),
            85 => masks(16, 0xf800, 0x7e0, 0x1f, 0)?,
            86 => masks(16, 0x7c00, 0x3e0, 0x1f, 0x8000)?,
            87 | 90 | 91 => masks(32, B, G, R, A)?,
            88 | 92 | 93 => masks(32, B, G, R, 0)?,
            94 | 95 => Self::verbatim(ImageFormat::Bc6h),
            96 => Self::verbatim(ImageFormat::Bc6hSigned),
            97..=99 => Self::verbatim(ImageFormat::Bc7),
            115 => masks(16, 0xf00, 0xf0, 0xf, 0xf000)?,
            other => return Err(unsupported(&format!("of the DXGI format {other}"))),
        };
        let channels = match (dx10.alpha_mode, layout.channels) {
            (3, Channels::Rgba) => Channels::Rgb,
            (_, channels) => channels,
        };
        Ok(Self {
            channels,
            premultiplied: dx10.alpha_mode == 2,
            ..layout
        })
    }

    /// Masks without their flag are ignored.
    fn of_masks(pixels: &PixelFormat) -> Result<Self, Fault> {
        let [r, g, b, a] = pixels.masks;
        let a = if pixels.flags & (PixelFormat::ALPHA_PIXELS | PixelFormat::ALPHA) != 0 {
            a
        } else {
            0
        };
        let masks = if pixels.flags & PixelFormat::RGB != 0 {
            [r, g, b, a]
        } else if pixels.flags & PixelFormat::LUMINANCE != 0 {
            [r, 0, 0, a]
        } else if pixels.flags & PixelFormat::ALPHA != 0 {
            [0, 0, 0, a]
        } else {
            let message = format!(
                "DDS pixels with the flags {:#x} are not supported; there must be a four-character code, colour, grey or alpha",
                pixels.flags
            );
            return Err(codes::DDS_UNSUPPORTED.says(message).into());
        };
        Masks::rgba(pixels.bit_count, masks).map(Self::masked)
    }

    fn masked(masks: Masks) -> Self {
        Self {
            texels: Texels::Masked(masks),
            channels: masks.channels(),
            premultiplied: false,
            label: masks.label(),
        }
    }

    fn verbatim(format: ImageFormat) -> Self {
        let (label, channels) = match format {
            ImageFormat::Rgba8 => ("R8G8B8A8", Channels::Rgba),
            ImageFormat::Rgba16Float => ("RGBA16F", Channels::Rgba),
            ImageFormat::Rgbe => ("RGBE", Channels::Rgb),
            ImageFormat::Bc1 => ("BC1", Channels::Rgba),
            ImageFormat::Bc2 => ("BC2", Channels::Rgba),
            ImageFormat::Bc3 => ("BC3", Channels::Rgba),
            ImageFormat::Bc4 => ("BC4", Channels::Grey),
            ImageFormat::Bc4Signed => ("BC4 signed", Channels::Grey),
            ImageFormat::Bc5 => ("BC5", Channels::RedGreen),
            ImageFormat::Bc5Signed => ("BC5 signed", Channels::RedGreen),
            ImageFormat::Bc6h => ("BC6H", Channels::Rgb),
            ImageFormat::Bc6hSigned => ("BC6H signed", Channels::Rgb),
            ImageFormat::Bc7 => ("BC7", Channels::Rgba),
        };
        Self {
            texels: Texels::Verbatim(format),
            channels,
            premultiplied: false,
            label: label.to_owned(),
        }
    }
}

fn unsupported(which: &str) -> Fault {
    codes::DDS_UNSUPPORTED
        .says(format!("DDS pixels {which} are not supported"))
        .into()
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
