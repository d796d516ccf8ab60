//! The view as plain data, and back.

use super::view_state::{AppearanceState, CameraState, PlaybackState, SelectionState, ViewState};
use crate::model::JointIndex;
use crate::scene::Overlays;
use crate::session::choose::selecting::{JointCommand, SubmeshCommand};
use crate::session::look::LookCommand;
use crate::session::look::view::Framed;
use crate::session::play::mixer::Blend;
use crate::session::{Event, Session};

impl Session {
    /// How the model is looked at now, for [`Command::Restore`](crate::session::Command::Restore).
    pub fn view_state(&self) -> ViewState {
        let (joints, submeshes) = (self.joints(), self.submeshes());
        let open = self.open_model();
        let file_bones = open.map_or(&[][..], |open| open.model.skeleton.file_bones());
        ViewState {
            camera: CameraState::of(&self.view),
            crowd: self.crowd(),
            appearance: AppearanceState::of(&self.view, file_bones),
            playback: PlaybackState::of(&self.actor, open),
            selection: SelectionState {
                bone: joints.selected().map(|joint| self.bone_number(joint)),
                vertex: joints.selected_vertex().map(|selected| selected.vertex),
                subset: submeshes.selected(),
                hidden_subsets: (0..submeshes.count())
                    .filter(|&submesh| submeshes.is_hidden(submesh))
                    .collect(),
                solo_subset: submeshes.solo(),
            },
        }
    }

    /// Looks at the open model as a state says. Clips, bones and submeshes that the model does not have are ignored, and numbers are
    /// clamped to their ranges.
    pub(in crate::session) fn restore(&mut self, state: &ViewState) {
        self.restore_appearance(&state.appearance);
        self.restore_playback(&state.playback);
        self.restore_crowd(state.crowd);
        self.restore_selection(&state.selection);
        self.view.motion.interrupt();
        self.view.motion.set_turntable(state.camera.turntable);
        self.view.camera = state.camera.camera(state.appearance.light);
        match state.camera {
            CameraState { framed: false, .. } => self.view.framed = Framed::No,
            CameraState { distance: 0.0, .. } => self.frame_model(),
            _ => self.hold_framed(),
        }
    }

    fn restore_appearance(&mut self, state: &AppearanceState) {
        let mut overlays = Overlays::none();
        state.overlays.iter().for_each(|&overlay| overlays.set(overlay, true));
        let trails: Vec<JointIndex> = state
            .trails
            .iter()
            .filter_map(|&bone| self.joint_of_bone(bone))
            .collect();
        let (view, joint_count) = (&mut self.view, self.selection.joints.count());
        overlays.line_length = view.look.overlays.line_length;
        view.look.overlays = overlays;
        for command in [
            LookCommand::SetLight(state.light),
            LookCommand::SetSplit(state.split),
            LookCommand::SetViewMode(state.view_mode),
            LookCommand::SetBackground(state.background),
            LookCommand::SetLineLength(state.line_length),
            LookCommand::SetEnvironmentTurn(state.environment_turn_radians),
            LookCommand::SetExposure(state.exposure_stops),
            LookCommand::SetGroundOffset(state.ground_offset),
            LookCommand::SetNormalGreenFlipped(state.normal_green_flipped),
            LookCommand::SetGhosts(state.ghosts),
            LookCommand::SetBindGhost(state.bind_ghost),
            LookCommand::SetBoneStyle(state.bone_style),
            LookCommand::SetLabelsVisible(state.labels_visible),
            LookCommand::SetBonesVisible(state.bones_visible),
            LookCommand::SetSkinView(state.skin_view),
            LookCommand::ClearTrails,
        ]
        .into_iter()
        .chain(trails.into_iter().map(LookCommand::ToggleTrail))
        {
            view.look.apply(command, joint_count);
        }
        view.look.set_book_lights_turn(state.book_lights_turn_radians);
        view.handedness = state.handedness;
        view.up_axis = state.up_axis;
    }

    fn restore_playback(&mut self, state: &PlaybackState) {
        for clip in 0..self.content.clip_count() {
            let is_kept = state.in_place.contains(&self.content.clips()[clip].name);
            self.keep_in_place(clip, is_kept);
        }
        let actor = &mut self.actor;
        actor.mixer.set_crossfade(state.crossfade_secs);
        actor.mixer.end_fades();
        actor.mixer.set_blend(None);
        actor.set_bind_weight(state.bind_weight);
        let playback = &mut actor.player.playback;
        playback.set_speed(state.speed);
        playback.set_loop_mode(state.loop_mode);
        playback.set_wrap_mode(state.wrap_mode);
        playback.set_backward(state.backward);
        playback.clear_range();
        let Some(open) = &self.content.open else { return };
        let clips = &open.model.clips;
        let named = |name: &str| clips.iter().position(|clip| clip.name == name);
        let Some(clip) = state.clip.as_deref().and_then(named) else {
            return;
        };
        actor.player.show_clip(open, clip);
        if let Some((name, weight)) = &state.blend
            && let Some(clip) = named(name)
        {
            actor.set_blend(Blend { clip, weight: *weight }, clips.len());
        }
        actor.player.set_range(state.range_secs);
        self.set_playing(state.playing);
        // After playing: to play at the end of a clip starts it over.
        self.actor.player.playback.seek(state.time_secs);
        self.note(Event::TimeUpdate);
    }

    fn restore_selection(&mut self, state: &SelectionState) {
        self.apply_to_submeshes(SubmeshCommand::ShowAll);
        for &submesh in &state.hidden_subsets {
            self.apply_to_submeshes(SubmeshCommand::SetVisible {
                submesh,
                visible: false,
            });
        }
        if let Some(submesh) = state.solo_subset {
            self.apply_to_submeshes(SubmeshCommand::Solo(submesh));
        }
        let joint = state.bone.and_then(|bone| self.joint_of_bone(bone));
        self.apply_to_submeshes(SubmeshCommand::Select(state.subset));
        self.apply_to_joints(JointCommand::Select(joint));
        self.apply_to_joints(JointCommand::SelectVertex(state.vertex));
    }

    /// The joint of a bone of the file.
    fn joint_of_bone(&self, bone: u32) -> Option<JointIndex> {
        let joints = self.open_model()?.model.skeleton.joint_of_bone();
        joints.get(bone as usize).copied()
    }
}
