//! Folders with textures: [`Folders`] lists the pictures in them, [`Textures`] reads those that a model can use.

use std::collections::{HashMap, HashSet};
use std::fs;
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use super::diagnostic::write_diagnostic;
use super::failure::Failure;
use super::paths::{self, not_a_file};
use crate::diagnostic::{Code, Diagnostic, Severity, codes};
use crate::image;
use crate::model::{MapSlot, Material};
use crate::session::{self, File, FileKind, MapNames, MapSource, Maps, find_maps};

/// The most entries of folders that are looked at, so that a whole disk given by mistake does not take for ever.
const MOST_ENTRIES: usize = 500_000;

/// All pictures of folders and of the folders in them, by their names. None is read yet.
#[derive(Debug, Default)]
pub(super) struct Folders {
    pictures: Vec<PathBuf>,
    /// Pipes and devices with the name of a picture. Opening one could wait for ever.
    not_files: Vec<PathBuf>,
}

/// Pictures of folders, as far as a model names them.
#[derive(Debug, Default)]
pub(super) struct Textures {
    /// Flat pictures whose names fit a map.
    pub(super) pictures: Vec<File>,
    /// Pictures that no map's name fits. Their contents are not known.
    pub(super) unnamed: Vec<PathBuf>,
    /// Pictures whose names fit a map, but that the system does not let us read, or that are cube maps. They hold no bytes.
    unopened: Vec<File>,
    /// Why, in the same order.
    reasons: Vec<Diagnostic>,
    /// Where a picture lies, by the path that its [`File`] goes by.
    paths: HashMap<String, PathBuf>,
    /// Of [`Folders::not_files`] those whose names fit a map.
    pub(super) not_files: Vec<PathBuf>,
}

/// A map that a material names.
#[derive(Clone, Debug)]
pub(super) struct NamedMap<'a> {
    pub(super) material: &'a str,
    pub(super) slot: MapSlot,
    /// As the file has it.
    pub(super) name: &'a str,
    /// `None` when nobody looked for it.
    pub(super) state: Option<MapState<'a>>,
}

/// What became of a map.
#[derive(Clone, Debug)]
pub(super) enum MapState<'a> {
    Found(&'a Path),
    Missing,
    Unreadable(&'a Path, Box<Diagnostic>),
}

impl MapState<'_> {
    /// The word that outputs use.
    pub(super) fn as_str(&self) -> &'static str {
        match self {
            Self::Found(_) => "found",
            Self::Missing => "missing",
            Self::Unreadable(..) => "unreadable",
        }
    }
}

/// The maps that materials name, in the order of the materials. Nobody looked for them.
pub(super) fn named_maps(materials: &[Material]) -> impl Iterator<Item = NamedMap<'_>> {
    session::named_maps(materials).map(|(material, slot, name)| NamedMap {
        material: &materials[material].name,
        slot,
        name,
        state: None,
    })
}

impl Folders {
    /// Looks through folders, and tells what was skipped, a line each.
    ///
    /// # Errors
    /// When one of them cannot be read. All else that cannot be read is a warning.
    pub(super) fn walk(folders: &[PathBuf], err: &mut dyn Write) -> Result<Self, Failure> {
        let mut walk = Walk {
            most_entries: MOST_ENTRIES,
            ..Walk::default()
        };
        for folder in folders {
            walk.through(folder)?;
        }
        for (path, warning) in &walk.warnings {
            write_diagnostic(err, path, warning, None)?;
        }
        Ok(walk.found)
    }
}

impl Textures {
    /// Reads what the materials name.
    pub(super) fn of(folders: &Folders, materials: &[Material]) -> Self {
        let names = MapNames::new(materials);
        let mut textures = Self::default();
        let fits = |path: &&PathBuf| names.fit(&path.to_string_lossy());
        textures.not_files = folders.not_files.iter().filter(fits).cloned().collect();
        for path in &folders.pictures {
            let name = path.to_string_lossy();
            if !names.fit(&name) {
                textures.unnamed.push(path.clone());
                continue;
            }
            match paths::read_file(path) {
                Ok(bytes) if image::cube_side(&bytes).is_some() => textures.add_unopened(path, is_cube()),
                Ok(bytes) => {
                    let file = File::new(&name, bytes);
                    textures.paths.insert(file.path.clone(), path.clone());
                    textures.pictures.push(file);
                }
                Err(reason) => textures.add_unopened(path, unreadable(&reason)),
            }
        }
        textures
    }

    /// Adds a picture whose name fits a map, but that is none for it.
    fn add_unopened(&mut self, path: &Path, reason: Diagnostic) {
        let file = File::new(&path.to_string_lossy(), []);
        self.paths.insert(file.path.clone(), path.to_owned());
        self.unopened.push(file);
        self.reasons.push(reason);
    }

