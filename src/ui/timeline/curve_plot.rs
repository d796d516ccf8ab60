//! The motion of the selected joint as lines over time: controls, lines, keys as dots, names with values.

use egui::{Align2, Color32, FontId, Rangef, Rect, Role, Sense, Shape, Stroke, Ui, WidgetInfo, pos2, vec2};

use super::axis::{END_ROOM, TimeAxis};
use super::curves::{CurveOf, Curves, Part, RotationAs, SampledOf};
use super::marks::MERGE_POINTS;
use super::state::TimelineState;
use super::time_area::{self, RULER_HEIGHT, segmented_of_width, split_x};
use crate::anim::{CurvePoint, CurveSpace};
use crate::model::JointIndex;
use crate::session::{Command, Session};
use crate::ui::theme::{self, CONTROL_RADIUS, Tokens};

/// Distance of samples, in points.
const SAMPLE_SPACING: f32 = 2.0;
/// The most samples, more than any screen needs.
const MOST_SAMPLES: usize = 2048;

/// The controls of the curves.
pub(super) fn controls(ui: &mut Ui, curves: &mut Curves) {
    let parts = [
        (Part::Translation, "Translation"),
        (Part::Rotation, "Rotation"),
        (Part::Scale, "Scale"),
    ];
    if let Some(part) = segmented_of_width(ui, 246.0, "Part", &parts, curves.part) {
        curves.part = part;
    }
    if curves.part == Part::Rotation {
        let kinds = [(RotationAs::Quaternion, "Quaternion"), (RotationAs::Euler, "Euler")];
        if let Some(kind) = segmented_of_width(ui, 164.0, "Rotation as", &kinds, curves.rotation) {
            curves.rotation = kind;
        }
    }
    let spaces = [(CurveSpace::Local, "Local"), (CurveSpace::Model, "Model")];
    if let Some(space) = segmented_of_width(ui, 124.0, "Space", &spaces, curves.space) {
        curves.space = space;
    }
}

/// The curves. Fills the rest of the sheet.
pub(super) fn show(ui: &mut Ui, session: &Session, state: &mut TimelineState, commands: &mut Vec<Command>) {
    let (Some(open), Some(clip_index), Some(clip)) = (session.open_model(), session.clip_index(), session.clip())
    else {
        return;
    };
    let area = ui.available_rect_before_wrap();
    let split = split_x(area);
    let plot = Rect::from_min_max(pos2(split, area.min.y), area.max);
    ui.painter().rect_filled(plot, CONTROL_RADIUS, Tokens::of(ui).field);
    let Some(joint) = session.joints().selected() else {
        paint_hint(ui, plot);
        return;
    };
    let span_secs = state.window.span_secs([clip.start_secs, clip.end_secs]);
    let axis = TimeAxis::new(plot.x_range(), END_ROOM, span_secs);
    let count = (axis.points().span() / SAMPLE_SPACING).ceil().max(1.0) as usize + 1;
    let of = SampledOf {
        curve: CurveOf {
            clips_revision: session.clips_revision(),
            clip: clip_index,
            joint,
            space: state.curves.space,
        },
        span_secs,
        count: count.min(MOST_SAMPLES),
    };
    state.curves.sample(session, open, of);

    let ruler_rect = Rect::from_min_max(plot.min, pos2(plot.max.x, plot.min.y + RULER_HEIGHT));
    time_area::paint_ruler(ui, clip, &axis, ruler_rect, plot.max.y);
    let lines_rect = Rect::from_min_max(pos2(plot.min.x, ruler_rect.max.y), plot.max);
    let values = paint_lines(ui, &state.curves, &axis, lines_rect, area.min.x);
    paint_keys(
        ui,
        &state.curves,
        open.key_times(clip_index, Some(joint)),
        &axis,
        &values,
    );

    let response = ui.interact(lines_rect, ui.scope_id().with("curves"), Sense::click_and_drag());
    let label = format!("Curves of {}", session.joint_label(joint));
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, &label));
    time_area::scrub(&response, &axis, commands);
    let ruler = time_area::ruler(ui, session, &axis, ruler_rect, commands);
    let read_secs = response
        .hover_pos()
        .filter(|_| !response.dragged())
        .map_or(session.playback().time_secs(), |at| axis.seen_time_at(at.x));
    let read = state.curves.point_at(session, open, read_secs);
    paint_legend(ui, session, &state.curves, joint, &read, area, split);
    time_area::paint_pointer(ui, &response, &axis, lines_rect.y_range());
    time_area::paint_head_below_ruler(ui, session, &axis, ruler_rect, plot.max.y);
    time_area::navigate(ui, &response, clip, &axis, state, false);
    time_area::navigate(ui, &ruler, clip, &axis, state, false);
}

