//! Texels of every format as RGBA.

use super::format::ImageFormat;
use super::srgb::srgb_from_linear;
use super::{half, rgbe};

/// Texels of a block.
const BLOCK_TEXELS: usize = 16;

/// A level as RGBA, 8 bits a channel. `data` holds the whole level.
pub(super) fn to_rgba8(format: ImageFormat, width: u32, height: u32, data: &[u8]) -> Vec<u8> {
    if format == ImageFormat::Rgba8 {
        return data.to_vec();
    }
    if format.is_float() {
        let texels = to_rgba32f(format, width, height, data);
        let encode = |(index, value): (usize, &f32)| match index % 4 {
            3 => (value.clamp(0.0, 1.0) * 255.0).round() as u8,
            _ => srgb_from_linear(*value),
        };
        return texels.iter().enumerate().map(encode).collect();
    }
    unpack(format, width, height, data, |block| rgba8_block(format, block))
}

/// A level of a float format as RGBA. `data` holds the whole level.
pub(super) fn to_rgba32f(format: ImageFormat, width: u32, height: u32, data: &[u8]) -> Vec<f32> {
    if format == ImageFormat::Rgba16Float {
        let halves = data.as_chunks::<2>().0;
        return halves
            .iter()
            .map(|&half| half::to_f32(u16::from_le_bytes(half)))
            .collect();
    }
    if format == ImageFormat::Rgbe {
        let rgba = |&texel| rgbe::light_of(texel).extend(1.0).to_array();
        return data.as_chunks().0.iter().flat_map(rgba).collect();
    }
    let signed = format == ImageFormat::Bc6hSigned;
    unpack(format, width, height, data, |block| {
        let mut rgb = [0.0; BLOCK_TEXELS * 3];
        bcdec_rs::bc6h_float(block, &mut rgb, 4 * 3, signed);
        spread(&rgb, |[r, g, b]| [r, g, b, 1.0])
    })
}

/// One compressed block of 8-bit values, row by row.
fn rgba8_block(format: ImageFormat, block: &[u8]) -> [[u8; 4]; BLOCK_TEXELS] {
    const ROW: usize = 4 * 4;
    let mut rgba = [0; BLOCK_TEXELS * 4];
    match format {
        ImageFormat::Bc1 => bcdec_rs::bc1(block, &mut rgba, ROW),
        ImageFormat::Bc2 => bcdec_rs::bc2(block, &mut rgba, ROW),
        ImageFormat::Bc3 => bcdec_rs::bc3(block, &mut rgba, ROW),
        ImageFormat::Bc7 => bcdec_rs::bc7(block, &mut rgba, ROW),
        ImageFormat::Bc4 | ImageFormat::Bc4Signed => {
            let signed = format.is_signed_unit();
            let mut grey = [0; BLOCK_TEXELS];
            bcdec_rs::bc4(block, &mut grey, 4, signed);
            return spread(&grey, |[v]| [unit(v, signed), unit(v, signed), unit(v, signed), 255]);
        }
        ImageFormat::Bc5 | ImageFormat::Bc5Signed => {
            let signed = format.is_signed_unit();
            let mut pairs = [0; BLOCK_TEXELS * 2];
            bcdec_rs::bc5(block, &mut pairs, 4 * 2, signed);
            return spread(&pairs, |[r, g]| [unit(r, signed), unit(g, signed), 0, 255]);
        }
        ImageFormat::Rgba8
        | ImageFormat::Rgba16Float
        | ImageFormat::Rgbe
        | ImageFormat::Bc6h
        | ImageFormat::Bc6hSigned => {
            unreachable!("{format:?} has no blocks of 8-bit values")
        }
    }
    spread(&rgba, |texel| texel)
}

/// Maps a decoded byte to 0 … 255; signed bytes are −127 … 127.
fn unit(value: u8, signed: bool) -> u8 {
    if !signed {
        return value;
    }
    let from_zero = i32::from(value.cast_signed()).max(-127) + 127;
    ((from_zero * 255 + 127) / 254) as u8
}

/// Texels of `N` channels each as RGBA.
fn spread<T: Copy + Default, const N: usize>(
    channels: &[T],
    to_rgba: impl Fn([T; N]) -> [T; 4],
) -> [[T; 4]; BLOCK_TEXELS] {
    let mut texels = [[T::default(); 4]; BLOCK_TEXELS];
    for (texel, &channels) in texels.iter_mut().zip(channels.as_chunks::<N>().0) {
        *texel = to_rgba(channels);
    }
    texels
}

/// Puts blocks side by side. Texels beyond the edges are cut off.
fn unpack<T: Copy + Default>(
    format: ImageFormat,
    width: u32,
    height: u32,
    data: &[u8],
    decode: impl Fn(&[u8]) -> [[T; 4]; BLOCK_TEXELS],
) -> Vec<T> {
    let (width, height) = (width as usize, height as usize);
    let mut texels = vec![[T::default(); 4]; width * height];
    let blocks_in_row = width.div_ceil(4);
    let rows_of_blocks = data.chunks_exact(format.block_len() * blocks_in_row);
    for (block_row, rows) in rows_of_blocks.zip(texels.chunks_mut(4 * width)) {
        for (column, block) in block_row.chunks_exact(format.block_len()).enumerate() {
            let decoded = decode(block);
            for (row, decoded_row) in rows.chunks_exact_mut(width).zip(decoded.chunks_exact(4)) {
                let left = column * 4;
                let cut = (width - left).min(4);
                row[left..left + cut].copy_from_slice(&decoded_row[..cut]);
            }
        }
    }
    texels.into_flattened()
}
