//! The maps of the open model: pictures that were dropped with it or later, and which material uses which.

use std::sync::Arc;

use crate::diagnostic::Diagnostic;
use crate::image::{self, Image};
use crate::model::Material;

use super::files::File;
use super::textures::{Checklist, MapSlot, MaterialMaps, find_maps, map_notices};

/// Pictures, and what the materials make of them. Only pictures that a material names are decoded.
#[derive(Debug, Default)]
pub struct Maps {
    pictures: Vec<File>,
    decoded: Vec<Decoded>,
    of_materials: Vec<MaterialMaps>,
    checklist: Checklist,
    notices: Vec<Diagnostic>,
}

/// What became of a picture.
#[derive(Clone, Debug, Default)]
enum Decoded {
    /// No material names it.
    #[default]
    Unused,
    Image(Arc<Image>),
    Failed(Diagnostic),
}

impl Maps {
    /// Finds and decodes what the materials name among these pictures.
    pub fn new(materials: &[Material], pictures: Vec<File>) -> Self {
        let mut maps = Self {
            decoded: vec![Decoded::Unused; pictures.len()],
            pictures,
            ..Self::default()
        };
        maps.find(materials);
        maps
    }

    /// Adds pictures; one with a path that is there already takes its place. Whether anything is used otherwise than before.
    pub fn add(&mut self, materials: &[Material], pictures: impl IntoIterator<Item = File>) -> bool {
        let mut changed = false;
        for picture in pictures {
            match self.pictures.iter().position(|known| known.path == picture.path) {
                Some(known) if self.pictures[known].bytes == picture.bytes => {}
                Some(known) => {
                    changed |= !matches!(self.decoded[known], Decoded::Unused);
                    self.pictures[known] = picture;
                    self.decoded[known] = Decoded::Unused;
                }
                None => {
                    self.pictures.push(picture);
                    self.decoded.push(Decoded::Unused);
                }
            }
        }
        let before = std::mem::take(&mut self.of_materials);
        self.find(materials);
        changed || before != self.of_materials
    }

    fn find(&mut self, materials: &[Material]) {
        self.of_materials = find_maps(materials, &self.pictures);
        self.checklist = Checklist::new(materials, &self.of_materials);
        let used: Vec<usize> = self
            .of_materials
            .iter()
            .flat_map(|maps| MapSlot::ALL.map(|slot| maps.slot(slot).file()))
            .flatten()
            .collect();
        for index in used {
            let picture = &self.pictures[index];
            if matches!(self.decoded[index], Decoded::Unused) {
                self.decoded[index] = match image::decode(&picture.bytes, picture.base_name()) {
                    Ok(image) => Decoded::Image(Arc::new(image)),
                    Err(error) => Decoded::Failed(error.diagnostic()),
                };
            }
        }
        // What is missing stands in the checklist; a list of findings that repeats it would hide the others.
        let ambiguous = map_notices(materials, &self.pictures, &self.of_materials);
        self.notices = ambiguous
            .into_iter()
            .filter(|notice| notice.code == "map-ambiguous")
            .collect();
        self.notices
            .extend(self.decoded.iter().filter_map(|decoded| match decoded {
                Decoded::Failed(diagnostic) => Some(diagnostic.clone()),
                Decoded::Unused | Decoded::Image(_) => None,
            }));
    }

    /// All pictures, used or not.
    pub fn pictures(&self) -> &[File] {
        &self.pictures
    }

    /// The decoded picture of a material's map, when it is there and could be read.
    pub fn image(&self, material: usize, slot: MapSlot) -> Option<&Image> {
        let file = self.of_materials.get(material)?.slot(slot).file()?;
        match self.decoded.get(file)? {
            Decoded::Image(image) => Some(image),
            Decoded::Unused | Decoded::Failed(_) => None,
        }
    }

    /// The decoded diffuse and normal map of each material, in the order of the materials.
    pub fn images(&self) -> impl Iterator<Item = [Option<&Image>; 2]> {
        (0..self.of_materials.len()).map(|material| MapSlot::ALL.map(|slot| self.image(material, slot)))
    }

    /// Pictures that are used, with what they hold and which materials use them.
    pub fn used(&self) -> impl Iterator<Item = UsedMap<'_>> {
        self.pictures
            .iter()
            .zip(&self.decoded)
            .enumerate()
            .filter_map(|(index, (file, decoded))| {
                let Decoded::Image(image) = decoded else { return None };
                let users = self.of_materials.iter().enumerate().flat_map(move |(material, maps)| {
                    MapSlot::ALL
                        .into_iter()
                        .filter(move |slot| maps.slot(*slot).file() == Some(index))
                        .map(move |slot| (material, slot))
                });
                Some(UsedMap {
                    file,
                    image,
                    users: users.collect(),
                })
            })
    }

    /// How much of what the materials name is there.
    pub fn checklist(&self) -> &Checklist {
        &self.checklist
    }

    /// Pictures that could not be read, and names that fit several files.
    pub fn notices(&self) -> &[Diagnostic] {
        &self.notices
    }
}

/// A picture that a material uses.
#[derive(Clone, Debug)]
pub struct UsedMap<'a> {
    /// Where it came from.
    pub file: &'a File,
    /// What it holds.
    pub image: &'a Image,
    /// Materials by index, and what for.
    pub users: Vec<(usize, MapSlot)>,
}
