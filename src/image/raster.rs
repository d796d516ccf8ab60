//! PNG, JPEG, WebP, TGA and BMP.

use std::io::Cursor;

use image::{
    ColorType, DynamicImage, GrayAlphaImage, GrayImage, ImageDecoder, ImageReader, Limits, RgbImage, RgbaImage,
};

use super::MAX_SIDE;
use super::file_kind::FileKind;
use super::format::{Channels, ImageFormat};
use super::picture::{Image, ImageKind, check_size};
use crate::diagnostic::{Fault, codes};
use crate::slices::Slices;

/// Bytes that decoding may take: a picture of 8192 × 8192 with 4 channels of 8 bits as the file has it, and as RGBA.
const MAX_DECODED_LEN: u64 = 512 << 20;

/// A byte of a file holds at most this many texels: deflate expands a byte to at most 1032, and a PNG packs 8 texels into
/// a byte.
const MAX_TEXELS_PER_BYTE: u64 = 8 * 1032;

/// Reads a picture of a kind other than DDS.
pub(super) async fn decode(bytes: &[u8], kind: FileKind, slices: &Slices) -> Result<Image, Fault> {
    let decoder = open(bytes, kind)?;
    let (width, height) = decoder.dimensions();
    let channels = match decoder.color_type() {
        // A TGA says in the low half of its byte 17 how many bits of alpha it has, even where pixels have room for
        // alpha.
        ColorType::Rgba8 if kind == FileKind::Tga && bytes.get(17).is_some_and(|bits| bits & 0xf == 0) => Channels::Rgb,
        ColorType::L8 | ColorType::L16 => Channels::Grey,
        ColorType::La8 | ColorType::La16 => Channels::GreyAlpha,
        ColorType::Rgb8 | ColorType::Rgb16 | ColorType::Rgb32F => Channels::Rgb,
        _ => Channels::Rgba,
    };
    let by_rows = match kind {
        FileKind::Png => png_by_rows(bytes, decoder.total_bytes(), slices).await,
        _ => None,
    };
    slices.pause().await;
    let decoded = match by_rows {
        Some(decoded) => decoded,
        None => DynamicImage::from_decoder(decoder).map_err(|error| undecodable(kind, &error))?,
    };
    let mut data = decoded.into_rgba8().into_raw();
    if !channels.has_alpha() {
        data.iter_mut().skip(3).step_by(4).for_each(|alpha| *alpha = 255);
    }
    Ok(Image {
        width,
        height,
        level_count: 1,
        kind: ImageKind::Texture2d,
        format: ImageFormat::Rgba8,
        channels,
        source: kind.to_string(),
        mips_generated: false,
        data,
    })
}

/// A PNG, row by row: the largest pictures are of that kind. `None` where its rows do not come in order, for kinds that are rare, and for
/// one that is damaged: who decodes it at once learns how.
async fn png_by_rows(bytes: &[u8], decoded_len: u64, slices: &Slices) -> Option<DynamicImage> {
    let mut decoder = png::Decoder::new(Cursor::new(bytes));
    decoder.set_transformations(png::Transformations::EXPAND);
    let mut reader = decoder.read_info().ok()?;
    let (width, height) = reader.info().size();
    if reader.info().interlaced {
        return None;
    }
    let (color_type, png::BitDepth::Eight) = reader.output_color_type() else {
        return None;
    };
    let mut data = Vec::with_capacity(usize::try_from(decoded_len).ok()?);
    while let Some(row) = reader.next_row().ok()? {
        data.extend_from_slice(row.data());
        slices.pause().await;
    }
    match color_type {
        png::ColorType::Grayscale => GrayImage::from_raw(width, height, data).map(Into::into),
        png::ColorType::GrayscaleAlpha => GrayAlphaImage::from_raw(width, height, data).map(Into::into),
        png::ColorType::Rgb => RgbImage::from_raw(width, height, data).map(Into::into),
        png::ColorType::Rgba => RgbaImage::from_raw(width, height, data).map(Into::into),
        png::ColorType::Indexed => None,
    }
}

/// Whether the header and the size of the file allow to decode it.
pub(super) fn check(bytes: &[u8], kind: FileKind) -> Result<(), Fault> {
    open(bytes, kind).map(drop)
}

/// Reads the header and checks it, its size and the end of the file. The texels may still be damaged.
fn open(bytes: &[u8], kind: FileKind) -> Result<impl ImageDecoder + '_, Fault> {
    let undecodable = |error: image::ImageError| undecodable(kind, &error);
    // The decoder would fill the rest of a truncated picture with grey.
    if kind == FileKind::Jpeg && memchr::memmem::rfind(bytes, b"\xff\xd9").is_none() {
        let message = "the JPEG file has no end marker: its last part is missing";
        return Err(codes::IMAGE_CUT.says(message).into());
    }
    let mut limits = Limits::default();
    limits.max_image_width = Some(MAX_SIDE);
    limits.max_image_height = Some(MAX_SIDE);
    limits.max_alloc = Some(MAX_DECODED_LEN);
    let mut reader = ImageReader::with_format(Cursor::new(bytes), format_of(kind));
    reader.limits(limits.clone());
    let mut decoder = reader.into_decoder().map_err(undecodable)?;

    let (width, height) = decoder.dimensions();
    check_size(width, height)?;
    let texel_count = u64::from(width) * u64::from(height);
    if texel_count > MAX_TEXELS_PER_BYTE * bytes.len() as u64 {
        let message = format!(
            "the header says {width} × {height}, which cannot fit into the {} bytes of the file",
            bytes.len()
        );
        return Err(codes::IMAGE_IMPLAUSIBLE.says(message).into());
    }
    // The texels as the file has them, and the same as RGBA.
    let decoded_len = decoder.total_bytes();
    let rgba8_len = 4 * texel_count;
    limits
        .clone()
        .reserve(decoded_len.saturating_add(rgba8_len))
        .map_err(undecodable)?;
    limits.reserve(decoded_len).map_err(undecodable)?;
    decoder.set_limits(limits).map_err(undecodable)?;
    Ok(decoder)
}

fn undecodable(kind: FileKind, reason: &image::ImageError) -> Fault {
    let message = format!("the {kind} file could not be read: {reason}");
    codes::IMAGE_UNDECODABLE.says(message).into()
}

fn format_of(kind: FileKind) -> image::ImageFormat {
    match kind {
        FileKind::Dds => image::ImageFormat::Dds,
        FileKind::Png => image::ImageFormat::Png,
        FileKind::Jpeg => image::ImageFormat::Jpeg,
        FileKind::WebP => image::ImageFormat::WebP,
        FileKind::Tga => image::ImageFormat::Tga,
        FileKind::Bmp => image::ImageFormat::Bmp,
        FileKind::Radiance => image::ImageFormat::Hdr,
    }
}
