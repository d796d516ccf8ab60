//! Opening what was dropped: a model with its maps and sky, or clips that join the open model.

use std::collections::{BTreeSet, HashSet};
use std::sync::Arc;

use super::actor::Actor;
use super::changes::Changes;
use super::content::Content;
use super::files::{File, FileSet};
use super::instances::Instances;
use super::load::{LoadError, LoadJob, Loaded};
use super::materials::Materials;
use super::mixer::Blend;
use super::player::Player;
use super::sky::FoundSky;
use super::{Event, Session};

/// A command about files.
#[derive(Clone, Debug, PartialEq)]
pub enum FileCommand {
    /// Opens the largest model of a drop; the others are listed, pictures are kept beside it, a cube map becomes the sky.
    Add(Vec<File>),
    /// Adds the clips of other models with the same bones to the open one; without an open model it opens them. One whose
    /// bones differ is refused as an error, and the model stays.
    AddClips(Vec<File>),
    /// Opens another of [`Session::models`], by its path.
    Open(String),
    /// Removes the sky that was dropped.
    ClearSky,
    /// Dismisses the error.
    DismissError,
}

impl FileCommand {
    /// Whether it may bring something that a renderer uploads.
    pub(super) fn opens(&self) -> bool {
        matches!(self, Self::Add(_) | Self::AddClips(_) | Self::Open(_))
    }
}

/// What plays, by the names of clips.
#[derive(Clone, Debug)]
pub(super) struct ShownClips {
    shown: Option<String>,
    /// By the other instances of the model.
    others: Vec<Option<String>>,
    blended: Option<(String, f32)>,
}

impl Session {
    pub(super) fn apply_to_files(&mut self, command: FileCommand) {
        match command {
            FileCommand::Add(files) => self.add_files(files),
            FileCommand::AddClips(files) => self.add_clips(files),
            FileCommand::Open(path) => self.open_file(&path),
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
        let job = LoadJob::new(Arc::clone(files), file).keeping_sky(self.sky_file().cloned());
        Some(self.reuse(job))
    }

    /// Opens one of [`Session::models`]. The pictures that were found for the models of its drop stay.
    fn open_file(&mut self, path: &str) {
        let content = &self.content;
        let here = content
            .files
            .get(path)
            .map(|file| (file, &content.files, &content.maps));
        let others = content.others.as_deref();
        let there = others.and_then(|others| Some((others.files.get(path)?, &others.files, &others.maps)));
        let Some((file, files, maps)) = here.or(there) else {
            return;
        };
        let again = content.open.as_ref().filter(|open| open.file.path == path);
        let joined = again
            .into_iter()
            .flat_map(|open| open.joined.iter().map(|joined| joined.file.clone()));
        let job = LoadJob::new(Arc::clone(files), file.clone())
            .without_sky()
            .reusing(maps.clone(), joined.collect());
        self.revisions.openings += 1;
        self.show(job.run());
    }

    /// The models that [`FileCommand::Open`] opens, sorted by their paths: those of the drop, and what was open before it.
    pub fn models(&self) -> Vec<&File> {
        let others = self.content.others.as_ref();
        let mut models = self.content.files.models();
        models.extend(others.into_iter().flat_map(|others| others.files.models()));
        models.sort_by_cached_key(|file| (file.path.to_lowercase(), file.path.clone()));
        models
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
                let joined = open.joined.iter().map(|joined| joined.file.clone());
                // The model alone, dropped again, keeps the pictures that came before.
                job.reusing(self.content.maps.clone(), joined.collect())
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

    /// A drop without a model: maps join the open one, and a cube map needs none.
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
        self.use_as_sky(FoundSky::among(files.cubes().cloned().collect(), self.sky_file()));
    }

    pub(super) fn fail(&mut self, error: LoadError) {
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
            sky,
        } = loaded;
        let was_playing = self.playback().is_playing();
        let clips_before = self.shown_clips();
        let others = self.content.others_of(&files);
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
            others,
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
        self.use_as_sky(sky);
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
            match open.join_clips(file, replaces) {
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
    pub(super) fn begin_first_clip(&mut self) {
        self.show_first_clip();
        self.begin_clips_of_crowd();
        if self.playback().is_playing() {
            self.note(Event::Play);
        }
        self.note(Event::TimeUpdate);
    }

    /// What plays, to be found again among other clips.
    pub(super) fn shown_clips(&self) -> ShownClips {
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
    pub(super) fn show_clips_again(&mut self, before: &ShownClips) {
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

    fn use_as_sky(&mut self, found: Option<FoundSky>) {
        let Content { sky, changes, .. } = &mut self.content;
        changes.sky |= found.is_some_and(|found| sky.choose(found, &mut self.view.look.background));
    }

    pub(super) fn clear_sky(&mut self) {
        let Content { sky, changes, .. } = &mut self.content;
        changes.sky |= sky.clear(&mut self.view.look.background);
    }
}
