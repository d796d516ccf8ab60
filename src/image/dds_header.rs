//! The header of a DDS file, field by field.
//!
//! No crate reads it: the known ones lack `BC5U`, drop the masks of grey files, and do not say where a file is wrong.

use crate::diagnostic::{Fault, codes};

/// Bytes of signature and header.
pub(super) const HEADER_LEN: usize = 4 + 124;

/// Bytes of the header that follows it where the four-character code is `DX10`.
pub(super) const DX10_LEN: usize = 20;

#[derive(Clone, Copy, Debug)]
pub(super) struct Header {
    pub(super) width: u32,
    pub(super) height: u32,
    /// 0 where the writer left it out.
    pub(super) mip_count: u32,
    pub(super) pixels: PixelFormat,
    /// Flags for cubes, their faces and volumes.
    pub(super) caps2: u32,
    pub(super) dx10: Option<Dx10>,
    /// Where the texels begin.
    pub(super) data_start: usize,
}

/// The part that describes pixels.
#[derive(Clone, Copy, Debug)]
pub(super) struct PixelFormat {
    pub(super) flags: u32,
    pub(super) four_cc: u32,
    pub(super) bit_count: u32,
    /// Red, green, blue, alpha.
    pub(super) masks: [u32; 4],
}

impl PixelFormat {
    /// There is a valid alpha mask.
    pub(super) const ALPHA_PIXELS: u32 = 0x1;
    /// Alpha alone.
    pub(super) const ALPHA: u32 = 0x2;
    /// The four-character code says what it is.
    pub(super) const FOUR_CC: u32 = 0x4;
    pub(super) const RGB: u32 = 0x40;
    /// The red mask is that of grey.
    pub(super) const LUMINANCE: u32 = 0x2_0000;
}

/// The header that DirectX 10 added.
#[derive(Clone, Copy, Debug)]
pub(super) struct Dx10 {
    pub(super) dxgi_format: u32,
    /// 2, 3 or 4 for one to three dimensions.
    pub(super) dimension: u32,
    pub(super) misc_flags: u32,
    pub(super) array_size: u32,
    /// 1 straight, 2 premultiplied, 3 opaque; 0 unknown, 4 custom.
    pub(super) alpha_mode: u32,
}

impl Header {
    /// Reads the header at the beginning of a file.
    pub(super) fn read(bytes: &[u8]) -> Result<Self, Fault> {
        if let Some(&signature) = bytes.first_chunk::<4>()
            && signature != *b"DDS "
        {
            let begins = signature.escape_ascii();
            let message = format!("a DDS file begins with \"DDS \", and this one with \"{begins}\"");
            return Err(codes::DDS_SIGNATURE.says(message).into());
        }
        let fields: [u32; 32] = words(bytes, 0)?;
        expect("its size", 124, fields[1])?;
        expect("the size of its pixel format", 32, fields[19])?;
        let [flags, four_cc, bit_count, r, g, b, a] = [20, 21, 22, 23, 24, 25, 26].map(|index: usize| fields[index]);
        let is_dx10 = flags & PixelFormat::FOUR_CC != 0 && four_cc == u32::from_le_bytes(*b"DX10");
        let dx10 = if is_dx10 {
            let [dxgi_format, dimension, misc_flags, array_size, misc_flags2] = words(bytes, HEADER_LEN)?;
            Some(Dx10 {
                dxgi_format,
                dimension,
                misc_flags,
                array_size,
                alpha_mode: misc_flags2 & 7,
            })
        } else {
            None
        };
        Ok(Self {
            height: fields[3],
            width: fields[4],
            mip_count: fields[7],
            pixels: PixelFormat {
                flags,
                four_cc,
                bit_count,
                masks: [r, g, b, a],
            },
            caps2: fields[28],
            dx10,
            data_start: if is_dx10 { HEADER_LEN + DX10_LEN } else { HEADER_LEN },
        })
    }
}

/// Little-endian words from an offset on.
fn words<const N: usize>(bytes: &[u8], offset: usize) -> Result<[u32; N], Fault> {
    let words = bytes
        .get(offset..)
        .and_then(|rest| rest.as_chunks::<4>().0.first_chunk::<N>());
    let words = words.ok_or_else(|| {
        let (needed, found) = (offset + 4 * N, bytes.len());
        let message = format!("the DDS header takes {needed} bytes, and the file has {found}");
        codes::DDS_HEADER_CUT.says(message)
    })?;
    Ok(words.map(u32::from_le_bytes))
}

pub(super) fn expect(field: &str, expected: u32, found: u32) -> Result<(), Fault> {
    if found == expected {
        return Ok(());
    }
    let message = format!("the DDS header gives {field} as {found}; it must be {expected}");
    Err(codes::DDS_HEADER_FIELD.says(message).into())
}
