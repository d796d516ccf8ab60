//! Opening what was dropped: a model with its maps and sky, or clips that join the open model.

use std::collections::{BTreeSet, HashSet};
use std::sync::Arc;

use super::content::{Content, Opened};
use super::files::{File, FileSet};
use super::load::{LoadError, LoadJob, Loaded};
use crate::session::changes::Changes;
use crate::session::look::materials::Materials;
use crate::session::play::actor::Actor;
use crate::session::play::instances::Instances;
use crate::session::play::mixer::Blend;
use crate::session::play::player::Player;
use crate::session::{Event, News, Session};

/// A command about files.
#[derive(Clone, Debug, PartialEq)]
pub enum FileCommand {
    /// Opens the largest model of a drop; the others are listed, pictures are kept beside it. A cube map by itself becomes the sky; beside
    /// other files it can become it.
    Add(Vec<File>),
    /// Adds the clips of other models with the same bones to the open one; without an open model it opens them. One whose
    /// bones differ is refused as an error, and the model stays.
    AddClips(Vec<File>),
    /// Opens another of [`Session::models`], by its path.
    Open(String),
    /// Closes one of [`Session::models`], by its path. In the place of the one on screen comes the next, or the one before the last. The only
    /// one stays.
    Close(String),
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
        !matches!(self, Self::ClearSky | Self::DismissError)
    }
}

/// What plays, by the names of clips.
#[derive(Clone, Debug)]
pub(in crate::session) struct ShownClips {
    shown: Option<String>,
    /// By the other instances of the model.
    others: Vec<Option<String>>,
    blended: Option<(String, f32)>,
}

impl Session {
    pub(in crate::session) fn apply_to_files(&mut self, command: FileCommand) {
        match command {
            FileCommand::Add(files) => self.add_files(files),
            FileCommand::AddClips(files) => self.add_clips(files),
            FileCommand::Open(path) => self.open_file(&path),
            FileCommand::Close(path) => self.close_file(&path),
            FileCommand::UseSky(path) => {
                let found = self.skies().iter().find(|file| file.path == path).cloned();
                self.use_as_sky(found);
            }
            FileCommand::ClearSky => self.clear_sky(),
            FileCommand::DismissError => self.content.error = None,
        }
    }

    fn add_files(&mut self, files: Vec<File>) {
        let files = Arc::new(FileSet::new(files));
        match self.job(&files) {
            Some(job) => self.show(job.run()),
            None => {
                self.content.maps.forget_unused();
                self.add_pictures(&files);
            }
        }
    }

    /// Begins to open a drop in steps: the caller does them, and then calls [`Session::end_opening`]. Until then all stays as it
    /// is. `None` for a drop without a model, which [`FileCommand::Add`] takes at once.
    pub fn begin_opening(&mut self, files: Vec<File>) -> Option<LoadJob> {
        self.job(&Arc::new(FileSet::new(files)))
    }

    /// Counts models that were asked for, and clips that joined one. A job whose number is no longer this one came too late: drop it.
    pub fn openings(&self) -> u64 {
        self.revisions.openings
    }

    /// Shows what became of the job of [`Session::begin_opening`].
    pub fn end_opening(&mut self, outcome: Result<Box<Loaded>, Box<LoadError>>) -> Changes {
        let to_go_back_to = self.to_go_back_to();
        let changes = self.track(|session| session.show(outcome));
        if changes.need_upload() && to_go_back_to.is_some() {
            self.before = to_go_back_to;
        }
        changes
    }

    /// The job that opens a drop's model; none without one. The old set stays while the new model is not there: its other models
    /// can still be opened.
    fn job(&mut self, files: &Arc<FileSet>) -> Option<LoadJob> {
        let file = files.get(&self.wanted_model(files)?).cloned()?;
        self.revisions.openings += 1;
        Some(self.reuse(LoadJob::new(Arc::clone(files), file)))
    }

    /// Opens one of [`Session::models`]. The pictures that were found for the models of its drop stay.
    fn open_file(&mut self, path: &str) {
        let content = &self.content;
        let mut list = content.opened.iter();
        let Some((opened, file)) = list.find_map(|opened| Some((opened, opened.files.model(path)?))) else {
            return;
        };
        let is_shown = Arc::ptr_eq(&opened.files, &content.files);
        let maps = if is_shown { &content.maps } else { &opened.maps };
        let again = content.open.as_ref().filter(|open| open.file.path == path);
        let joined = again.map_or(Vec::new(), |open| open.joined.clone());
        let job = LoadJob::new(Arc::clone(&opened.files), file.clone()).reusing(maps.clone(), joined);
        self.revisions.openings += 1;
        self.show(job.run());
    }

