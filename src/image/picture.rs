//! A picture as plain data.

use std::fmt;
use std::ops::Range;

use super::format::{Channels, ImageFormat};
use super::{MAX_SIDE, blocks};
use crate::diagnostic::{Fault, codes};

/// The kind of a texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ImageKind {
    /// One flat picture.
    Texture2d,
    /// Six square faces: +x, −x, +y, −y, +z, −z. Of an array of cubes, the first.
    Cube,
    /// The first slice of an array.
    Array {
        /// Slices of the file.
        slices: u32,
    },
}

/// A picture with its mips. It has at least one texel, and every level is complete.
#[derive(Clone, PartialEq, Eq)]
pub struct Image {
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) level_count: u32,
    pub(super) kind: ImageKind,
    pub(super) format: ImageFormat,
    pub(super) channels: Channels,
    /// What the file calls its texels: `BC5`, `B8G8R8X8`, `PNG`.
    pub(super) source: String,
    pub(super) mips_generated: bool,
    /// Faces one after another, each with its levels from the largest, rows from the top without padding.
    pub(super) data: Vec<u8>,
}

impl Image {
    /// A flat picture of these texels: RGBA, 8 bits a channel, rows from the top without padding. `source` is what the
    /// description calls it.
    ///
    /// # Errors
    /// When a side is 0 or more than [`MAX_SIDE`], or `data` is not `4 × width × height` long.
    pub fn from_rgba8(width: u32, height: u32, data: Vec<u8>, source: &str) -> Result<Self, Fault> {
        check_size(width, height)?;
        let expected = ImageFormat::Rgba8.level_len(width, height);
        if data.len() as u64 != expected {
            let found = data.len();
            let message = format!("{found} bytes of texels are not the {expected} of {width} × {height}");
            return Err(codes::IMAGE_DATA_LENGTH.says(message).into());
        }
        Ok(Self {
            width,
            height,
            level_count: 1,
            kind: ImageKind::Texture2d,
            format: ImageFormat::Rgba8,
            channels: Channels::Rgba,
            source: source.to_owned(),
            mips_generated: false,
            data,
        })
    }

    /// Texels in a row of the largest level, 1 to [`MAX_SIDE`].
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Rows of the largest level, 1 to [`MAX_SIDE`].
    pub fn height(&self) -> u32 {
        self.height
    }

    /// How many mip levels each face has, the largest included.
    pub fn level_count(&self) -> u32 {
        self.level_count
    }

    /// How many of them the file has.
    pub fn file_level_count(&self) -> u32 {
        if self.mips_generated { 1 } else { self.level_count }
    }

    /// Its kind.
    pub fn kind(&self) -> ImageKind {
        self.kind
    }

    /// How many flat pictures: 6 for a cube, else 1.
    pub fn face_count(&self) -> u32 {
        if self.kind == ImageKind::Cube { 6 } else { 1 }
    }

    /// How the texels are stored.
    pub fn format(&self) -> ImageFormat {
        self.format
    }

    /// What the file calls its texels: `BC5`, `B8G8R8X8`, `PNG`.
    pub fn source(&self) -> &str {
        &self.source
    }

    /// Which channels carry data.
    pub fn channels(&self) -> Channels {
        self.channels
    }

    /// Whether alpha carries data. Where it does not, alpha is 1, whatever compressed blocks say.
    pub fn has_alpha(&self) -> bool {
        self.channels.has_alpha()
    }

    /// Whether the smaller levels were computed here instead of read.
    pub fn mips_generated(&self) -> bool {
        self.mips_generated
    }

    /// All texels: faces one after another, each with its levels from the largest on, rows from the top, no padding.
    pub fn data(&self) -> &[u8] {
        &self.data
    }

    /// Texels in a row and rows of a level.
    pub fn level_size(&self, level: u32) -> (u32, u32) {
        level_size(self.width, self.height, level)
    }

    /// The texels of one level of one face; `None` where there is no such face or level.
    pub fn level(&self, face: u32, level: u32) -> Option<&[u8]> {
        self.data.get(self.level_range(face, level)?)
    }

