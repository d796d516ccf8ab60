//! Which dropped file is which map: by base name, at any depth, without case, then without extension.

use std::cmp::Reverse;
use std::collections::{BTreeSet, HashMap, HashSet};
use std::sync::Arc;

use serde::Serialize;

use crate::diagnostic::{Diagnostic, Subject, codes};
use crate::model::{MapSlot, Material};
use crate::sorting;

use super::files::File;

/// What became of one map of one material.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum MapSource {
    /// There is a file for it. Materials that give one name share what was found.
    Found(Arc<FoundMap>),
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
    /// Files of the same drop that fit the name as closely and lost by their folder or order, in the order of their merit.
    pub rivals: Vec<usize>,
}

/// The maps of one material.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MaterialMaps([MapSource; MapSlot::ALL.len()]);

impl MaterialMaps {
    /// What became of a slot.
    pub fn slot(&self, slot: MapSlot) -> &MapSource {
        &self.0[slot as usize]
    }
}

/// The maps of each material, in the order of the materials, as [`find_map`] finds them.
pub fn find_maps(materials: &[Material], files: &[File], drops: &[u32]) -> Vec<MaterialMaps> {
    let names = FileNames::new(files, drops);
    let mut known: HashMap<&str, MapSource> = HashMap::new();
    let mut maps = Vec::with_capacity(materials.len());
    for material in materials {
        let source = |slot: MapSlot| match material.map_name(slot) {
            None => MapSource::NoneNamed,
            Some(name) => {
                let find = || match names.find(name) {
                    Some(found) => MapSource::Found(Arc::new(found)),
                    None => MapSource::Missing(name.to_owned()),
                };
                known.entry(name).or_insert_with(find).clone()
            }
        };
        maps.push(MaterialMaps(MapSlot::ALL.map(source)));
    }
    maps
}

/// The picture that fits a name as a model gives it: a base name or a path, with `/` or `\`.
///
/// Only the base name counts, without case. A file with the extension of the name comes before one with another; of
/// several, the one that was dropped last, then the one that lies in the most folders that the name gives too, then the one
/// with the shortest path, then the first. `drops` has the number of the drop that each file came with; those that it does
/// not reach came first.
///
/// Looks at every file: [`find_maps`] is for many names.
pub fn find_map(name: &str, files: &[File], drops: &[u32]) -> Option<FoundMap> {
    FileNames::new(files, drops).find(name)
}

/// Pictures by their names.
struct FileNames<'a> {
    files: &'a [File],
    drops: &'a [u32],
    /// Indices by base name without its extension, in lower case.
    by_stem: HashMap<String, Vec<usize>>,
}

impl<'a> FileNames<'a> {
    fn new(files: &'a [File], drops: &'a [u32]) -> Self {
        let mut by_stem: HashMap<String, Vec<usize>> = HashMap::new();
        for (index, file) in files.iter().enumerate().filter(|(_, file)| file.is_image()) {
            let stem = stem(&base_name(&file.path)).to_owned();
            by_stem.entry(stem).or_default().push(index);
        }
        Self { files, drops, by_stem }
    }

    /// See [`find_map`].
    fn find(&self, name: &str) -> Option<FoundMap> {
        let wanted = parts(name);
        let base_name = wanted.first().filter(|base_name| !base_name.is_empty())?;
        let candidates = stems_that_fit(base_name).filter_map(|stem| self.by_stem.get(stem));
        let mut fitting: Vec<_> = candidates
            .flatten()
            .map(|&index| {
                let file = &self.files[index];
                let path = parts(&file.path);
                let is_exact = path.first() == Some(base_name);
                let common = path.iter().zip(&wanted).skip(1).take_while(|(a, b)| a == b).count();
                let drop = self.drops.get(index).copied().unwrap_or_default();
                let rank = (!is_exact, Reverse(drop));
                let merit = (rank, Reverse(common), path.len(), file.path.len());
                (merit, index)
            })
            .collect();
        sorting::sort(&mut fitting);
        let &((rank, ..), file) = fitting.first()?;
        let rivals = fitting.iter().skip(1);
        let rivals = rivals.take_while(|((other, ..), _)| *other == rank);
        Some(FoundMap {
            file,
            rivals: rivals.map(|&(_, index)| index).collect(),
        })
    }
}

/// The base names without extension that fit a base name in lower case: its own, and all of it, since a name that has no
/// extension may still have a dot.
fn stems_that_fit(base_name: &str) -> impl Iterator<Item = &str> {
    let stem = stem(base_name);
    std::iter::once(stem).chain((stem != base_name).then_some(base_name))
}

/// The names that maps go by, for whoever chooses files by their names before reading them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct MapNames {
    /// Base names without extension that fit one, in lower case.
    stems: HashSet<String>,
}

impl MapNames {
    /// Of all maps that the materials name.
    pub fn new(materials: &[Material]) -> Self {
        let base_names = named_maps(materials).map(|(.., name)| base_name(name));
        let stems = base_names
            .filter(|base_name| !base_name.is_empty())
            .flat_map(|base_name| stems_that_fit(&base_name).map(str::to_owned).collect::<Vec<_>>());
        Self { stems: stems.collect() }
    }

