//! What was asked to be opened, and how it is made ready: of copies of what is open, without a session.

use std::collections::{BTreeSet, HashSet};
use std::sync::Arc;

use super::files::{File, FileKind, FileSet};
use super::load::{Before, Kept, LoadError, Loaded, load_among, load_whole};
use super::maps::Maps;
use super::open_model::OpenModel;
use crate::slices::Slices;

/// What is to be opened.
#[derive(Clone, Debug)]
pub(in crate::session) enum Wish {
    /// The largest model of a drop, or its pictures where it has none.
    Files(Vec<File>),
    /// A model of the list.
    Listed(Box<Listed>),
    /// Clips for the open model.
    Clips(Vec<File>),
}

#[derive(Clone, Debug)]
pub(in crate::session) struct Listed {
    pub(in crate::session) files: Arc<FileSet>,
    pub(in crate::session) file: File,
    /// The pictures that were found for the models of its drop.
    pub(in crate::session) maps: Maps,
    /// The model that leaves the list then.
    pub(in crate::session) closes: Option<String>,
}

/// What is open while something else is made ready; nothing of it changes.
#[derive(Debug)]
pub(in crate::session) struct Beside(pub(in crate::session) Option<Before>);

/// What can be shown.
#[derive(Debug)]
pub(in crate::session) enum Ready {
    Model(Result<Box<Loaded>, Box<LoadError>>),
    /// Files without a model, and what their pictures bring where there are some and a model is open.
    Others(Arc<FileSet>, Option<PicturesJoined>),
    /// What was read of each model of a drop, in its order. The largest does not come first here.
    Clips(FileSet, Vec<Result<OpenModel, Box<LoadError>>>),
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
            Self::Listed(_) => true,
            Self::Clips(_) => false,
        }
    }

    /// The model that leaves the list then.
    pub(in crate::session) fn closes(&self) -> Option<String> {
        match self {
            Self::Listed(listed) => listed.closes.clone(),
            Self::Files(_) | Self::Clips(_) => None,
        }
    }

    /// Base name of the file that it is about, as far as names tell.
    pub(in crate::session) fn name(&self) -> String {
        let file = match self {
            Self::Listed(listed) => Some(&listed.file),
            Self::Files(files) | Self::Clips(files) => {
                let is_model = |file: &&File| matches!(file.kind(), Some(FileKind::Model | FileKind::Archive));
                let models = files.iter().filter(is_model);
                models.max_by_key(|file| file.bytes.len()).or(files.first())
            }
        };
        file.map_or("", File::base_name).to_owned()
    }

    /// Makes it ready.
    pub(in crate::session) async fn fulfil(self, beside: Beside, slices: &Slices) -> Ready {
        match self {
            Self::Files(files) => {
                let files = Arc::new(FileSet::new_in(files, slices).await);
                match beside.wanted_model(&files) {
                    Some(file) => {
                        let kept = beside.kept_for(&file);
                        Ready::Model(load_whole(files, &file, kept, slices).await)
                    }
                    None => beside.others(files, slices).await,
                }
            }
            Self::Listed(listed) => {
                let Listed { files, file, maps, .. } = *listed;
                let before = beside.0.filter(|before| before.open.file.path == file.path);
                let joined = before.as_ref().map_or(Vec::new(), |before| before.open.joined.clone());
                let kept = Kept { maps, joined, before };
                Ready::Model(load_whole(files, &file, kept, slices).await)
            }
            Self::Clips(files) => {
                let files = FileSet::new_in(files, slices).await;
                let models: HashSet<&str> = files.models().iter().map(|file| file.path.as_str()).collect();
                let mut read = Vec::new();
                for file in files.files().iter().filter(|file| models.contains(file.path.as_str())) {
                    read.push(load_among(file, &files, slices).await);
                }
                Ready::Clips(files, read)
            }
        }
    }
}

impl Beside {
    /// The model to open: the largest, but where the models of the open drop come again, the one that is on screen.
    fn wanted_model(&self, files: &FileSet) -> Option<File> {
        let paths = |set: &FileSet| {
            set.models()
                .iter()
                .map(|file| file.path.clone())
                .collect::<BTreeSet<_>>()
        };
        let again = self.0.as_ref().filter(|before| {
            let models = paths(files);
            models.contains(&before.open.file.path) && models == paths(&before.files)
        });
        let path = again.map(|before| &before.open.file.path);
        files
            .get(path.or(files.models().first().map(|file| &file.path))?)
            .cloned()
    }

    /// What is there already of the same file: decoded maps and joined clips. The model alone, dropped again, keeps the pictures that came
    /// before.
    fn kept_for(self, file: &File) -> Kept {
        let before = self.0.filter(|before| before.open.file.base_name() == file.base_name());
        before.map_or_else(Kept::default, |before| Kept {
            maps: before.maps.clone(),
            joined: before.open.joined.clone(),
            before: Some(before),
        })
    }

    async fn others(self, files: Arc<FileSet>, slices: &Slices) -> Ready {
        let mut joined = None;
        if let Some(Before { open, mut maps, .. }) = self.0
            && files.images().next().is_some()
        {
            maps.forget_unused();
            let are_others = maps.join(&open.model.materials, files.images().cloned(), slices).await;
            joined = Some(PicturesJoined { maps, are_others });
        }
        Ready::Others(files, joined)
    }
}
