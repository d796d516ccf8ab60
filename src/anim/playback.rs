//! Where in a clip we are, and how time moves on. There is no clock here: the caller says how much time went by.

use crate::model::{Clip, FrameGrid};

/// A time this close to a frame, in frames, is on it: what f32 loses of a time is far less.
const ON_FRAME: f64 = 0.01;

/// What happens at the end of the range.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum LoopMode {
    /// Stop there.
    Once,
    /// Go on from the other end.
    #[default]
    Loop,
    /// Turn around.
    PingPong,
}

/// A place in a clip and the way it moves. Time stays inside the clip; while playing it stays inside the range, a part of
/// the clip that is the whole clip at first.
#[derive(Clone, Debug, PartialEq)]
pub struct Playback {
    frames: FrameGrid,
    range_start_secs: f32,
    range_end_secs: f32,
    // In f64, so that thousands of small steps add up to the time that went by.
    time_secs: f64,
    playing: bool,
    // The way back of a ping-pong.
    returning: bool,
    speed: f32,
    loop_mode: LoopMode,
}

/// Nothing to play.
impl Default for Playback {
    fn default() -> Self {
        Self::for_clip(&Clip::new("", Vec::new()))
    }
}

impl Playback {
    /// Paused at the start of a clip, its whole length as range, at speed 1, looping.
    pub fn for_clip(clip: &Clip) -> Self {
        Self {
            frames: clip.frames(),
            range_start_secs: clip.start_secs,
            range_end_secs: clip.end_secs,
            time_secs: f64::from(clip.start_secs),
            playing: false,
            returning: false,
            speed: 1.0,
            loop_mode: LoopMode::default(),
        }
    }

    /// The start of another clip; playing, speed and loop mode stay as they are.
    pub fn set_clip(&mut self, clip: &Clip) {
        let (playing, speed, loop_mode) = (self.playing, self.speed, self.loop_mode);
        *self = Self {
            playing,
            speed,
            loop_mode,
            ..Self::for_clip(clip)
        };
    }

    /// Time in the clip, seconds.
    pub fn time_secs(&self) -> f32 {
        self.time_secs as f32
    }

    /// Start of the clip.
    pub fn start_secs(&self) -> f32 {
        self.frames.start_secs
    }

    /// End of the clip.
    pub fn end_secs(&self) -> f32 {
        self.frames.end_secs
    }

    /// Length of the clip, 0 or more.
    pub fn duration_secs(&self) -> f32 {
        self.frames.duration_secs()
    }

    /// The clip's frames.
    pub fn frames(&self) -> FrameGrid {
        self.frames
    }

    /// The frame nearest to the time.
    pub fn frame(&self) -> u32 {
        self.frames.frame_at(self.time_secs())
    }

    /// Start and end of the part that plays.
    pub fn range_secs(&self) -> (f32, f32) {
        (self.range_start_secs, self.range_end_secs)
    }

    /// Whether it was told to play and has not stopped.
    pub fn is_playing(&self) -> bool {
        self.playing
    }

    /// Whether [`Playback::advance`] would move it: playing, at a speed, over a range that has a length.
    pub fn is_moving(&self) -> bool {
        self.playing && self.speed != 0.0 && self.range_end_secs > self.range_start_secs
    }

    /// Seconds of the clip for a second of time; negative plays backwards.
    pub fn speed(&self) -> f32 {
        self.speed
    }

    /// What happens at the end of the range.
    pub fn loop_mode(&self) -> LoopMode {
        self.loop_mode
    }

    /// Sets the speed; a speed that is not finite is left out.
    pub fn set_speed(&mut self, speed: f32) {
        if speed.is_finite() {
            self.speed = speed;
        }
    }

    /// Sets what happens at the end of the range.
    pub fn set_loop_mode(&mut self, loop_mode: LoopMode) {
        self.loop_mode = loop_mode;
        self.returning = false;
    }

    /// Begins to play. In [`LoopMode::Once`] a playback that stands at its end begins anew.
    pub fn play(&mut self) {
        self.playing = true;
        let (start_secs, end_secs) = self.range();
        let at_end = match self.speed {
            speed if speed > 0.0 => self.time_secs >= end_secs,
            speed if speed < 0.0 => self.time_secs <= start_secs,
            _ => false,
        };
        if self.loop_mode == LoopMode::Once && at_end {
            self.time_secs = self.entry();
        }
    }

    /// Stops where it is.
    pub fn pause(&mut self) {
        self.playing = false;
    }

    /// Plays when paused, and the other way round.
    pub fn toggle(&mut self) {
        if self.playing { self.pause() } else { self.play() }
    }

    /// Goes to a time inside the clip, whether playing or not; the range does not hold it. NaN goes to the start.
    pub fn seek(&mut self, time_secs: f32) {
        // The bounds in this order turn NaN into the start.
        self.time_secs = f64::from(time_secs.max(self.frames.start_secs).min(self.frames.end_secs));
        self.returning = false;
    }