/// Width of names and values, left of the lines.
const LEGEND_WIDTH: f32 = 100.0;

/// Colours of x, y and z, those of the axes, and of w.
fn channel_color(ui: &Ui, channel: usize) -> Color32 {
    let tokens = Tokens::of(ui);
    tokens.axes.get(channel).copied().unwrap_or(tokens.muted)
}

/// Words while no joint is selected.
fn paint_hint(ui: &Ui, plot: Rect) {
    let (font, color) = (FontId::proportional(13.0), Tokens::of(ui).muted);
    let words = "Choose a bone in the dope sheet to see how it moves.";
    let galley = ui.painter().layout(words.to_owned(), font, color, plot.width() - 24.0);
    ui.painter().galley(plot.center() - 0.5 * galley.size(), galley, color);
    let response = ui.interact(plot, ui.scope_id().with("hint"), Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, words));
}

/// The lines, over lines at round values. Returns the value axis.
fn paint_lines(ui: &Ui, curves: &Curves, axis: &TimeAxis, rect: Rect, legend_left: f32) -> ValueAxis {
    let (tokens, split) = (Tokens::of(ui), rect.min.x);
    let channels = curves.channels().len();
    let all = curves
        .points
        .iter()
        .flat_map(|point| (0..channels).map(move |channel| curves.value(point, channel)));
    let height = Rangef::new(rect.min.y + 4.0, rect.max.y - 4.0);
    let values = ValueAxis::fitted(height, all);
    let (lines, decimals) = values.lines();
    for value in lines {
        let y = values.y_of(value);
        ui.painter().hline(rect.x_range(), y, Stroke::new(1.0, tokens.hairline));
        let text = format!("{value:.decimals$}{}", curves.unit());
        // Beside the lines if the legend leaves room, otherwise over them.
        let (at, anchor) = if split - legend_left >= LEGEND_WIDTH + 60.0 {
            (pos2(split - 6.0, y), Align2::RIGHT_CENTER)
        } else {
            (pos2(split + 4.0, y), Align2::LEFT_BOTTOM)
        };
        ui.painter().text(at, anchor, text, theme::mono(10.5), tokens.faint);
    }
    for channel in (0..channels).rev() {
        let line = curves
            .points
            .iter()
            .map(|point| pos2(axis.x_of(point.time_secs), values.y_of(curves.value(point, channel))));
        let stroke = Stroke::new(1.5, channel_color(ui, channel));
        ui.painter().add(Shape::line(line.collect(), stroke));
    }
    values
}

/// A dot at each key, if there is room.
fn paint_keys(ui: &Ui, curves: &Curves, times_secs: &[f32], axis: &TimeAxis, values: &ValueAxis) {
    let seen = axis.points().expand(1.0);
    let first = times_secs.partition_point(|&secs| axis.x_of(secs) < seen.min);
    let count = times_secs[first..].partition_point(|&secs| axis.x_of(secs) <= seen.max);
    let spacing = seen.span() / count.max(1) as f32;
    if spacing < 2.0 * MERGE_POINTS {
        return;
    }
    let radius = (0.2 * spacing).clamp(1.4, 2.4);
    let mut before = f32::NEG_INFINITY;
    for &time_secs in &times_secs[first..first + count] {
        let x = axis.x_of(time_secs);
        if x - before < MERGE_POINTS {
            continue;
        }
        before = x;
        for channel in (0..curves.channels().len()).rev() {
            if let Some(value) = curves.value_at(channel, time_secs) {
                let at = pos2(x, values.y_of(value));
                ui.painter().circle_filled(at, radius, channel_color(ui, channel));
            }
        }
    }
}

/// The joint and its values at a time, left of the lines.
fn paint_legend(
    ui: &Ui,
    session: &Session,
    curves: &Curves,
    joint: JointIndex,
    read: &CurvePoint,
    area: Rect,
    split: f32,
) {
    let tokens = Tokens::of(ui);
    let painter = ui.painter();
    let left = area.min.x + 6.0;
    let middle = area.min.y + 0.5 * RULER_HEIGHT;
    let name = session.joint_label(joint);
    painter.text(
        pos2(left, middle),
        Align2::LEFT_CENTER,
        name,
        theme::semibold(12.5),
        tokens.text,
    );
    let rows = [("t", format!("{:.3} s", read.time_secs), tokens.muted)]
        .into_iter()
        .chain(curves.channels().iter().enumerate().map(|(channel, name)| {
            let value = curves.value(read, channel);
            let text = format!("{:>9}{}", format!("{value:.4}"), curves.unit());
            (*name, text, channel_color(ui, channel))
        }));
    let mut words = Vec::new();
    let step = 18.0_f32.min((area.height() - RULER_HEIGHT) / 5.5);
    for (row, (name, text, color)) in rows.enumerate() {
        let y = area.min.y + RULER_HEIGHT + (row as f32 + 0.6) * step;
        painter.text(pos2(left, y), Align2::LEFT_CENTER, name, theme::mono(12.0), color);
        let end = pos2((left + LEGEND_WIDTH).min(split - 4.0), y);
        painter.text(end, Align2::RIGHT_CENTER, text.trim(), theme::mono(12.0), tokens.text);
        words.push(format!("{name} {}", text.trim()));
    }
    let legend = Rect::from_min_size(pos2(left, area.min.y + RULER_HEIGHT), vec2(LEGEND_WIDTH, 5.0 * step));
    let response = ui.interact(legend, ui.scope_id().with("legend"), Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, words.join(", ")));
}

