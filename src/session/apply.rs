//! The one place where things change.

use super::look::quality::QualityNow;
use super::look::skeleton_cache::SkinColorsKey;
use super::look::view::View;
use super::play::actor::{PlaybackSettings, PoseInputs};
use super::{Changes, Command, Event, Session};
use crate::model::{Handedness, UpAxis};

impl Session {
    /// Applies a command and returns what changed. A command that makes no sense now is ignored.
    pub fn apply(&mut self, command: impl Into<Command>) -> Changes {
        let command = command.into();
        let to_go_back_to = match &command {
            Command::File(command) if command.opens() => self.to_go_back_to(),
            _ => None,
        };
        let before = command.is_undoable().then(|| self.undoable());
        let changes = self.track(|session| session.perform(command));
        if let Some(before) = before
            && !changes.model
        {
            self.record_step(&before);
        }
        if changes.need_upload() && to_go_back_to.is_some() {
            self.before = to_go_back_to;
        }
        // Opening a model has its own event, `Load`.
        if changes.playback && !changes.model {
            self.note(Event::PlaybackChange);
        }
        changes
    }

    pub(super) fn perform(&mut self, command: Command) {
        match command {
            Command::File(command) => self.apply_to_files(command),
            Command::Play(command) => self.apply_to_playback(command),
            Command::Camera(command) => self.apply_to_camera(command),
            Command::Joint(command) => self.apply_to_joints(command),
            Command::Name(command) => self.apply_to_names(command),
            Command::Submesh(command) => self.apply_to_submeshes(command),
            Command::Look(command) => {
                self.view.look.apply(command, self.selection.joints.count());
                self.follow_light();
            }
            Command::Material(command) => {
                let open = self.content.open.as_ref();
                let of_file = open.map_or(&[][..], |open| &open.model.materials);
                self.content.changes.materials |= self.content.materials.apply(command, of_file);
            }
            Command::Quality(command) => self.quality.apply(command),
            Command::Crowd(command) => self.apply_to_crowd(command),
            Command::Export(command) => self.apply_to_export(command),
            Command::History(command) => self.apply_to_history(command),
            Command::SetHandedness(handedness) => {
                self.view.handedness = handedness;
                self.change_goal(Self::frame_model);
            }
            Command::SetUpAxis(up_axis) => {
                self.view.up_axis = up_axis;
                self.change_goal(Self::frame_model);
            }
            Command::SetTheme(theme) => self.view.theme = theme,
            Command::Restore(state) => self.restore(&state),
        }
    }
}

/// Copies of the small parts of a session, to compare before with after: so no change of them is missed, whichever command made
/// it. Large parts (model, maps, sky, materials, names) and parts that change in few places record their changes themselves.
struct Before {
    view: View,
    /// How the model stands in the world.
    space: (Handedness, UpAxis),
    pose: PoseInputs,
    settings: PlaybackSettings,
    clip_count: usize,
    quality: QualityNow,
    skin_colors: Option<SkinColorsKey>,
}

impl Session {
    fn before(&self) -> Before {
        Before {
            view: self.view.clone(),
            space: (self.handedness(), self.up_axis()),
            pose: self.actor.pose_inputs(),
            settings: self.actor.settings(),
            clip_count: self.content.clip_count(),
            quality: self.quality.now(),
            skin_colors: self.skin_colors_key(),
        }
    }

    /// What differs from before, and what the parts recorded.
    fn changes_since(&mut self, before: &Before) -> Changes {
        let mut changes = self.content.changes.take();
        let [others_drawn, others_stand_out] = self.selection.submeshes.take_redraw();
        changes.picture |= others_stand_out || self.selection.joints.take_redraw();
        changes.pose |= changes.clips || self.actor.pose_inputs() != before.pose;
        changes.pose |= self.actor.mixer.take_changed();
        changes.pose |= self.instances.take_changed();
        changes.playback |=
            changes.clips || self.actor.settings() != before.settings || self.content.clip_count() != before.clip_count;
        changes.scene |= changes.pose
            || changes.maps
            || changes.materials
            || changes.sky
            || others_drawn
            || (self.handedness(), self.up_axis()) != before.space
            || self.quality.now() != before.quality
            || self.skin_colors_key() != before.skin_colors
            || !self.view.shows_the_same_scene_as(&before.view);
        changes.picture |= changes.scene || changes.names || !self.view.shows_the_same_as(&before.view);
        changes
    }

    /// Counts changes in the revisions, so that caches that were made from what changed are filled again.
    pub(super) fn commit(&mut self, changes: Changes) {
        self.revisions.count(changes);
    }

    /// Runs `act`, counts what it changed, and returns it.
    pub(super) fn track(&mut self, act: impl FnOnce(&mut Self)) -> Changes {
        let before = self.before();
        act(self);
        let changes = self.changes_since(&before);
        self.commit(changes);
        changes
    }
}
