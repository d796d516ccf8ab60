//! Pictures beside a file of the books: which there are, what they hold, and their names in its materials.

use std::collections::{BTreeMap, HashMap, HashSet, VecDeque};
use std::path::Path;
use std::sync::Arc;

use super::export_plan::ExportPlan;
use super::files::File;
use crate::diagnostic::codes;
use crate::diagnostic::collect::counted;
use crate::edit::Change;
use crate::export::{ExportError, Loss, directions, one_word};
use crate::image::{Channels, Image, MapKind, encode_dds, encode_png};
use crate::model::{Green, MapSlot, MaterialMap, Model};
use crate::scene::map_kind;

/// Slots that the books' materials have names for.
const SLOTS: [MapSlot; 2] = [MapSlot::Diffuse, MapSlot::Normal];

/// What is known of the maps of a model that is to be written, by material and slot.
#[derive(Debug, Default)]
pub(super) struct KnownMaps {
    /// Decoded pictures.
    pub(super) images: BTreeMap<(usize, MapSlot), Arc<Image>>,
    /// The files that they came from.
    pub(super) pictures: BTreeMap<(usize, MapSlot), File>,
}

/// What becomes of the maps.
#[derive(Clone, Copy, Debug)]
pub(super) struct MapsAsked {
    /// Pictures are written beside the file. Otherwise names stay as they are.
    pub(super) are_written: bool,
    /// As DDS with mips, and one for each map that the books' demo opens.
    pub(super) for_book: bool,
    /// The demo is of the book that reads DDS alone.
    pub(super) only_dds: bool,
    /// Green may point up, as in glTF, and is turned where its picture is written.
    pub(super) turns_green: bool,
}

/// Pictures on their way to their files.
#[derive(Debug, Default)]
pub(super) struct MapFiles {
    waiting: VecDeque<(String, Content)>,
    pub(super) made: Vec<(String, Arc<[u8]>)>,
}

/// What a file is made of.
#[derive(Debug)]
enum Content {
    AsItIs(Arc<[u8]>),
    /// Directions with green the other way.
    TurnedPng(Arc<Image>),
    Dds(Arc<Image>, Texels, MapKind),
    /// One colour.
    Plain([u8; 4]),
}

/// Which texels of a picture are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Texels {
    Same,
    /// Directions alone, with green the other way.
    Turned,
}

impl MapFiles {
    /// How many files are made, and how many are waiting.
    pub(super) fn progress(&self) -> [usize; 2] {
        [self.made.len(), self.waiting.len()]
    }

    /// How many files there are or will be.
    pub(super) fn count(&self) -> usize {
        self.made.len() + self.waiting.len()
    }

    /// Makes the next file. Whether there was one.
    pub(super) fn make_next(&mut self) -> Result<bool, ExportError> {
        let Some((name, content)) = self.waiting.pop_front() else {
            return Ok(false);
        };
        self.made.push((name, content.bytes()?));
        Ok(true)
    }
}

impl Content {
    fn bytes(self) -> Result<Arc<[u8]>, ExportError> {
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
            Self::Plain(texel) => {
                let image = Image::from_rgba8(4, 4, texel.repeat(16), "plain");
                let bytes = image.map_or_else(|_| Vec::new(), |image| encode_dds(&image.with_mips(MapKind::Data)));
                bytes.into()
            }
        })
    }
}