    /// What became of each map that the materials name. `maps` holds [`Textures::pictures`].
    pub(super) fn states<'a>(&'a self, materials: &'a [Material], maps: &'a Maps) -> Vec<NamedMap<'a>> {
        let unopened = find_maps(materials, &self.unopened, &[]);
        let unopened = |material: usize, slot| {
            let MapSource::Found(found) = unopened.get(material)?.slot(slot) else {
                return None;
            };
            let file = self.unopened.get(found.file)?;
            Some(MapState::Unreadable(
                self.path(file),
                Box::new(self.reasons.get(found.file)?.clone()),
            ))
        };
        let mut all: Vec<NamedMap<'a>> = named_maps(materials).collect();
        for (map, (material, slot, _)) in all.iter_mut().zip(session::named_maps(materials)) {
            map.state = Some(match (maps.file(material, slot), maps.diagnostic(material, slot)) {
                (Some(file), Some(diagnostic)) => MapState::Unreadable(self.path(file), Box::new(diagnostic.clone())),
                (Some(file), None) => MapState::Found(self.path(file)),
                (None, _) => unopened(material, slot).unwrap_or(MapState::Missing),
            });
        }
        all
    }

    /// Where a picture lies.
    pub(super) fn path<'a>(&'a self, file: &'a File) -> &'a Path {
        self.paths
            .get(&file.path)
            .map_or(Path::new(&file.path), PathBuf::as_path)
    }

    /// Tells what has the name of a map and was not opened, a line each.
    pub(super) fn write_warnings(&self, err: &mut dyn Write) -> io::Result<()> {
        let mut paths = self.not_files.iter();
        paths.try_for_each(|path| write_diagnostic(err, path, &not_a_file(), None))
    }

    /// Notes which of the other pictures are cube maps, a line each: the sky has an option of its own.
    pub(super) fn write_cubes(&self, err: &mut dyn Write) -> io::Result<()> {
        let note = Diagnostic {
            severity: Severity::Note,
            ..codes::MAP_IS_CUBE.says("This is a cube map; --sky takes it.".to_owned())
        };
        let mut cubes = self
            .unnamed
            .iter()
            .filter(|path| begins_like_cube(path).unwrap_or(false));
        cubes.try_for_each(|path| write_diagnostic(err, path, &note, None))
    }
}

