//! The maps of a model as picture files of their own, and their names in its materials.

use std::collections::{HashMap, HashSet};
use std::path::Path;

use super::failure::Failure;
use crate::diagnostic::codes;
use crate::edit::Change;
use crate::export::{Loss, one_word};
use crate::image::{Image, encode_dds, encode_png};
use crate::model::{MapSlot, MaterialMap, Model};
use crate::session::Maps;

/// A picture to write.
#[derive(Debug)]
pub(super) struct MapFile {
    /// Name in the folder.
    pub(super) name: String,
    pub(super) bytes: Vec<u8>,
}

/// Slots that a `.m3d` has names for.
const SLOTS: [MapSlot; 2] = [MapSlot::Diffuse, MapSlot::Normal];

/// Names the maps of diffuse and normal slots by files that are to be written: PNG, or for the books DDS with mips. The books' demo opens
/// maps of every material, so one without gets a white one and a flat one. What has no picture keeps its name, but for the books.
pub(super) fn name_maps(
    model: &mut Model,
    maps: &Maps,
    for_book: bool,
    changes: &mut Vec<Change>,
    losses: &mut Vec<Loss>,
) -> Result<Vec<MapFile>, Failure> {
    let extension = if for_book { "dds" } else { "png" };
    let mut files = Files::default();
    let (mut missing, mut added) = (0, 0);
    for material in 0..model.materials.len() {
        for slot in SLOTS {
            let named = model.materials[material].map_name(slot).is_some();
            let name = match (maps.file(material, slot), maps.image(material, slot)) {
                (Some(file), Some(image)) => {
                    let stem = Path::new(file.base_name())
                        .file_stem()
                        .unwrap_or_default()
                        .to_string_lossy();
                    files.name((&file.path, slot), &stem, extension, || {
                        if for_book {
                            Ok(dds(&file.bytes, image))
                        } else {
                            png(image)
                        }
                    })?
                }
                _ if for_book => {
                    missing += usize::from(named);
                    added += usize::from(!named);
                    let (stem, texel) = match slot {
                        MapSlot::Normal => ("flat_normal", [128, 128, 255, 255]),
                        _ => ("white", [255; 4]),
                    };
                    files.name((stem, slot), stem, extension, || Ok(plain(texel)))?
                }
                _ => continue,
            };
            let material = &mut model.materials[material];
            let map = match slot {
                MapSlot::Normal => &mut material.normal_map,
                _ => &mut material.diffuse_map,
            };
            let sampling = map.as_ref().map(|map| map.sampling).unwrap_or_default();
            *map = Some(MaterialMap { name, sampling });
        }
    }
    if !files.files.is_empty() {
        let count = files.files.len();
        changes.push(Change {
            code: "maps-written",
            message: format!(
                "{count} {} written as {}, and materials name {}.",
                if count == 1 { "map is" } else { "maps are" },
                extension.to_uppercase(),
                if count == 1 { "it" } else { "them" }
            ),
        });
    }
    if added > 0 {
        changes.push(Change {
            code: "maps-added",
            message: format!(
                "{added} slots of materials without a map get a plain one, since the demo opens one for each."
            ),
        });
    }
    if missing > 0 {
        losses.push(Loss {
            code: codes::MAP_MISSING.name,
            message: "Maps that were not found are replaced by plain ones, since the demo opens them all.".to_owned(),
            count: missing,
        });
    }
    Ok(files.files)
}

#[derive(Default)]
struct Files {
    files: Vec<MapFile>,
    /// Names by the picture that they stand for and its use.
    names: HashMap<(String, MapSlot), String>,
    taken: HashSet<String>,
}

impl Files {
    /// The name of a picture's file, which is made when it is first asked for.
    fn name(
        &mut self,
        (picture, slot): (&str, MapSlot),
        stem: &str,
        extension: &str,
        bytes: impl FnOnce() -> Result<Vec<u8>, Failure>,
    ) -> Result<String, Failure> {
        let key = (picture.to_owned(), slot);
        if let Some(name) = self.names.get(&key) {
            return Ok(name.clone());
        }
        let word = match one_word(stem) {
            word if word.is_empty() => "map".to_owned(),
            word => word,
        };
        let mut name = format!("{word}.{extension}");
        let mut number = 2;
        // Files are told apart without case on some systems.
        while !self.taken.insert(name.to_lowercase()) {
            name = format!("{word}_{number}.{extension}");
            number += 1;
        }
        self.files.push(MapFile {
            name: name.clone(),
            bytes: bytes()?,
        });
        self.names.insert(key, name.clone());
        Ok(name)
    }
}

fn png(image: &Image) -> Result<Vec<u8>, Failure> {
    let texels = image.to_rgba8(0, 0).unwrap_or_default();
    Ok(encode_png(&texels, image.width(), image.height())?)
}

/// A DDS file that has mips stays as it is.
fn dds(file: &[u8], image: &Image) -> Vec<u8> {
    if file.starts_with(b"DDS ") && (image.file_level_count() > 1 || image.level_count() == 1) {
        return file.to_vec();
    }
    encode_dds(image)
}

/// A picture of one colour.
fn plain(texel: [u8; 4]) -> Vec<u8> {
    let image = Image::from_rgba8(4, 4, texel.repeat(16), "plain");
    image.map_or_else(
        |_| Vec::new(),
        |image| encode_dds(&image.with_mips(crate::image::MapKind::Data)),
    )
}