/// Names the pictures of a model's materials by the files that are to be written, and turns green and bitangents where glTF has them up and
/// the picture is written too. The books' demo opens maps of every material, so for it one without gets a white one and a flat one. What
/// has no picture keeps its name otherwise.
pub(super) fn plan_maps(model: &mut Model, known: &KnownMaps, asked: MapsAsked, plan: &mut ExportPlan) -> MapFiles {
    let turned = turn(model, known, asked, plan);
    if !asked.are_written {
        say_unwritten(model, known, asked, plan);
        return MapFiles::default();
    }
    let mut files = Names::default();
    let (mut missing, mut added) = (0, 0);
    for (material, &is_turned) in turned.iter().enumerate() {
        for slot in SLOTS {
            let named = model.materials[material].map_name(slot);
            let place = (material, slot);
            let name = match (named, known.pictures.get(&place), known.images.get(&place)) {
                (Some(named), Some(file), image) if image.is_some() || !asked.for_book => {
                    let texels = if is_turned && slot == MapSlot::Normal {
                        Texels::Turned
                    } else {
                        Texels::Same
                    };
                    let (extension, content) = content(file, image, (slot, texels), asked.for_book);
                    files.name((&file.path, slot, texels), stem(named), &extension, content)
                }
                (named, ..) if asked.for_book => {
                    missing += usize::from(named.is_some());
                    added += usize::from(named.is_none());
                    let (stem, texel) = match slot {
                        MapSlot::Normal => ("flat_normal", [128, 128, 255, 255]),
                        _ => ("white", [255; 4]),
                    };
                    files.name((stem, slot, Texels::Same), stem, "dds", Content::Plain(texel))
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
    say_written(files.files.len(), [added, missing], asked, plan);
    MapFiles {
        waiting: files.files,
        made: Vec::new(),
    }
}

/// Turns the bitangents of materials whose green points up, where no picture that is left as it is says otherwise. Whether each is turned.
fn turn(model: &mut Model, known: &KnownMaps, asked: MapsAsked, plan: &mut ExportPlan) -> Vec<bool> {
    let mut turned = vec![false; model.materials.len()];
    if !asked.turns_green {
        return turned;
    }
    let (mut pictures, mut kept) = (0, 0);
    for (material, green) in model.greens().into_iter().enumerate() {
        if green != Some(Green::Up) {
            continue;
        }
        let has_map = model.materials[material].normal_map.is_some();
        let is_read = has_map && known.images.contains_key(&(material, MapSlot::Normal));
        // A flat picture takes the place of one that is missing.
        let is_written = is_read && asked.are_written;
        turned[material] = !has_map || is_written || (asked.for_book && asked.are_written);
        pictures += usize::from(is_written);
        kept += usize::from(!turned[material]);
    }
    model.turn_bitangents(|material| turned[material]);
    if pictures > 0 {
        plan.changes.push(Change {
            code: "normal-green-turned",
            message: format!(
                "{} green down, as the books have it, and the tangents' sign follows.",
                counted(pictures, "normal map has", "normal maps have")
            ),
        });
    }
    if kept > 0 {
        plan.losses.push(Loss {
            code: "normal-green-up",
            message: format!(
                "{} green up, as glTF has it, and no picture is written; the books have it down.",
                counted(kept, "normal map has", "normal maps have")
            ),
            count: kept,
        });
    }
    turned
}

/// A file's extension and content. One that needs no other texels stays as it is, for the books if it is DDS with mips; so does one that
/// cannot be read.
fn content(
    file: &File,
    image: Option<&Arc<Image>>,
    (slot, texels): (MapSlot, Texels),
    for_book: bool,
) -> (String, Content) {
    let has_mips = |image: &Image| image.file_level_count() > 1 || image.level_size(0) == (1, 1);
    match image {
        Some(image) if for_book && file.bytes.starts_with(b"DDS ") && texels == Texels::Same && has_mips(image) => {
            ("dds".to_owned(), Content::AsItIs(Arc::clone(&file.bytes)))
        }
        Some(image) if for_book => (
            "dds".to_owned(),
            Content::Dds(Arc::clone(image), texels, map_kind(slot)),
        ),
        Some(image) if texels == Texels::Turned => ("png".to_owned(), Content::TurnedPng(Arc::clone(image))),
        _ => (file.extension(), Content::AsItIs(Arc::clone(&file.bytes))),
    }
}

/// The last part of a path, without its extension.
fn stem(name: &str) -> &str {
    let base = name.rsplit(['/', '\\']).next().unwrap_or(name).trim();
    base.rsplit_once('.').map_or(base, |(stem, _)| stem)
}

/// Says which maps that lie inside the input are named alone, and which the demo does not read.
fn say_unwritten(model: &Model, known: &KnownMaps, asked: MapsAsked, plan: &mut ExportPlan) {
    let inside = known.pictures.keys().filter(|(_, slot)| SLOTS.contains(slot)).count();
    if inside > 0 {
        plan.losses.push(Loss {
            code: "maps-not-written",
            message: "Maps of the input are named and not written.".to_owned(),
            count: inside,
        });
    }
    let names = model
        .materials
        .iter()
        .flat_map(|material| SLOTS.map(|slot| material.map_name(slot)));
    let is_other = |name: &&str| {
        Path::new(name)
            .extension()
            .is_none_or(|extension| !extension.eq_ignore_ascii_case("dds"))
    };
    let others = names.flatten().filter(is_other).count();
    if asked.for_book && asked.only_dds && others > 0 {
        plan.losses.push(Loss {
            code: codes::BOOK_MAP_FORMAT.name,
            message: "Maps are not named as DDS, which the demo needs.".to_owned(),
            count: others,
        });
    }
}

fn say_written(count: usize, [added, missing]: [usize; 2], asked: MapsAsked, plan: &mut ExportPlan) {
    if count > 0 {
        let way = if asked.for_book { " as DDS with mips" } else { "" };
        plan.changes.push(Change {
            code: "maps-written",
            message: format!(
                "{} beside the file{way}.",
                counted(count, "map is written", "maps are written")
            ),
        });
    }
    if added > 0 {
        plan.changes.push(Change {
            code: "maps-added",
            message: format!(
                "{} without a map {} a plain one, since the demo opens one for each.",
                counted(added, "slot of a material", "slots of materials"),
                if added == 1 { "gets" } else { "get" }
            ),
        });
    }
    if missing > 0 {
        plan.losses.push(Loss {
            code: codes::MAP_MISSING.name,
            message: format!(
                "{} not found and replaced by {}, since the demo opens them all.",
                counted(missing, "map is", "maps are"),
                if missing == 1 { "a plain one" } else { "plain ones" }
            ),
            count: missing,
        });
    }
}

#[derive(Default)]
struct Names {
    files: VecDeque<(String, Content)>,
    /// Names by the picture that they stand for, its use and its texels.
    names: HashMap<(String, MapSlot, Texels), String>,
    taken: HashSet<String>,
}

impl Names {
    /// The name of a picture's file.
    fn name(
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
        // A name of dots is a folder.
        let word = match one_word(&stem.replace(':', "_")).trim_matches('.') {
            "" => "map".to_owned(),
            word => word.to_owned(),
        };
        let ending = if extension.is_empty() {
            String::new()
        } else {
            format!(".{extension}")
        };
        let mut name = format!("{word}{ending}");
        let mut number = 2;
        // Files are told apart without case on some systems.
        while !self.taken.insert(name.to_lowercase()) {
            name = format!("{word}_{number}{ending}");
            number += 1;
        }
        self.files.push_back((name.clone(), content));
        self.names.insert(key, name.clone());
        name
    }
}
