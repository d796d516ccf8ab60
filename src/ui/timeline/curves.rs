//! The motion of the selected joint as lines over time.

use egui::{Align2, Color32, FontId, Rangef, Rect, Role, Sense, Shape, Stroke, Ui, WidgetInfo, pos2, vec2};

use super::super::theme::{self, CONTROL_RADIUS, Tokens};
use super::axis::{END_ROOM, TimeAxis};
use super::marks::MERGE_POINTS;
use super::plot::ValueAxis;
use super::ruler::{self, RULER_HEIGHT};
use super::sheet::{segmented_of_width, split_x};
use super::state::TimelineState;
use super::time_area;
use crate::anim::{CurvePoint, CurveSpace, curve};
use crate::model::{Clip, JointIndex};
use crate::session::{Command, OpenModel, Session};

/// Points of the width from sample to sample.
const SAMPLE_SPACING: f32 = 2.0;
/// Samples at most: a width beyond that is of no screen.
const MOST_SAMPLES: usize = 2048;
/// Room that names and values take left of the lines.
const LEGEND_WIDTH: f32 = 100.0;

/// Which part of the motion.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Part {
    Translation,
    #[default]
    Rotation,
    Scale,
}

/// In which numbers a rotation is given.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum RotationAs {
    #[default]
    Quaternion,
    Euler,
}

/// What is shown, and its samples.
#[derive(Debug, Default)]
pub(super) struct Curves {
    part: Part,
    rotation: RotationAs,
    space: CurveSpace,
    of: Option<SampledOf>,
    points: Vec<CurvePoint>,
}

/// What the samples depend on.
#[derive(Clone, Copy, Debug, PartialEq)]
struct SampledOf {
    model_revision: u64,
    clip: usize,
    joint: JointIndex,
    space: CurveSpace,
    span_secs: [f32; 2],
    count: usize,
}

impl Curves {
    /// What can be chosen.
    pub(super) fn controls(&mut self, ui: &mut Ui) {
        let parts = [
            (Part::Translation, "Translation"),
            (Part::Rotation, "Rotation"),
            (Part::Scale, "Scale"),
        ];
        if let Some(part) = segmented_of_width(ui, 246.0, "Part", &parts, self.part) {
            self.part = part;
        }
        if self.part == Part::Rotation {
            let kinds = [(RotationAs::Quaternion, "Quaternion"), (RotationAs::Euler, "Euler")];
            if let Some(kind) = segmented_of_width(ui, 164.0, "Rotation as", &kinds, self.rotation) {
                self.rotation = kind;
            }
        }
        let spaces = [(CurveSpace::Local, "Local"), (CurveSpace::Model, "Model")];
        if let Some(space) = segmented_of_width(ui, 124.0, "Space", &spaces, self.space) {
            self.space = space;
        }
    }

    /// Samples what is seen, when that changed.
    fn sample(&mut self, session: &Session, open: &OpenModel, of: SampledOf) {
        if self.of == Some(of) {
            return;
        }
        self.of = Some(of);
        self.points.resize(of.count, CurvePoint::default());
        if let Some(clip) = session.clip() {
            let skeleton = &open.model.skeleton;
            curve(skeleton, clip, of.joint, of.space, of.span_secs, &mut self.points);
        }
    }

