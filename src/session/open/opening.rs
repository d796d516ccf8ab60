//! Opening what was dropped: a model with its maps and sky, or clips that join the open model.
//!
//! What is asked for is made ready from copies of what is open, so that the session goes on meanwhile, and then shown at once: until then all
//! stays as it is. A session that was given slices works in them, whenever [`Session::advance_opening`] is called; any other does all at once.

use std::collections::VecDeque;
use std::sync::Arc;

use super::content::{Content, Opened};
use super::files::File;
use super::load::Loaded;
use super::underway::{Opening, Underway};
use super::wish::{Ready, Wish};
use crate::session::Session;
use crate::session::changes::Changes;
use crate::slices::{Sliced, Slices, Stage, StageProgress};
use crate::sorting;

/// A command about files.
#[derive(Clone, Debug, PartialEq)]
pub enum FileCommand {
    /// Opens the largest model of a drop; the others are listed, pictures are kept beside it. A cube map by itself becomes the sky; beside
    /// other files it can become it. What can bring a model takes the place of all that is being opened; pictures wait for it.
    Add(Vec<File>),
    /// Adds the clips of other models with the same bones to the open one, after what is being opened; without an open model it opens
    /// them. One whose bones differ is refused as an error, and the model stays.
    AddClips(Vec<File>),
    /// Opens another of [`Session::models`], by its path.
    Open(String),
    /// Closes one of [`Session::models`], by its path. In the place of the one on screen comes the next, or the one before the last. The only
    /// one stays.
    Close(String),
    /// Gives up what is being opened.
    CancelOpening,
    /// Makes one of [`Session::skies`] the sky, by its path.
    UseSky(String),
    /// Removes the sky that was dropped.
    ClearSky,
    /// Dismisses the error.
    DismissError,
}

impl FileCommand {
    /// Whether it may bring something that a renderer uploads.
    pub(in crate::session) fn opens(&self) -> bool {
        !matches!(self, Self::ClearSky | Self::DismissError | Self::CancelOpening)
    }
}

/// What is being opened.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BeingOpened<'a> {
    /// Base name of the file, as far as it is known.
    pub name: &'a str,
    /// How far it is.
    pub progress: StageProgress,
}

impl Session {
    pub(in crate::session) fn apply_to_files(&mut self, command: FileCommand) {
        match command {
            FileCommand::Add(files) => self.ask(Wish::Files(files), None),
            FileCommand::AddClips(files) => self.ask(Wish::Clips(files), None),
            FileCommand::Open(path) => self.open_listed(&path, None),
            FileCommand::Close(path) => self.close_file(&path),
            FileCommand::CancelOpening => self.cancel_opening(),
            FileCommand::UseSky(path) => {
                let found = self.skies().iter().find(|file| file.path == path).cloned();
                if let Some(wish) = self.sky_wish(found) {
                    self.ask(wish, None);
                }
            }
            FileCommand::ClearSky => {
                self.take_sky_wishes();
                self.begin_next_if_idle();
                self.clear_sky();
            }
            FileCommand::DismissError => self.content.error = None,
        }
    }

    /// From now on this session opens in these slices.
    pub fn open_in(&mut self, slices: &Slices) {
        self.opening.slices = slices.clone();
    }