    fn close_file(&mut self, path: &str) {
        let is_on_screen = |session: &Self| session.open_model().is_some_and(|open| open.file.path == path);
        if is_on_screen(self) {
            let paths: Vec<&str> = self.models().iter().map(|file| &*file.path).collect();
            let place = paths.iter().position(|&listed| listed == path);
            let beside = place.and_then(|place| paths.get(place + 1).or_else(|| paths.get(place.checked_sub(1)?)));
            if let Some(beside) = beside.map(|&beside| beside.to_owned()) {
                self.open_file(&beside);
            }
            // It is the only one, or that one could not be read.
            if is_on_screen(self) {
                return;
            }
        }
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
            models.sort_by_cached_key(|file| (file.path.to_lowercase(), file.path.clone()));
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

    fn show(&mut self, outcome: Result<Box<Loaded>, Box<LoadError>>) {
        self.content.maps.forget_unused();
        match outcome {
            Ok(loaded) => self.replace_model(*loaded),
            Err(error) => self.fail(*error),
        }
    }

    /// Gives a job what the open model already has of the same file: decoded maps and joined clips.
    fn reuse(&self, job: LoadJob) -> LoadJob {
        match &self.content.open {
            Some(open) if open.file.base_name() == job.file_name() => {
                // The model alone, dropped again, keeps the pictures that came before.
                job.reusing(self.content.maps.clone(), open.joined.clone())
            }
            _ => job,
        }
    }

    /// The path of the model to open: the largest, but where the models of the open drop come again, the one that is on screen.
    fn wanted_model(&self, files: &FileSet) -> Option<String> {
        let paths = |set: &FileSet| {
            set.models()
                .iter()
                .map(|file| file.path.clone())
                .collect::<BTreeSet<_>>()
        };
        let on_screen = self.content.open.as_ref().map(|open| &open.file.path);
        let again = on_screen.filter(|&path| {
            let models = paths(files);
            models.contains(path) && models == paths(&self.content.files)
        });
        again.or(files.models().first().map(|file| &file.path)).cloned()
    }

    /// A drop without a model: maps join the open one, and cube maps by themselves need none.
    fn add_pictures(&mut self, files: &FileSet) {
        let has_maps = files.images().next().is_some();
        let has_cubes = files.cubes().next().is_some();
        match &self.content.open {
            Some(open) if has_maps => {
                if self.content.maps.join(&open.model.materials, files.images().cloned()) {
                    self.content.changes.maps = true;
                }
                // The first picture makes the others missing, even one that fits none.
                self.content.verdicts.forget();
                self.content.error = None;
            }
            None if has_maps => self.fail(LoadError::no_model(files)),
            _ if has_cubes => self.content.error = None,
            _ => self.fail(LoadError::no_model(files)),
        }
        if has_maps {
            self.offer_skies(files);
        } else {
            let cubes = self.content.sky.note(files);
            self.use_as_sky(cubes.into_iter().next());
        }
    }

    pub(in crate::session) fn fail(&mut self, error: LoadError) {
        self.content.error = Some(error);
        self.note(Event::Error);
    }

    /// Shows another model, with all that belongs to it. The same file again keeps camera, clip, time and choices.
    fn replace_model(&mut self, loaded: Loaded) {
        let Loaded {
            files,
            open,
            maps,
            verdicts,
        } = loaded;
        let was_playing = self.playback().is_playing();
        let clips_before = self.shown_clips();
        let (opened, news) = self.content.opened_with(&files, self.revisions.openings);
        let old = std::mem::take(&mut self.content);
        let before = old.open.filter(|old| old.file.base_name() == open.file.base_name());
        let again = before.is_some();
        if !before.as_ref().is_some_and(|before| self.history.fits(before, &open)) {
            self.history.clear();
        }

        let of_file = &open.model.materials;
        let materials = match before {
            Some(before) => Materials::of_file_again(of_file, &old.materials, &before.model.materials),
            None => Materials::of_file(of_file),
        };
        let submesh_count = open.model.mesh.submeshes.len();
        self.selection.submeshes.reset_for_model(submesh_count, again);
        let same_joints = self.selection.joints.reset_for_model(&open.model, again);
        let names = if same_joints { old.names } else { Arc::default() };
        if !same_joints {
            self.view.look.trails.clear();
        }
        let actor = if again {
            let others = &clips_before.others;
            self.instances.find_clips(&open, others, Player::show_again);
            Actor::for_model_again(&open, &self.actor, clips_before.shown.as_deref())
        } else {
            self.instances = Instances::default();
            Actor::for_model(&open, &self.actor)
        };
        self.actor = actor;
        self.content = Content {
            open: Some(Arc::new(open)),
            files,
            opened: Arc::new(opened),
            maps,
            materials,
            names,
            sky: old.sky,
            verdicts,
            error: None,
            changes: old.changes,
        };
        self.content.changes |= Changes::MODEL;
        self.content.changes.names |= !same_joints;

        if !again {
            self.quality.reset_for_model();
            self.view.reset_for_model();
            self.show_first_clip();
            self.frame_model();
        }
        self.note(Event::Load);
        if self.playback().is_playing() != was_playing {
            self.note(if was_playing { Event::Pause } else { Event::Play });
        }
        self.note(Event::TimeUpdate);
        self.news.extend(news);
        let files = Arc::clone(&self.content.files);
        self.offer_skies(&files);
    }

    /// Goes to the first clip, if there is one, and plays it unless motion is reduced.
    fn show_first_clip(&mut self) {
        if let Some(open) = &self.content.open
            && let actor = &mut self.actor
            && actor.player.show_clip(open, 0)
            && !self.reduced_motion
        {
            actor.player.playback.play();
        }
    }

    /// Adds the clips of every model of a drop. Without a model to join the drop is opened.
    fn add_clips(&mut self, files: Vec<File>) {
        if self.content.open.is_none() {
            return self.add_files(files);
        }
        // A model that is still being opened would replace this one and its new clips.
        self.revisions.openings += 1;
        self.content.maps.forget_unused();
        let before = self.shown_clips();
        let Some(open) = &mut self.content.open else {
            return;
        };
        let open = Arc::make_mut(open);
        let had_clips = !open.model.clips.is_empty();
        let set = FileSet::new(files);
        let models = set.models();
        let mut refused = models.is_empty().then(|| Box::new(LoadError::no_model(&set)));
        // In the order of the drop; `models` has the largest first.
        let models: HashSet<&str> = models.iter().map(|file| file.path.as_str()).collect();
        let mut joined: HashSet<&str> = HashSet::new();
        let mut replaced = false;
        for file in set.files().iter().filter(|file| models.contains(file.path.as_str())) {
            // Files of one drop that have one name in several folders do not replace each other.
            let replaces = !joined.contains(file.base_name());
            match open.join_clips(file, &set, replaces) {
                Ok(replaced_some) => {
                    joined.insert(file.base_name());
                    replaced |= replaced_some;
                }
                Err(error) => refused = refused.or(Some(error)),
            }
        }
        self.instances.measure(open);
        match refused {
            Some(error) => self.fail(*error),
            None => self.content.error = None,
        }
        if replaced {
            self.show_clips_again(&before);
        }
        if !had_clips && self.content.clip_count() > 0 {
            self.begin_first_clip();
        }
    }

    /// Shows the first clip of a model that had none, and plays it unless motion is reduced.
    pub(in crate::session) fn begin_first_clip(&mut self) {
        self.show_first_clip();
        self.begin_clips_of_crowd();
        if self.playback().is_playing() {
            self.note(Event::Play);
        }
        self.note(Event::TimeUpdate);
    }

    /// What plays, to be found again among other clips.
    pub(in crate::session) fn shown_clips(&self) -> ShownClips {
        let name = |index: usize| Some(self.content.clips().get(index)?.name.clone());
        ShownClips {
            shown: self.clip_index().and_then(name),
            others: self
                .instances
                .others()
                .map(|(_, player)| player.clip.and_then(name))
                .collect(),
            blended: self.blend().and_then(|blend| Some((name(blend.clip)?, blend.weight))),
        }
    }

    /// Finds what played among clips that took the places of others, as [`Player::follow_clips`] says.
    pub(in crate::session) fn show_clips_again(&mut self, before: &ShownClips) {
        self.content.changes.clips = true;
        let Some(open) = &self.content.open else { return };
        let actor = &mut self.actor;
        let clips = &open.model.clips;
        actor.mixer.end_fades();
        let was_at = actor.player.playback.time_secs();
        actor.player.follow_clips(open, before.shown.as_deref());
        self.instances.find_clips(open, &before.others, Player::follow_clips);
        actor.mixer.set_blend(None);
        if let Some((name, weight)) = &before.blended
            && let Some(clip) = clips.iter().position(|clip| clip.name == *name)
        {
            actor.set_blend(Blend { clip, weight: *weight }, clips.len());
        }
        if actor.player.playback.time_secs() != was_at {
            self.note(Event::TimeUpdate);
        }
    }

    fn use_as_sky(&mut self, cube: Option<File>) {
        let Content { sky, changes, .. } = &mut self.content;
        if let Some(cube) = cube.filter(|cube| sky.choose(cube, &mut self.view.look.background)) {
            changes.sky = true;
            self.news.push(News::SkyUsed(cube.base_name().to_owned()));
        }
    }

    /// Notes the cube maps that came among other files. Where the sky came again and is another now, it is shown.
    fn offer_skies(&mut self, files: &FileSet) {
        let Content { sky, changes, .. } = &mut self.content;
        let known = sky.found.len();
        let cubes = sky.note(files);
        let is_sky = |cube: &&File| sky.file().is_some_and(|file| file.path == cube.path);
        if let Some(again) = cubes.iter().find(is_sky) {
            changes.sky |= sky.choose(again, &mut self.view.look.background);
        }
        let new = sky.found.get(known);
        self.news.extend(new.map(|cube| News::SkyFound(cube.path.clone())));
    }

    pub(in crate::session) fn clear_sky(&mut self) {
        let Content { sky, changes, .. } = &mut self.content;
        changes.sky |= sky.clear(&mut self.view.look.background);
    }
}
