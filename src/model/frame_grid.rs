//! The frames of a clip: even steps of time between its ends.

/// A span of time in seconds and the number of frames a second. Frames count from 0 at `start_secs` to
/// [`FrameGrid::last_frame`] at `end_secs`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameGrid {
    /// Time of frame 0.
    pub start_secs: f32,
    /// Time of the last frame, `start_secs` or later.
    pub end_secs: f32,
    /// Frames a second, above 0.
    pub keys_per_sec: f32,
}

impl FrameGrid {
    /// Length in seconds, 0 or more.
    pub fn duration_secs(&self) -> f32 {
        self.end_secs - self.start_secs
    }

    /// Number of the frame at `end_secs`, counted from 0. A span that is no whole number of frames has its remainder in
    /// the last step.
    pub fn last_frame(&self) -> u32 {
        // A cast from a float saturates.
        (f64::from(self.duration_secs()) * f64::from(self.keys_per_sec)).round() as u32
    }

    /// Where a time lies, in frames, inside the span: 30.5 is half way from frame 30 to frame 31.
    pub fn position_of(&self, time_secs: f32) -> f64 {
        let since_start_secs = f64::from(time_secs) - f64::from(self.start_secs);
        // The bounds in this order turn NaN into 0.
        (since_start_secs * f64::from(self.keys_per_sec))
            .min(f64::from(self.last_frame()))
            .max(0.0)
    }

    /// The frame nearest to a time.
    pub fn frame_at(&self, time_secs: f32) -> u32 {
        self.position_of(time_secs).round() as u32
    }

    /// The time of a frame; the last frame and any beyond it are at `end_secs`.
    pub fn time_of_frame(&self, frame: u32) -> f32 {
        if frame == 0 {
            return self.start_secs;
        }
        if frame >= self.last_frame() {
            return self.end_secs;
        }
        let since_start_secs = f64::from(frame) / f64::from(self.keys_per_sec);
        ((f64::from(self.start_secs) + since_start_secs) as f32).clamp(self.start_secs, self.end_secs)
    }
}