    /// What is read or being opened; never anything for a session without slices.
    pub fn being_opened(&self) -> Option<BeingOpened<'_>> {
        let now = self.opening.now.as_ref().map(|now| BeingOpened {
            name: &now.name,
            progress: now.work.progress(),
        });
        let fetching = self.opening.fetching.as_ref();
        now.or(fetching.map(|&(ref name, [done, total])| BeingOpened {
            name,
            progress: StageProgress::new(Stage::Fetching, done, total),
        }))
    }

    /// Whether [`Session::advance_opening`] has something to do.
    pub fn is_opening(&self) -> bool {
        self.opening.now.is_some()
    }

    /// Learns that files are read that will be opened. Where they can bring another model, what is being opened is overtaken. Returns
    /// [`Session::openings`]: once that is another number, nobody waits for them.
    pub fn begin_fetching(&mut self, name: String, total_bytes: usize, replaces: bool) -> u64 {
        if replaces {
            self.overtake_opening();
            self.begin_next_if_idle();
        }
        self.opening.fetching = Some((name, [0, total_bytes]));
        self.revisions.openings
    }

    /// Learns that so many bytes more are read, and that so many more will be.
    pub fn note_fetched(&mut self, bytes: usize, promised: usize) {
        if let Some((_, [done, total])) = &mut self.opening.fetching {
            *done += bytes;
            *total += promised;
        }
    }

    /// Learns that all is read, or will never be.
    pub fn end_fetching(&mut self) {
        self.opening.fetching = None;
    }

    /// Counts how often this session began anew.
    pub fn beginnings(&self) -> u64 {
        self.revisions.beginnings
    }

    /// Counts models that were asked for, and what was given up. Where it is another than after a command, that command was overtaken.
    pub fn openings(&self) -> u64 {
        self.revisions.openings
    }

    /// Closes what is open and forgets what was chosen, once these files are ready to be shown in its place.
    pub fn begin_anew(&mut self, reduced_motion: bool, files: Vec<File>) -> Changes {
        let changes = self.track(|session| {
            session.forget_opening();
            session.begin(Wish::Files(files), Some(reduced_motion), None);
        });
        let mut changes = changes;
        while self.opening.slices.are_endless() && self.is_opening() {
            changes |= self.advance_opening();
        }
        changes
    }

    /// `closes`: the model that leaves the list once this one is shown.
    fn ask(&mut self, wish: Wish, closes: Option<String>) {
        if wish.replaces() {
            self.overtake_opening();
        } else if self.opening.now.is_some() {
            self.opening.waiting.push_back(wish);
            return;
        }
        self.begin(wish, None, closes);
        while self.opening.slices.are_endless()
            && let Some((ready, ended)) = self.next_ready()
        {
            self.show_ready(ready, ended);
            self.begin_next();
        }
    }

    /// Begins with what waits, where there is something.
    fn begin_next(&mut self) {
        if let Some(next) = self.opening.waiting.pop_front() {
            self.begin(next, None, None);
        }
    }

    /// [`Session::begin_next`] where nothing is being opened.
    fn begin_next_if_idle(&mut self) {
        if self.opening.now.is_none() {
            self.begin_next();
        }
    }

    /// Another model is asked for. Nobody waits any more for what came before, but a sky belongs to no model: it comes afterwards.
    fn overtake_opening(&mut self) {
        let skies = self.take_sky_wishes();
        self.forget_opening();
        self.opening.waiting.extend(skies);
    }

    /// Takes the skies out of what is being opened and out of what waits.
    fn take_sky_wishes(&mut self) -> Vec<Wish> {
        let Opening { now, waiting, .. } = &mut self.opening;
        let now = now.take_if(|now| now.sky.is_some()).and_then(|now| now.sky);
        let (skies, others) = std::mem::take(waiting)
            .into_iter()
            .partition::<VecDeque<_>, _>(|wish| matches!(wish, Wish::Sky(_)));
        *waiting = others;
        now.map(Wish::Sky).into_iter().chain(skies).collect()
    }

    /// All that came before is given up.
    fn forget_opening(&mut self) {
        self.revisions.openings += 1;
        self.opening.waiting.clear();
        self.opening.fetching = None;
        self.opening.now = None;
    }

    fn cancel_opening(&mut self) {
        if self.being_opened().is_some() {
            self.forget_opening();
        }
    }

    fn begin(&mut self, wish: Wish, begins_anew: Option<bool>, closes: Option<String>) {
        let content = &self.content;
        let wish = match wish {
            Wish::Clips(files) if content.open.is_none() => Wish::Files(files),
            wish => wish,
        };
        let name = wish.name();
        let sky = match &wish {
            Wish::Sky(file) => Some(file.clone()),
            _ => None,
        };
        let shown = content.open.as_ref().map(|open| Loaded {
            open: Arc::clone(open),
            files: Arc::clone(&content.files),
            maps: content.maps.clone(),
            verdicts: content.verdicts.clone(),
        });
        let work = Sliced::new(&self.opening.slices, async move |slices| {
            wish.fulfil(shown, &slices).await
        });
        self.opening.now = Some(Underway {
            work,
            name,
            sky,
            begins_anew,
            closes,
        });
    }

    /// Works on what is being opened until the slice is over, and shows it when it is ready.
    pub fn advance_opening(&mut self) -> Changes {
        let Some((ready, ended)) = self.next_ready() else {
            return Changes::default();
        };
        let to_go_back_to = self.to_go_back_to();
        let before = self.undoable();
        let changes = self.track(|session| session.show_ready(ready, ended));
        if !changes.model {
            self.record_step(&before);
        }
        if changes.need_upload() && to_go_back_to.is_some() {
            self.before = to_go_back_to;
        }
        self.begin_next();
        changes
    }

    fn next_ready(&mut self) -> Option<(Ready, Underway)> {
        let ready = self.opening.now.as_mut()?.work.advance()?;
        Some((ready, self.opening.now.take()?))
    }

    fn show_ready(&mut self, ready: Ready, ended: Underway) {
        if let Some(reduced_motion) = ended.begins_anew {
            self.start_over(reduced_motion);
        }
        self.show(ready);
        if let Some(path) = ended.closes
            && !self.is_on_screen(&path)
        {
            self.take_from_list(&path);
        }
    }

    /// Opens one of [`Session::models`]. The pictures that were found for the models of its drop stay. Where it can be read, `closes` leaves the
    /// list then.
    fn open_listed(&mut self, path: &str, closes: Option<String>) {
        let content = &self.content;
        let mut list = content.opened.iter();
        let Some((opened, file)) = list.find_map(|opened| Some((opened, opened.files.model(path)?))) else {
            return;
        };
        let is_shown = Arc::ptr_eq(&opened.files, &content.files);
        let maps = if is_shown { &content.maps } else { &opened.maps };
        let wish = Wish::Listed(Arc::clone(&opened.files), file.clone(), Box::new(maps.clone()));
        self.ask(wish, closes);
    }

    fn is_on_screen(&self, path: &str) -> bool {
        self.open_model().is_some_and(|open| open.file.path == path)
    }

    fn close_file(&mut self, path: &str) {
        if !self.is_on_screen(path) {
            return self.take_from_list(path);
        }
        let paths: Vec<&str> = self.models().iter().map(|file| &*file.path).collect();
        let place = paths.iter().position(|&listed| listed == path);
        let beside = place.and_then(|place| paths.get(place + 1).or_else(|| paths.get(place.checked_sub(1)?)));
        if let Some(beside) = beside.map(|&beside| beside.to_owned()) {
            self.open_listed(&beside, Some(path.to_owned()));
        }
    }

    fn take_from_list(&mut self, path: &str) {
        let Content { opened, files, .. } = &mut self.content;
        let list = Arc::make_mut(opened);
        for opened in list.iter_mut().filter(|opened| opened.files.model(path).is_some()) {
            let left = Arc::new(opened.files.without(|file| file.path == path));
            if Arc::ptr_eq(files, &opened.files) {
                *files = Arc::clone(&left);
            }
            opened.files = left;
        }
        list.retain(|opened| !opened.files.models().is_empty());
    }

    /// The models that [`FileCommand::Open`] opens, in the order of opening; those that came together by their paths.
    pub fn models(&self) -> Vec<&File> {
        fn sorted(opened: &Opened) -> Vec<&File> {
            let mut models = opened.files.models();
            sorting::sort_by_key(&mut models, |file| (file.path.to_lowercase(), file.path.clone()));
            models
        }
        self.content.opened.iter().flat_map(sorted).collect()
    }

    /// The number of the opening that brought the model on screen.
    pub fn shown_opening(&self) -> Option<u64> {
        let Content { opened, files, .. } = &self.content;
        let shown = opened.iter().find(|opened| Arc::ptr_eq(&opened.files, files));
        shown.map(|opened| opened.number)
    }
}
