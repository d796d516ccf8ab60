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

/// The bytes of a DDS file with all levels of a flat picture: 32 bits a texel, red first, as every program of DirectX 9 and later reads.
pub fn encode_dds(image: &Image) -> Vec<u8> {
    const CAPS_HEIGHT_WIDTH_PITCH_FORMAT_LEVELS: u32 = 0x2_100f;
    const RGB_WITH_ALPHA: u32 = 0x41;
    const COMPLEX_TEXTURE_MIPMAP: u32 = 0x40_1008;
    let (width, height, levels) = (image.width(), image.height(), image.level_count());
    let mut header = [0_u32; 32];
    header[0] = u32::from_le_bytes(*b"DDS ");
    header[1] = 124;
    header[2] = CAPS_HEIGHT_WIDTH_PITCH_FORMAT_LEVELS;
    header[3] = height;
    header[4] = width;
    header[5] = width * 4;
    header[7] = levels;
    header[19] = 32;
    header[20] = RGB_WITH_ALPHA;
    header[22] = 32;
    header[23] = 0x0000_00ff;
    header[24] = 0x0000_ff00;
    header[25] = 0x00ff_0000;
    header[26] = 0xff00_0000;
    header[27] = COMPLEX_TEXTURE_MIPMAP;
    let mut bytes: Vec<u8> = header.into_iter().flat_map(u32::to_le_bytes).collect();
    for level in 0..levels {
        bytes.extend(image.to_rgba8(0, level).unwrap_or_default());
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_png_reads_back_to_its_pixels() -> Result<(), Box<dyn std::error::Error>> {
        let pixels = [255, 0, 0, 255, 0, 255, 0, 128];
        let png = encode_png(&pixels, 2, 1)?;
        let read = image::load_from_memory_with_format(&png, image::ImageFormat::Png)?.into_rgba8();
        assert_eq!(
            (read.dimensions(), read.into_raw().as_slice()),
            ((2, 1), pixels.as_slice())
        );
        Ok(())
    }

    #[test]
    fn a_dds_reads_back_to_its_texels_at_all_levels() -> Result<(), Box<dyn std::error::Error>> {
        let texels: Vec<u8> = (0..4 * 6 * 5).map(|byte| byte as u8 * 2).collect();
        let written = Image::from_rgba8(6, 5, texels, "made")?.with_mips(crate::image::MapKind::Data);
        let read = crate::image::decode(&encode_dds(&written), "made.dds")?;
        assert_eq!((read.width(), read.height(), read.level_count()), (6, 5, 3));
        assert!((0..3).all(|level| read.to_rgba8(0, level) == written.to_rgba8(0, level)));
        Ok(())
    }

    #[test]
    fn a_wrong_size_is_an_error() {
        assert!(encode_png(&[0; 7], 2, 1).is_err());
    }
}