/// Room above and below the curves, as a fraction of their height.
const HEADROOM: f32 = 0.08;
/// The least distance of lines, in points.
const LINE_SPACING: f32 = 34.0;

/// A range of values along a height, the greatest at the top.
#[derive(Clone, Copy, Debug, PartialEq)]
struct ValueAxis {
    height: Rangef,
    values: [f32; 2],
}

impl ValueAxis {
    /// An axis on which all values fit, with headroom. NaN is ignored. The span is at least a thousandth of the largest
    /// absolute value, so that noise is not magnified.
    fn fitted(height: Rangef, values: impl Iterator<Item = f32>) -> Self {
        let finite = values.filter(|value| value.is_finite());
        let (least, most) = finite.fold((f32::INFINITY, f32::NEG_INFINITY), |(least, most), value| {
            (least.min(value), most.max(value))
        });
        let (least, most) = if least <= most { (least, most) } else { (0.0, 0.0) };
        let middle = 0.5 * (least + most);
        let least_half = (1e-3 * least.abs().max(most.abs())).max(1e-3);
        let half = (0.5 * (most - least)).max(least_half) * (1.0 + 2.0 * HEADROOM);
        Self {
            height,
            values: [middle - half, middle + half],
        }
    }

    /// The y of a value.
    fn y_of(&self, value: f32) -> f32 {
        let fraction = (value - self.values[0]) / (self.values[1] - self.values[0]);
        self.height.max - fraction * self.height.span()
    }

    /// Round values with room between them, and the decimals that tell them apart.
    fn lines(&self) -> (Vec<f32>, usize) {
        let [least, most] = self.values;
        let count = (self.height.span() / LINE_SPACING).max(1.0);
        let step = round_up((most - least) / count);
        let decimals = (-step.log10().floor()).clamp(0.0, 6.0) as usize;
        let [first, last] = [(least / step).ceil(), (most / step).floor()];
        // Counted, so that rounding loses no line.
        let lines = (0..=(last - first).clamp(0.0, 100.0) as u32).map(|line| (first + line as f32) * step);
        (lines.collect(), decimals)
    }
}

/// The next of 1, 2 and 5 times a power of ten.
fn round_up(step: f32) -> f32 {
    let power = 10.0_f32.powf(step.max(1e-9).log10().floor());
    let part = step / power;
    let round = [1.0, 2.0, 5.0].into_iter().find(|&round| part <= round * 1.0001);
    power * round.unwrap_or(10.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn axis(values: &[f32]) -> ValueAxis {
        ValueAxis::fitted(Rangef::new(0.0, 200.0), values.iter().copied())
    }

    #[test]
    fn all_values_are_inside_and_greater_ones_above() {
        let axis = axis(&[-3.0, 7.0, 2.0, f32::NAN]);
        let [low, high] = [-3.0, 7.0].map(|value| axis.y_of(value));
        assert!(high > 5.0 && low < 195.0 && high < low);
    }

    #[test]
    fn what_stands_still_is_in_the_middle() {
        for value in [0.0, 5.0, -12_000.0] {
            assert!((axis(&[value, value]).y_of(value) - 100.0).abs() < 1e-2);
        }
        assert!(axis(&[]).y_of(0.0).is_finite());
    }

    #[test]
    fn lines_are_round_and_have_room() {
        let (lines, decimals) = axis(&[-3.0, 7.0]).lines();
        assert_eq!((lines, decimals), (vec![-2.0, 0.0, 2.0, 4.0, 6.0], 0));
        let (lines, decimals) = axis(&[0.1, 0.2]).lines();
        assert_eq!(decimals, 2);
        assert!(
            lines.windows(2).all(|pair| (pair[1] - pair[0] - 0.02).abs() < 1e-5),
            "{lines:?}"
        );
        for step in [1e-4, 0.3, 1.0, 4.9, 700.0] {
            assert!(round_up(step) >= step * 0.999 && round_up(step) <= step * 2.5);
        }
    }
}
