//! The maps of the open model: pictures that were dropped with it or later, and which material uses which.

use std::collections::{BTreeMap, HashMap, HashSet};
use std::sync::Arc;

use crate::diagnostic::{Diagnostic, Subject, codes};
use crate::image::{self, Image, MapKind};
use crate::model::{MapSlot, Material};
use crate::scene::map_kind;
use crate::slices::{Slices, Stage, at_once};

use super::files::File;
use super::textures::{Checklist, MaterialMaps, find_maps, map_diagnostics, unused_diagnostic};

/// Pictures, and what the materials make of them. Only pictures that a material names are decoded; of the others it is known
/// whether they could be.
#[derive(Clone, Debug, Default)]
pub struct Maps {
    pictures: Vec<File>,
    by_path: HashMap<String, usize>,
    /// For each picture the number of the drop that it came with.
    drops: Vec<u32>,
    decoded: Vec<Decoded>,
    last_drop: u32,
    /// Pictures that nobody has looked at yet, the next one last.
    waiting: Vec<usize>,
    of_materials: Vec<MaterialMaps>,
    /// Materials that each picture in use is for, and what for.
    users: BTreeMap<usize, Vec<(usize, MapSlot)>>,
    checklist: Checklist,
    diagnostics: Vec<Diagnostic>,
    without_mips: bool,
}

#[derive(Clone, Debug, Default)]
enum Decoded {
    /// Nobody has looked at it yet.
    #[default]
    New,
    /// No material names it.
    Unused,
    Images(ForSlots),
    Failed(Diagnostic),
}

/// A picture with its mips for each slot that it is used in, in the order of [`MapSlot::ALL`]: mips of colours and of directions
/// are made in different ways. A picture that needs none made is one for both.
type ForSlots = [Option<Arc<Image>>; MapSlot::ALL.len()];

impl Maps {
    /// Maps that are looked at but not drawn: no mips are made.
    pub fn without_mips() -> Self {
        Self {
            without_mips: true,
            ..Self::default()
        }
    }

    /// Adds pictures that came with the model of these materials, which may be another one than before. Those that are there
    /// already keep their turn: the drop may be one that was read again.
    pub fn add(&mut self, materials: &[Material], pictures: impl IntoIterator<Item = File>) {
        at_once(self.add_in(materials, pictures, &Slices::ENDLESS));
    }

    /// [`Maps::add`] in slices.
    pub(in crate::session) async fn add_in(
        &mut self,
        materials: &[Material],
        pictures: impl IntoIterator<Item = File>,
        slices: &Slices,
    ) {
        self.keep(pictures, false);
        self.find(materials);
        self.decode(materials, slices).await;
        self.conclude(materials);
    }

    /// The same pictures, none of them decoded.
    pub(in crate::session) fn undecoded(&self) -> Self {
        let mut maps = self.clone();
        for decoded in &mut maps.decoded {
            if matches!(decoded, Decoded::Images(_)) {
                *decoded = Decoded::New;
            }
        }
        maps
    }

    /// Adds pictures that were dropped by themselves, which take the place of all that fit a name no better. Where none of them
    /// is used, a note says so. Whether anything is used otherwise than before.
    pub(in crate::session) async fn join(
        &mut self,
        materials: &[Material],
        pictures: impl IntoIterator<Item = File>,
        slices: &Slices,
    ) -> bool {
        let (dropped, replaced) = self.keep(pictures, true);
        let changed = self.find(materials) || replaced;
        self.decode(materials, slices).await;
        self.conclude(materials);
        if !dropped.iter().any(|&index| self.is_used(index)) {
            let is_sound = |&&index: &&usize| matches!(self.decoded[index], Decoded::Unused);
            let unused: Vec<_> = dropped
                .iter()
                .filter(is_sound)
                .map(|&index| &self.pictures[index])
                .collect();
            self.diagnostics.extend(unused_diagnostic(materials, &unused));
        }
        changed
    }

    /// Takes back what was noted about the last drop alone, since another one came.
    pub(in crate::session) fn forget_unused(&mut self) {
        self.diagnostics
            .retain(|diagnostic| diagnostic.code != codes::MAP_UNUSED.name);
    }

    /// Keeps pictures as a drop of their own; one with a path that is there already takes its place. Their indices, and whether
    /// one that was used is another now.
    fn keep(&mut self, pictures: impl IntoIterator<Item = File>, are_latest: bool) -> (Vec<usize>, bool) {
        self.last_drop += 1;
        let mut indices = Vec::new();
        let mut changed = false;
        for picture in pictures {
            let known = self.by_path.get(&picture.path).copied();
            let index = known.unwrap_or(self.pictures.len());
            indices.push(index);
            if known.is_none() {
                self.by_path.insert(picture.path.clone(), index);
                self.pictures.push(picture);
                self.drops.push(self.last_drop);
                self.decoded.push(Decoded::New);
                continue;
            }
            if are_latest {
                self.drops[index] = self.last_drop;
            }
            if self.pictures[index].bytes != picture.bytes {
                changed |= self.is_used(index);
                self.pictures[index] = picture;
                self.decoded[index] = Decoded::New;
            }
        }
        (indices, changed)
    }

