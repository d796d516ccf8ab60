//! Maps as pictures, each once: PNG, or the file as it is.

use std::collections::HashMap;
use std::sync::Arc;

use serde_json::{Value, json};

use super::binary::{Binary, Target};
use crate::export::ExportError;
use crate::export::directions::directions;
use crate::image::{Image, encode_png};

/// What a picture is made of a map for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Use {
    /// Its texels as they are.
    AsIs,
    /// A direction in red, green and blue; z follows from x and y where the map has none.
    Directions {
        /// Whether green points the other way.
        is_turned: bool,
    },
    /// Roughness in green: 1 − (1 − roughness) × alpha of a normal map, as both lights take it. Metalness in blue.
    Roughness {
        /// Bits of the roughness that the map changes.
        roughness: u32,
        /// Whether it is a metal.
        metal: bool,
    },
}

/// Pictures that were encoded before their file is written, by the map's place in memory and what they are for.
#[derive(Clone, Debug, Default)]
pub struct EncodedMaps {
    encoded: HashMap<(usize, Use), Arc<[u8]>>,
    /// Files that glTF takes as they are.
    files: HashMap<usize, Arc<[u8]>>,
}

impl EncodedMaps {
    /// The file that a map was read from. A PNG or JPEG is written as it is where its texels are.
    pub fn add_file(&mut self, image: &Image, bytes: Arc<[u8]>) {
        if is_jpeg(&bytes) || bytes.starts_with(b"\x89PNG") {
            self.files.insert(place(image), bytes);
        }
    }

    /// Encodes a picture. Whether it was not there yet.
    pub(super) fn encode(&mut self, image: &Image, purpose: Use) -> Result<bool, ExportError> {
        let key = (place(image), purpose);
        if self.encoded.contains_key(&key) {
            return Ok(false);
        }
        let file = self.files.get(&key.0).filter(|_| purpose == Use::AsIs);
        let bytes = match file {
            Some(file) => Arc::clone(file),
            None => encode_png(&texels(image, purpose), image.width(), image.height())?.into(),
        };
        self.encoded.insert(key, bytes);
        Ok(true)
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.encoded.len()
    }
}

fn is_jpeg(bytes: &[u8]) -> bool {
    bytes.starts_with(b"\xFF\xD8\xFF")
}

fn place(image: &Image) -> usize {
    std::ptr::from_ref(image).addr()
}

/// The pictures that were written.
#[derive(Default)]
pub(super) struct Pictures {
    pub(super) images: Vec<Value>,
    encoded: EncodedMaps,
    /// By the map's place in memory and what it is for.
    made: HashMap<(usize, Use), usize>,
    by_bytes: HashMap<Arc<[u8]>, usize>,
}

impl Pictures {
    /// No picture yet, and some that are encoded.
    pub(super) fn new(encoded: EncodedMaps) -> Self {
        Self {
            encoded,
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
        self.encoded.encode(image, purpose)?;
        let bytes = self.encoded.encoded.remove(&key).unwrap_or_default();
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gloss_becomes_roughness() {
        let image = Image::from_rgba8(3, 1, vec![1, 2, 3, 0, 1, 2, 3, 255, 1, 2, 3, 128], "test");
        let purpose = Use::Roughness {
            roughness: 0.5_f32.to_bits(),
            metal: false,
        };
        let found = texels(&image.expect("a sound picture"), purpose);
        assert_eq!(found, [255, 255, 0, 255, 255, 128, 0, 255, 255, 191, 0, 255]);
    }
}
