//! Seconds and frames along a time axis.

use egui::{Align2, FontId, Rect, Stroke, Ui, pos2};

use super::super::theme::Tokens;
use super::axis::TimeAxis;
use crate::model::Clip;

/// Height of the ruler.
pub(super) const RULER_HEIGHT: f32 = 24.0;
/// Room that a label takes with the gap to the next one.
const LABEL_SPACING: f32 = 92.0;
/// Ticks of single frames are this far apart at least.
const TICK_SPACING: f32 = 5.0;

/// Draws ticks and labels over `rect`, and faint lines down to `bottom`.
pub(super) fn paint(ui: &Ui, clip: &Clip, axis: &TimeAxis, rect: Rect, bottom: f32) {
    let tokens = Tokens::of(ui);
    let painter = ui
        .painter()
        .with_clip_rect(Rect::from_x_y_ranges(rect.x_range(), rect.min.y..=bottom));
    let last_frame = clip.last_frame();
    let points_per_frame = axis.points_per_sec() / clip.keys_per_sec;
    if points_per_frame >= TICK_SPACING {
        for frame in seen_frames(clip, axis, 1) {
            let x = axis.x_of(clip.time_of_frame(frame));
            painter.vline(x, rect.max.y - 4.0..=rect.max.y, Stroke::new(1.0, tokens.hairline));
        }
    }
    let step = label_step(
        clip.keys_per_sec,
        LABEL_SPACING / points_per_frame.max(f32::MIN_POSITIVE),
        last_frame,
    );
    for frame in seen_frames(clip, axis, step) {
        let time_secs = clip.time_of_frame(frame);
        let x = axis.x_of(time_secs);
        painter.vline(x, rect.max.y - 7.0..=rect.max.y, Stroke::new(1.0, tokens.faint));
        painter.vline(x, rect.max.y..=bottom, Stroke::new(1.0, tokens.hairline));
        let at = pos2(x + 4.0, rect.center().y - 1.0);
        let secs = format!("{} s", seconds(time_secs));
        let drawn = painter.text(at, Align2::LEFT_CENTER, secs, FontId::proportional(11.0), tokens.muted);
        let at = pos2(drawn.max.x + 6.0, at.y);
        painter.text(at, Align2::LEFT_CENTER, frame, FontId::proportional(11.0), tokens.faint);
    }
}

/// Every so many frames, those that are seen, and one more at the left whose label reaches in.
fn seen_frames(clip: &Clip, axis: &TimeAxis, step: u32) -> impl Iterator<Item = u32> {
    let points = axis.points();
    let left = clip.frame_at(axis.time_at(points.min - LABEL_SPACING)) / step * step;
    let right = clip.frame_at(axis.time_at(points.max)).min(clip.last_frame());
    (left..=right).step_by(step as usize)
}

/// Frames from label to label: the least round number that leaves room, round in seconds where the rate is whole.
fn label_step(keys_per_sec: f32, least_frames: f32, last_frame: u32) -> u32 {
    let rate = keys_per_sec.round().max(1.0);
    let is_whole = (keys_per_sec - rate).abs() < 0.01 * rate;
    let rate = rate as u32;
    let parts = (1..rate).filter(|part| {
        if is_whole {
            rate.is_multiple_of(*part)
        } else {
            is_round(*part)
        }
    });
    let whole = [1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 1800, 3600]
        .into_iter()
        .map(|secs| rate.saturating_mul(secs));
    let mut steps = parts.chain(whole).filter(|&step| step as f32 >= least_frames);
    steps.next().unwrap_or(last_frame).max(1)
}

/// One, two or five times a power of ten.
fn is_round(number: u32) -> bool {
    let power = 10_u32.pow(number.max(1).ilog10());
    number.is_multiple_of(power) && matches!(number / power, 1 | 2 | 5)
}

/// Seconds to the thousandth, without trailing zeros.
fn seconds(time_secs: f32) -> String {
    let text = format!("{time_secs:.3}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_stand_at_round_numbers_of_frames_and_seconds() {
        for (rate, least, step) in [
            (30.0, 0.5, 1),
            (30.0, 4.0, 5),
            (30.0, 12.0, 15),
            (30.0, 16.0, 30),
            (30.0, 100.0, 150),
            (24.0, 7.0, 8),
            (29.5, 7.0, 10),
            (30.0, 1e9, 77),
            (1.0, 0.5, 1),
        ] {
            assert_eq!(label_step(rate, least, 77), step, "{rate} {least}");
        }
    }

    #[test]
    fn seconds_are_short() {
        assert_eq!(
            [0.0, 0.5, 1.25, 1.0 / 3.0, 10.0].map(seconds),
            ["0", "0.5", "1.25", "0.333", "10"]
        );
    }
}
