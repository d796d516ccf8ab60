//! Reads DDS files to an [`Image`], once their length was checked against the header.

use super::dds_header::{Header, expect};
use super::dds_layout::{Layout, Texels};
use super::format::{Channels, ImageFormat};
use super::picture::{Image, ImageKind, check_size, full_level_count, level_size};
use crate::diagnostic::{Fault, codes};

const CAPS2_CUBE: u32 = 0x200;
const CAPS2_FACES: u32 = 0xfc00;
const CAPS2_VOLUME: u32 = 0x20_0000;

/// `D3D10_RESOURCE_DIMENSION_TEXTURE2D`
const DIMENSION_2D: u32 = 3;
const DIMENSION_3D: u32 = 4;
const MISC_CUBE: u32 = 0x4;

const FACES: [&str; 6] = ["+x", "-x", "+y", "-y", "+z", "-z"];

/// Reads a DDS file. Bytes after the last texel are ignored.
pub(super) fn decode(bytes: &[u8]) -> Result<Image, Fault> {
    let (extent, layout, shown) = open(bytes)?;
    let Extent {
        width,
        height,
        level_count,
        kind,
        ..
    } = extent;
    let (format, data) = match layout.texels {
        Texels::Verbatim(format) => (format, shown.to_vec()),
        Texels::Masked(masks) => (ImageFormat::Rgba8, masks.to_rgba8(shown)),
    };
    let mut image = Image {
        width,
        height,
        level_count,
        kind,
        format,
        channels: layout.channels,
        source: layout.label,
        mips_generated: false,
        data,
    };
    if format == ImageFormat::Bc1 && !has_holes(&image) {
        image.channels = Channels::Rgb;
    }
    let premultiplied = layout.premultiplied && image.has_alpha() && !format.is_float();
    Ok(if premultiplied {
        with_straight_alpha(image)
    } else {
        image
    })
}

/// Whether [`decode`] would accept the file; decodes nothing.
pub(super) fn check(bytes: &[u8]) -> Result<(), Fault> {
    open(bytes).map(drop)
}

/// The content of a valid file, and the texels that are shown.
fn open(bytes: &[u8]) -> Result<(Extent, Layout, &[u8]), Fault> {
    let header = Header::read(bytes)?;
    let (width, height) = (header.width, header.height);
    check_size(width, height)?;
    let (kind, layer_count) = kind(&header)?;
    if kind == ImageKind::Cube && width != height {
        let message = format!("the faces of a cube must be square, and these are {width} × {height}");
        return Err(codes::IMAGE_CUBE.says(message).into());
    }
    let level_count = level_count(&header)?;
    let layout = Layout::of(&header)?;
    let extent = Extent {
        texels: layout.texels,
        width,
        height,
        level_count,
        kind,
        layer_count,
    };
    let shown = extent.shown_texels(bytes, header.data_start)?;
    Ok((extent, layout, shown))
}

/// Texels a side of a cube map, by the header alone; the rest of the file may be damaged.
pub(super) fn cube_side(bytes: &[u8]) -> Option<u32> {
    let header = Header::read(bytes).ok()?;
    let is_cube = match &header.dx10 {
        Some(dx10) => dx10.misc_flags & MISC_CUBE != 0,
        None => header.caps2 & CAPS2_CUBE != 0,
    };
    is_cube.then_some(header.width)
}

/// Levels of each face. Some writers leave the count at 0 when there are no mips.
fn level_count(header: &Header) -> Result<u32, Fault> {
    let (width, height) = (header.width, header.height);
    let most = full_level_count(width, height);
    let found = header.mip_count.max(1);
    if found <= most {
        return Ok(found);
    }
    let message = format!("the header gives {found} mips, and a picture of {width} × {height} has at most {most}");
    Err(codes::IMAGE_MIP_COUNT.says(message).into())
}

/// What the header says about the length of the file. Neither side is 0.
struct Extent {
    texels: Texels,
    width: u32,
    height: u32,
    level_count: u32,
    kind: ImageKind,
    /// Faces and slices, those that are not shown included.
    layer_count: u64,
}

