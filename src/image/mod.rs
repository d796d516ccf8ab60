//! Pictures: the maps that models name, from a file's bytes to texels, and screenshots, from texels to a file.
//!
//! ```text
//! bytes -> Image -> with_mips -> data (for the GPU)
//!     decode              \----> to_rgba8, to_rgba32f (where the GPU lacks the format)
//! ```
//! DDS and Radiance files are read here, header and all; compressed blocks by `bcdec_rs`; PNG, JPEG, WebP, TGA and BMP by `image`.
//! No allocation trusts a header: sizes are compared with the length of the file first.

mod blocks;
mod cube_faces;
mod dds;
mod dds_header;
mod dds_layout;
mod encode;
mod file_kind;
mod format;
pub mod half;
mod masks;
mod mips;
mod picture;
mod radiance;
mod raster;
mod rgbe;
pub(crate) mod srgb;

use file_kind::FileKind;

use crate::diagnostic::{Diagnostic, Fault, codes};
use crate::slices::{Slices, at_once};

pub(crate) use cube_faces::cube_direction;
pub use encode::{EncodeError, encode_dds, encode_png};
pub use format::{Channels, ImageFormat, MAX_SIDE};
pub use mips::MapKind;
pub use picture::{Image, ImageKind};

/// Reads a picture. Its first bytes tell the format; for TGA, which has no signature, its name does.
///
/// # Errors
/// When the bytes are no picture of a known format, or are damaged. The error names the file.
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
/// assert_eq!(error.to_string(), "textures/notes.png: this is none of DDS, PNG, JPEG, WebP, TGA, BMP and Radiance");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn decode(bytes: &[u8], name: &str) -> Result<Image, Fault> {
    at_once(decode_in(bytes, name, &Slices::ENDLESS))
}

/// [`decode`] in slices. A JPEG, a WebP, a TGA or a BMP is decoded in one piece.
///
/// # Errors
/// Those of [`decode`].
pub async fn decode_in(bytes: &[u8], name: &str, slices: &Slices) -> Result<Image, Fault> {
    let decoded = match kind_of(bytes, name) {
        Ok(FileKind::Dds) => dds::decode(bytes),
        Ok(FileKind::Radiance) => radiance::decode(bytes, slices).await,
        Ok(kind) => raster::decode(bytes, kind, slices).await,
        Err(fault) => Err(fault),
    };
    decoded.map_err(|fault| naming(*fault, name))
}

/// Checks whether [`decode`] can read a picture, by its header and the length of the file. Compressed data may still
/// turn out to be damaged.
///
/// # Errors
/// Those of [`decode`].
pub fn check(bytes: &[u8], name: &str) -> Result<(), Fault> {
    let checked = kind_of(bytes, name).and_then(|kind| match kind {
        FileKind::Dds => dds::check(bytes),
        FileKind::Radiance => radiance::check(bytes),
        kind => raster::check(bytes, kind),
    });
    checked.map_err(|fault| naming(*fault, name))
}

fn kind_of(bytes: &[u8], name: &str) -> Result<FileKind, Fault> {
    FileKind::of(bytes, name).ok_or_else(|| {
        let (code, message) = match bytes {
            [] => (&codes::IMAGE_EMPTY, "the file is empty"),
            [0x76, 0x2f, 0x31, 0x01, ..] => (
                &codes::IMAGE_UNRECOGNIZED,
                "OpenEXR (.exr) cannot be read; a panorama as Radiance (.hdr) or a cube map as .dds can",
            ),
            _ => (
                &codes::IMAGE_UNRECOGNIZED,
                "this is none of DDS, PNG, JPEG, WebP, TGA, BMP and Radiance",
            ),
        };
        code.says(message).into()
    })
}

/// The fault with the name of its file.
fn naming(fault: Diagnostic, name: &str) -> Fault {
    Box::new(Diagnostic {
        message: format!("{name}: {}", fault.message),
        ..fault
    })
}

/// Bytes from the beginning of a file that [`cube_side`] reads at most.
pub const CUBE_HEADER_LEN: usize = dds_header::HEADER_LEN + dds_header::DX10_LEN;

/// Texels a side of each face when a file begins like a cube map or a panorama, which becomes one; `None` otherwise. Reads the header alone, so
/// the texels may be damaged.
pub fn cube_side(bytes: &[u8]) -> Option<u32> {
    dds::cube_side(bytes).or_else(|| radiance::cube_side(bytes))
}
