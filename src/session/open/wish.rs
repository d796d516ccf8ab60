//! What was asked to be opened, and how it is made ready: of copies of what is open, without a session.

use std::collections::{BTreeSet, HashSet};
use std::sync::Arc;

use super::files::{File, FileKind, FileSet};
use super::load::{LoadError, Loaded, load_among, load_whole};
use super::maps::Maps;
use super::open_model::OpenModel;
use crate::diagnostic::Fault;
use crate::image::{self, Image, MapKind};
use crate::slices::{Slices, Stage};

/// What is to be opened.
#[derive(Clone, Debug)]
pub(in crate::session) enum Wish {
    /// The largest model of a drop, or its pictures where it has none.
    Files(Vec<File>),
    /// A model of the list, with the pictures that were found for the models of its drop.
    Listed(Arc<FileSet>, File, Box<Maps>),
    /// Clips for the open model.
    Clips(Vec<File>),
    /// The sky, of one of the cube maps that came.
    Sky(File),
}

/// What can be shown.
#[derive(Debug)]
pub(in crate::session) enum Ready {
    Model(Result<Box<Loaded>, Box<LoadError>>),
    /// Files without a model, and what their pictures bring where there are some and a model is open.
    Others(Arc<FileSet>, Option<PicturesJoined>),
    /// What was read of each model of a drop, in its order. The largest does not come first here.
    Clips(FileSet, Vec<Result<OpenModel, Box<LoadError>>>),
    /// The sky of a cube map, with all its levels.
    Sky(File, Result<Image, Fault>),
}

/// Maps of the open model with pictures that came later.
#[derive(Debug)]
pub(in crate::session) struct PicturesJoined {
    pub(in crate::session) maps: Maps,
    /// Whether materials use others than before.
    pub(in crate::session) are_others: bool,
}

impl Wish {
    /// Whether it can bring another model: then nobody waits any more for what is being opened.
    pub(in crate::session) fn replaces(&self) -> bool {
        let is_other = |file: &File| matches!(file.kind(), Some(FileKind::Picture | FileKind::Unread));
        match self {
            Self::Files(files) => !files.iter().all(is_other),
            Self::Listed(..) => true,
            Self::Clips(_) | Self::Sky(_) => false,
        }
    }

    /// Base name of the file that it is about, as far as names tell.
    pub(in crate::session) fn name(&self) -> String {
        let file = match self {
            Self::Listed(_, file, _) | Self::Sky(file) => Some(file),
            Self::Files(files) | Self::Clips(files) => {
                let is_model = |file: &&File| matches!(file.kind(), Some(FileKind::Model | FileKind::Archive));
                let models = files.iter().filter(is_model);
                models.max_by_key(|file| file.bytes.len()).or(files.first())
            }
        };
        file.map_or("", File::base_name).to_owned()
    }

    /// Makes it ready beside what is shown; nothing of that changes.
    pub(in crate::session) async fn fulfil(self, shown: Option<Loaded>, slices: &Slices) -> Ready {
        match self {
            Self::Files(files) => {
                let files = Arc::new(FileSet::new_in(files, slices).await);
                let Some(file) = wanted_model(shown.as_ref(), &files) else {
                    return others(shown, files, slices).await;
                };
                // The model alone, dropped again, keeps the pictures that came before.
                let before = shown.filter(|shown| shown.open.file.base_name() == file.base_name());
                let maps = before.as_ref().map_or_else(Maps::default, |before| before.maps.clone());
                Ready::Model(load_whole(files, &file, maps, before, slices).await)
            }
            Self::Listed(files, file, maps) => {
                let before = shown.filter(|shown| shown.open.file.path == file.path);
                Ready::Model(load_whole(files, &file, *maps, before, slices).await)
            }
            Self::Clips(files) => {
                let files = FileSet::new_in(files, slices).await;
                let models = files.models().into_iter().chain(files.motions());
                let models: HashSet<&str> = models.map(|file| file.path.as_str()).collect();
                let is_model = |file: &&File| models.contains(file.path.as_str());
                let in_order: Vec<&File> = files.files().iter().filter(is_model).collect();
                let sizes = in_order.iter().map(|file| (Some(Stage::Joining), file.bytes.len()));
                let sizes: Vec<_> = sizes.collect();
                let of_each = slices.for_files(
                    Stage::Reading..=Stage::Checking,
                    Stage::Reading..=Stage::Judging,
                    &sizes,
                );
                let mut read = Vec::new();
                for (file, slices) in in_order.into_iter().zip(&of_each) {
                    read.push(load_among(file, &files, slices).await);
                }
                Ready::Clips(files, read)
            }
            Self::Sky(file) => {
                slices.pause_at(Stage::Decoding, 0, 1).await;
                let read = match image::decode_in(&file.bytes, file.base_name(), slices).await {
                    Ok(image) => Ok(image.mipped_in(MapKind::Diffuse, None, slices).await.unwrap_or(image)),
                    Err(fault) => Err(fault),
                };
                Ready::Sky(file, read)
            }
        }
    }
}

/// The model to open: the largest, but where the models of the open drop come again, the one that is on screen.
fn wanted_model(shown: Option<&Loaded>, files: &FileSet) -> Option<File> {
    let paths = |set: &FileSet| {
        set.models()
            .iter()
            .map(|file| file.path.clone())
            .collect::<BTreeSet<_>>()
    };
    let again = shown.filter(|shown| {
        let models = paths(files);
        models.contains(&shown.open.file.path) && models == paths(&shown.files)
    });
    let path = again.map(|shown| &shown.open.file.path);
    files
        .get(path.or(files.models().first().map(|file| &file.path))?)
        .cloned()
}

/// Files without a model.
async fn others(shown: Option<Loaded>, files: Arc<FileSet>, slices: &Slices) -> Ready {
    let mut joined = None;
    if let Some(Loaded { open, mut maps, .. }) = shown
        && files.images().next().is_some()
    {
        maps.forget_unused();
        let are_others = maps.join(&open.model.materials, files.images().cloned(), slices).await;
        joined = Some(PicturesJoined { maps, are_others });
    }
    Ready::Others(files, joined)
}