    /// Pauses and goes `count` frames on, or back when negative, to a whole frame inside the clip. Between two frames the
    /// first step reaches the nearer side.
    pub fn step_frames(&mut self, count: i32) {
        self.pause();
        let position = self.frames.position_of(self.time_secs());
        let from = if count >= 0 {
            (position + ON_FRAME).floor()
        } else {
            (position - ON_FRAME).ceil()
        };
        // A cast from a float saturates, so a step below 0 is frame 0.
        let frame = (from + f64::from(count)) as u32;
        self.seek(self.frames.time_of_frame(frame));
    }

    /// Lets the range begin at a time; a range that ended before it then ends with the clip.
    pub fn set_range_start(&mut self, time_secs: f32) {
        self.range_start_secs = time_secs.max(self.frames.start_secs).min(self.frames.end_secs);
        if self.range_end_secs <= self.range_start_secs {
            self.range_end_secs = self.frames.end_secs;
        }
    }

    /// Lets the range end at a time; a range that began after it then begins with the clip.
    pub fn set_range_end(&mut self, time_secs: f32) {
        self.range_end_secs = time_secs.max(self.frames.start_secs).min(self.frames.end_secs);
        if self.range_start_secs >= self.range_end_secs {
            self.range_start_secs = self.frames.start_secs;
        }
    }

    /// The whole clip as range.
    pub fn clear_range(&mut self) {
        (self.range_start_secs, self.range_end_secs) = (self.frames.start_secs, self.frames.end_secs);
    }

    /// Lets `dt_secs` of time go by. Whether the time in the clip, or playing itself, changed by it. Paused, without
    /// speed, over no length, or for a `dt_secs` that is not above 0 nothing changes, but a [`LoopMode::Once`] of no
    /// length stops.
    pub fn advance(&mut self, dt_secs: f32) -> bool {
        if !self.playing || dt_secs.is_nan() || dt_secs <= 0.0 || self.speed == 0.0 {
            return false;
        }
        let before = (self.time_secs, self.playing);
        let (start_secs, end_secs) = self.range();
        if !(start_secs..=end_secs).contains(&self.time_secs) {
            self.time_secs = self.entry();
        }
        // The least length is far above 0 and every step stays finite: an endless dt is a long one.
        let step_secs = f64::from(dt_secs.min(f32::MAX)) * f64::from(self.speed);
        match self.loop_mode {
            LoopMode::Once => self.run_once(step_secs),
            LoopMode::Loop => self.run_round(step_secs),
            LoopMode::PingPong => self.run_to_and_fro(step_secs),
        }
        before != (self.time_secs, self.playing)
    }

    fn run_once(&mut self, step_secs: f64) {
        let (start_secs, end_secs) = self.range();
        let time_secs = self.time_secs + step_secs;
        self.time_secs = time_secs.clamp(start_secs, end_secs);
        let end = if step_secs > 0.0 { end_secs } else { start_secs };
        self.playing = self.time_secs != end;
    }

    /// Both ends of the range can be stood on; only a step beyond one goes round.
    fn run_round(&mut self, step_secs: f64) {
        let (start_secs, end_secs) = self.range();
        let length_secs = end_secs - start_secs;
        let time_secs = self.time_secs + step_secs;
        self.time_secs = if (start_secs..=end_secs).contains(&time_secs) {
            time_secs
        } else if length_secs <= 0.0 {
            start_secs
        } else if step_secs > 0.0 {
            start_secs + (time_secs - start_secs).rem_euclid(length_secs)
        } else {
            end_secs - (end_secs - time_secs).rem_euclid(length_secs)
        };
    }

    /// There and back is one round of twice the length, laid out flat.
    fn run_to_and_fro(&mut self, step_secs: f64) {
        let (start_secs, end_secs) = self.range();
        let length_secs = end_secs - start_secs;
        if length_secs <= 0.0 {
            self.time_secs = start_secs;
            return;
        }
        let there_secs = self.time_secs - start_secs;
        let flat_secs = if self.returning {
            2.0 * length_secs - there_secs
        } else {
            there_secs
        };
        let flat_secs = (flat_secs + step_secs).rem_euclid(2.0 * length_secs);
        self.returning = flat_secs > length_secs;
        let there_secs = if self.returning {
            2.0 * length_secs - flat_secs
        } else {
            flat_secs
        };
        // Rounding must not leave the range.
        self.time_secs = (start_secs + there_secs).clamp(start_secs, end_secs);
    }

    fn range(&self) -> (f64, f64) {
        (f64::from(self.range_start_secs), f64::from(self.range_end_secs))
    }

    /// The end of the range where playing begins.
    fn entry(&self) -> f64 {
        let (start_secs, end_secs) = self.range();
        if self.speed < 0.0 { end_secs } else { start_secs }
    }
}
