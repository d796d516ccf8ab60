//! Maps as pictures, each once: PNG, or the file as it is.

use std::collections::HashMap;

use serde_json::{Value, json};

use super::binary::{Binary, Target};
use crate::export::directions::directions;
use crate::export::{ExportError, MapImages, MapSources};
use crate::image::{Image, encode_png};

/// What a picture is made of a map for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Use {
    /// Its texels as they are.
    AsIs,
    /// A direction in red, green and blue; z follows from x and y where the map has none.
    Directions { is_turned: bool },
    /// Roughness in green: 1 − (1 − roughness) × alpha of a normal map, as both lights take it. Metalness in blue.
    Roughness {
        /// Bits of the roughness that the map changes.
        roughness: u32,
        metal: bool,
    },
}

fn is_jpeg(bytes: &[u8]) -> bool {
    bytes.starts_with(b"\xFF\xD8\xFF")
}

/// Whether a strict reader takes a JPEG: it is grey or has three components, all of its segments have the lengths that their tables need,
/// and it ends where it says so. `None` where it is cut.
fn is_strict_jpeg(bytes: &[u8]) -> Option<bool> {
    let mut rest = bytes.strip_prefix(b"\xFF\xD8")?;
    let mut is_framed = false;
    loop {
        rest = rest.strip_prefix(b"\xFF")?;
        let (&marker, after) = rest.split_first()?;
        rest = match marker {
            0xD9 => return Some(is_framed),
            // Padding.
            0xFF => continue,
            0x01 | 0xD0..=0xD7 => after,
            _ => {
                let length = usize::from(u16::from_be_bytes(*after.first_chunk()?));
                let mut segment = after.get(2..length)?;
                let is_whole = match marker {
                    // Baseline, extended and progressive: eight bits, and a size.
                    0xC0..=0xC2 => {
                        is_framed = true;
                        segment.first() == Some(&8)
                            && matches!(segment.get(5)?, 1 | 3)
                            && segment.len() == 6 + 3 * usize::from(*segment.get(5)?)
                    }
                    // Tables of Huffman codes: sixteen counts, and so many values.
                    0xC4 => {
                        while !segment.is_empty() {
                            let counts = segment.get(1..17)?.iter().map(|&count| usize::from(count));
                            segment = segment.get(17 + counts.sum::<usize>()..)?;
                        }
                        true
                    }
                    // Other ways to code, which no reader of pages has.
                    0xC3 | 0xC5..=0xCF => false,
                    // Tables of quantisation.
                    0xDB => {
                        while let Some(&kind) = segment.first() {
                            segment = segment.get(if kind >= 16 { 129 } else { 65 }..)?;
                        }
                        true
                    }
                    0xDA => is_framed,
                    _ => true,
                };
                if !is_whole {
                    return Some(false);
                }
                let after = &after[length..];
                // Behind the head of a scan comes what it codes, up to the next marker.
                let is_end = |pair: &[u8]| pair[0] == 0xFF && !matches!(pair[1], 0 | 0xD0..=0xD7 | 0xFF);
                let coded = if marker == 0xDA {
                    after.windows(2).position(is_end)?
                } else {
                    0
                };
                &after[coded..]
            }
        };
    }
}

fn place(image: &Image) -> usize {
    std::ptr::from_ref(image).addr()
}

#[derive(Default)]
pub(super) struct Pictures {
    pub(super) images: Vec<Value>,
    /// Files that glTF takes as they are, by their maps' places in memory.
    files: HashMap<usize, bytes::Bytes>,
    /// By the map's place in memory and what it is for.
    made: HashMap<(usize, Use), usize>,
    by_bytes: HashMap<bytes::Bytes, usize>,
}

impl Pictures {
    /// No picture yet. A PNG can be written as it is where its texels are, and a JPEG that has nothing to forgive.
    pub(super) fn new(maps: &MapImages<'_>, sources: &MapSources) -> Self {
        let is_taken = |bytes: &[u8]| is_strict_jpeg(bytes).unwrap_or_default() || bytes.starts_with(b"\x89PNG");
        let files = sources.iter().filter(|(_, bytes)| is_taken(bytes));
        let files = files.filter_map(|(map, bytes)| Some((place(maps.get(map)?), bytes.clone())));
        Self {
            files: files.collect(),
            ..Self::default()
        }
    }

    /// The picture of a map. Equal ones are written once, with the first name.
    pub(super) fn picture(
        &mut self,
        image: &Image,
        purpose: Use,
        name: &str,
        binary: &mut Binary,
    ) -> Result<usize, ExportError> {
        let key = (place(image), purpose);
        if let Some(&made) = self.made.get(&key) {
            return Ok(made);
        }
        let file = self.files.get(&key.0).filter(|_| purpose == Use::AsIs);
        let bytes = match file {
            Some(file) => file.clone(),
            None => encode_png(&texels(image, purpose), image.width(), image.height())?.into(),
        };
        let index = match self.by_bytes.get(&bytes) {
            Some(&index) => index,
            None => {
                let view = binary.view(&bytes, Target::Other);
                let mime = if is_jpeg(&bytes) { "image/jpeg" } else { "image/png" };
                self.images
                    .push(json!({ "bufferView": view, "mimeType": mime, "name": name }));
                self.by_bytes.insert(bytes, self.images.len() - 1);
                self.images.len() - 1
            }
        };
        self.made.insert(key, index);
        Ok(index)
    }
}

/// RGBA, 8 bits a channel.
fn texels(image: &Image, purpose: Use) -> Vec<u8> {
    let rgba8 = || image.to_rgba8(0, 0).unwrap_or_default();
    match purpose {
        Use::AsIs => rgba8(),
        Use::Directions { is_turned } => directions(image, is_turned),
        Use::Roughness { roughness, metal } => {
            let mut texels = rgba8();
            let shininess = 1.0 - f32::from_bits(roughness);
            for texel in texels.chunks_exact_mut(4) {
                let roughness = 1.0 - shininess * f32::from(texel[3]) / 255.0;
                let metalness = if metal { u8::MAX } else { 0 };
                texel.copy_from_slice(&[u8::MAX, (roughness * 255.0).round() as u8, metalness, u8::MAX]);
            }
            texels
        }
    }
}
