//! Time: playing, seeking, stepping, clips and speeds.

use std::borrow::Cow;

use super::{Blend, Event, SPEEDS, Session};
use crate::anim::{Direction, LoopGap, next_key, previous_key};
use crate::model::JointIndex;

impl Session {
    /// How far the pose is brought to the bind pose: 0 as the clip has it … 1 the bind pose. See
    /// [`crate::anim::blend_to_rest`].
    pub fn bind_weight(&self) -> f32 {
        self.actor.bind_weight
    }

    /// Brings the pose to the clip and the time.
    pub(super) fn pose_now(&mut self) {
        if let Some(open) = &self.content.open {
            self.actor.update_pose(open, self.revisions.pose);
        }
    }

    pub(super) fn set_playing(&mut self, playing: bool) {
        let playback = &mut self.actor.playback;
        if self.actor.clip.is_none() || playing == playback.is_playing() {
            return;
        }
        let was_at = playback.time_secs();
        if playing {
            playback.play();
        } else {
            playback.pause();
        }
        // What stood at its end begins anew.
        let moved = playback.time_secs() != was_at;
        self.note(if playing { Event::Play } else { Event::Pause });
        if moved {
            self.note(Event::TimeUpdate);
        }
    }

    pub(super) fn seek(&mut self, time_secs: f32) {
        if self.actor.clip.is_none() || time_secs.is_nan() {
            return;
        }
        // Who asks for a time wants to see the pose of that time.
        self.actor.mixer.end_fades();
        let was_at = self.actor.playback.time_secs();
        self.actor.playback.seek(time_secs);
        if self.actor.playback.time_secs() != was_at {
            self.note(Event::TimeUpdate);
        }
    }

    pub(super) fn step_frames(&mut self, frames: i32) {
        let Some(clip) = self.clip() else { return };
        let time_secs = clip.step_frames(self.actor.playback.time_secs(), frames);
        self.set_playing(false);
        self.seek(time_secs);
    }

    pub(super) fn seek_frame(&mut self, frame: f64) {
        let Some(clip) = self.clip() else { return };
        if !frame.is_nan() {
            self.seek(clip.time_at_place(frame));
        }
    }

    pub(super) fn step_key(&mut self, direction: Direction, joint: Option<JointIndex>) {
        let Some(clip) = self.clip() else { return };
        let (key_times, time_secs) = (self.key_times(joint), self.actor.playback.time_secs());
        let key_secs = match direction {
            Direction::Forward => next_key(clip, key_times, time_secs),
            Direction::Backward => previous_key(clip, key_times, time_secs),
        };
        self.set_playing(false);
        if let Some(key_secs) = key_secs {
            self.seek(key_secs);
        }
    }

    pub(super) fn select_clip(&mut self, index: usize) {
        let Some(open) = self.content.open.clone() else { return };
        if self.actor.clip == Some(index) || index >= open.model.clips.len() {
            return;
        }
        let at_once = self.reduced_motion;
        self.actor.fade_to(index, at_once);
        self.actor.show_clip(&open, index);
        self.note(Event::TimeUpdate);
    }

    pub(super) fn cycle_clip(&mut self, places: i32) {
        let count = self.content.clip_count();
        if let (Some(clip), true) = (self.actor.clip, count > 0) {
            self.select_clip((clip as i64 + i64::from(places)).rem_euclid(count as i64) as usize);
        }
    }

    pub(super) fn step_speed(&mut self, pick: impl Fn(&'static [f32], f32) -> Option<&'static f32>) {
        if let Some(&speed) = pick(&SPEEDS, self.actor.playback.speed()) {
            self.actor.playback.set_speed(speed);
        }
    }

    /// How long the pose takes from one clip to the next while it plays, in seconds; 0 is at once. Paused and under reduced
    /// motion clips change at once.
    pub fn crossfade_secs(&self) -> f32 {
        self.actor.mixer.crossfade_secs()
    }

    /// The clip that is blended into the one that plays.
    pub fn blend(&self) -> Option<Blend> {
        self.actor.mixer.blend()
    }

    /// Whether a clip that played before is still seen. A fade goes on to its end when playing is paused, so that a picture that
    /// stands still is a pose of its clip and time.
    pub fn is_fading(&self) -> bool {
        self.actor.is_fading()
    }

    /// Key times of the clip on show, in order: of one joint, or of all.
    pub fn key_times(&self, joint: Option<JointIndex>) -> &[f32] {
        match (&self.content.open, self.actor.clip) {
            (Some(open), Some(clip)) => open.key_times(clip, joint),
            _ => &[],
        }
    }

    /// The gap of the loop that plays or would play: of the whole clip it is lent, of a range it is found anew. `None` where
    /// nothing loops.
    pub fn loop_gap(&self) -> Option<Cow<'_, LoopGap>> {
        let (open, clip) = (self.content.open.as_ref()?, self.clip()?);
        let span_secs = self.actor.playback.loop_gap_secs()?;
        Some(if span_secs == [clip.start_secs, clip.end_secs] {
            Cow::Borrowed(open.loop_gap(self.actor.clip?)?)
        } else {
            Cow::Owned(open.loop_gap_between(open.compiled.get(self.actor.clip?)?, span_secs))
        })
    }

    /// Where the time is in frames of the clip on show, counted from 0: 30.5 is half way from frame 30 to frame 31.
    pub fn frame_place(&self) -> Option<f64> {
        Some(self.clip()?.place_of(self.actor.playback.time_secs()))
    }
}
