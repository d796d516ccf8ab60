//! Several instances of the open model, each with a clip and a time of its own.

use glam::Affine3A;

use super::instances::{CrowdState, Formation, MAX_CROWD, moved};
use super::player::Player;
use crate::scene::Aabb;
use crate::session::look::camera::CameraCommand;
use crate::session::{Event, Session};

/// A command about the instances of the model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CrowdCommand {
    /// Shows this many instances, clamped to 1…[`MAX_CROWD`]; clips, times and places come from a seed. The first stays where it is and as
    /// it is. If the seed is the same as before, the others that are kept stay as they are, too. The camera frames them. Ignored without a model.
    Set {
        /// Instances, with the first.
        count: usize,
        /// The same seed, the same crowd.
        seed: u32,
    },
    /// Makes an instance the one that is selected: timeline, skeleton and read-outs are of it. Fades and blends of the instance selected
    /// before end. An instance that is not there is ignored.
    Select(usize),
}

impl Session {
    /// How many instances of the model there are, and which is selected.
    pub fn crowd(&self) -> CrowdState {
        self.instances.state()
    }

    pub(in crate::session) fn apply_to_crowd(&mut self, command: CrowdCommand) {
        match command {
            CrowdCommand::Set { count, seed } => self.set_crowd(count, seed),
            CrowdCommand::Select(instance) => self.select_instance(instance),
        }
    }

    fn set_crowd(&mut self, count: usize, seed: u32) {
        let (Some(open), before) = (self.content.open.clone(), self.crowd()) else {
            return;
        };
        let count = count.clamp(1, MAX_CROWD);
        let kept = if seed == before.seed {
            before.count.min(count)
        } else {
            1
        };
        if before.selected >= kept {
            self.select_instance(0);
        }
        if (count, seed) != (before.count, before.seed) {
            self.instances.set(&open, kept, (count, seed), &self.actor.player);
        }
        self.select_instance(before.selected.min(count - 1));
        if count != before.count || self.is_framed() {
            self.apply_to_camera(CameraCommand::Glide(Box::new(CameraCommand::FrameModel)));
        }
    }

    /// Makes all instances but the selected one anew, which keeps what it plays.
    pub(in crate::session) fn restore_crowd(&mut self, state: CrowdState) {
        let Some(open) = &self.content.open else { return };
        self.instances.restore(open, state, &self.actor.player);
    }

    /// Gives the other instances clips of a model that had none.
    pub(in crate::session) fn begin_clips_of_crowd(&mut self) {
        if let Some(open) = &self.content.open {
            self.instances.give_clips(open, 0, &self.actor.player);
            self.instances.measure(open);
        }
    }

    pub(in crate::session) fn player(&self, instance: usize) -> Option<&Player> {
        if instance == self.crowd().selected {
            return Some(&self.actor.player);
        }
        self.instances.player(instance)
    }

    /// Makes an instance the selected one, if it is there.
    pub(in crate::session) fn select_instance(&mut self, instance: usize) {
        if instance == self.crowd().selected || instance >= self.instances.count() {
            return;
        }
        let (was_at, was_playing) = (self.playback().time_secs(), self.playback().is_playing());
        self.actor.mixer.end_fades();
        self.actor.mixer.set_blend(None);
        self.instances.select(instance, &mut self.actor.player);
        if self.playback().time_secs() != was_at {
            self.note(Event::TimeUpdate);
        }
        // It has come to the end of its clip, played once.
        if was_playing && !self.playback().is_playing() {
            self.note(Event::Pause);
            self.instances.set_playing(false);
        }
    }

    pub(in crate::session) fn formation(&self) -> Formation {
        self.instances.formation(self.world_from_file())
    }

    /// The file's space -> the world, for the first instance.
    pub(in crate::session) fn world_from_file(&self) -> Affine3A {
        self.view.world_from_model(self.open_model())
    }

    /// The same for the selected instance.
    pub(in crate::session) fn world_from_model(&self) -> Affine3A {
        let world_from_file = self.world_from_file();
        if !self.instances.are_many() {
            return world_from_file;
        }
        moved(
            world_from_file,
            self.instances.offset(&self.formation(), self.crowd().selected),
        )
    }

    /// Box of all that the clips in the pose of the selected instance reach, world space.
    pub(in crate::session) fn selected_bounds(&self) -> Aabb {
        let reach = self.content.open.as_ref().map(|open| self.actor.reach(open));
        reach.unwrap_or_default().transformed(self.world_from_model())
    }
}
