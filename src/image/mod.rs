//! Pictures: the maps that models name, from a file's bytes to texels, and screenshots, from texels to a file.
//!
//! ```text
//! bytes -> Image -> with_mips -> data (for the GPU)
//!     decode              \----> to_rgba8, to_rgba32f (where the GPU lacks the format)
//! ```
//! DDS files are read here, header and all; their compressed blocks by `bcdec_rs`; PNG, JPEG, TGA and BMP by `image`.
//! No header's claim decides an allocation: sizes are compared with the bytes that are there first.

mod blocks;
mod dds;
mod dds_header;
mod dds_layout;
mod encode;
mod error;
mod format;
pub(crate) mod half;
mod masks;
mod mips;
mod picture;
mod raster;
pub(crate) mod srgb;

pub use encode::{EncodeError, encode_png};
pub use error::{FileKind, ImageError, ImageErrorKind, Layer};
pub use format::{Channels, ImageFormat, MAX_SIDE};
pub use mips::MapKind;
pub use picture::{Image, ImageKind};

/// Reads a picture. What it is shows in its first bytes, and only for TGA, which has no signature, in its name.
///
/// # Errors
/// When the bytes are no picture that is known here, or are damaged; the error names the file.
///
/// # Examples
/// ```
/// use bindpose::image;
///
/// let png = image::encode_png(&[255, 0, 0, 255], 1, 1)?;
/// let red = image::decode(&png, "red.png")?;
/// assert_eq!(red.description(), "PNG 1 × 1, 1 mip");
/// assert_eq!(red.to_rgba8(0, 0).as_deref(), Some([255, 0, 0, 255].as_slice()));
///
/// let error = image::decode(b"hello", "textures/notes.png").unwrap_err();
/// assert_eq!(error.to_string(), "textures/notes.png: this is none of DDS, PNG, JPEG, TGA and BMP");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn decode(bytes: &[u8], name: &str) -> Result<Image, ImageError> {
    let decoded = kind_of(bytes, name).and_then(|kind| match kind {
        FileKind::Dds => dds::decode(bytes),
        kind => raster::decode(bytes, kind),
    });
    decoded.map_err(|kind| named(kind, name))
}

/// Looks whether [`decode`] can read a picture, without its texels: at the header, and whether the file is long enough for it.
/// Only what is packed may still turn out to be damaged.
///
/// # Errors
/// Those of [`decode`].
pub fn check(bytes: &[u8], name: &str) -> Result<(), ImageError> {
    let checked = kind_of(bytes, name).and_then(|kind| match kind {
        FileKind::Dds => dds::check(bytes),
        kind => raster::check(bytes, kind),
    });
    checked.map_err(|kind| named(kind, name))
}

fn kind_of(bytes: &[u8], name: &str) -> Result<FileKind, ImageErrorKind> {
    FileKind::of(bytes, name).ok_or(if bytes.is_empty() {
        ImageErrorKind::Empty
    } else {
        ImageErrorKind::Unrecognized
    })
}

fn named(kind: ImageErrorKind, name: &str) -> ImageError {
    ImageError {
        name: name.to_owned(),
        kind,
    }
}

/// Bytes from the beginning of a file that [`cube_side`] reads at most.
pub const CUBE_HEADER_LEN: usize = dds_header::HEADER_LEN + dds_header::DX10_LEN;

/// Texels a side of each face when a file begins like a cube map, whose texels may still be damaged; `None` for anything
/// else. Reads the header alone.
pub fn cube_side(bytes: &[u8]) -> Option<u32> {
    dds::cube_side(bytes)
}
