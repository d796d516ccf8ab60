//! Pictures beside a file of the books: which there are, what they hold, and their names in its materials.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::sync::Arc;

use super::export_plan::ExportPlan;
use super::picture_files::{Content, Names, Texels, stem};
use crate::diagnostic::codes;
use crate::diagnostic::collect::counted;
use crate::edit::Change;
use crate::export::{self, Bake, Look, Loss, MapImages};
use crate::format::Dialect;
use crate::image::Image;
use crate::model::{Green, MapSlot, Material, MaterialMap, Model};
use crate::scene::map_kind;
use crate::session::open::files::File;

/// Slots that the books' materials have names for.
const SLOTS: [MapSlot; 2] = [MapSlot::Diffuse, MapSlot::Normal];

const MOST_TOLD: usize = 5;

/// What is known of the maps of a model that is to be written, by material and slot.
#[derive(Debug, Default)]
pub(in crate::session) struct KnownMaps {
    pub(in crate::session) images: BTreeMap<(usize, MapSlot), Arc<Image>>,
    /// The files that they came from.
    pub(in crate::session) pictures: BTreeMap<(usize, MapSlot), File>,
}

impl KnownMaps {
    pub(in crate::session) fn lent(&self) -> MapImages<'_> {
        self.images.iter().map(|(&place, image)| (place, &**image)).collect()
    }

    /// Maps of these slots whose files are there and cannot be read.
    pub(in crate::session) fn unreadable(&self, slots: &[MapSlot]) -> BTreeSet<(usize, MapSlot)> {
        let places = self.pictures.keys().filter(|place| slots.contains(&place.1));
        places
            .filter(|place| !self.images.contains_key(place))
            .copied()
            .collect()
    }
}

#[derive(Clone, Copy, Debug)]
pub(in crate::session) struct MapsAsked {
    /// Pictures are written beside the file. Otherwise names stay as they are.
    pub(in crate::session) are_written: bool,
    /// As DDS with mips, and one for each map that the books' demo opens.
    pub(in crate::session) for_book: bool,
    pub(in crate::session) dialect: Dialect,
    /// Green may point up, as in glTF, and is turned where its picture is written.
    pub(in crate::session) turns_green: bool,
}

/// Pictures that are to be written beside a file.
#[derive(Debug, Default)]
pub(in crate::session) struct MapFiles {
    /// The name of each and what it will hold.
    pub(in crate::session) waiting: Vec<(String, Content)>,
    /// What the materials look like, with the pictures that are written.
    pub(in crate::session) looks: Vec<Look>,
}

