//! What is open: a model with its maps, edited materials, names of joints and diagnostics, the files it came with, and the sky.

use std::sync::Arc;

use super::files::{File, FileSet};
use super::load::LoadError;
use super::maps::Maps;
use super::open_model::OpenModel;
use crate::diagnostic::Diagnostic;
use crate::model::{Clip, JointNames};
use crate::session::changes::Changes;
use crate::session::event::News;
use crate::session::look::materials::Materials;
use crate::session::look::sky::Sky;
use crate::session::published::verdicts::Verdicts;

/// So many bytes of files are kept, with all their pictures: more than a person looks at in turn, and little enough for a page.
const MOST_BYTES: usize = 1 << 29;

/// Files that came together, and the pictures that were found for their models.
#[derive(Clone, Debug)]
pub(in crate::session) struct Opened {
    pub(in crate::session) files: Arc<FileSet>,
    /// While a model of them is on screen, its maps are those of [`Content`].
    pub(in crate::session) maps: Maps,
    /// The number of the opening that brought them.
    pub(in crate::session) number: u64,
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
pub(in crate::session) struct Content {
    /// Shared with the copy that [`Session::go_back`](crate::session::Session::go_back) returns to.
    pub(in crate::session) open: Option<Arc<OpenModel>>,
    /// Those of `opened` that the model came with.
    pub(in crate::session) files: Arc<FileSet>,
    /// All that can be opened again, in the order of opening.
    pub(in crate::session) opened: Arc<Vec<Opened>>,
    pub(in crate::session) maps: Maps,
    pub(in crate::session) materials: Materials,
    pub(in crate::session) names: Arc<JointNames>,
    pub(in crate::session) sky: Sky,
    pub(in crate::session) verdicts: Verdicts,
    /// Why the last load failed.
    pub(in crate::session) error: Option<LoadError>,
    /// What changed since the last [`Changes::take`].
    pub(in crate::session) changes: Changes,
}

impl Content {
    pub(in crate::session) fn clips(&self) -> &[Clip] {
        self.open.as_ref().map_or(&[], |open| &open.model.clips)
    }

    pub(in crate::session) fn clip_count(&self) -> usize {
        self.clips().len()
    }

    /// The list when a model of `next` is shown. New files stand at the end, or in the place of those whose models all come again. The
    /// oldest leave when all have too many bytes. The second is what is to be told of it.
    pub(in crate::session) fn opened_with(&self, next: &Arc<FileSet>, number: u64) -> (Vec<Opened>, Vec<News>) {
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
    pub(in crate::session) fn diagnostics(&self) -> impl Iterator<Item = &Diagnostic> {
        let of_file = self.open.iter().flat_map(|open| &open.diagnostics);
        let of_joined = self.open.iter().flat_map(|open| open.joined_diagnostics());
        of_file
            .chain(of_joined)
            .chain(self.maps.diagnostics())
            .chain(self.sky.diagnostics())
    }
}
