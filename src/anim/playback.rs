//! Where in a span of time we are, and how time moves on. There is no clock here: the caller says how much time went by.

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

/// A time inside a range, a clip or a part of one, and the way it moves.
///
/// By default a range of no length at 0, paused, forward at speed 1, looping.
#[derive(Clone, Debug, PartialEq)]
pub struct Playback {
    start_secs: f64,
    end_secs: f64,
    // In f64, so that thousands of small steps add up to the time that went by.
    time_secs: f64,
    playing: bool,
    backward: bool,
    // The way back of a ping-pong.
    returning: bool,
    speed: f32,
    loop_mode: LoopMode,
}

impl Default for Playback {
    fn default() -> Self {
        Self {
            start_secs: 0.0,
            end_secs: 0.0,
            time_secs: 0.0,
            playing: false,
            backward: false,
            returning: false,
            speed: 1.0,
            loop_mode: LoopMode::default(),
        }
    }
}

impl Playback {
    /// Paused at the start of a range.
    pub fn new(start_secs: f32, end_secs: f32) -> Self {
        let mut playback = Self::default();
        playback.set_range(start_secs, end_secs);
        playback.seek(f32::NEG_INFINITY);
        playback
    }

    /// Time in seconds, inside the range.
    pub fn time_secs(&self) -> f32 {
        self.time_secs as f32
    }

    /// Start of the range.
    pub fn start_secs(&self) -> f32 {
        self.start_secs as f32
    }

    /// End of the range.
    pub fn end_secs(&self) -> f32 {
        self.end_secs as f32
    }

    /// Length of the range, 0 or more.
    pub fn duration_secs(&self) -> f32 {
        (self.end_secs - self.start_secs) as f32
    }

    /// Whether it was told to play and has not stopped.
    pub fn is_playing(&self) -> bool {
        self.playing
    }

    /// Whether time runs backward; a ping-pong then begins with the way back.
    pub fn is_backward(&self) -> bool {
        self.backward
    }

    /// Seconds of the range for a second of time, above 0.
    pub fn speed(&self) -> f32 {
        self.speed
    }

    /// What happens at the end of the range.
    pub fn loop_mode(&self) -> LoopMode {
        self.loop_mode
    }

    /// Sets the range, its ends in any order; the time moves into it. A range with an end that is not finite is left out.
    pub fn set_range(&mut self, start_secs: f32, end_secs: f32) {
        if !start_secs.is_finite() || !end_secs.is_finite() {
            return;
        }
        self.start_secs = f64::from(start_secs.min(end_secs));
        self.end_secs = f64::from(start_secs.max(end_secs));
        self.time_secs = self.time_secs.clamp(self.start_secs, self.end_secs);
    }

    /// Sets the speed. A speed that is not above 0, or not finite, is left out; [`Playback::set_backward`] turns time.
    pub fn set_speed(&mut self, speed: f32) {
        if speed.is_finite() && speed > 0.0 {
            self.speed = speed;
        }
    }

    /// Lets time run backward, or forward.
    pub fn set_backward(&mut self, backward: bool) {
        self.backward = backward;
        self.returning = false;
    }

    /// Sets what happens at the end of the range.
    pub fn set_loop_mode(&mut self, loop_mode: LoopMode) {
        self.loop_mode = loop_mode;
        self.returning = false;
    }

    /// Begins to play. In [`LoopMode::Once`] a playback that stands at its end begins anew.
    pub fn play(&mut self) {
        self.playing = true;
        let (first_secs, last_secs) = if self.backward {
            (self.end_secs, self.start_secs)
        } else {
            (self.start_secs, self.end_secs)
        };
        if self.loop_mode == LoopMode::Once && self.time_secs == last_secs {
            self.time_secs = first_secs;
        }
    }

    /// Stops where it is.
    pub fn pause(&mut self) {
        self.playing = false;
    }

    /// Goes to a time, or to the nearer end of the range; whether it plays stays. NaN goes to the start.
    pub fn seek(&mut self, time_secs: f32) {
        // The bounds in this order turn NaN into the start.
        self.time_secs = f64::from(time_secs).max(self.start_secs).min(self.end_secs);
        self.returning = false;
    }

    /// Lets `dt_secs` of time go by, and tells whether the time in the range, or playing itself, changed by it. Paused, or
    /// for a `dt_secs` that is not above 0, nothing does; over a range of no length only a [`LoopMode::Once`] stops.
    pub fn advance(&mut self, dt_secs: f32) -> bool {
        if !self.playing || dt_secs.is_nan() || dt_secs <= 0.0 {
            return false;
        }
        let before = (self.time_secs, self.playing);
        // An endless dt is a very long one: its product with a speed stays finite in f64.
        let way_secs = f64::from(dt_secs.min(f32::MAX)) * f64::from(self.speed);
        let step_secs = if self.backward { -way_secs } else { way_secs };
        match self.loop_mode {
            LoopMode::Once => self.run_once(step_secs),
            LoopMode::Loop => self.run_round(step_secs),
            LoopMode::PingPong => self.run_to_and_fro(step_secs),
        }
        before != (self.time_secs, self.playing)
    }

    fn run_once(&mut self, step_secs: f64) {
        self.time_secs = (self.time_secs + step_secs).clamp(self.start_secs, self.end_secs);
        let last_secs = if self.backward { self.start_secs } else { self.end_secs };
        self.playing = self.time_secs != last_secs;
    }

    /// Both ends of the range can be stood on; only a step beyond one goes round.
    fn run_round(&mut self, step_secs: f64) {
        let length_secs = self.end_secs - self.start_secs;
        let time_secs = self.time_secs + step_secs;
        self.time_secs = if (self.start_secs..=self.end_secs).contains(&time_secs) {
            time_secs
        } else if length_secs <= 0.0 {
            self.start_secs
        } else if step_secs > 0.0 {
            self.start_secs + (time_secs - self.start_secs).rem_euclid(length_secs)
        } else {
            self.end_secs - (self.end_secs - time_secs).rem_euclid(length_secs)
        };
    }

    /// There and back is one round of twice the length, laid out flat.
    fn run_to_and_fro(&mut self, step_secs: f64) {
        let length_secs = self.end_secs - self.start_secs;
        if length_secs <= 0.0 {
            return;
        }
        let round_secs = 2.0 * length_secs;
        let there_secs = self.time_secs - self.start_secs;
        let flat_secs = if self.returning {
            round_secs - there_secs
        } else {
            there_secs
        };
        let flat_secs = (flat_secs + step_secs).rem_euclid(round_secs);
        self.returning = flat_secs > length_secs;
        let there_secs = if self.returning {
            round_secs - flat_secs
        } else {
            flat_secs
        };
        // Rounding must not leave the range.
        self.time_secs = (self.start_secs + there_secs).clamp(self.start_secs, self.end_secs);
    }
}
