//! The maps of a model as findings: those that are missing, unreadable, or named by no material.

use std::collections::HashMap;
use std::path::Path;

use crate::cli::paths::not_a_file;
use crate::cli::text::counted;
use crate::cli::textures::{Folders, MapState, Textures, by_name, missing, without_name};
use crate::diagnostic::{Diagnostic, Subject, codes};
use crate::import::Imported;
use crate::session::{File, Maps};

/// What looking for maps gives.
pub(super) struct FoundMaps {
    pub(super) diagnostics: Vec<Diagnostic>,
    /// Names without a file, each once.
    pub(super) missing: Vec<String>,
}

/// Looks for the maps that the materials of a file name. `is_only`: no other file is read, so that pictures without a name are worth a word.
pub(super) fn find(imported: &Imported, folders: &Folders, is_only: bool) -> FoundMaps {
    let materials = imported.model.materials.as_slice();
    let mut textures = Textures::of(folders, materials);
    let mut maps = Maps::without_mips();
    let pictures = std::mem::take(&mut textures.pictures).into_iter();
    let own = imported
        .pictures
        .iter()
        .map(|picture| File::sharing(&picture.name, picture.bytes.clone()));
    maps.add(materials, pictures.chain(own));
    let states = textures.states(materials, &maps);
    let mut diagnostics = Vec::new();
    let mut absent = Vec::new();
    let mut indices = HashMap::new();
    for (index, map) in (0..).zip(&states) {
        indices.entry(map.name).or_insert(index);
    }
    // A name that several materials have is told once, with the first.
    for (map, users) in by_name(&states) {
        let diagnostic = match &map.state {
            Some(MapState::Missing) => {
                absent.push(map.name.to_owned());
                missing(map, users)
            }
            Some(MapState::Unreadable(path, diagnostic)) => named(path, &without_name(diagnostic, path)),
            Some(MapState::Found(_)) | None => continue,
        };
        diagnostics.push(Diagnostic {
            subject: indices.get(map.name).copied().map(Subject::Map),
            ..diagnostic
        });
    }
    let is_ambiguous = |diagnostic: &&Diagnostic| diagnostic.code == codes::MAP_AMBIGUOUS.name;
    diagnostics.extend(maps.diagnostics().iter().filter(is_ambiguous).cloned());
    diagnostics.extend(textures.not_files.iter().map(|path| named(path, &not_a_file())));
    if is_only && let Some(first) = textures.unnamed.first() {
        let first = File::new(&first.to_string_lossy(), []);
        let others = match textures.unnamed.len() - 1 {
            0 => String::new(),
            others => format!(" and {}", counted(others, "other picture")),
        };
        diagnostics.push(Diagnostic {
            count: u32::try_from(textures.unnamed.len()).unwrap_or(u32::MAX),
            ..codes::MAP_UNUSED.says(format!("No material names {}{others}.", first.base_name()))
        });
    }
    FoundMaps {
        diagnostics,
        missing: absent,
    }
}

/// A diagnostic about a picture, with its path in the message: what stands before it is the model's.
fn named(path: &Path, diagnostic: &Diagnostic) -> Diagnostic {
    Diagnostic {
        message: format!("{}: {}", path.display(), diagnostic.message),
        ..diagnostic.clone()
    }
}
