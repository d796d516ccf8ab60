//! Which dropped file is which map: by base name, at any depth, without case, then without extension.

use std::collections::BTreeSet;

use crate::diagnostic::{Diagnostic, Severity, Subject};
use crate::model::Material;

use super::files::File;

/// What a material uses a map for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum MapSlot {
    /// Colours, sRGB.
    Diffuse,
    /// Directions, linear.
    Normal,
}

impl MapSlot {
    /// Both, in the order in which panels list them.
    pub const ALL: [Self; 2] = [Self::Diffuse, Self::Normal];

    /// The word for people: `diffuse map`.
    pub fn label(self) -> &'static str {
        match self {
            Self::Diffuse => "diffuse map",
            Self::Normal => "normal map",
        }
    }

    /// The name that a material gives, when it gives one.
    pub fn name_in(self, material: &Material) -> Option<&str> {
        let name = match self {
            Self::Diffuse => &material.diffuse_map,
            Self::Normal => &material.normal_map,
        };
        name.as_deref().map(str::trim).filter(|name| !name.is_empty())
    }
}

/// What became of one map of one material.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum MapSource {
    /// There is a file for it.
    Found(FoundMap),
    /// No file fits the name, which is given as the model has it.
    Missing(String),
    /// The material names none.
    NoneNamed,
}

impl MapSource {
    /// Index of the file that was found.
    pub fn file(&self) -> Option<usize> {
        match self {
            Self::Found(found) => Some(found.file),
            Self::Missing(_) | Self::NoneNamed => None,
        }
    }
}

/// A file that fits a name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FoundMap {
    /// Its index among the files.
    pub file: usize,
    /// Files that fit the name as closely and lost by their folder or order, in the order of their merit.
    pub rivals: Vec<usize>,
}

/// The maps of one material.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MaterialMaps {
    /// Colours.
    pub diffuse: MapSource,
    /// Directions.
    pub normal: MapSource,
}

impl MaterialMaps {
    /// What became of a slot.
    pub fn slot(&self, slot: MapSlot) -> &MapSource {
        match slot {
            MapSlot::Diffuse => &self.diffuse,
            MapSlot::Normal => &self.normal,
        }
    }
}

/// The maps of each material, in the order of the materials.
pub fn find_maps(materials: &[Material], files: &[File]) -> Vec<MaterialMaps> {
    let source = |material, slot: MapSlot| match slot.name_in(material) {
        None => MapSource::NoneNamed,
        Some(name) => find_map(name, files).map_or_else(|| MapSource::Missing(name.to_owned()), MapSource::Found),
    };
    let maps = materials.iter().map(|material| MaterialMaps {
        diffuse: source(material, MapSlot::Diffuse),
        normal: source(material, MapSlot::Normal),
    });
    maps.collect()
}

/// The picture that fits a name as a model gives it: a base name or a path, with `/` or `\`.
///
/// Only the base name counts, without case. A file with the extension of the name comes before one with another; of
/// several, the one that lies in the most folders that the name gives too, then the one with the shortest path, then the
/// first.
pub fn find_map(name: &str, files: &[File]) -> Option<FoundMap> {
    let wanted = parts(name);
    let base_name = wanted.first().filter(|base_name| !base_name.is_empty())?;
    let fits_without_extension = |file: &String| {
        let file = stem(file);
        // A name that has no extension may still have a dot.
        file == stem(base_name) || file == base_name
    };
    let mut fitting: Vec<_> = files
        .iter()
        .enumerate()
        .filter(|(_, file)| file.is_image())
        .filter_map(|(index, file)| {
            let path = parts(&file.path);
            let file_name = path.first()?;
            let exact = file_name == base_name;
            (exact || fits_without_extension(file_name)).then(|| {
                let shared = path.iter().zip(&wanted).skip(1).take_while(|(a, b)| a == b).count();
                let merit = (!exact, std::cmp::Reverse(shared), path.len(), file.path.len());
                (merit, index)
            })
        })
        .collect();
    fitting.sort();
    let &((other_extension, ..), file) = fitting.first()?;
    let rivals = fitting.iter().skip(1);
    let rivals = rivals.take_while(|((other, ..), _)| *other == other_extension);
    Some(FoundMap {
        file,
        rivals: rivals.map(|&(_, index)| index).collect(),
    })
}

/// How much of what the materials name is there. A name that several materials share counts once.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Checklist {
    /// How many names there are.
    pub named: usize,
    /// Names that no file fits, as the model has them, in alphabetical order.
    pub missing: Vec<String>,
}

impl Checklist {
    /// What [`find_maps`] found for these materials.
    pub fn new(materials: &[Material], maps: &[MaterialMaps]) -> Self {
        let mut named = BTreeSet::new();
        let mut missing = BTreeSet::new();
        for (material, maps) in materials.iter().zip(maps) {
            for slot in MapSlot::ALL {
                named.extend(slot.name_in(material));
                if let MapSource::Missing(name) = maps.slot(slot) {
                    missing.insert(name.clone());
                }
            }
        }
        Self {
            named: named.len(),
            missing: missing.into_iter().collect(),
        }
    }
}

/// Names without a file, and names with more files than one, in the order of the materials.
pub fn map_notices(materials: &[Material], files: &[File], maps: &[MaterialMaps]) -> Vec<Diagnostic> {
    let mut notices = Vec::new();
    let path = |index: usize| files.get(index).map_or("", |file| file.path.as_str());
    for (number, (material, maps)) in materials.iter().zip(maps).enumerate() {
        let mut note = |code, message| {
            notices.push(Diagnostic {
                severity: Severity::Note,
                code,
                message,
                expected: None,
                found: None,
                position: None,
                length: 0,
                subject: Some(Subject::Material(number as u32)),
            });
        };
        for slot in MapSlot::ALL {
            let (label, owner) = (slot.label(), &material.name);
            match maps.slot(slot) {
                MapSource::Missing(name) => note(
                    "map-missing",
                    format!("no file fits the {label} \"{name}\" of material \"{owner}\""),
                ),
                MapSource::Found(found) if !found.rivals.is_empty() => {
                    let rivals: Vec<_> = found.rivals.iter().map(|&index| path(index)).collect();
                    let (taken, left) = (path(found.file), rivals.join(", "));
                    note(
                        "map-ambiguous",
                        format!(
                            "the {label} of material \"{owner}\" could be several files: {taken} is taken, not {left}"
                        ),
                    );
                }
                MapSource::Found(_) | MapSource::NoneNamed => {}
            }
        }
    }
    notices
}

/// Base name, then the folders from the innermost on, in lower case.
fn parts(path: &str) -> Vec<String> {
    let path = path.trim().to_lowercase();
    path.rsplit(['/', '\\']).map(str::to_owned).collect()
}

/// A base name without its extension.
fn stem(base_name: &str) -> &str {
    base_name.rsplit_once('.').map_or(base_name, |(stem, _)| stem)
}
