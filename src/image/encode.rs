//! Pictures as files.

use std::io::Cursor;

use super::Image;

/// A picture could not be written.
#[derive(Debug, thiserror::Error)]
#[error("the picture could not be written as PNG: {0}")]
pub struct EncodeError(#[from] image::ImageError);

/// The bytes of a PNG file.
///
/// `pixels` are RGBA, 8 bits a channel, sRGB, straight alpha, rows from the top without padding.
///
/// # Errors
/// When `pixels` is not `4 × width × height` long.
pub fn encode_png(pixels: &[u8], width: u32, height: u32) -> Result<Vec<u8>, EncodeError> {
    let mut bytes = Cursor::new(Vec::new());
    let encoder = image::codecs::png::PngEncoder::new(&mut bytes);
    let expected = u64::from(width) * u64::from(height) * 4;
    if pixels.len() as u64 != expected {
        let mismatch = image::error::ParameterError::from_kind(image::error::ParameterErrorKind::DimensionMismatch);
        return Err(EncodeError(image::ImageError::Parameter(mismatch)));
    }
    image::ImageEncoder::write_image(encoder, pixels, width, height, image::ExtendedColorType::Rgba8)?;
    Ok(bytes.into_inner())
}

/// The bytes of a DDS file with all levels of a flat picture, of its first face otherwise: blue, green, red and alpha, 8 bits each, in
/// the header that the books' loaders know. Levels that the picture lacks are not made: see [`Image::with_mips`].
pub fn encode_dds(image: &Image) -> Vec<u8> {
    const HEADER_SIZE: u32 = 124;
    const PIXEL_FORMAT_SIZE: u32 = 32;
    // Caps, height, width, pitch, pixel format; and the count of mips.
    const FLAGS: u32 = 0x100f | 0x2_0000;
    const RGB_WITH_ALPHA: u32 = 0x41;
    const TEXTURE: u32 = 0x1000;
    const COMPLEX_WITH_MIPS: u32 = 0x40_0008;
    let levels = image.level_count();
    let mut header = [0_u32; 32];
    header[0] = u32::from_le_bytes(*b"DDS ");
    header[1] = HEADER_SIZE;
    header[2] = FLAGS;
    header[3] = image.height();
    header[4] = image.width();
    header[5] = 4 * image.width();
    header[7] = levels;
    header[19] = PIXEL_FORMAT_SIZE;
    header[20] = RGB_WITH_ALPHA;
    header[22] = 32;
    header[23..27].copy_from_slice(&[0x00ff_0000, 0x0000_ff00, 0x0000_00ff, 0xff00_0000]);
    header[27] = if levels > 1 {
        TEXTURE | COMPLEX_WITH_MIPS
    } else {
        TEXTURE
    };
    let mut bytes: Vec<u8> = header.into_iter().flat_map(u32::to_le_bytes).collect();
    for level in 0..levels {
        let mut texels = image.to_rgba8(0, level).unwrap_or_default();
        texels.chunks_exact_mut(4).for_each(|texel| texel.swap(0, 2));
        bytes.extend_from_slice(&texels);
    }
    bytes
}
