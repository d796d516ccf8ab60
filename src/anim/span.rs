//! A span of time and steps through it: plain arithmetic in f64.
//!
//! Times and steps come from f32 numbers, and the product of two of those is exact in f64. What is rounded is each sum,
//! by at most 2⁻⁵³ of the span's farther end: steps at 60 a second for ten hours lose less than 1e-9 s of a clip of some seconds.

/// From `start_secs` to `end_secs`, which is not before it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Span {
    pub(super) start_secs: f64,
    pub(super) end_secs: f64,
}

impl Span {
    /// A span with its ends in any order; `None` when one is not finite.
    pub(super) fn new(start_secs: f32, end_secs: f32) -> Option<Self> {
        (start_secs.is_finite() && end_secs.is_finite()).then(|| Self {
            start_secs: f64::from(start_secs.min(end_secs)),
            end_secs: f64::from(start_secs.max(end_secs)),
        })
    }

    pub(super) fn length_secs(&self) -> f64 {
        self.end_secs - self.start_secs
    }

    pub(super) fn contains(&self, time_secs: f64) -> bool {
        (self.start_secs..=self.end_secs).contains(&time_secs)
    }

    /// The time, or the nearer end. NaN is the start.
    pub(super) fn clamp(&self, time_secs: f64) -> f64 {
        // The bounds in this order turn NaN into the start.
        time_secs.max(self.start_secs).min(self.end_secs)
    }

    /// Where a way through it begins.
    pub(super) fn first_secs(&self, backward: bool) -> f64 {
        if backward { self.end_secs } else { self.start_secs }
    }

    /// Where a way through it ends.
    pub(super) fn last_secs(&self, backward: bool) -> f64 {
        self.first_secs(!backward)
    }

    /// A step (negative: back) that goes on from the other end with what is left of it. Both ends can be stood on; only a
    /// step beyond one goes round.
    pub(super) fn step_around(&self, time_secs: f64, step_secs: f64) -> f64 {
        let (length_secs, stepped_secs) = (self.length_secs(), time_secs + step_secs);
        let time_secs = if self.contains(stepped_secs) {
            stepped_secs
        } else if length_secs <= 0.0 {
            self.start_secs
        } else if step_secs > 0.0 {
            self.start_secs + (stepped_secs - self.start_secs).rem_euclid(length_secs)
        } else {
            self.end_secs - (self.end_secs - stepped_secs).rem_euclid(length_secs)
        };
        // Rounding must not leave the span.
        self.clamp(time_secs)
    }

    /// A step as the books' demo does it: beyond the end the time is 0 again, and the rest of the step is lost. A span that does
    /// not hold 0 before its end begins at its start. The demo never plays backward: here that begins at the end.
    pub(super) fn step_as_book_demo(&self, time_secs: f64, step_secs: f64) -> f64 {
        let stepped_secs = time_secs + step_secs;
        if self.contains(stepped_secs) {
            stepped_secs
        } else if step_secs < 0.0 {
            self.end_secs
        } else {
            self.book_demo_start_secs()
        }
    }

    /// Where the books' demo begins again.
    pub(super) fn book_demo_start_secs(&self) -> f64 {
        if (self.start_secs..self.end_secs).contains(&0.0) {
            0.0
        } else {
            self.start_secs
        }
    }

    /// A step of a way there and back, which is one round of twice the length, laid out flat. `returning` is the way back.
    pub(super) fn step_to_and_fro(&self, time_secs: f64, returning: bool, step_secs: f64) -> (f64, bool) {
        let length_secs = self.length_secs();
        if length_secs <= 0.0 {
            return (self.start_secs, returning);
        }
        let round_secs = 2.0 * length_secs;
        let there_secs = time_secs - self.start_secs;
        let flat_secs = if returning { round_secs - there_secs } else { there_secs };
        let flat_secs = (flat_secs + step_secs).rem_euclid(round_secs);
        let returning = flat_secs > length_secs;
        let there_secs = if returning { round_secs - flat_secs } else { flat_secs };
        // Rounding must not leave the span.
        (self.clamp(self.start_secs + there_secs), returning)
    }
}
