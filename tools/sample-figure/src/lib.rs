//! Makes the sample: a figure that the page opens with, so that there is something to see before a file was dropped.
//! `cargo run --package sample-figure` writes it to `web/sample`.
//!
//! ```text
//! rig -> parts (lists of rings and outlines) -> shape (lofts, plates, tubes) -> solids -> Document -> demo -> figure.m3d
//!    \-> motion (poses, two-bone legs) -> clips                                         /
//! parts' marks -> atlas -> maps (grooves, rivets, letters) -> texels
//! ```
//!
//! The same document on every machine: mesh and maps depend on + − × ÷ √ alone, which IEEE 754 fixes; sines appear in clips only, in
//! f64, and all numbers are rounded to few decimals before they are stored. A sine that differs in its last bit between systems could still flip
//! the last decimal of a rare key.

mod atlas;
mod demo;
mod document;
mod maps;
mod materials;
mod motion;
mod order;
mod parts;
mod rig;
mod shape;

use std::path::{Path, PathBuf};

use bindpose::format::{self, Document};
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder as _};

pub use maps::SampleMap;

/// The figure as it is made: left-handed, y up, 1.8 m tall, standing on y = 0 and facing −z, with the clips `Idle`, `Walk`, `Run`
/// and `Wave` at 30 keys a second, each of which loops.
pub fn figure() -> Document {
    let rig = rig::Rig::new();
    document::document(&parts::Kit::figure(&rig), motion::clips(&rig))
}

/// The maps that the figure's materials name.
pub fn maps() -> Vec<SampleMap> {
    maps::maps(&parts::Kit::figure(&rig::Rig::new()))
}

/// The sample: a figure as the DirectX 12 book's demo shows it, right-handed, 72 units high, and standing at ease in the clip `Take1`. Its
/// materials name DDS files; [`maps`] are their pictures.
pub fn sample(figure: Document) -> Document {
    demo::for_the_demo(figure)
}

/// The folder that holds the committed sample.
pub fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../web/sample")
}

/// The file of the model.
pub const FIGURE_NAME: &str = "figure.m3d";

/// All files of the sample with their names: the model, then its maps.
pub fn files() -> Vec<(&'static str, Vec<u8>)> {
    let figure = (FIGURE_NAME, format::write(&sample(figure())).into_bytes());
    let maps = maps();
    let maps = maps.iter().map(|map| (map.name, packed(map)));
    std::iter::once(figure).chain(maps).collect()
}

/// As small a PNG as the encoder makes, without an alpha channel where all is opaque.
fn packed(map: &SampleMap) -> Vec<u8> {
    let opaque = map.rgba.chunks_exact(4).all(|texel| texel[3] == u8::MAX);
    let (color, texels) = if opaque {
        let rgb = map.rgba.chunks_exact(4).flat_map(|texel| &texel[..3]).copied();
        (ExtendedColorType::Rgb8, rgb.collect())
    } else {
        (ExtendedColorType::Rgba8, map.rgba.clone())
    };
    let mut png = Vec::new();
    PngEncoder::new_with_quality(&mut png, CompressionType::Best, FilterType::Adaptive)
        .write_image(&texels, map.side, map.side, color)
        .expect("a square of texels");
    png
}
