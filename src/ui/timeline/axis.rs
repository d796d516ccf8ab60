//! Time along a width: which part of a clip is visible, and where.

use egui::Rangef;

/// Margin at both ends of a width, so that marks at the first and last time are not cut.
pub const END_ROOM: f32 = 8.0;

/// The fewest frames that zooming in shows.
const LEAST_FRAMES: f32 = 4.0;

/// A time span along a width.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimeAxis {
    points: Rangef,
    span_secs: [f32; 2],
}

impl TimeAxis {
    /// A time span (start, end) along a width, with room at both ends.
    pub fn new(width: Rangef, end_room: f32, span_secs: [f32; 2]) -> Self {
        let room = end_room.min(0.5 * width.span());
        Self {
            points: Rangef::new(width.min + room, width.max - room),
            span_secs,
        }
    }

    pub(super) fn points(&self) -> Rangef {
        self.points
    }

    fn length_secs(&self) -> f64 {
        f64::from(self.span_secs[1]) - f64::from(self.span_secs[0])
    }

    /// The x of a time, not clamped. The start's if the span has no length.
    pub fn x_of(&self, time_secs: f32) -> f32 {
        let length_secs = self.length_secs();
        if length_secs <= 0.0 {
            return self.points.min;
        }
        let fraction = (f64::from(time_secs) - f64::from(self.span_secs[0])) / length_secs;
        self.points.min + (fraction * f64::from(self.points.span())) as f32
    }

    /// The time at an x, not clamped.
    pub fn time_at(&self, x: f32) -> f32 {
        let fraction = f64::from(x - self.points.min) / f64::from(self.points.span().max(1.0));
        (f64::from(self.span_secs[0]) + fraction * self.length_secs()) as f32
    }

    /// The time at an x, clamped to the ends.
    pub fn seen_time_at(&self, x: f32) -> f32 {
        self.time_at(self.points.clamp(x))
    }

    /// Points per second. 0 if the span has no length.
    pub fn points_per_sec(&self) -> f32 {
        let length_secs = self.length_secs() as f32;
        if length_secs > 0.0 {
            self.points.span() / length_secs
        } else {
            0.0
        }
    }
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SeenTime {
    part_secs: Option<[f32; 2]>,
}

impl SeenTime {
    /// Start and end of the visible part.
    pub fn span_secs(&self, whole_secs: [f32; 2]) -> [f32; 2] {
        self.part_secs.unwrap_or(whole_secs)
    }

    /// Whether only a part of the clip is shown.
    pub fn is_part(&self) -> bool {
        self.part_secs.is_some()
    }

    pub(super) fn show_all(&mut self) {
        self.part_secs = None;
    }

    /// Shows a time span, clamped to the clip. A span as long as the clip, or NaN, shows all.
    pub fn show(&mut self, whole_secs: [f32; 2], frame_secs: f32, [start_secs, end_secs]: [f32; 2]) {
        let whole_length = whole_secs[1] - whole_secs[0];
        let length = (end_secs - start_secs).max(LEAST_FRAMES * frame_secs);
        // As long as the clip, or NaN.
        if length.partial_cmp(&whole_length) != Some(std::cmp::Ordering::Less) {
            self.part_secs = None;
            return;
        }
        let start_secs = start_secs.max(whole_secs[0]).min(whole_secs[1] - length);
        self.part_secs = Some([start_secs, start_secs + length]);
    }

    /// Zooms in by `factor` around a time, which keeps its x.
    pub fn zoom(&mut self, whole_secs: [f32; 2], frame_secs: f32, factor: f32, around_secs: f32) {
        let [start_secs, end_secs] = self.span_secs(whole_secs);
        let length = end_secs - start_secs;
        let least = (LEAST_FRAMES * frame_secs).min(length);
        let zoomed = (length / factor).max(least);
        let fraction = if length > 0.0 {
            ((around_secs - start_secs) / length).clamp(0.0, 1.0)
        } else {
            0.0
        };
        let start_secs = around_secs - fraction * zoomed;
        self.show(whole_secs, frame_secs, [start_secs, start_secs + zoomed]);
    }

    /// Moves the visible part to later times.
    pub fn pan(&mut self, whole_secs: [f32; 2], frame_secs: f32, by_secs: f32) {
        if let Some([start_secs, end_secs]) = self.part_secs {
            self.show(whole_secs, frame_secs, [start_secs + by_secs, end_secs + by_secs]);
        }
    }
}
