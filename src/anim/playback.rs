//! The time in a clip, and how it moves on. There is no clock here: the caller says how much time went by.

use super::span::Span;
use crate::modes::modes;

/// The slowest speed that can be set.
pub const MIN_SPEED: f32 = 0.05;
/// The fastest speed that can be set.
pub const MAX_SPEED: f32 = 4.0;

modes! {
    /// What happens at the end of the range.
    #[derive(Default)]
    pub enum LoopMode {
        /// Stop there.
        Once = "once", "Once";
        /// Go on from the other end.
        #[default]
        Loop = "loop", "Loop";
        /// Turn around.
        PingPong = "pingpong", "There and back";
    }
}

modes! {
    /// How [`LoopMode::Loop`] goes on from the other end.
    #[derive(Default)]
    pub enum WrapMode {
        /// The rest of the step goes on from there, so that a loop takes its length whatever the steps are.
        #[default]
        Wrap = "wrap", "Wrap";
        /// It goes on at time 0, as the books' demo does, and the rest of the step is lost. Where the range does not hold 0, it goes
        /// on at its start.
        BookDemo = "book-demo", "As the book's demo";
    }
}

/// A time inside the span of a clip, and the way it moves through the span or through a range of it.
///
/// Seeking reaches the whole span. Playing keeps to the range: from outside it begins at the range's first end.
/// By default a span of no length at 0, paused, forward at speed 1, looping.
#[derive(Clone, Debug, PartialEq)]
pub struct Playback {
    span: Span,
    // Inside the span, of some length, and not the whole span.
    range: Option<Span>,
    // In f64, so that thousands of small steps add up to the time that went by.
    time_secs: f64,
    playing: bool,
    backward: bool,
    // The way back of a ping-pong.
    returning: bool,
    speed: f32,
    loop_mode: LoopMode,
    wrap_mode: WrapMode,
}

impl Default for Playback {
    fn default() -> Self {
        Self {
            span: Span::default(),
            range: None,
            time_secs: 0.0,
            playing: false,
            backward: false,
            returning: false,
            speed: 1.0,
            loop_mode: LoopMode::default(),
            wrap_mode: WrapMode::default(),
        }
    }
}

impl Playback {
    /// Paused at the start of a span.
    pub fn new(start_secs: f32, end_secs: f32) -> Self {
        let mut playback = Self::default();
        playback.set_span(start_secs, end_secs);
        playback.seek(f32::NEG_INFINITY);
        playback
    }

    /// Time in seconds, inside the span.
    pub fn time_secs(&self) -> f32 {
        self.time_secs as f32
    }

    /// Start of the span.
    pub fn start_secs(&self) -> f32 {
        self.span.start_secs as f32
    }

    /// End of the span.
    pub fn end_secs(&self) -> f32 {
        self.span.end_secs as f32
    }

    /// Length of the span, 0 or more.
    pub fn duration_secs(&self) -> f32 {
        self.span.length_secs() as f32
    }

    /// Start and end of the range that playing keeps to; `None` when it is the whole span.
    pub fn range_secs(&self) -> Option<[f32; 2]> {
        self.range
            .map(|range| [range.start_secs, range.end_secs].map(|secs| secs as f32))
    }

    /// Start and end of what plays: the range, or the whole span.
    pub fn played_secs(&self) -> [f32; 2] {
        self.range_secs().unwrap_or([self.start_secs(), self.end_secs()])
    }

    /// The two times between which a loop jumps or would jump, the earlier first: the ends of what plays, but that
    /// [`WrapMode::BookDemo`] goes on at 0 where it can. `None` where there is one pose alone.
    pub fn loop_gap_secs(&self) -> Option<[f32; 2]> {
        let played = self.played();
        let goes_on_secs = match (self.wrap_mode, self.backward) {
            (WrapMode::BookDemo, false) => played.book_demo_start_secs(),
            _ => played.start_secs,
        };
        (played.length_secs() > 0.0).then(|| [goes_on_secs, played.end_secs].map(|secs| secs as f32))
    }

    /// Whether it plays.
    pub fn is_playing(&self) -> bool {
        self.playing
    }

    /// Whether time runs backward; a ping-pong then begins with the way back.
    pub fn is_backward(&self) -> bool {
        self.backward
    }

    /// Seconds of the clip for a second of time, [`MIN_SPEED`] to [`MAX_SPEED`].
    pub fn speed(&self) -> f32 {
        self.speed
    }

    /// What happens at the end of the range.
    pub fn loop_mode(&self) -> LoopMode {
        self.loop_mode
    }

    /// How a loop goes on from the other end.
    pub fn wrap_mode(&self) -> WrapMode {
        self.wrap_mode
    }

    /// Sets the span, its ends in any order; the time moves into it and the range is the whole of it. A span with an end
    /// that is not finite is ignored.
    pub fn set_span(&mut self, start_secs: f32, end_secs: f32) {
        let Some(span) = Span::new(start_secs, end_secs) else {
            return;
        };
        self.span = span;
        self.range = None;
        self.time_secs = span.clamp(self.time_secs);
    }

    /// Sets the start of the range, clamped to the span. If the range ended there or before, its end becomes that of the span.
    /// A range without length is ignored, as NaN is.
    pub fn set_range_start(&mut self, start_secs: f32) {
        let start_secs = f64::from(start_secs);
        let end_secs = self.played().end_secs;
        let end_secs = if start_secs < end_secs {
            end_secs
        } else {
            self.span.end_secs
        };
        self.set_range(start_secs, end_secs);
    }