    /// Whether [`find_map`] can take a picture at this path for one of the names.
    pub fn fit(&self, path: &str) -> bool {
        self.stems.contains(stem(&base_name(path)))
    }
}

/// The maps that materials name, in the order of the materials, the diffuse map first: index of the material, slot, and name as the file
/// has it. [`Subject::Map`] counts them.
pub fn named_maps(materials: &[Material]) -> impl Iterator<Item = (usize, MapSlot, &str)> {
    materials.iter().enumerate().flat_map(|(index, material)| {
        let slots = MapSlot::ALL.into_iter();
        slots.filter_map(move |slot| Some((index, slot, material.map_name(slot)?)))
    })
}

/// How much of what the materials name is there. A name that several materials share counts once.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Checklist {
    /// How many names there are.
    pub named: usize,
    /// Names that no file fits, as the model has them, in alphabetical order.
    pub missing: Vec<String>,
    /// Names whose file could not be read, in the same order.
    pub unreadable: Vec<String>,
}

impl Checklist {
    /// What [`find_maps`] found for these materials, and which of the files that it found could be read.
    pub fn new(materials: &[Material], maps: &[MaterialMaps], is_readable: impl Fn(usize) -> bool) -> Self {
        let mut named = BTreeSet::new();
        let mut missing = BTreeSet::new();
        let mut unreadable = BTreeSet::new();
        for (material, maps) in materials.iter().zip(maps) {
            for slot in MapSlot::ALL {
                let Some(name) = material.map_name(slot) else { continue };
                named.insert(name);
                match maps.slot(slot).file() {
                    None => missing.extend([name]),
                    Some(file) if !is_readable(file) => unreadable.extend([name]),
                    Some(_) => {}
                }
            }
        }
        let list = |names: BTreeSet<&str>| names.into_iter().map(str::to_owned).collect();
        Self {
            named: named.len(),
            missing: list(missing),
            unreadable: list(unreadable),
        }
    }

    /// How many names have a file that could be read.
    pub fn found(&self) -> usize {
        self.named - self.missing.len() - self.unreadable.len()
    }
}

/// Names with more files than one, in the order of the materials.
pub fn map_diagnostics(materials: &[Material], files: &[File], maps: &[MaterialMaps]) -> Vec<Diagnostic> {
    let mut diagnostics = Vec::new();
    let path = |index: usize| files.get(index).map_or("", |file| file.path.as_str());
    for (number, (material, maps)) in materials.iter().zip(maps).enumerate() {
        for slot in MapSlot::ALL {
            let MapSource::Found(found) = maps.slot(slot) else {
                continue;
            };
            if found.rivals.is_empty() {
                continue;
            }
            let rivals = found.rivals.iter().map(|&index| path(index).to_owned());
            let (label, owner) = (slot.label(), &material.name);
            let (taken, left) = (path(found.file), spelt(rivals).join(", "));
            let message =
                format!("the {label} of material \"{owner}\" could be several files: {taken} is taken, not {left}");
            diagnostics.push(Diagnostic {
                subject: Some(Subject::Material(number as u32)),
                ..codes::MAP_AMBIGUOUS.says(message)
            });
        }
    }
    diagnostics
}

/// Names of files that a note spells out before it counts the rest.
const NAMES_SPELT: usize = 3;

/// The first names, and how many more there are.
fn spelt(mut names: impl ExactSizeIterator<Item = String>) -> Vec<String> {
    let mut spelt: Vec<String> = names.by_ref().take(NAMES_SPELT).collect();
    if names.len() > 0 {
        spelt.push(format!("{} more", names.len()));
    }
    spelt
}

/// A note about pictures that were dropped for a model that uses none of them, if there are any.
pub(in crate::session) fn unused_diagnostic(materials: &[Material], pictures: &[&File]) -> Option<Diagnostic> {
    let names = MapNames::new(materials);
    let fits_a_name = |picture: &File| picture.is_image() && names.fit(&picture.path);
    let (outdone, strange): (Vec<&File>, Vec<&File>) = pictures.iter().partition(|picture| fits_a_name(picture));
    let (named, of_one, of_many) = if strange.is_empty() {
        let because = "not used: there is a picture with the very name that the model gives.";
        (outdone, format!("is {because}"), format!("are {because}"))
    } else {
        let name = "no name of the model's maps.";
        (strange, format!("fits {name}"), format!("fit {name}"))
    };
    let spelt = spelt(named.iter().map(|picture| picture.base_name().to_owned()));
    let message = match spelt.as_slice() {
        [] => return None,
        [only] => format!("{only} {of_one}"),
        [others @ .., last] => format!("{} and {last} {of_many}", others.join(", ")),
    };
    Some(codes::MAP_UNUSED.says(message))
}

/// Last part of a path, in lower case.
fn base_name(path: &str) -> String {
    let path = path.trim();
    path.rsplit(['/', '\\']).next().unwrap_or(path).to_lowercase()
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