    /// Finds what the materials name. Whether it is different from before.
    fn find(&mut self, materials: &[Material]) -> bool {
        let found = find_maps(materials, &self.pictures, &self.drops);
        let before = std::mem::replace(&mut self.of_materials, found);
        self.users = users(&self.of_materials);
        for index in 0..self.pictures.len() {
            let is_used = self.is_used(index);
            let decoded = &mut self.decoded[index];
            match decoded {
                Decoded::Unused if is_used => *decoded = Decoded::New,
                Decoded::Images(_) if !is_used => *decoded = Decoded::Unused,
                _ => {}
            }
        }
        let is_waiting = |&index: &usize| match &self.decoded[index] {
            Decoded::New => true,
            Decoded::Images(images) => MapSlot::ALL
                .iter()
                .zip(images)
                .any(|(&slot, image)| image.is_none() && self.is_used_as(index, slot)),
            Decoded::Unused | Decoded::Failed(_) => false,
        };
        self.waiting = (0..self.pictures.len()).filter(is_waiting).rev().collect();
        before != self.of_materials
    }

    /// Decodes the pictures that materials name and makes their mips, and looks whether those could be decoded that nobody names.
    async fn decode(&mut self, materials: &[Material], slices: &Slices) {
        while let Some(index) = self.waiting.pop() {
            let all = self.pictures.len();
            slices
                .pause_at(Stage::Decoding, all - 1 - self.waiting.len(), all)
                .await;
            let picture = &self.pictures[index];
            let name = picture.base_name();
            let looked_at = if self.is_used(index) {
                match image::decode_in(&picture.bytes, name, slices).await {
                    Ok(image) => Ok(Decoded::Images(self.for_slots(index, image, materials, slices).await)),
                    Err(fault) => Err(fault),
                }
            } else {
                image::check(&picture.bytes, name).map(|()| Decoded::Unused)
            };
            self.decoded[index] = looked_at.unwrap_or_else(|fault| Decoded::Failed(*fault));
        }
    }

    /// A picture that was just decoded, for its slots. What is there of it stays.
    async fn for_slots(&self, index: usize, image: Image, materials: &[Material], slices: &Slices) -> ForSlots {
        let before = match &self.decoded[index] {
            Decoded::Images(images) => images.clone(),
            _ => ForSlots::default(),
        };
        let image = Arc::new(image);
        // Slots of one kind share one chain of mips.
        let mut of_kinds: [Option<Arc<Image>>; MapKind::ALL.len()] = Default::default();
        for (slot, image) in MapSlot::ALL.into_iter().zip(&before) {
            if let Some(image) = image {
                of_kinds[map_kind(slot) as usize] = Some(Arc::clone(image));
            }
        }
        let users = self.users.get(&index).map_or(&[][..], Vec::as_slice);
        let of_users = users.iter().filter(|(_, slot)| *slot == MapSlot::Diffuse);
        let cutoff = of_users
            .filter_map(|&(material, _)| materials[material].cutoff())
            .next();
        for kind in MapKind::ALL {
            let is_wanted = |&slot: &MapSlot| map_kind(slot) == kind && self.is_used_as(index, slot);
            let of_kind = &mut of_kinds[kind as usize];
            if of_kind.is_none() && MapSlot::ALL.iter().any(is_wanted) {
                slices.pause().await;
                let mipped = if self.without_mips {
                    None
                } else {
                    image.mipped_in(kind, cutoff, slices).await
                };
                *of_kind = Some(mipped.map_or_else(|| Arc::clone(&image), Arc::new));
            }
        }
        MapSlot::ALL.map(|slot| {
            let is_used = self.is_used_as(index, slot);
            let of_kind = is_used.then(|| of_kinds[map_kind(slot) as usize].clone()).flatten();
            of_kind.or_else(|| before[slot as usize].clone())
        })
    }

    /// Says what is missing and what could not be read, when all are decoded.
    fn conclude(&mut self, materials: &[Material]) {
        let could_be_read = |index: usize| matches!(self.decoded[index], Decoded::Images(_));
        self.checklist = Checklist::new(materials, &self.of_materials, could_be_read);
        // What is missing stands in the checklist; a list of findings that repeats it would hide the others.
        self.diagnostics = map_diagnostics(materials, &self.pictures, &self.of_materials);
        // Where a picture of the same name that could be read is used in its place, one that could not is of no interest.
        let name = |index: usize| self.pictures[index].base_name().to_lowercase();
        let read: HashSet<String> = self
            .users
            .keys()
            .copied()
            .filter(|&index| could_be_read(index))
            .map(name)
            .collect();
        let failed = (0..self.pictures.len()).filter_map(|index| match &self.decoded[index] {
            Decoded::Failed(diagnostic) if self.is_used(index) || !read.contains(&name(index)) => Some(Diagnostic {
                subject: self.first_user(index).map(Subject::Material),
                ..diagnostic.clone()
            }),
            _ => None,
        });
        self.diagnostics.extend(failed.collect::<Vec<_>>());
    }

