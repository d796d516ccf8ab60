//! Taking up what was dropped.

use std::collections::BTreeSet;
use std::sync::Arc;

use super::{Event, File, FileSet, LoadError, Maps, OpenModel, Session, load};
use crate::anim::{Playback, PoseBuffers};
use crate::scene::Camera;

impl Session {
    pub(super) fn add_files(&mut self, files: Vec<File>) -> bool {
        self.maps.forget_unused();
        let files = FileSet::new(files);
        let Some(path) = self.wanted_model(&files) else {
            self.add_pictures(&files);
            return false;
        };
        // The old set stays while the new model is not there: its other models can still be opened.
        let previous = std::mem::replace(&mut self.files, files);
        let opened = self.open_file(&path);
        if opened {
            self.take_up_sky(self.files.cubes().cloned().collect());
        } else {
            self.files = previous;
        }
        opened
    }

    /// The path of the model to open: the largest, but where the models of the open drop come again, the one that is on screen.
    fn wanted_model(&self, files: &FileSet) -> Option<String> {
        let paths = |set: &FileSet| {
            set.models()
                .iter()
                .map(|file| file.path.clone())
                .collect::<BTreeSet<_>>()
        };
        let on_screen = self.open.as_ref().map(|open| &open.file.path);
        let again = on_screen.filter(|&path| {
            let models = paths(files);
            models.contains(path) && models == paths(&self.files)
        });
        again.or(files.models().first().map(|file| &file.path)).cloned()
    }

    /// A drop without a model: maps join the open one, and a cube map needs none.
    fn add_pictures(&mut self, files: &FileSet) {
        let has_maps = files.images().next().is_some();
        let has_cubes = files.cubes().next().is_some();
        match &self.open {
            Some(open) if has_maps => {
                if self.maps.join(&open.model.materials, files.images().cloned()) {
                    self.maps_revision += 1;
                }
                self.error = None;
            }
            None if has_maps => self.fail(LoadError::no_model(files)),
            _ if has_cubes => self.error = None,
            _ => self.fail(LoadError::no_model(files)),
        }
        self.take_up_sky(files.cubes().cloned().collect());
    }

    pub(super) fn open_file(&mut self, path: &str) -> bool {
        let Some(file) = self.files.get(path) else { return false };
        match load(file) {
            Ok(open) => {
                self.replace_model(open);
                true
            }
            Err(error) => {
                self.fail(*error);
                false
            }
        }
    }

    pub(super) fn fail(&mut self, error: LoadError) {
        self.error = Some(error);
        self.note(Event::Error);
    }

    /// Shows another model. The same file again keeps camera, clip, time and choices.
    pub(super) fn replace_model(&mut self, mut open: OpenModel) {
        let again = self
            .open
            .as_ref()
            .filter(|old| old.file.base_name() == open.file.base_name());
        let kept_clip = again.and_then(|_| Some(self.clip()?.name.clone()));
        if let Some(old) = again {
            open.join_again(old.joined.iter().map(|joined| &joined.file));
        }
        let again = again.is_some();
        let range_secs = self.playback.range_secs();
        let was_playing = self.playback.is_playing();

        self.pose = PoseBuffers::for_skeleton(&open.model.skeleton);
        self.posed = None;
        self.mix.take_up_model();
        self.error = None;
        // The bar that was held may be gone, and nothing would let go of the time.
        self.scrubbing = false;
        self.model_revision += 1;
        self.clips_revision += 1;
        self.maps_revision += 1;
        // The model alone, dropped again, keeps the pictures that came before.
        if !again {
            self.maps = Maps::default();
        }
        self.maps.add(&open.model.materials, self.files.images().cloned());
        self.subsets.take_up(open.model.mesh.submeshes.len(), again);
        self.joints.take_up(&open.model, again);
        match &self.open {
            Some(before) if again => self
                .materials
                .take_up_again(&open.model.materials, &before.model.materials),
            _ => self.materials.take_up(&open.model.materials),
        }
        self.open = Some(Arc::new(open));
        if again {
            let time_secs = self.playback.time_secs();
            let clips = self
                .open
                .as_ref()
                .map(|open| open.model.clips.as_slice())
                .unwrap_or_default();
            let clip = kept_clip.and_then(|name| clips.iter().position(|clip| clip.name == name));
            self.clip = None;
            if self.show_clip(clip.unwrap_or(0)) {
                if let (Some(_), Some([start_secs, end_secs])) = (clip, range_secs) {
                    self.playback.set_range_end(end_secs);
                    self.playback.set_range_start(start_secs);
                }
                self.playback.seek(time_secs);
            } else {
                self.playback = Playback::default();
            }
        } else {
            self.motion.take_up_model();
            self.quality.take_up_model();
            self.bind_share = 0.0;
            self.handedness_override = None;
            self.up_axis_override = None;
            self.clip = None;
            self.playback = Playback::default();
            self.show_clip(0);
            self.camera = Camera {
                projection: self.camera.projection,
                ..Camera::default()
            };
            self.frame_model();
            if self.clip.is_some() && !self.reduced_motion {
                self.playback.play();
            }
        }
        self.note(Event::Load);
        if self.playback.is_playing() != was_playing {
            self.note(if was_playing { Event::Pause } else { Event::Play });
        }
        self.note(Event::TimeUpdate);
    }
}