/// Names the pictures of a model's materials by the files that are to be written, and turns green and bitangents where glTF has them up and
/// the picture is written too. The books' demo opens maps of every material, so for it one without gets a white one and a flat one. What
/// has no picture keeps its name otherwise.
pub(in crate::session) fn plan_maps(
    model: &mut Model,
    known: &KnownMaps,
    asked: MapsAsked,
    plan: &mut ExportPlan,
) -> MapFiles {
    let turned = turn(model, known, asked, plan);
    let mut looks = export::looks(model, &known.lent());
    let mut files = Names::default();
    let (mut missing, mut added, mut is_flat) = (0, 0, vec![false; turned.len()]);
    for (material, &is_turned) in turned.iter().enumerate() {
        for slot in SLOTS {
            let named = model.materials[material].map_name(slot);
            let place = (material, slot);
            let bake = match slot {
                MapSlot::Diffuse if asked.are_written => looks[material].bake(asked.dialect),
                _ => None,
            };
            let found = (named, known.pictures.get(&place), known.images.get(&place));
            let is_missing = named.is_none() || asked.are_written && found.2.is_none();
            let has_plain = asked.are_written || asked.dialect == Dialect::D3d12;
            let is_plain = asked.for_book && bake.is_none() && is_missing && has_plain;
            is_flat[material] |= slot == MapSlot::Normal && (named.is_none() || is_plain);
            let mut sampling = model.materials[material]
                .map(slot)
                .map(|map| map.sampling)
                .unwrap_or_default();
            let name = match (bake, found) {
                (Some(bake), _) => {
                    sampling = bake.sampling;
                    files.baked((material, &model.materials[material]), bake, (known, asked))
                }
                _ if is_plain => {
                    missing += usize::from(named.is_some());
                    added += usize::from(named.is_none());
                    plain(slot, asked, &mut files)
                }
                (None, (Some(named), Some(file), image)) if asked.are_written => {
                    let texels = if is_turned && slot == MapSlot::Normal {
                        Texels::Turned
                    } else {
                        Texels::Same
                    };
                    let (extension, content) = content(file, image, (slot, texels), asked.for_book);
                    files.name((&file.path, slot, texels), stem(named), &extension, content)
                }
                _ => continue,
            };
            let material = &mut model.materials[material];
            let map = match slot {
                MapSlot::Normal => &mut material.normal_map,
                _ => &mut material.diffuse_map,
            };
            *map = Some(MaterialMap { name, sampling });
        }
    }
    if asked.for_book {
        straighten(model, &is_flat);
    }
    let unreadable = known.unreadable(&SLOTS);
    say_written(
        files.files.len(),
        [added, missing - unreadable.len().min(missing)],
        asked,
        plan,
    );
    if asked.are_written {
        plan.losses.extend(unreadable_maps(unreadable.len()));
    } else {
        say_unwritten(model, known, asked, plan);
    }
    say_looks(model, &looks, known, plan);
    MapFiles {
        waiting: files.files,
        looks,
    }
}

/// The name of a map of one colour that changes nothing: one that is written, else the one beside the DirectX 12 book's demo.
fn plain(slot: MapSlot, asked: MapsAsked, files: &mut Names) -> String {
    let (stem, texel, of_demo) = match slot {
        MapSlot::Normal => ("flat_normal", [128, 128, 255, 255], "default_nmap.dds"),
        _ => ("white", [255; 4], "white1x1.dds"),
    };
    if asked.are_written {
        files.name((stem, slot, Texels::Same), stem, "dds", Content::Plain(texel))
    } else {
        of_demo.to_owned()
    }
}

/// Gives vertices of materials without bumps the sign of tangents that the demo takes all to have.
fn straighten(model: &mut Model, is_flat: &[bool]) {
    let are_flat = model.vertices_of(|material| is_flat[material]);
    let mut tangents = model.mesh.tangents_or_computed().into_owned();
    for (tangent, is_flat) in tangents.iter_mut().zip(are_flat) {
        if is_flat {
            tangent.w = -1.0;
        }
    }
    model.mesh.tangents = tangents;
}

/// Says which materials have numbers that are means of pictures.
fn say_looks(model: &Model, looks: &[Look], known: &KnownMaps, plan: &mut ExportPlan) {
    let mapped = model.materials.iter().zip(looks).enumerate();
    let mapped = mapped.filter(|(_, (material, _))| material.metallic_roughness_map.is_some());
    let told: Vec<String> = mapped
        .map(|(index, (material, look))| {
            let is_there = known.images.contains_key(&(index, MapSlot::MetallicRoughness));
            let metallic = match (is_there, look.is_baked()) {
                (false, _) => "its picture cannot be read, so it is taken for no metal".to_owned(),
                (_, true) => "metalness is multiplied into its diffuse map".to_owned(),
                _ => format!("metalness is {:.2}", look.metallic),
            };
            format!("\"{}\": {metallic}, roughness is {:.2}", material.name, look.roughness)
        })
        .collect();
    let Some(first) = told.get(..told.len().min(MOST_TOLD)).filter(|first| !first.is_empty()) else {
        return;
    };
    let more = match told.len() - first.len() {
        0 => String::new(),
        more => format!("; and {} like these", counted(more, "material", "materials")),
    };
    plan.changes.push(Change {
        code: "metalness-from-picture",
        message: format!("Averages of pictures are written. {}{more}.", first.join("; ")),
    });
}

