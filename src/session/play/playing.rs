//! Time: playing, seeking, stepping, clips and speeds.

use std::borrow::Cow;

use super::actor::Actor;
use super::player::Player;
use crate::anim::{Direction, LoopGap, LoopMode, WrapMode, next_key, previous_key};
use crate::model::JointIndex;
use crate::session::{Blend, Event, SPEEDS, Session};

/// A command about what plays and how.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PlayCommand {
    /// Plays on in the direction it had; a clip that stopped at its end starts over.
    Play,
    /// Stops where it is.
    Pause,
    /// Plays or pauses.
    Toggle,
    /// Plays backward, or pauses when it does.
    ToggleBackward,
    /// Goes to a time, clamped to the clip.
    Seek {
        /// Seconds in the clip's own time.
        time_secs: f32,
    },
    /// Pauses and goes some frames on (or back), to a whole frame.
    StepFrames(i32),
    /// Goes to a place in frames of the clip's own key rate, clamped to the clip; between two frames where it has a fraction.
    SeekFrame(f64),
    /// Pauses and goes to the next key of a joint, or of any, in a direction; nowhere when there is none.
    StepKey {
        /// To later or to earlier keys.
        direction: Direction,
        /// Whose keys; `None` is every joint's.
        joint: Option<JointIndex>,
    },
    /// First frame, of the range where there is one.
    SeekStart,
    /// Last frame, of the range where there is one.
    SeekEnd,
    /// Starts the range at a time in seconds, or at the present time. A range that would end before then ends with the clip.
    /// Ranges are forgotten with their clip.
    SetRangeStart(Option<f32>),
    /// Ends the range at a time in seconds, or at the present time. A range that would begin after then begins with the clip.
    SetRangeEnd(Option<f32>),
    /// Removes the range: the whole clip plays.
    ClearRange,
    /// The pointer holds the time: playing waits until [`PlayCommand::EndScrub`].
    BeginScrub,
    /// The pointer let go: playing goes on if it played before.
    EndScrub,
    /// Shows a clip, by its index.
    SelectClip(usize),
    /// Shows the clip some places further in the list, which goes round at its ends.
    CycleClip(i32),
    /// How long the pose takes from clip to clip when one is selected while another plays, in seconds; 0 is at once.
    /// Under reduced motion it is at once in any case.
    SetCrossfade(f32),
    /// Blends a second clip into the one on show, at the same fraction of its length. Nothing for the clip on show itself.
    SetBlend {
        /// Index of the clip.
        clip: usize,
        /// Its weight in the pose, clamped to 0…1.
        weight: f32,
    },
    /// Shows the clip on show alone.
    ClearBlend,
    /// Keeps a clip over where it starts, or lets it go as its file has it. Nothing for one that goes nowhere.
    SetInPlace {
        /// Index of the clip.
        clip: usize,
        /// Whether it stays.
        on: bool,
    },
    /// Speed as a factor of the file's, clamped to [`crate::anim::MIN_SPEED`] and [`crate::anim::MAX_SPEED`].
    SetSpeed(f32),
    /// One of the [`crate::session::SPEEDS`] down.
    Slower,
    /// One of the [`crate::session::SPEEDS`] up.
    Faster,
    SetLoopMode(LoopMode),
    /// The next of once, loop, ping-pong.
    CycleLoopMode,
    SetWrapMode(WrapMode),
    /// Blends the pose with the bind pose: 0 the clip's pose … 1 the bind pose.
    SetBindWeight(f32),
    /// Switches between the bind pose and the clip's pose.
    ToggleBindPose,
}

