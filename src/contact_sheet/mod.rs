//! A contact sheet: many pictures in rows on one, each with a label under it. Pixels only; nothing here draws a model.

#[doc(hidden)]
pub mod for_tests;
mod label;
mod layout;

pub use label::INTER_REGULAR;
pub use layout::ContactSheetError;

use crate::image::{EncodeError, encode_png};
use crate::scene::Theme;
use label::Labels;
use layout::{Layout, Place};

/// sRGB.
type Ink = [u8; 3];

/// Colours of a sheet: the ground between the pictures and under labels, the first part of a label, the others.
struct Inks {
    ground: Ink,
    text: Ink,
    muted: Ink,
}

impl Inks {
    fn of(theme: Theme) -> Self {
        match theme {
            Theme::Dark => Self {
                ground: [0x18, 0x1b, 0x21],
                text: [0xe7, 0xea, 0xf0],
                muted: [0x98, 0xa1, 0xb0],
            },
            Theme::Light => Self {
                ground: [0xfc, 0xfd, 0xfe],
                text: [0x1b, 0x20, 0x29],
                muted: [0x5b, 0x65, 0x74],
            },
        }
    }
}

pub struct ContactSheet {
    layout: Layout,
    inks: Inks,
    labels: Labels,
    /// Room beside the text of a label, pixels.
    margin: f32,
    /// RGBA, sRGB, straight alpha, rows from the top.
    pixels: Vec<u8>,
    /// With the places that they are for.
    captions: Vec<(usize, Vec<String>)>,
}

impl ContactSheet {
    /// Without pictures, of a size in pixels, for so many columns and rows of pictures. A transparent one has no ground
    /// but under labels, so that they can be read wherever it is laid.
    ///
    /// # Errors
    /// When it has too many pixels, or too few for so many pictures.
    pub fn new(size: [u32; 2], cells: [u32; 2], theme: Theme, transparent: bool) -> Result<Self, ContactSheetError> {
        let layout = Layout::new(size, cells)?;
        let inks = Inks::of(theme);
        let [red, green, blue] = inks.ground;
        let ground = if transparent { [0; 4] } else { [red, green, blue, 255] };
        Ok(Self {
            pixels: ground.repeat(layout.pixel_count()),
            labels: Labels::new(layout.text_size()),
            margin: if transparent { 0.5 * layout.text_size() } else { 0.0 },
            layout,
            inks,
            captions: Vec::new(),
        })
    }

    /// Width and height of each picture, pixels.
    pub fn cell_size(&self) -> [u32; 2] {
        self.layout.cell_size()
    }

    /// Sets a picture of [`ContactSheet::cell_size`] into a place, counted from 0 along the rows, with a label for it. A place that is not
    /// there is ignored.
    ///
    /// `pixels` are RGBA, sRGB, straight alpha, rows from the top without padding.
    pub fn place(&mut self, index: usize, pixels: &[u8], caption: Vec<String>) {
        let Some((picture, _)) = self.layout.places(index) else {
            return;
        };
        let row_bytes = picture.size[0] as usize * 4;
        for (row, from) in (picture.at[1]..)
            .zip(pixels.chunks_exact(row_bytes))
            .take(picture.size[1] as usize)
        {
            let start = self.layout.pixel_index([picture.at[0], row]) * 4;
            self.pixels[start..start + row_bytes].copy_from_slice(from);
        }
        self.captions.push((index, caption));
    }

    /// Writes the labels: the first part at the left end, the others at the right end. Where one label lacks room for them, all go without
    /// their last parts.
    fn write_captions(&mut self) {
        let captions = std::mem::take(&mut self.captions);
        let most = captions.iter().map(|(_, caption)| caption.len()).max().unwrap_or(0);
        let fits = |parts: &usize| captions.iter().all(|(_, caption)| self.fits(caption, *parts));
        let Some(parts) = (1..=most).rev().find(fits) else {
            return;
        };
        for (index, caption) in &captions {
            let (Some((_, label)), Some((first, others))) = (self.layout.places(*index), ends(caption, parts)) else {
                continue;
            };
            for row in (label.at[1]..).take(label.size[1] as usize) {
                let start = self.layout.pixel_index([label.at[0], row]) * 4;
                let row = self.pixels[start..].chunks_exact_mut(4).take(label.size[0] as usize);
                row.for_each(|pixel| blend(pixel, self.inks.ground, 255));
            }
            self.write(label, self.margin, first, self.inks.text);
            let left = label.size[0] as f32 - self.margin - self.labels.width(&others);
            self.write(label, left, &others, self.inks.muted);
        }
    }

    /// Whether a label has room for so many parts.
    fn fits(&self, caption: &[String], parts: usize) -> bool {
        let Some((first, others)) = ends(caption, parts) else {
            return true;
        };
        let gap = if others.is_empty() {
            0.0
        } else {
            2.0 * self.labels.size()
        };
        let width = self.labels.width(first) + gap + self.labels.width(&others);
        width + 2.0 * self.margin <= self.layout.cell_size()[0] as f32
    }

    /// Writes text into a place, beginning so far from its left end.
    fn write(&mut self, place: Place, left: f32, text: &str, [red, green, blue]: Ink) {
        let coverage = self.labels.coverage(text, left, place.size);
        let rows = coverage.chunks_exact(place.size[0] as usize);
        for (row, covered) in (place.at[1]..).zip(rows) {
            let start = self.layout.pixel_index([place.at[0], row]) * 4;
            let pixels = self.pixels[start..].chunks_exact_mut(4);
            for (pixel, &covered) in pixels.zip(covered) {
                blend(pixel, [red, green, blue], covered);
            }
        }
    }

    /// The bytes of a PNG file.
    ///
    /// # Errors
    /// When it cannot be encoded.
    pub fn into_png(mut self) -> Result<Vec<u8>, EncodeError> {
        self.write_captions();
        let [width, height] = self.layout.size();
        encode_png(&self.pixels, width, height)
    }
}

/// What stands at both ends of a label of at most so many parts.
fn ends(caption: &[String], parts: usize) -> Option<(&String, String)> {
    let (first, others) = caption[..parts.min(caption.len())].split_first()?;
    Some((first, others.join(" · ")))
}

/// Puts an ink over a pixel with straight alpha, as sRGB values like all text of the interface.
pub fn blend(pixel: &mut [u8], ink: Ink, covered: u8) {
    let [red, green, blue, alpha] = pixel else { return };
    let over = f32::from(covered) / 255.0;
    let under = f32::from(*alpha) / 255.0 * (1.0 - over);
    let sum = over + under;
    if sum <= 0.0 {
        return;
    }
    for (channel, ink) in [red, green, blue].into_iter().zip(ink) {
        *channel = ((f32::from(ink) * over + f32::from(*channel) * under) / sum).round() as u8;
    }
    *alpha = (sum * 255.0).round() as u8;
}
