//! Time: playing, seeking, stepping, clips and speeds.

use super::{Event, SPEEDS, Session};
use crate::anim::{Direction, next_key, previous_key};
use crate::model::JointIndex;

impl Session {
    pub(super) fn set_playing(&mut self, playing: bool) {
        if self.clip().is_none() || playing == self.playback.is_playing() {
            return;
        }
        let was_at = self.playback.time_secs();
        if playing {
            self.playback.play();
        } else {
            self.playback.pause();
        }
        self.note(if playing { Event::Play } else { Event::Pause });
        // What stood at its end begins anew.
        if self.playback.time_secs() != was_at {
            self.note(Event::TimeUpdate);
        }
    }

    pub(super) fn seek(&mut self, time_secs: f32) {
        if self.clip().is_none() || time_secs.is_nan() {
            return;
        }
        // Who asks for a time wants to see the pose of that time.
        self.mix.end_fades();
        let was_at = self.playback.time_secs();
        self.playback.seek(time_secs);
        if self.playback.time_secs() != was_at {
            self.note(Event::TimeUpdate);
        }
    }

    pub(super) fn step_frames(&mut self, frames: i32) {
        let Some(clip) = self.clip() else { return };
        let time_secs = clip.step_frames(self.playback.time_secs(), frames);
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
        let (key_times, time_secs) = (self.key_times(joint), self.playback.time_secs());
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
        let count = self.open.as_ref().map_or(0, |open| open.model.clips.len());
        if self.clip == Some(index) || index >= count {
            return;
        }
        self.fade_to(index);
        if self.show_clip(index) {
            self.note(Event::TimeUpdate);
        }
    }

    /// Goes to a clip's first time; false when there is no such clip.
    pub(super) fn show_clip(&mut self, index: usize) -> bool {
        let Some(clip) = self.open.as_ref().and_then(|open| open.model.clips.get(index)) else {
            return false;
        };
        self.playback.set_span(clip.start_secs, clip.end_secs);
        self.playback.seek(if self.playback.is_backward() {
            clip.end_secs
        } else {
            clip.start_secs
        });
        self.clip = Some(index);
        true
    }

    pub(super) fn cycle_clip(&mut self, places: i32) {
        let count = self.open.as_ref().map_or(0, |open| open.model.clips.len());
        if let (Some(clip), true) = (self.clip, count > 0) {
            self.select_clip((clip as i64 + i64::from(places)).rem_euclid(count as i64) as usize);
        }
    }

    pub(super) fn step_speed(&mut self, pick: impl Fn(&'static [f32], f32) -> Option<&'static f32>) {
        if let Some(&speed) = pick(&SPEEDS, self.playback.speed()) {
            self.playback.set_speed(speed);
        }
    }
}