    /// The first material that a picture is for.
    fn first_user(&self, index: usize) -> Option<u32> {
        let &(material, _) = self.users.get(&index)?.first()?;
        u32::try_from(material).ok()
    }

    fn is_used(&self, index: usize) -> bool {
        self.users.contains_key(&index)
    }

    fn is_used_as(&self, index: usize, slot: MapSlot) -> bool {
        let users = self.users.get(&index);
        users.is_some_and(|users| users.iter().any(|&(_, used_as)| used_as == slot))
    }

    /// All pictures, used or not.
    pub fn pictures(&self) -> &[File] {
        &self.pictures
    }

    /// The picture that was found for a material's map, whether it can be read or not.
    pub fn file(&self, material: usize, slot: MapSlot) -> Option<&File> {
        self.pictures.get(self.of_materials.get(material)?.slot(slot).file()?)
    }

    /// Why the picture that was found for a material's map cannot be read.
    pub fn diagnostic(&self, material: usize, slot: MapSlot) -> Option<&Diagnostic> {
        let file = self.of_materials.get(material)?.slot(slot).file()?;
        match self.decoded.get(file)? {
            Decoded::Failed(diagnostic) => Some(diagnostic),
            Decoded::New | Decoded::Unused | Decoded::Images(_) => None,
        }
    }

    /// The decoded picture of a material's map with its mips, when it is there and could be read.
    pub fn image(&self, material: usize, slot: MapSlot) -> Option<&Arc<Image>> {
        let file = self.of_materials.get(material)?.slot(slot).file()?;
        match self.decoded.get(file)? {
            Decoded::Images(images) => images.get(slot as usize)?.as_ref(),
            Decoded::New | Decoded::Unused | Decoded::Failed(_) => None,
        }
    }

    /// The decoded maps of each material, in the order of the materials and of [`MapSlot::ALL`]. One that stays is the same `Arc`.
    pub fn images(&self) -> impl Iterator<Item = [Option<&Arc<Image>>; MapSlot::ALL.len()]> {
        (0..self.of_materials.len()).map(|material| MapSlot::ALL.map(|slot| self.image(material, slot)))
    }

    /// Pictures that are used, with what they hold and which materials use them.
    pub fn used(&self) -> impl Iterator<Item = UsedMap<'_>> {
        self.users
            .iter()
            .filter_map(|(&index, users)| match &self.decoded[index] {
                Decoded::Images(images) => Some(UsedMap {
                    file: &self.pictures[index],
                    image: images.iter().flatten().next()?,
                    users,
                }),
                _ => None,
            })
    }

    /// Pictures that materials name but that could not be read.
    pub fn unreadable(&self) -> impl Iterator<Item = UnreadableMap<'_>> {
        self.users
            .iter()
            .filter_map(|(&index, users)| match &self.decoded[index] {
                Decoded::Failed(diagnostic) => Some(UnreadableMap {
                    file: &self.pictures[index],
                    diagnostic,
                    users,
                }),
                _ => None,
            })
    }

    /// How much of what the materials name is there.
    pub fn checklist(&self) -> &Checklist {
        &self.checklist
    }

    /// Pictures that could not be read, names that fit several files, and pictures of the last drop that fit none.
    pub fn diagnostics(&self) -> &[Diagnostic] {
        &self.diagnostics
    }
}

/// Materials that each picture is for, and what for, by the index of the picture.
fn users(of_materials: &[MaterialMaps]) -> BTreeMap<usize, Vec<(usize, MapSlot)>> {
    let mut users: BTreeMap<_, Vec<_>> = BTreeMap::new();
    for (material, maps) in of_materials.iter().enumerate() {
        for slot in MapSlot::ALL {
            if let Some(file) = maps.slot(slot).file() {
                users.entry(file).or_default().push((material, slot));
            }
        }
    }
    users
}

/// A picture that a material uses.
#[derive(Clone, Debug)]
pub struct UsedMap<'a> {
    /// Where it came from.
    pub file: &'a File,
    /// What it holds.
    pub image: &'a Arc<Image>,
    /// Materials by index, and what for.
    pub users: &'a [(usize, MapSlot)],
}

/// A picture that a material names and that could not be read.
#[derive(Clone, Debug)]
pub struct UnreadableMap<'a> {
    /// Where it came from.
    pub file: &'a File,
    /// What is wrong with it.
    pub diagnostic: &'a Diagnostic,
    /// Materials by index, and what for.
    pub users: &'a [(usize, MapSlot)],
}
