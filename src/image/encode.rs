//! Pictures as files.

use std::io::Cursor;

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
    fn a_wrong_size_is_an_error() {
        assert!(encode_png(&[0; 7], 2, 1).is_err());
    }
}