    /// The lines, by name.
    fn channels(&self) -> &'static [&'static str] {
        match (self.part, self.rotation) {
            (Part::Rotation, RotationAs::Quaternion) => &["x", "y", "z", "w"],
            _ => &["x", "y", "z"],
        }
    }

    fn value(&self, point: &CurvePoint, channel: usize) -> f32 {
        match (self.part, self.rotation) {
            (Part::Translation, _) => point.translation.to_array()[channel],
            (Part::Scale, _) => point.scale.to_array()[channel],
            (Part::Rotation, RotationAs::Quaternion) => point.rotation.to_array()[channel],
            (Part::Rotation, RotationAs::Euler) => point.euler_degrees.to_array()[channel],
        }
    }

    /// A value as it is drawn: on the line between two samples.
    fn value_at(&self, channel: usize, time_secs: f32) -> Option<f32> {
        let [start_secs, end_secs] = self.of?.span_secs;
        let last = self.points.len().checked_sub(1)?;
        let share = if end_secs > start_secs {
            ((time_secs - start_secs) / (end_secs - start_secs)).clamp(0.0, 1.0)
        } else {
            0.0
        };
        let place = share * last as f32;
        let before = (place as usize).min(last);
        let [a, b] = [before, (before + 1).min(last)].map(|index| self.value(&self.points[index], channel));
        Some(a + (b - a) * (place - before as f32))
    }

    fn unit(&self) -> &'static str {
        match (self.part, self.rotation) {
            (Part::Rotation, RotationAs::Euler) => "°",
            _ => "",
        }
    }
}

/// Colours of x, y, z as the axes have them, and of w.
fn channel_color(ui: &Ui, channel: usize) -> Color32 {
    let tokens = Tokens::of(ui);
    tokens.axes.get(channel).copied().unwrap_or(tokens.muted)
}

/// Fills what is left of the sheet.
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
        model_revision: session.model_revision(),
        clip: clip_index,
        joint,
        space: state.curves.space,
        span_secs,
        count: count.min(MOST_SAMPLES),
    };
    state.curves.sample(session, open, of);

    let ruler_rect = Rect::from_min_max(plot.min, pos2(plot.max.x, plot.min.y + RULER_HEIGHT));
    ruler::paint(ui, clip, &axis, ruler_rect, plot.max.y);
    let lines_rect = Rect::from_min_max(pos2(plot.min.x, ruler_rect.max.y), plot.max);
    let values = paint_lines(ui, &state.curves, &axis, lines_rect, area.min.x);
    paint_keys(
        ui,
        &state.curves,
        clip,
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
    paint_legend(ui, session, &state.curves, joint, read_secs, area, split);
    time_area::paint_pointer(ui, &response, &axis, lines_rect.y_range());
    time_area::paint_head_below_ruler(ui, session, &axis, ruler_rect, plot.max.y);
    time_area::navigate(ui, &response, clip, &axis, state);
    time_area::navigate(ui, &ruler, clip, &axis, state);
}

fn paint_hint(ui: &Ui, plot: Rect) {
    let (font, color) = (FontId::proportional(13.0), Tokens::of(ui).muted);
    let words = "Choose a bone in the dope sheet to see how it moves.";
    let galley = ui.painter().layout(words.to_owned(), font, color, plot.width() - 24.0);
    ui.painter().galley(plot.center() - 0.5 * galley.size(), galley, color);
    let response = ui.interact(plot, ui.scope_id().with("hint"), Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, words));
}

/// The lines, and behind them round values. Where values are.
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
        // Beside the lines where the legend leaves room, else over them.
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

/// A dot at each key, where there is room for dots.
fn paint_keys(ui: &Ui, curves: &Curves, clip: &Clip, times_secs: &[f32], axis: &TimeAxis, values: &ValueAxis) {
    let spacing = axis.points_per_sec() / clip.keys_per_sec;
    if spacing < 2.0 * MERGE_POINTS {
        return;
    }
    let radius = (0.2 * spacing).clamp(1.4, 2.4);
    let seen = axis.points().expand(1.0);
    let first = times_secs.partition_point(|&secs| axis.x_of(secs) < seen.min);
    let mut before = f32::NEG_INFINITY;
    for &time_secs in &times_secs[first..] {
        let x = axis.x_of(time_secs);
        if x > seen.max {
            break;
        }
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
    time_secs: f32,
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
    let rows =
        [("t", format!("{time_secs:.3} s"), tokens.muted)]
            .into_iter()
            .chain(curves.channels().iter().enumerate().map(|(channel, name)| {
                let value = curves.value_at(channel, time_secs).unwrap_or(0.0);
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