/// Tells which maps are missing or cannot be read, a line for each name. `file` is the model's. Whether there are any.
pub(super) fn write_missing(err: &mut dyn Write, file: &Path, maps: &[NamedMap<'_>]) -> io::Result<bool> {
    let mut any = false;
    for (map, count) in by_name(maps) {
        let (path, diagnostic) = match &map.state {
            Some(MapState::Missing) => (file, missing(map, count)),
            Some(MapState::Unreadable(path, diagnostic)) => (*path, without_name(diagnostic, path)),
            Some(MapState::Found(_)) | None => continue,
        };
        any = true;
        write_diagnostic(err, path, &diagnostic, None)?;
    }
    Ok(any)
}

/// The first map of each name, in their order, and how many materials and slots have it.
pub(super) fn by_name<'m, 'a>(maps: &'m [NamedMap<'a>]) -> Vec<(&'m NamedMap<'a>, usize)> {
    let mut firsts: Vec<(&NamedMap<'a>, usize)> = Vec::new();
    let mut places = HashMap::new();
    for map in maps {
        let place = *places.entry(map.name).or_insert(firsts.len());
        match firsts.get_mut(place) {
            Some((_, count)) => *count += 1,
            None => firsts.push((map, 1)),
        }
    }
    firsts
}

/// That no file fits a map, which `count` materials and slots have.
pub(super) fn missing(map: &NamedMap<'_>, count: usize) -> Diagnostic {
    let NamedMap { material, name, .. } = map;
    let others = match count - 1 {
        0 => String::new(),
        1 => " and 1 other".to_owned(),
        others => format!(" and {others} others"),
    };
    let label = map.slot.label();
    warning(
        &codes::MAP_MISSING,
        format!("No file fits the {label} \"{name}\" of material \"{material}\"{others}."),
    )
}

/// A diagnostic about a picture without the name that its message begins with, since the path stands before it.
pub(super) fn without_name(diagnostic: &Diagnostic, path: &Path) -> Diagnostic {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let message = diagnostic.message.strip_prefix(&*name);
    let message = message.and_then(|message| message.strip_prefix(": "));
    Diagnostic {
        message: message.unwrap_or(&diagnostic.message).to_owned(),
        ..diagnostic.clone()
    }
}

/// A warning, whatever the code's usual severity: the user asked for the map.
fn warning(code: &Code, message: String) -> Diagnostic {
    Diagnostic {
        severity: Severity::Warning,
        ..code.says(message)
    }
}

/// Whether a picture is a cube map, by its beginning.
fn begins_like_cube(path: &Path) -> io::Result<bool> {
    let mut bytes = Vec::new();
    let mut header = fs::File::open(path)?.take(image::CUBE_HEADER_LEN as u64);
    header.read_to_end(&mut bytes)?;
    Ok(image::cube_side(&bytes).is_some())
}

/// That a cube map has the name of a map.
fn is_cube() -> Diagnostic {
    warning(
        &codes::MAP_IS_CUBE,
        "This is a cube map, and no picture for a material.".to_owned(),
    )
}

fn unreadable(reason: &io::Error) -> Diagnostic {
    warning(&codes::FILE_UNREADABLE, format!("The file cannot be read: {reason}."))
}

/// A walk through folders. Each folder is met once, however many links lead to it.
#[derive(Default)]
struct Walk {
    found: Folders,
    /// Folders that were met, without links in their paths.
    met: HashSet<PathBuf>,
    entries_met: usize,
    most_entries: usize,
    warnings: Vec<(PathBuf, Diagnostic)>,
}

/// What a folder lists.
struct Entry {
    path: PathBuf,
    is_link: bool,
}

/// What is told of a walk through a folder that meets no more than so many files and folders.
#[doc(hidden)]
pub fn walk_warnings(folder: &Path, most_entries: usize) -> Vec<(PathBuf, Diagnostic)> {
    let mut walk = Walk {
        most_entries,
        ..Walk::default()
    };
    let through = walk.through(folder);
    through.map_or_else(|_| Vec::new(), |()| walk.warnings)
}

impl Walk {
    fn through(&mut self, folder: &Path) -> Result<(), Failure> {
        let first = self.entries(folder).map_err(|reason| Failure::Unreadable {
            path: folder.to_owned(),
            reason,
        })?;
        let mut ahead = first;
        // Links to folders come last, so that a folder in this folder is met under its own name.
        let mut linked = Vec::new();
        loop {
            if let Some(entry) = ahead.pop() {
                if let Some(folder) = self.visit(entry) {
                    if folder.is_link {
                        linked.push(folder.path);
                    } else {
                        ahead.extend(self.entries_or_warning(&folder.path));
                    }
                }
            } else if let Some(folder) = linked.pop() {
                ahead = self.entries_or_warning(&folder);
            } else {
                break;
            }
        }
        if self.entries_met > self.most_entries {
            let most = self.most_entries;
            let message = format!("More than {most} files and folders were met; the others are skipped.");
            self.warn(folder.to_owned(), &codes::FOLDER_TOO_LARGE, message);
        }
        Ok(())
    }

    /// Adds a picture, or returns a folder to walk through.
    fn visit(&mut self, entry: Entry) -> Option<Entry> {
        let kind = match fs::metadata(&entry.path) {
            Ok(metadata) => metadata.file_type(),
            Err(reason) => {
                let (code, what) = if entry.is_link {
                    (&codes::LINK_BROKEN, "link cannot be followed")
                } else {
                    (&codes::FILE_UNREADABLE, "file cannot be read")
                };
                self.warn(entry.path, code, format!("The {what}: {reason}; skipped."));
                return None;
            }
        };
        if kind.is_dir() {
            return Some(entry);
        }
        let name = entry.path.to_string_lossy();
        let file = File::new(&name, []);
        if file.kind() == Some(FileKind::Unread) {
            let is_told = |(_, warning): &(_, Diagnostic)| warning.code == codes::IMAGE_UNRECOGNIZED.name;
            if !self.warnings.iter().any(is_told) {
                self.warn(entry.path.clone(), &codes::IMAGE_UNRECOGNIZED, file.unread_words());
            }
        }
        if !file.is_image() {
            return None;
        }
        let found = &mut self.found;
        let list = if kind.is_file() {
            &mut found.pictures
        } else {
            &mut found.not_files
        };
        list.push(entry.path);
        None
    }

    fn entries_or_warning(&mut self, folder: &Path) -> Vec<Entry> {
        self.entries(folder).unwrap_or_else(|reason| {
            let message = format!("The folder cannot be read: {reason}; skipped.");
            self.warn(folder.to_owned(), &codes::FOLDER_UNREADABLE, message);
            Vec::new()
        })
    }

    /// What is in a folder, the last first; nothing when the folder was met before.
    fn entries(&mut self, folder: &Path) -> io::Result<Vec<Entry>> {
        if !self.met.insert(fs::canonicalize(folder)?) {
            return Ok(Vec::new());
        }
        let mut entries = Vec::new();
        for entry in fs::read_dir(folder)? {
            let entry = entry?;
            self.entries_met += 1;
            if self.entries_met > self.most_entries {
                break;
            }
            entries.push(Entry {
                path: entry.path(),
                is_link: entry.file_type()?.is_symlink(),
            });
        }
        // Systems list folders in different orders. The choice between two pictures must not depend on that.
        entries.sort_by(|a, b| b.path.cmp(&a.path));
        Ok(entries)
    }

    fn warn(&mut self, path: PathBuf, code: &Code, message: String) {
        self.warnings.push((path, warning(code, message)));
    }
}