impl Extent {
    /// The texels of the layers that are shown, once it is checked that the file holds all layers.
    fn shown_texels<'a>(&self, bytes: &'a [u8], data_start: usize) -> Result<&'a [u8], Fault> {
        let shown_layers = if self.kind == ImageKind::Cube { 6 } else { 1 };
        let texels = bytes.get(data_start..).unwrap_or_default();
        let found = texels.len() as u64;
        let layer_len: u64 = (0..self.level_count).map(|level| self.level_len(level)).sum();
        let needed = layer_len.saturating_mul(self.layer_count);
        if found >= needed {
            return Ok(&texels[..(layer_len * shown_layers) as usize]);
        }
        let layer = found / layer_len;
        let mut offset = layer * layer_len;
        let mut level = 0;
        while offset + self.level_len(level) <= found {
            offset += self.level_len(level);
            level += 1;
        }
        let (width, height) = level_size(self.width, self.height, level);
        let layer = match self.kind {
            ImageKind::Texture2d => "the picture".into(),
            ImageKind::Cube if layer < 6 => format!("face {}", FACES[layer as usize]),
            ImageKind::Cube | ImageKind::Array { .. } => format!("slice {layer}"),
        };
        let (missing, offset) = (needed - found, data_start as u64 + offset);
        let message = format!(
            "the file ends {missing} bytes early, in mip {level} ({width} × {height}) of {layer} at byte {offset}"
        );
        Err(codes::IMAGE_CUT.says(message).into())
    }

    fn level_len(&self, level: u32) -> u64 {
        let (width, height) = level_size(self.width, self.height, level);
        self.texels.level_len(width, height)
    }
}

/// What the texture is and how many flat pictures its file holds.
fn kind(header: &Header) -> Result<(ImageKind, u64), Fault> {
    if let Some(dx10) = &header.dx10 {
        match dx10.dimension {
            DIMENSION_3D => return Err(not_flat("three dimensions")),
            2 => return Err(not_flat("one dimension")),
            found => expect("its dimension", DIMENSION_2D, found)?,
        }
        return match (dx10.misc_flags & MISC_CUBE != 0, dx10.array_size) {
            (_, 0) => Err(codes::IMAGE_NO_SLICES.says("the array has no slices").into()),
            (true, cubes) => Ok((ImageKind::Cube, 6 * u64::from(cubes))),
            (false, 1) => Ok((ImageKind::Texture2d, 1)),
            (false, slices) => Ok((ImageKind::Array { slices }, u64::from(slices))),
        };
    }
    if header.caps2 & CAPS2_VOLUME != 0 {
        return Err(not_flat("three dimensions"));
    }
    if header.caps2 & CAPS2_CUBE == 0 {
        return Ok((ImageKind::Texture2d, 1));
    }
    match (header.caps2 & CAPS2_FACES).count_ones() {
        6 => Ok((ImageKind::Cube, 6)),
        faces => {
            let message = format!("a cube has 6 faces, and this one {faces}");
            Err(codes::IMAGE_CUBE.says(message).into())
        }
    }
}

fn not_flat(dimensions: &str) -> Fault {
    let message = format!("a texture with {dimensions} is not supported, only flat ones and cubes are");
    codes::IMAGE_DIMENSION.says(message).into()
}

/// Whether a picture in BC1 has a clear texel: the first colour of its block is not the larger, and its index is 3.
/// Texels of a block beyond the edge are not looked at: encoders write anything there.
fn has_holes(image: &Image) -> bool {
    let (width, height) = (image.width, image.height);
    let blocks_in_row = width.div_ceil(4);
    let inside = |column: u32, row: u32| {
        let columns = u32::MAX >> (32 - 2 * (width - 4 * column).min(4)) & 0xff;
        (0..(height - 4 * row).min(4)).fold(0, |inside, row| inside | columns << (8 * row))
    };
    let has_hole = |(index, &[a, b, c, d, ref indices @ ..]): (u32, &[u8; 8])| {
        let three_colours = u16::from_le_bytes([a, b]) <= u16::from_le_bytes([c, d]);
        let indices = u32::from_le_bytes(*indices) & inside(index % blocks_in_row, index / blocks_in_row);
        three_colours && indices & indices >> 1 & 0x5555_5555 != 0
    };
    (0..image.face_count())
        .filter_map(|face| image.level(face, 0))
        .any(|level| (0..).zip(level.as_chunks::<8>().0).any(has_hole))
}

/// Divides premultiplied colour by alpha. Blocks are decoded for it.
fn with_straight_alpha(image: Image) -> Image {
    let faces = 0..image.face_count();
    let levels = faces.flat_map(|face| (0..image.level_count).map(move |level| (face, level)));
    let mut data: Vec<u8> = levels
        .filter_map(|(face, level)| image.to_rgba8(face, level))
        .flatten()
        .collect();
    for [colour @ .., alpha] in data.as_chunks_mut::<4>().0 {
        let alpha = u32::from(*alpha);
        for value in colour {
            // With alpha 0 the colour is lost.
            let straight = (u32::from(*value) * 255 + alpha / 2).checked_div(alpha);
            *value = straight.unwrap_or(0).min(255) as u8;
        }
    }
    Image {
        format: ImageFormat::Rgba8,
        data,
        ..image
    }
}
