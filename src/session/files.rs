//! Dropped files by name, as they came from one drop.

use std::collections::HashMap;
use std::sync::Arc;

use super::archive;
use crate::{image, import};

/// One file: where it lay relative to what was dropped, and its bytes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct File {
    /// Relative path with `/`, as the drop gave it: `soldier/soldier.m3d`.
    pub path: String,
    /// Its bytes.
    pub bytes: Arc<[u8]>,
}

impl File {
    /// A file with its path in one form: `/` between the parts, no leading `/` or `./`.
    pub fn new(path: &str, bytes: impl Into<Arc<[u8]>>) -> Self {
        let path = path.replace('\\', "/");
        let path = path.trim_start_matches("./").trim_start_matches('/');
        Self {
            path: path.to_owned(),
            bytes: bytes.into(),
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
    pub(super) fn unpacked(&self) -> Option<Result<Vec<Self>, String>> {
        if self.extension() != "zip" || !archive::begins_like_archive(&self.bytes) {
            return None;
        }
        let folder = self.path.strip_suffix(self.base_name()).unwrap_or_default();
        let files = archive::unpack(&self.bytes).map(|files| {
            let files = files.into_iter();
            files
                .map(|(path, bytes)| Self::new(&format!("{folder}{path}"), bytes))
                .collect()
        });
        Some(files)
    }

    /// Whether it is a picture by its name.
    pub fn is_image(&self) -> bool {
        IMAGE_EXTENSIONS.contains(&self.extension().as_str())
    }

    /// Whether it is a cube map, by its name and its first bytes.
    pub fn is_cube(&self) -> bool {
        self.is_image() && image::cube_side(&self.bytes).is_some()
    }
}

/// What a drop brought.
#[derive(Clone, Debug, Default)]
pub struct FileSet {
    files: Vec<File>,
    by_path: HashMap<String, usize>,
    /// See [`FileSet::models`].
    models: Vec<usize>,
}

/// Extensions of pictures that models name as their maps.
const IMAGE_EXTENSIONS: [&str; 7] = ["dds", "png", "jpg", "jpeg", "tga", "bmp", "hdr"];

/// Extensions of models.
const MODEL_EXTENSIONS: [&str; 3] = ["m3d", "glb", "gltf"];

impl FileSet {
    /// A set of these files, in their order. Of two files with one path the later is kept. The files in a `.zip` take its place; one that
    /// cannot be unpacked stays as it is.
    pub fn new(files: impl IntoIterator<Item = File>) -> Self {
        let mut set = Self::default();
        let unpacked = |file: File| match file.unpacked() {
            Some(Ok(files)) => files,
            _ => vec![file],
        };
        for file in files.into_iter().flat_map(unpacked) {
            match set.by_path.get(&file.path) {
                Some(&known) => set.files[known] = file,
                None => {
                    set.by_path.insert(file.path.clone(), set.files.len());
                    set.files.push(file);
                }
            }
        }
        set.models = models_among(&set.files);
        set
    }

    /// All files.
    pub fn files(&self) -> &[File] {
        &self.files
    }

    /// Files that are models by their name, the largest first. When there is none, any file that is no picture
    /// counts, so that a renamed model opens and any other file is told what it is; but beside pictures, which come with
    /// notes and sources, only one that begins like a model.
    pub fn models(&self) -> Vec<&File> {
        self.models.iter().map(|&index| &self.files[index]).collect()
    }

    /// One of its files, what that one names, and all pictures: what is needed to open that model again.
    pub(super) fn with_one_model(&self, model: &File) -> Self {
        let pictures = self.files.iter().filter(|file| file.is_image());
        let named = import::files_beside(&model.bytes);
        let named = named.iter().filter_map(|path| self.beside(model, path));
        Self::new(pictures.chain(named).chain([model]).cloned())
    }

    /// Flat pictures: those that a model can name.
    pub fn images(&self) -> impl Iterator<Item = &File> {
        self.files.iter().filter(|file| file.is_image() && !file.is_cube())
    }

    /// Cube maps: one of them is the sky.
    pub fn cubes(&self) -> impl Iterator<Item = &File> {
        self.files.iter().filter(|file| file.is_cube())
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

fn models_among(files: &[File]) -> Vec<usize> {
    let by_name = |wanted: fn(&File) -> bool| {
        let files = files.iter().enumerate().filter(|(_, file)| wanted(file));
        files.map(|(index, _)| index).collect::<Vec<_>>()
    };
    let mut models = by_name(|file| MODEL_EXTENSIONS.contains(&file.extension().as_str()));
    if models.is_empty() {
        models = by_name(|file| !file.is_image());
        if models.len() < files.len() {
            models.retain(|&index| import::begins_like_model(&files[index].bytes));
        }
    }
    models.sort_by_key(|&index| std::cmp::Reverse(files[index].bytes.len()));
    models
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(path: &str, len: usize) -> File {
        File::new(path, vec![0; len])
    }

    #[test]
    fn paths_have_one_form_and_names_are_their_last_part() {
        let file = file("\\media\\Soldier.M3D", 1);
        assert_eq!(
            (file.path.as_str(), file.base_name()),
            ("media/Soldier.M3D", "Soldier.M3D")
        );
        assert_eq!(file.extension(), "m3d");
        assert_eq!(File::new("./a", []).path, "a");
        assert_eq!(File::new("README", []).extension(), "");
    }

    #[test]
    fn models_come_largest_first_and_pictures_are_none() {
        let set = FileSet::new([
            file("a.m3d", 3),
            file("t/b.dds", 100),
            file("c.m3d", 9),
            file("notes.txt", 50),
        ]);
        assert_eq!(
            set.models().iter().map(|f| f.base_name()).collect::<Vec<_>>(),
            ["c.m3d", "a.m3d"]
        );
        assert_eq!(set.images().count(), 1);
    }

    #[test]
    fn without_a_model_by_name_anything_but_pictures_is_tried_and_beside_them_what_begins_like_one() {
        let names = |files: &[File]| {
            let set = FileSet::new(files.iter().cloned());
            set.models()
                .iter()
                .map(|f| f.base_name().to_owned())
                .collect::<Vec<_>>()
        };
        let model = File::new("model.txt", *b"***m3d-File-Header***\n#Materials 1\n");
        let (picture, notes) = (file("a.png", 3), file("notes.txt", 100));
        assert_eq!(names(&[notes.clone(), model.clone()]), ["notes.txt", "model.txt"]);
        assert_eq!(names(&[picture.clone(), notes.clone(), model]), ["model.txt"]);
        assert!(names(&[picture.clone(), notes]).is_empty());
        assert!(names(&[picture]).is_empty());
    }

    #[test]
    fn one_model_of_a_drop_keeps_the_pictures_of_the_drop() {
        let set = FileSet::new([
            file("a.m3d", 9),
            file("a.png", 3),
            file("b.m3d", 5),
            file("notes.txt", 2),
        ]);
        let kept = set.with_one_model(set.get("b.m3d").expect("it is there"));
        let names: Vec<_> = kept.files().iter().map(|file| file.base_name()).collect();
        assert_eq!(names, ["a.png", "b.m3d"]);
        assert_eq!(kept.models().len(), 1);
    }

    #[test]
    fn the_later_of_two_files_with_one_path_is_kept() {
        let set = FileSet::new([file("a.m3d", 3), file("a.m3d", 4)]);
        assert_eq!(set.files().len(), 1);
        assert_eq!(set.get("a.m3d").map(|f| f.bytes.len()), Some(4));
    }
}
