//! Files of pictures: what each holds, and its name, a word that every system takes. Each file is there once.

use std::collections::HashMap;
use std::sync::Arc;

use crate::export::{Bake, ExportError, directions, one_word};
use crate::image::{Channels, Image, MapKind, encode_dds, encode_png};
use crate::model::{MapSlot, Taken};

/// What a file of a picture holds.
#[derive(Debug)]
pub(in crate::session) enum Content {
    AsItIs(bytes::Bytes),
    TurnedPng(Arc<Image>),
    Dds(Arc<Image>, Texels, MapKind),
    /// Base colours, if there are any, and metalness as one map: DDS, else PNG.
    Baked(Box<Bake>, Option<Arc<Image>>, Arc<Image>, bool),
    Plain([u8; 4]),
}

/// Which texels of a picture are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(in crate::session) enum Texels {
    Same,
    /// Directions alone, with green the other way.
    Turned,
}

impl Content {
    /// The bytes of the file.
    pub(super) fn bytes(self) -> Result<bytes::Bytes, ExportError> {
        Ok(match self {
            Self::AsItIs(bytes) => bytes,
            Self::TurnedPng(image) => encode_png(&directions(&image, true), image.width(), image.height())?.into(),
            Self::Dds(image, texels, kind) => {
                let is_turned = texels == Texels::Turned;
                // The demo takes three numbers of a direction.
                let other = if is_turned || (kind == MapKind::Normal && image.channels() == Channels::RedGreen) {
                    let texels = directions(&image, is_turned);
                    let made = Image::from_rgba8(image.width(), image.height(), texels, image.source());
                    made.ok().map(|made| made.with_mips(kind))
                } else {
                    image.mipped(kind)
                };
                encode_dds(other.as_ref().unwrap_or(&image)).into()
            }
            Self::Baked(bake, base, metallic, is_dds) => {
                let (texels, width, height) = bake.texels(base.as_deref(), &metallic);
                if is_dds {
                    let image = Image::from_rgba8(width, height, texels, "baked");
                    image
                        .map_or_else(|_| Vec::new(), |image| encode_dds(&image.with_mips(MapKind::Diffuse)))
                        .into()
                } else {
                    encode_png(&texels, width, height)?.into()
                }
            }
            Self::Plain(texel) => {
                let image = Image::from_rgba8(4, 4, texel.repeat(16), "plain");
                let bytes = image.map_or_else(|_| Vec::new(), |image| encode_dds(&image.with_mips(MapKind::Data)));
                bytes.into()
            }
        })
    }
}

/// Bytes of a name without its extension: systems take 255, of which a number, an extension and what is written beside need some.
const LONGEST_STEM: usize = 120;

/// The files of pictures that are to be written, each once, and their names.
#[derive(Default)]
pub(super) struct Names {
    pub(super) files: Vec<(String, Content)>,
    /// Names by the picture that they stand for, its use and its texels.
    names: HashMap<(String, MapSlot, Texels), String>,
    taken: Taken,
}

impl Names {
    /// The name of the file of a picture in a slot, with these texels.
    pub(super) fn name(
        &mut self,
        (picture, slot, texels): (&str, MapSlot, Texels),
        stem: &str,
        extension: &str,
        content: Content,
    ) -> String {
        let key = (picture.to_owned(), slot, texels);
        if let Some(name) = self.names.get(&key) {
            return name.clone();
        }
        let word = file_word(stem);
        let ending = match file_word(extension).as_str() {
            _ if extension.is_empty() => String::new(),
            extension => format!(".{extension}"),
        };
        let named = |number: u32| match number {
            1 => format!("{word}{ending}"),
            _ => format!("{word}_{number}{ending}"),
        };
        // Files are told apart without case on some systems.
        let name = named(self.taken.free(|number| named(number).to_lowercase()));
        self.files.push((name.clone(), content));
        self.names.insert(key, name.clone());
        name
    }
}

/// The last part of a path, without its extension.
pub(super) fn stem(name: &str) -> &str {
    let base = name.rsplit(['/', '\\']).next().unwrap_or(name).trim();
    base.rsplit_once('.').map_or(base, |(stem, _)| stem)
}

/// A word that every system takes as a file's name.
fn file_word(stem: &str) -> String {
    let is_kept = |letter: char| !letter.is_control() && !"<>:|?*/\\\u{22}".contains(letter);
    let word = one_word(&stem.replace(|letter| !is_kept(letter), "_"));
    let end = (0..=LONGEST_STEM.min(word.len()))
        .rev()
        .find(|&end| word.is_char_boundary(end));
    // A name of dots is a folder.
    let word = word[..end.unwrap_or_default()].trim_matches('.');
    let first = word.split('.').next().unwrap_or_default().to_ascii_lowercase();
    let is_device = matches!(
        first.as_bytes(),
        b"con" | b"prn" | b"aux" | b"nul" | [b'c', b'o', b'm', b'0'..=b'9'] | [b'l', b'p', b't', b'0'..=b'9']
    );
    match word {
        "" => "map".to_owned(),
        word if is_device => format!("_{word}"),
        word => word.to_owned(),
    }
}