/// The loss of maps whose pictures are there and cannot be read.
pub(in crate::session) fn unreadable_maps(count: usize) -> Option<Loss> {
    let rest = "there and cannot be read; `check --textures` says why.";
    Loss::counted("maps-unreadable", count, ["map is", "maps are"], rest)
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
    let maps = ["normal map has", "normal maps have"];
    let rest = "green down, as the books have it, and the tangents' sign follows.";
    plan.changes
        .extend(Change::counted("normal-green-turned", pictures, maps, rest));
    let rest = "green up, as glTF has it, and no picture is written; the books have it down.";
    plan.losses.extend(Loss::counted("normal-green-up", kept, maps, rest));
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
            ("dds".to_owned(), Content::AsItIs(file.bytes.clone()))
        }
        Some(image) if for_book => (
            "dds".to_owned(),
            Content::Dds(Arc::clone(image), texels, map_kind(slot)),
        ),
        Some(image) if texels == Texels::Turned => ("png".to_owned(), Content::TurnedPng(Arc::clone(image))),
        _ => (file.extension(), Content::AsItIs(file.bytes.clone())),
    }
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
    let (count, message) = match asked.dialect {
        Dialect::D3d12 => {
            let others = names.flatten().filter(is_other).count();
            (others, "Maps are not named as DDS, which the demo needs.")
        }
        _ => {
            let none = names.filter(Option::is_none).count();
            (
                none,
                "Materials lack maps, and the demo opens two for each; `--textures-out` writes plain ones.",
            )
        }
    };
    if asked.for_book && count > 0 {
        plan.losses.push(Loss {
            code: codes::BOOK_MAP_FORMAT.name,
            message: message.to_owned(),
            count,
        });
    }
}

fn say_written(count: usize, [added, missing]: [usize; 2], asked: MapsAsked, plan: &mut ExportPlan) {
    let way = if asked.for_book { " as DDS with mips" } else { "" };
    plan.changes.extend(Change::counted(
        "maps-written",
        count,
        ["map is", "maps are"],
        &format!("written beside the file{way}."),
    ));
    plan.changes.extend(Change::counted(
        "maps-added",
        added,
        [
            "slot of a material without a map gets",
            "slots of materials without a map get",
        ],
        "a plain one, since the demo opens one for each.",
    ));
    plan.losses.extend(Loss::counted(
        codes::MAP_MISSING.name,
        missing,
        [
            "map is not found and replaced by a plain one,",
            "maps are not found and replaced by plain ones,",
        ],
        "since the demo opens them all.",
    ));
}

impl Names {
    /// The name of a diffuse map that is made of base colours and metalness.
    fn baked(
        &mut self,
        (index, material): (usize, &Material),
        bake: Bake,
        (known, asked): (&KnownMaps, MapsAsked),
    ) -> String {
        let slots = [MapSlot::Diffuse, MapSlot::MetallicRoughness];
        let [of_color, of_metal] = slots.map(|slot| known.pictures.get(&(index, slot)).map_or("", |file| &file.path));
        let picture = format!("{of_color}\n{of_metal}\n{bake:?}");
        let name = slots
            .into_iter()
            .find_map(|slot| material.map_name(slot))
            .unwrap_or_default();
        let [base, metallic] = slots.map(|slot| known.images.get(&(index, slot)).cloned());
        let Some(metallic) = metallic else { return String::new() };
        let extension = if asked.for_book { "dds" } else { "png" };
        let content = Content::Baked(Box::new(bake), base, metallic, asked.for_book);
        self.name(
            (&picture, MapSlot::Diffuse, Texels::Same),
            stem(name),
            extension,
            content,
        )
    }
}