impl Session {
    /// Playing, times and ways of playing are for all instances; clips, ranges and what is mixed are for the selected one.
    pub(in crate::session) fn apply_to_playback(&mut self, command: PlayCommand) {
        let actor = &mut self.actor;
        match command {
            PlayCommand::Play => self.set_playing(true),
            PlayCommand::Pause => self.set_playing(false),
            PlayCommand::Toggle => {
                let playing = !actor.player.playback.is_playing();
                actor.player.playback.set_backward(false);
                self.set_playing(playing);
            }
            PlayCommand::ToggleBackward => {
                let playing = !(actor.player.playback.is_playing() && actor.player.playback.is_backward());
                actor.player.playback.set_backward(true);
                self.set_playing(playing);
            }
            PlayCommand::Seek { time_secs } => self.seek(time_secs),
            PlayCommand::StepFrames(frames) => self.step_frames(frames),
            PlayCommand::SeekFrame(frame) => self.seek_frame(frame),
            PlayCommand::StepKey { direction, joint } => self.step_key(direction, joint),
            PlayCommand::SeekStart => {
                let [start_secs, _] = actor.player.playback.played_secs();
                self.seek(start_secs);
            }
            PlayCommand::SeekEnd => {
                let [_, end_secs] = actor.player.playback.played_secs();
                self.seek(end_secs);
            }
            PlayCommand::SetRangeStart(secs) => {
                let secs = secs.unwrap_or(actor.player.playback.time_secs());
                actor.player.playback.set_range_start(secs);
            }
            PlayCommand::SetRangeEnd(secs) => {
                let secs = secs.unwrap_or(actor.player.playback.time_secs());
                actor.player.playback.set_range_end(secs);
            }
            PlayCommand::ClearRange => actor.player.playback.clear_range(),
            PlayCommand::BeginScrub => actor.scrubbing = true,
            PlayCommand::EndScrub => actor.scrubbing = false,
            PlayCommand::SelectClip(clip) => self.select_clip(clip),
            PlayCommand::CycleClip(places) => self.cycle_clip(places),
            PlayCommand::SetCrossfade(secs) => actor.mixer.set_crossfade(secs),
            PlayCommand::SetBlend { clip, weight } => {
                actor.set_blend(Blend { clip, weight }, self.content.clip_count());
            }
            PlayCommand::ClearBlend => actor.mixer.set_blend(None),
            PlayCommand::SetInPlace { clip, on } => self.keep_in_place(clip, on),
            PlayCommand::SetSpeed(speed) => actor.player.playback.set_speed(speed),
            PlayCommand::Slower => self.step_speed(|speeds, speed| speeds.iter().rev().find(|&&s| s < speed - 1e-4)),
            PlayCommand::Faster => self.step_speed(|speeds, speed| speeds.iter().find(|&&s| s > speed + 1e-4)),
            PlayCommand::SetLoopMode(mode) => actor.player.playback.set_loop_mode(mode),
            PlayCommand::CycleLoopMode => {
                let next = match actor.player.playback.loop_mode() {
                    LoopMode::Once => LoopMode::Loop,
                    LoopMode::Loop => LoopMode::PingPong,
                    LoopMode::PingPong => LoopMode::Once,
                };
                actor.player.playback.set_loop_mode(next);
            }
            PlayCommand::SetWrapMode(mode) => actor.player.playback.set_wrap_mode(mode),
            PlayCommand::SetBindWeight(weight) => actor.set_bind_weight(weight),
            PlayCommand::ToggleBindPose => {
                let weight = if actor.bind_weight < 0.5 { 1.0 } else { 0.0 };
                actor.set_bind_weight(weight);
            }
        }
        self.instances.play_as(&self.actor.player);
    }

    /// How far the pose is brought to the bind pose: 0 as the clip has it … 1 the bind pose. See
    /// [`crate::anim::blend_to_bind`].
    pub fn bind_weight(&self) -> f32 {
        self.actor.bind_weight
    }

    /// Brings the pose to the clip and the time.
    pub(in crate::session) fn pose_now(&mut self) {
        if let Some(open) = &self.content.open {
            self.actor.update_pose(open, self.revisions.pose);
        }
    }

