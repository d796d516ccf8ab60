//! Dropped files by name, as they came from one drop.

use std::collections::{HashMap, HashSet};

use super::archive;
use crate::slices::{Slices, Stage, at_once};
use crate::sorting;
use crate::{image, import};

/// One file: where it lay relative to what was dropped, and its bytes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct File {
    /// Relative path with `/`, as the drop gave it: `soldier/soldier.m3d`.
    pub path: String,
    /// Its bytes.
    pub bytes: bytes::Bytes,
}

impl File {
    /// A file with its path in one form: `/` between the parts, no leading `/` or `./`.
    pub fn new(path: &str, bytes: impl Into<Vec<u8>>) -> Self {
        Self::sharing(path, bytes.into().into())
    }

    /// The same of bytes that others have, too.
    pub fn sharing(path: &str, bytes: bytes::Bytes) -> Self {
        let path = path.replace('\\', "/");
        let path = path.trim_start_matches("./").trim_start_matches('/');
        Self {
            path: path.to_owned(),
            bytes,
        }
    }

    /// Last part of the path.
    pub fn base_name(&self) -> &str {
        self.path.rsplit('/').next().unwrap_or(&self.path)
    }

    /// What follows the last dot of the base name, in lower case; empty without a dot.
    pub fn extension(&self) -> String {
        self.base_name()
            .rsplit_once('.')
            .map(|(_, extension)| extension.to_ascii_lowercase())
            .unwrap_or_default()
    }

    /// The files in a `.zip`, as if its folder had been dropped, or why it cannot be unpacked; `None` for any other file.
    async fn unpacked(&self, slices: &Slices) -> Option<Result<Vec<Self>, String>> {
        if !self.is_archive() {
            return None;
        }
        let folder = self.path.strip_suffix(self.base_name()).unwrap_or_default();
        let files = archive::unpack(&self.bytes, slices).await.map(|files| {
            let files = files.into_iter();
            files
                .map(|(path, bytes)| Self::new(&format!("{folder}{path}"), bytes))
                .collect()
        });
        Some(files)
    }

    fn is_archive(&self) -> bool {
        self.kind() == Some(FileKind::Archive) && archive::begins_like_archive(&self.bytes)
    }

    /// What it is by its name; `None` where that says nothing.
    pub fn kind(&self) -> Option<FileKind> {
        let extension = self.extension();
        let is_of = |(_, extensions): &&(_, &[&str])| extensions.contains(&extension.as_str());
        FILE_KINDS.iter().find(is_of).map(|&(kind, _)| kind)
    }

    /// Whether it is a picture by its name.
    pub fn is_image(&self) -> bool {
        self.kind() == Some(FileKind::Picture)
    }

    /// Why a file of [`FileKind::Unread`] is not shown.
    pub(crate) fn unread_words(&self) -> String {
        format!(
            "{} cannot be read; a panorama as Radiance (.hdr) or a cube map as .dds can.",
            self.base_name()
        )
    }

    /// Whether it is a cube map or a panorama, by its name and its first bytes.
    pub fn is_cube(&self) -> bool {
        self.is_image() && image::cube_side(&self.bytes).is_some()
    }
}

/// What a drop brought.
#[derive(Clone, Debug, Default)]
pub struct FileSet {
    files: Vec<File>,
    by_path: HashMap<String, usize>,
    /// Why archives could not be unpacked, by their paths.
    damaged: HashMap<String, String>,
    /// See [`FileSet::models`].
    models: Vec<usize>,
    /// See [`FileSet::motions`].
    motions: Vec<usize>,
}

/// What a file is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileKind {
    Model,
    Archive,
    /// A map or a cube map.
    Picture,
    /// Data that a model names.
    Buffer,
    /// A model where it begins like one; else notes.
    Text,
    /// A picture of an environment, in a format that is not read.
    Unread,
}

/// The extensions of each kind. The page has the same table, in web/files.js.
pub const FILE_KINDS: [(FileKind, &[&str]); 6] = [
    (FileKind::Model, &["m3d", "glb", "gltf", "fbx"]),
    (FileKind::Archive, &["zip"]),
    (
        FileKind::Picture,
        &["dds", "png", "jpg", "jpeg", "webp", "tga", "bmp", "hdr"],
    ),
    (FileKind::Buffer, &["bin"]),
    (FileKind::Text, &["txt"]),
    (FileKind::Unread, &["exr"]),
];

impl FileSet {
    /// A set of these files, in their order. Of two files with one path the later is kept. The files in a `.zip` take its place; one that
    /// cannot be unpacked stays as it is.
    pub fn new(files: impl IntoIterator<Item = File>) -> Self {
        at_once(Self::new_in(files, &Slices::ENDLESS))
    }

    /// [`FileSet::new`] in slices.
    pub(in crate::session) async fn new_in(files: impl IntoIterator<Item = File>, slices: &Slices) -> Self {
        let files: Vec<File> = files.into_iter().collect();
        let size = |file: &File| if file.is_archive() { file.bytes.len() } else { 0 };
        let sizes: Vec<_> = files.iter().map(|file| (None, size(file))).collect();
        let of_each = slices.for_files(
            Stage::Unpacking..=Stage::Unpacking,
            Stage::Unpacking..=Stage::Unpacking,
            &sizes,
        );
        let mut all = Vec::new();
        let mut damaged = HashMap::new();
        for (file, slices) in files.into_iter().zip(&of_each) {
            match file.unpacked(slices).await {
                Some(Ok(files)) => {
                    all.extend(files);
                    continue;
                }
                Some(Err(reason)) => damaged.insert(file.path.clone(), reason),
                None => damaged.remove(&file.path),
            };
            all.push(file);
        }
        Self::of_unpacked(all, damaged)
    }