    /// Sets the end of the range, as [`Playback::set_range_start`] sets its start.
    pub fn set_range_end(&mut self, end_secs: f32) {
        let end_secs = f64::from(end_secs);
        let start_secs = self.played().start_secs;
        let start_secs = if end_secs > start_secs {
            start_secs
        } else {
            self.span.start_secs
        };
        self.set_range(start_secs, end_secs);
    }

    /// Removes the range: the whole span plays.
    pub fn clear_range(&mut self) {
        self.range = None;
    }

    fn set_range(&mut self, start_secs: f64, end_secs: f64) {
        if start_secs.is_nan() || end_secs.is_nan() {
            return;
        }
        let range = Span {
            start_secs: self.span.clamp(start_secs),
            end_secs: self.span.clamp(end_secs),
        };
        if range.length_secs() > 0.0 {
            self.range = (range != self.span).then_some(range);
        }
    }

    fn played(&self) -> Span {
        self.range.unwrap_or(self.span)
    }

    /// Sets the speed, clamped to [`MIN_SPEED`] and [`MAX_SPEED`]. A speed that is not above 0, or not finite, is ignored;
    /// [`Playback::set_backward`] turns time.
    pub fn set_speed(&mut self, speed: f32) {
        if speed.is_finite() && speed > 0.0 {
            self.speed = speed.clamp(MIN_SPEED, MAX_SPEED);
        }
    }

    /// Sets whether time runs backward. A ping-pong on its way back stays on it, unless the direction changes.
    pub fn set_backward(&mut self, backward: bool) {
        if self.backward != backward {
            self.backward = backward;
            self.returning = false;
        }
    }

    /// Sets what happens at the end of the range.
    pub fn set_loop_mode(&mut self, loop_mode: LoopMode) {
        self.loop_mode = loop_mode;
        self.returning = false;
    }

    /// Sets how a loop goes on from the other end.
    pub fn set_wrap_mode(&mut self, wrap_mode: WrapMode) {
        self.wrap_mode = wrap_mode;
    }

    /// Begins to play. Outside the range, and in [`LoopMode::Once`] at its end, it begins anew.
    pub fn play(&mut self) {
        self.playing = true;
        let stands_at_last =
            self.loop_mode == LoopMode::Once && self.time_secs == self.played().last_secs(self.backward);
        if stands_at_last {
            self.time_secs = self.played().first_secs(self.backward);
        }
        self.enter_range();
    }

    /// Stops where it is.
    pub fn pause(&mut self) {
        self.playing = false;
    }

    /// Goes to a time, or to the nearer end of the span; whether it plays stays. NaN goes to the start.
    pub fn seek(&mut self, time_secs: f32) {
        self.time_secs = self.span.clamp(f64::from(time_secs));
        self.returning = false;
    }

    /// Moves on by `dt_secs`. True when the time in the clip changed or playing stopped. While paused, and for a `dt_secs` that is
    /// not above 0, nothing changes; over a range without length only [`LoopMode::Once`] stops.
    pub fn advance(&mut self, dt_secs: f32) -> bool {
        if !self.playing || dt_secs.is_nan() || dt_secs <= 0.0 {
            return false;
        }
        let before = (self.time_secs, self.playing);
        self.enter_range();
        // An infinite dt becomes a very long one, so that its product with a speed stays finite in f64.
        let way_secs = f64::from(dt_secs.min(f32::MAX)) * f64::from(self.speed);
        let step_secs = if self.backward { -way_secs } else { way_secs };
        let played = self.played();
        match (self.loop_mode, self.wrap_mode) {
            (LoopMode::Once, _) => {
                self.time_secs = played.clamp(self.time_secs + step_secs);
                self.playing = self.time_secs != played.last_secs(self.backward);
            }
            (LoopMode::Loop, WrapMode::Wrap) => self.time_secs = played.step_around(self.time_secs, step_secs),
            (LoopMode::Loop, WrapMode::BookDemo) => {
                self.time_secs = played.step_as_book_demo(self.time_secs, step_secs);
            }
            (LoopMode::PingPong, _) => {
                (self.time_secs, self.returning) = played.step_to_and_fro(self.time_secs, self.returning, step_secs);
            }
        }
        before != (self.time_secs, self.playing)
    }

    /// Goes on by some seconds of the clip, or back where they are negative, whether it plays or not: in [`LoopMode::PingPong`] there
    /// and back, else round and round. The same way back leads to where it was, unless that was the very end. What is not finite is ignored.
    pub fn shift(&mut self, secs: f64) {
        if !secs.is_finite() {
            return;
        }
        let played = self.played();
        match self.loop_mode {
            LoopMode::Once | LoopMode::Loop => self.time_secs = played.step_around(self.time_secs, secs),
            LoopMode::PingPong => {
                (self.time_secs, self.returning) = played.step_to_and_fro(self.time_secs, self.returning, secs);
            }
        }
    }

    /// Playing begins in the range wherever the time was sought to.
    fn enter_range(&mut self) {
        let played = self.played();
        if !played.contains(self.time_secs) {
            self.time_secs = played.first_secs(self.backward);
            self.returning = false;
        }
    }
}
