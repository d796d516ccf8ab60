//! Time along a width: which part of a clip is visible, and where.

use egui::Rangef;

/// Margin at both ends of a width, so that marks at the first and last time are not cut.
pub(super) const END_ROOM: f32 = 8.0;

/// The fewest frames that zooming in shows.
const LEAST_FRAMES: f32 = 4.0;

/// A time span along a width.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct TimeAxis {
    points: Rangef,
    span_secs: [f32; 2],
}

impl TimeAxis {
    /// A time span (start, end) along a width, with room at both ends.
    pub(super) fn new(width: Rangef, end_room: f32, span_secs: [f32; 2]) -> Self {
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
    pub(super) fn x_of(&self, time_secs: f32) -> f32 {
        let length_secs = self.length_secs();
        if length_secs <= 0.0 {
            return self.points.min;
        }
        let fraction = (f64::from(time_secs) - f64::from(self.span_secs[0])) / length_secs;
        self.points.min + (fraction * f64::from(self.points.span())) as f32
    }

    /// The time at an x, not clamped.
    pub(super) fn time_at(&self, x: f32) -> f32 {
        let fraction = f64::from(x - self.points.min) / f64::from(self.points.span().max(1.0));
        (f64::from(self.span_secs[0]) + fraction * self.length_secs()) as f32
    }

    /// The time at an x, clamped to the ends.
    pub(super) fn seen_time_at(&self, x: f32) -> f32 {
        self.time_at(self.points.clamp(x))
    }

    /// Points per second. 0 if the span has no length.
    pub(super) fn points_per_sec(&self) -> f32 {
        let length_secs = self.length_secs() as f32;
        if length_secs > 0.0 {
            self.points.span() / length_secs
        } else {
            0.0
        }
    }
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct TimeWindow {
    part_secs: Option<[f32; 2]>,
}

impl TimeWindow {
    /// Start and end of the visible part.
    pub(super) fn span_secs(&self, whole_secs: [f32; 2]) -> [f32; 2] {
        self.part_secs.unwrap_or(whole_secs)
    }

    /// Whether only a part of the clip is shown.
    pub(super) fn is_part(&self) -> bool {
        self.part_secs.is_some()
    }

    pub(super) fn show_all(&mut self) {
        self.part_secs = None;
    }

    /// Shows a time span, clamped to the clip. A span as long as the clip, or NaN, shows all.
    pub(super) fn show(&mut self, whole_secs: [f32; 2], frame_secs: f32, [start_secs, end_secs]: [f32; 2]) {
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
    pub(super) fn zoom(&mut self, whole_secs: [f32; 2], frame_secs: f32, factor: f32, around_secs: f32) {
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
    pub(super) fn pan(&mut self, whole_secs: [f32; 2], frame_secs: f32, by_secs: f32) {
        if let Some([start_secs, end_secs]) = self.part_secs {
            self.show(whole_secs, frame_secs, [start_secs + by_secs, end_secs + by_secs]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WHOLE: [f32; 2] = [0.5, 10.5];
    const FRAME: f32 = 1.0 / 30.0;

    #[test]
    fn places_and_times_are_inverse() {
        let axis = TimeAxis::new(Rangef::new(100.0, 900.0), END_ROOM, WHOLE);
        assert_eq!([axis.x_of(0.5), axis.x_of(10.5)], [108.0, 892.0]);
        for time_secs in [0.5, 3.25, 10.5, -1.0, 12.0] {
            assert!((axis.time_at(axis.x_of(time_secs)) - time_secs).abs() < 1e-5);
        }
        assert_eq!(axis.seen_time_at(0.0), 0.5);
        assert_eq!(axis.seen_time_at(2000.0), 10.5);
    }

    #[test]
    fn a_stretch_without_length_and_a_width_without_room_are_a_place() {
        let axis = TimeAxis::new(Rangef::new(10.0, 10.0), END_ROOM, [2.0, 2.0]);
        assert_eq!(
            (axis.x_of(7.0), axis.time_at(50.0), axis.points_per_sec()),
            (10.0, 2.0, 0.0)
        );
    }

    #[test]
    fn zooming_keeps_the_time_under_the_pointer_and_ends_at_both_ends() {
        let mut window = TimeWindow::default();
        let width = Rangef::new(0.0, 1000.0);
        let axis = |window: &TimeWindow| TimeAxis::new(width, END_ROOM, window.span_secs(WHOLE));
        let before = axis(&window).x_of(4.0);
        window.zoom(WHOLE, FRAME, 5.0, 4.0);
        assert!(window.is_part());
        assert!((axis(&window).x_of(4.0) - before).abs() < 0.1);
        for _ in 0..40 {
            window.zoom(WHOLE, FRAME, 2.0, 4.0);
        }
        let [start, end] = window.span_secs(WHOLE);
        assert!((end - start - 4.0 * FRAME).abs() < 1e-4, "{start} {end}");
        window.zoom(WHOLE, FRAME, 1e-6, 4.0);
        assert!(!window.is_part());
    }

    #[test]
    fn panning_stays_inside_and_the_whole_cannot_be_panned() {
        let mut window = TimeWindow::default();
        window.pan(WHOLE, FRAME, 1.0);
        assert_eq!(window.span_secs(WHOLE), WHOLE);
        window.show(WHOLE, FRAME, [2.0, 4.0]);
        window.pan(WHOLE, FRAME, 100.0);
        assert_eq!(window.span_secs(WHOLE), [8.5, 10.5]);
        window.pan(WHOLE, FRAME, -100.0);
        assert_eq!(window.span_secs(WHOLE), [0.5, 2.5]);
        window.show(WHOLE, FRAME, [f32::NAN, 1.0]);
        let [start, end] = window.span_secs(WHOLE);
        assert!(
            start == 0.5 && (end - start - 4.0 * FRAME).abs() < 1e-6,
            "no number is the start"
        );
    }
}
