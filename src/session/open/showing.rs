//! What was made ready is shown: a model with all that belongs to it, pictures and clips that join the open one, skies.

use std::collections::HashSet;
use std::sync::Arc;

use super::content::Content;
use super::files::{File, FileSet};
use super::load::{LoadError, Loaded};
use super::open_model::OpenModel;
use super::wish::{PicturesJoined, Ready, Wish};
use crate::diagnostic::Fault;
use crate::image::Image;
use crate::session::changes::Changes;
use crate::session::look::materials::Materials;
use crate::session::play::actor::Actor;
use crate::session::play::instances::Instances;
use crate::session::play::mixer::Blend;
use crate::session::play::player::Player;
use crate::session::{Event, News, Session};

/// What plays, by the names of clips.
#[derive(Clone, Debug)]
pub(in crate::session) struct ShownClips {
    shown: Option<String>,
    /// By the other instances of the model.
    others: Vec<Option<String>>,
    blended: Option<(String, f32)>,
}

impl Session {
    pub(in crate::session) fn show(&mut self, ready: Ready) {
        match ready {
            Ready::Model(Ok(loaded)) => {
                self.content.maps.forget_unused();
                self.replace_model(*loaded);
            }
            Ready::Model(Err(error)) => {
                self.content.maps.forget_unused();
                self.fail(*error);
            }
            Ready::Others(files, joined) => self.add_others(&files, joined),
            Ready::Clips(files, read) => self.add_clips(&files, read),
            Ready::Sky(file, read) => self.use_as_sky(file, read),
        }
    }

    /// A drop without a model: maps join the open one, and cube maps by themselves need none.
    fn add_others(&mut self, files: &FileSet, joined: Option<PicturesJoined>) {
        let has_maps = files.images().next().is_some();
        let has_cubes = files.cubes().next().is_some();
        match joined {
            Some(joined) => {
                self.content.maps = joined.maps;
                self.content.changes.maps |= joined.are_others;
                // The first picture makes the others missing, even one that fits none.
                self.content.verdicts.forget();
                self.content.error = None;
            }
            None => {
                self.content.maps.forget_unused();
                if has_cubes && !has_maps {
                    self.content.error = None;
                } else {
                    self.fail(LoadError::no_model(files));
                }
            }
        }
        if has_maps {
            self.offer_skies(files);
        } else {
            let cubes = self.content.sky.note(files);
            let wish = self.sky_wish(cubes.into_iter().next());
            self.opening.waiting.extend(wish);
        }
    }

    pub(in crate::session) fn fail(&mut self, error: LoadError) {
        self.content.error = Some(error);
        self.note(Event::Error);
    }

    /// Shows another model, with all that belongs to it. The same file again keeps camera, clip, time and choices, and what is in place.
    fn replace_model(&mut self, loaded: Loaded) {
        let Loaded {
            files,
            mut open,
            maps,
            verdicts,
        } = loaded;
        let was_playing = self.playback().is_playing();
        let clips_before = self.shown_clips();
        let (opened, news) = self.content.opened_with(&files, self.revisions.openings);
        let old = std::mem::take(&mut self.content);
        let before = old.open.filter(|old| old.file.base_name() == open.file.base_name());
        let again = before.is_some();
        if let Some(before) = &before {
            Arc::make_mut(&mut open).keep_as_before(before);
        }
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
            self.view.look.trails = Default::default();
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
            open: Some(open),
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

    /// Goes to the clip that is shown first, if there is one, and plays it unless motion is reduced.
    fn show_first_clip(&mut self) {
        if let Some(open) = &self.content.open
            && let Some(first) = open.first_clip()
        {
            let player = &mut self.actor.player;
            player.show_clip(open, first);
            if !self.reduced_motion {
                player.playback.play();
            }
        }
    }

    /// Adds the clips of every model of a drop that could be read, in the order of the drop.
    fn add_clips(&mut self, files: &FileSet, read: Vec<Result<OpenModel, Box<LoadError>>>) {
        self.content.maps.forget_unused();
        let before = self.shown_clips();
        let Some(open) = &mut self.content.open else {
            return;
        };
        let was = Arc::clone(open);
        let open = Arc::make_mut(open);
        let had_clips = !open.model.clips.is_empty();
        let mut refused = read.is_empty().then(|| Box::new(LoadError::no_model(files)));
        let mut joined: HashSet<String> = HashSet::new();
        let mut replaced = false;
        for other in read {
            let added = other.and_then(|other| {
                let name = other.file.base_name().to_owned();
                // Files of one drop that have one name in several folders do not replace each other.
                let replaced_some = open.join_clips(other, files, !joined.contains(&name))?;
                joined.insert(name);
                Ok(replaced_some)
            });
            match added {
                Ok(replaced_some) => replaced |= replaced_some,
                Err(error) => refused = refused.or(Some(error)),
            }
        }
        open.keep_as_before(&was);
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

    /// Keeps a clip over where it starts, or lets it go.
    pub(in crate::session) fn keep_in_place(&mut self, clip: usize, is_kept: bool) {
        let open = self.content.open.as_ref();
        let Some(placed) = open.and_then(|open| open.placed(clip, is_kept)) else {
            return;
        };
        let before = self.shown_clips();
        if let Some(open) = &mut self.content.open {
            Arc::make_mut(open).put(clip, placed);
        }
        self.show_clips_again(&before);
    }

    /// The wish that a cube map is the sky, unless it is.
    pub(super) fn sky_wish(&self, cube: Option<File>) -> Option<Wish> {
        cube.filter(|cube| self.sky_file() != Some(cube)).map(Wish::Sky)
    }

    fn use_as_sky(&mut self, cube: File, read: Result<Image, Fault>) {
        let Content { sky, changes, .. } = &mut self.content;
        // Read again, it changes what is shown and is no news.
        let is_again = sky.file().is_some_and(|file| file.path == cube.path);
        let name = cube.base_name().to_owned();
        if sky.choose(cube, read, &mut self.view.look.background) {
            changes.sky = true;
            self.news.extend((!is_again).then_some(News::SkyUsed(name)));
        }
    }

    /// Notes the cube maps that came among other files. Where the sky came again and is another now, it is shown.
    fn offer_skies(&mut self, files: &FileSet) {
        let sky = &mut self.content.sky;
        let known = sky.found.len();
        let cubes = sky.note(files);
        let is_sky = |cube: &&File| sky.file().is_some_and(|file| file.path == cube.path);
        let again = cubes.iter().find(is_sky).cloned();
        let new = sky.found.get(known);
        self.news.extend(new.map(|cube| News::SkyFound(cube.path.clone())));
        let wish = self.sky_wish(again);
        self.opening.waiting.extend(wish);
    }

    pub(in crate::session) fn clear_sky(&mut self) {
        let Content { sky, changes, .. } = &mut self.content;
        changes.sky |= sky.clear(&mut self.view.look.background);
    }
}