    pub(in crate::session) fn set_playing(&mut self, playing: bool) {
        let Player { clip, playback } = &mut self.actor.player;
        if clip.is_none() || playing == playback.is_playing() {
            return;
        }
        let was_at = playback.time_secs();
        if playing {
            playback.play();
        } else {
            playback.pause();
        }
        // To play at the end of a clip starts it over.
        let moved = playback.time_secs() != was_at;
        self.instances.set_playing(playing);
        self.note(if playing { Event::Play } else { Event::Pause });
        if moved {
            self.note(Event::TimeUpdate);
        }
    }

    fn seek(&mut self, time_secs: f32) {
        if self.clip_index().is_none() || time_secs.is_nan() {
            return;
        }
        // A time that was asked for is shown without fades.
        let Actor { mixer, player, .. } = &mut self.actor;
        mixer.end_fades();
        let was_at = player.playback.time_secs();
        player.playback.seek(time_secs);
        let is_at = player.playback.time_secs();
        if is_at != was_at {
            self.instances.shift(f64::from(is_at) - f64::from(was_at));
            self.note(Event::TimeUpdate);
        }
    }

    fn step_frames(&mut self, frames: i32) {
        let Some(clip) = self.clip() else { return };
        let time_secs = clip.step_frames(self.playback().time_secs(), frames);
        self.set_playing(false);
        self.seek(time_secs);
    }

    fn seek_frame(&mut self, frame: f64) {
        let Some(clip) = self.clip() else { return };
        if !frame.is_nan() {
            self.seek(clip.time_at_place(frame));
        }
    }

    fn step_key(&mut self, direction: Direction, joint: Option<JointIndex>) {
        let Some(clip) = self.clip() else { return };
        let (key_times, time_secs) = (self.key_times(joint), self.playback().time_secs());
        let key_secs = match direction {
            Direction::Forward => next_key(clip, key_times, time_secs),
            Direction::Backward => previous_key(clip, key_times, time_secs),
        };
        self.set_playing(false);
        if let Some(key_secs) = key_secs {
            self.seek(key_secs);
        }
    }

    fn select_clip(&mut self, index: usize) {
        let Some(open) = self.content.open.clone() else { return };
        if self.clip_index() == Some(index) || index >= open.model.clips.len() {
            return;
        }
        let actor = &mut self.actor;
        actor.fade_to(index, self.reduced_motion);
        actor.player.show_clip(&open, index);
        self.note(Event::TimeUpdate);
    }

    fn cycle_clip(&mut self, places: i32) {
        let count = self.content.clip_count();
        if let (Some(clip), true) = (self.clip_index(), count > 0) {
            self.select_clip((clip as i64 + i64::from(places)).rem_euclid(count as i64) as usize);
        }
    }

    fn step_speed(&mut self, pick: impl Fn(&'static [f32], f32) -> Option<&'static f32>) {
        if let Some(&speed) = pick(&SPEEDS, self.playback().speed()) {
            self.actor.player.playback.set_speed(speed);
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
        match (&self.content.open, self.clip_index()) {
            (Some(open), Some(clip)) => open.key_times(clip, joint),
            _ => &[],
        }
    }

    /// The gap of the loop that plays or would play: of the whole clip it is lent, of a range it is found anew. `None` where
    /// there is one pose alone.
    pub fn loop_gap(&self) -> Option<Cow<'_, LoopGap>> {
        let (open, clip) = (self.content.open.as_ref()?, self.clip()?);
        let span_secs = self.playback().loop_gap_secs()?;
        Some(if span_secs == [clip.start_secs, clip.end_secs] {
            Cow::Borrowed(open.loop_gap(self.clip_index()?)?)
        } else {
            Cow::Owned(open.loop_gap_between(open.compiled.get(self.clip_index()?)?, span_secs))
        })
    }

    /// Where the time is in frames of the clip on show, counted from 0: 30.5 is half way from frame 30 to frame 31.
    pub fn frame_place(&self) -> Option<f64> {
        Some(self.clip()?.place_of(self.playback().time_secs()))
    }
}
