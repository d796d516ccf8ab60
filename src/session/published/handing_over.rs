//! What another viewer needs to go on with all that this one has open: files, edits, and how it is looked at.

use std::sync::Arc;

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::link::Linked;
use crate::import;
use crate::model::{Material, SavedNames};
use crate::session::open::content::Opened;
use crate::session::open::files::File;
use crate::session::open::open_model::JoinedFile;
use crate::session::{Command, MaterialCommand, NameCommand, QualityCommand, Session};
use crate::sorting;

/// All that a session has open, for another one. In their order: each of `openings` is opened, then `model` is shown, the clips of each of `clips`
/// are added, `sky` is opened, and [`Session::go_on_from`] takes `rest`.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct HandedOver {
    /// Files that were opened together, with pictures that joined them later. Those of the model on screen are the last.
    pub openings: Vec<Vec<File>>,
    /// The path of the model on screen.
    pub model: Option<String>,
    /// Each file whose clips joined it, with those that it names.
    pub clips: Vec<Vec<File>>,
    /// The cube map or panorama that is the sky.
    pub sky: Option<File>,
    /// Edits and view, as JSON.
    pub rest: String,
}

/// What is no file.
#[derive(Debug, Default, Serialize, Deserialize)]
struct Rest {
    /// Edited materials, by their index.
    materials: Vec<(usize, Value)>,
    /// The hierarchy that the names are of.
    fingerprint: u64,
    /// Names of bones, as [`SavedNames::to_text`] writes them.
    names: String,
    seen: Linked,
}

impl Session {
    /// All that another session needs to go on with what is open in this one, where these panels are open. The steps of the history stay behind.
    pub fn handed_over(&self, panels: Vec<String>) -> HandedOver {
        let content = &self.content;
        let mut openings: Vec<_> = content.opened.iter().collect();
        sorting::sort_by_key(&mut openings, |opened| self.is_shown_of(opened));
        let joined = content.open.iter().flat_map(|open| &open.joined);
        HandedOver {
            openings: openings.into_iter().map(|opened| self.with_pictures(opened)).collect(),
            model: content.open.as_ref().map(|open| open.file.path.clone()),
            clips: joined.map(with_named).collect(),
            sky: content.sky.file().cloned(),
            rest: serde_json::to_string(&self.rest(panels)).unwrap_or_default(),
        }
    }

    fn is_shown_of(&self, opened: &Opened) -> bool {
        Arc::ptr_eq(&opened.files, &self.content.files)
    }

    /// The files of an opening, and the pictures that joined them later. Those inside a model's file are no files.
    fn with_pictures(&self, opened: &Opened) -> Vec<File> {
        let (content, is_shown) = (&self.content, self.is_shown_of(opened));
        let maps = if is_shown { &content.maps } else { &opened.maps };
        let inside = content.open.iter().flat_map(|open| &open.pictures);
        let inside: Vec<&File> = inside.filter(|_| is_shown).collect();
        let came_later = |picture: &&File| opened.files.get(&picture.path).is_none() && !inside.contains(picture);
        let later = maps.pictures().iter().filter(came_later);
        opened.files.files().iter().chain(later).cloned().collect()
    }

    fn rest(&self, panels: Vec<String>) -> Rest {
        let drawn = self.content.materials.drawn().iter().enumerate();
        let edited = drawn.filter(|&(index, _)| self.is_edited(index));
        let names = self.saved_joint_names().unwrap_or_default();
        Rest {
            materials: edited
                .filter_map(|(index, material)| Some((index, serde_json::to_value(material).ok()?)))
                .collect(),
            fingerprint: names.fingerprint,
            names: names.to_text(),
            seen: Linked {
                view: self.view_state(),
                quality: self.quality.mode(),
                panels,
            },
        }
    }

    /// Takes the rest of what another session has handed over, once its files are open. Returns the panels that were open.
    pub fn go_on_from(&mut self, rest: &str) -> Vec<String> {
        let Rest {
            materials,
            fingerprint,
            names,
            seen,
        } = serde_json::from_str(rest).unwrap_or_default();
        for (index, material) in materials {
            if let Ok(material) = serde_json::from_value::<Material>(material) {
                let material = Box::new(material);
                self.apply(MaterialCommand::Edit { index, material });
            }
        }
        self.apply(NameCommand::Import(SavedNames::from_text(fingerprint, &names)));
        self.apply(QualityCommand::SetMode(seen.quality));
        self.apply(Command::Restore(Box::new(seen.view)));
        seen.panels
    }
}

/// A file whose clips joined, with those that it names.
fn with_named(joined: &JoinedFile) -> Vec<File> {
    let named = import::files_beside(&joined.file.bytes);
    let named = named
        .iter()
        .filter_map(|path| joined.files.data_beside(&joined.file, path));
    [&joined.file].into_iter().chain(named).cloned().collect()
}