    /// One level decoded: RGBA, 8 bits a channel, rows from the top without padding. `None` where there is no such face
    /// or level.
    ///
    /// Values are as a GPU samples them from the blocks, but one grey value stands in red, green and blue, values from −1
    /// to 1 come as 0 to 255, and alpha is 255 where the picture [has none](Self::has_alpha). Linear half floats are cut
    /// at 1 and encoded as sRGB.
    pub fn to_rgba8(&self, face: u32, level: u32) -> Option<Vec<u8>> {
        let mut texels = Vec::new();
        self.append_rgba8(&mut texels, face, level)?;
        Some(texels)
    }

    /// The same at the end of a buffer. `None`, and nothing is added, where there is no such face or level.
    pub(super) fn append_rgba8(&self, texels: &mut Vec<u8>, face: u32, level: u32) -> Option<()> {
        let ((width, height), stored) = (self.level_size(level), self.level(face, level)?);
        let start = texels.len();
        if self.format == ImageFormat::Rgba8 {
            texels.extend_from_slice(stored);
        } else {
            texels.extend(blocks::to_rgba8(self.format, width, height, stored));
        }
        if !self.has_alpha() {
            let (texels, _) = texels[start..].as_chunks_mut();
            texels.iter_mut().for_each(|[.., alpha]: &mut [u8; 4]| *alpha = 255);
        }
        Some(())
    }

    /// One level decoded: RGBA as floats, rows from the top without padding. `None` where there is no such face or level.
    ///
    /// Float formats give their linear values; the others what [`to_rgba8`](Self::to_rgba8) gives, as 0 … 1.
    pub fn to_rgba32f(&self, face: u32, level: u32) -> Option<Vec<f32>> {
        if !self.format.is_float() {
            let texels = self.to_rgba8(face, level)?;
            return Some(texels.into_iter().map(|value| f32::from(value) / 255.0).collect());
        }
        let (width, height) = self.level_size(level);
        let mut texels = blocks::to_rgba32f(self.format, width, height, self.level(face, level)?);
        if !self.has_alpha() {
            texels.iter_mut().skip(3).step_by(4).for_each(|alpha| *alpha = 1.0);
        }
        Some(texels)
    }

    /// What the panel says: `BC5 512 × 512, 10 mips`.
    pub fn description(&self) -> String {
        let (source, width, height) = (&self.source, self.width, self.height);
        let kind = match self.kind {
            ImageKind::Texture2d => String::new(),
            ImageKind::Cube => " cube".to_owned(),
            ImageKind::Array { slices } => format!(", first of {slices} slices"),
        };
        let plural = if self.level_count == 1 { "" } else { "s" };
        let generated = if self.mips_generated { " made here" } else { "" };
        format!(
            "{source} {width} × {height}{kind}, {} mip{plural}{generated}",
            self.level_count
        )
    }

    fn level_range(&self, face: u32, level: u32) -> Option<Range<usize>> {
        if face >= self.face_count() || level >= self.level_count {
            return None;
        }
        let level_len = |level| {
            let (width, height) = self.level_size(level);
            self.format.level_len(width, height) as usize
        };
        let before_level: usize = (0..level).map(level_len).sum();
        let face_len: usize = (0..self.level_count).map(level_len).sum();
        let start = face as usize * face_len + before_level;
        Some(start..start + level_len(level))
    }
}

impl fmt::Debug for Image {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Image({})", self.description())
    }
}

/// Texels in a row and rows of a level: halves, rounded down, but never 0.
pub(super) fn level_size(width: u32, height: u32, level: u32) -> (u32, u32) {
    let halved = |side: u32| side.checked_shr(level).unwrap_or(0).max(1);
    (halved(width), halved(height))
}

/// Levels down to 1 × 1. Neither side is 0.
pub(super) fn full_level_count(width: u32, height: u32) -> u32 {
    u32::BITS - width.max(height).leading_zeros()
}

/// Whether a picture of this size is read at all.
pub(super) fn check_size(width: u32, height: u32) -> Result<(), Fault> {
    let allowed = 1..=MAX_SIDE;
    if allowed.contains(&width) && allowed.contains(&height) {
        return Ok(());
    }
    let message = format!("a picture of {width} × {height} cannot be shown; a side may have 1 to {MAX_SIDE} texels");
    Err(codes::IMAGE_SIZE.says(message).into())
}
