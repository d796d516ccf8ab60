//! What is open: a model with its maps, edited materials, names of joints and diagnostics, the files it came with, and the sky.

use std::sync::Arc;

use super::changes::Changes;
use super::event::News;
use super::files::{File, FileSet};
use super::load::LoadError;
use super::maps::Maps;
use super::materials::Materials;
use super::open_model::OpenModel;
use super::sky::Sky;
use super::verdicts::Verdicts;
use crate::diagnostic::Diagnostic;
use crate::model::{Clip, JointNames};

/// So many bytes of files are kept, with all their pictures: more than a person looks at in turn, and little enough for a page.
const MOST_BYTES: usize = 1 << 29;

/// Files that came together, and the pictures that were found for their models.
#[derive(Clone, Debug)]
pub(super) struct Opened {
    pub(super) files: Arc<FileSet>,
    /// While a model of them is on screen, its maps are those of [`Content`].
    pub(super) maps: Maps,
    /// The number of the opening that brought them.
    pub(super) number: u64,
}

impl Opened {
    fn byte_count(&self) -> usize {
        let came_later = |picture: &&File| self.files.get(&picture.path).is_none();
        let later = self.maps.pictures().iter().filter(came_later);
        self.files
            .files()
            .iter()
            .chain(later)
            .map(|file| file.bytes.len())
            .sum()
    }
}

/// A model is replaced together with all that belongs to it; the sky belongs to no model.
#[derive(Clone, Debug, Default)]
pub(super) struct Content {
    /// Shared with the copy that [`Session::go_back`](super::Session::go_back) returns to.
    pub(super) open: Option<Arc<OpenModel>>,
    /// Those of `opened` that the model came with.
    pub(super) files: Arc<FileSet>,
    /// All that can be opened again, in the order of opening.
    pub(super) opened: Arc<Vec<Opened>>,
    pub(super) maps: Maps,
    pub(super) materials: Materials,
    pub(super) names: Arc<JointNames>,
    pub(super) sky: Sky,
    pub(super) verdicts: Verdicts,
    /// Why the last load failed.
    pub(super) error: Option<LoadError>,
    /// What changed since the last [`Changes::take`].
    pub(super) changes: Changes,
}

impl Content {
    pub(super) fn clips(&self) -> &[Clip] {
        self.open.as_ref().map_or(&[], |open| &open.model.clips)
    }

    pub(super) fn clip_count(&self) -> usize {
        self.clips().len()
    }

    /// The list when a model of `next` is shown. New files stand at the end, or in the place of those whose models all come again. The
    /// oldest leave when all have too many bytes. The second is what is to be told of it.
    pub(super) fn opened_with(&self, next: &Arc<FileSet>, number: u64) -> (Vec<Opened>, Vec<News>) {
        let mut list = Vec::clone(&self.opened);
        if let Some(shown) = list.iter_mut().find(|opened| Arc::ptr_eq(&opened.files, &self.files)) {
            // They can be decoded again; until then their memory is free.
            shown.maps = self.maps.undecoded();
        }
        if list.iter().any(|opened| Arc::ptr_eq(&opened.files, next)) {
            return (list, Vec::new());
        }
        let comes_again = |file: &File| next.get(&file.path).is_some();
        let models = next.models();
        let is_next = |of: Vec<&File>| of.len() == models.len() && of.into_iter().all(comes_again);
        let is_new = !list.iter().any(|opened| is_next(opened.files.models()));
        let largest = models.first().filter(|_| is_new && models.len() > 1);
        let largest = largest.map(|file| News::OpenedLargest(file.base_name().to_owned(), models.len()));
        let mut news: Vec<News> = largest.into_iter().collect();
        for opened in &mut list {
            if opened.files.models().into_iter().any(comes_again) {
                opened.files = Arc::new(opened.files.without(comes_again));
            }
        }
        let is_empty = |opened: &Opened| opened.files.models().is_empty();
        let place = list.iter().position(is_empty).unwrap_or(list.len());
        list.retain(|opened| !is_empty(opened));
        let files = Arc::clone(next);
        let maps = Maps::default();
        list.insert(place, Opened { files, maps, number });

        let mut bytes: usize = list.iter().map(Opened::byte_count).sum();
        let mut closed = 0;
        while bytes > MOST_BYTES
            && let Some(oldest) = list.iter().position(|opened| !Arc::ptr_eq(&opened.files, next))
        {
            let oldest = list.remove(oldest);
            bytes -= oldest.byte_count();
            closed += oldest.files.models().len();
        }
        news.extend((closed > 0).then_some(News::ModelsClosed(closed)));
        (list, news)
    }

    /// What was mended or is worth knowing about the model, its maps and the sky.
    pub(super) fn diagnostics(&self) -> impl Iterator<Item = &Diagnostic> {
        let of_file = self.open.iter().flat_map(|open| &open.diagnostics);
        let of_joined = self.open.iter().flat_map(|open| open.joined_diagnostics());
        of_file
            .chain(of_joined)
            .chain(self.maps.diagnostics())
            .chain(self.sky.diagnostics())
    }
}