    fn of_unpacked(files: impl IntoIterator<Item = File>, damaged: HashMap<String, String>) -> Self {
        let mut set = Self {
            damaged,
            ..Self::default()
        };
        for file in files {
            match set.by_path.get(&file.path) {
                Some(&known) => set.files[known] = file,
                None => {
                    set.by_path.insert(file.path.clone(), set.files.len());
                    set.files.push(file);
                }
            }
        }
        (set.models, set.motions) = models_among(&set.files);
        set
    }

    /// Why one of its archives could not be unpacked.
    pub(in crate::session) fn damage(&self, file: &File) -> Option<&str> {
        self.damaged.get(&file.path).map(String::as_str)
    }

    /// All files.
    pub fn files(&self) -> &[File] {
        &self.files
    }

    /// Files that are models by their name, and texts that begin like one, the largest first. When there is none, any file that is no picture
    /// counts, so that a renamed model opens and any other file is told what it is; but beside pictures, which come with
    /// notes and sources, only one that begins like a model.
    pub fn models(&self) -> Vec<&File> {
        self.models.iter().map(|&index| &self.files[index]).collect()
    }

    /// Files with motions and nothing that they move, where there is a model besides: their clips join it.
    pub(in crate::session) fn motions(&self) -> Vec<&File> {
        self.motions.iter().map(|&index| &self.files[index]).collect()
    }

    /// One of its models, by its path.
    pub(in crate::session) fn model(&self, path: &str) -> Option<&File> {
        let index = self.by_path.get(path)?;
        self.models.contains(index).then(|| &self.files[*index])
    }

    /// A model of it and the data that it names: what is needed to read that model again.
    pub(in crate::session) fn needed_by(&self, model: &File) -> Self {
        let named = import::files_beside(&model.bytes);
        let named = named.iter().filter_map(|path| self.data_beside(model, path));
        Self::of_unpacked(named.chain([model]).cloned(), self.damaged.clone())
    }

    /// The same without some of its models.
    pub(in crate::session) fn without(&self, is_gone: impl Fn(&File) -> bool) -> Self {
        let (gone, left): (Vec<&File>, Vec<&File>) = self.models().into_iter().partition(|file| is_gone(file));
        let paths = |files: Vec<_>| -> HashSet<&str> { files.into_iter().map(|file: &File| &*file.path).collect() };
        let (gone, left) = (paths(gone), paths(left));
        let files = self.files.iter().filter(|file| !gone.contains(&*file.path));
        let mut set = Self::of_unpacked(files.cloned(), self.damaged.clone());
        // When the last model goes, no other file is taken for one.
        set.models.retain(|&index| left.contains(&*set.files[index].path));
        set
    }

    /// Flat pictures: those that a model can name.
    pub fn images(&self) -> impl Iterator<Item = &File> {
        self.files.iter().filter(|file| file.is_image() && !file.is_cube())
    }

    /// Cube maps and panoramas: one of them is the sky.
    pub fn cubes(&self) -> impl Iterator<Item = &File> {
        self.files.iter().filter(|file| file.is_cube())
    }

    /// Pictures of environments that cannot be read.
    pub fn unread(&self) -> impl Iterator<Item = &File> {
        self.files.iter().filter(|file| file.kind() == Some(FileKind::Unread))
    }

    /// What `from` names as [`FileSet::beside`] finds it, unless that is a picture: pictures are found by their names later.
    pub(in crate::session) fn data_beside(&self, from: &File, path: &str) -> Option<&File> {
        self.beside(from, path).filter(|file| !file.is_image())
    }

    /// The file that `from` names by a relative path: at that path, or else any of that base name.
    pub fn beside(&self, from: &File, path: &str) -> Option<&File> {
        let mut parts: Vec<&str> = from.path.split('/').collect();
        parts.pop();
        for part in path.split('/') {
            match part {
                "" | "." => {}
                ".." => {
                    parts.pop();
                }
                part => parts.push(part),
            }
        }
        let base_name = parts.last()?;
        let has_name = |file: &&File| file.base_name().eq_ignore_ascii_case(base_name);
        self.get(&parts.join("/")).or_else(|| self.files.iter().find(has_name))
    }

    /// The file with this path.
    pub fn get(&self, path: &str) -> Option<&File> {
        self.by_path.get(path).map(|&index| &self.files[index])
    }
}

/// Models, the largest first, and motions for them.
fn models_among(files: &[File]) -> (Vec<usize>, Vec<usize>) {
    let by_name = |wanted: fn(&File) -> bool| {
        let files = files.iter().enumerate().filter(|(_, file)| wanted(file));
        files.map(|(index, _)| index).collect::<Vec<_>>()
    };
    let mut models = by_name(|file| match file.kind() {
        Some(FileKind::Text) => import::begins_like_model(&file.bytes),
        kind => kind == Some(FileKind::Model),
    });
    if models.is_empty() {
        models = by_name(|file| !matches!(file.kind(), Some(FileKind::Picture | FileKind::Unread)));
        if models.len() < files.len() {
            models.retain(|&index| import::begins_like_model(&files[index].bytes));
        }
    }
    sorting::sort_by_key(&mut models, |&index| std::cmp::Reverse(files[index].bytes.len()));
    let (motions, others): (Vec<usize>, Vec<usize>) = models
        .iter()
        .partition(|&&index| import::is_motion(&files[index].bytes));
    if others.is_empty() {
        (motions, others)
    } else {
        (others, motions)
    }
}
