//! How curves are drawn: lines, keys as dots, names with values.

use egui::{Align2, Color32, FontId, Rangef, Rect, Role, Sense, Shape, Stroke, Ui, WidgetInfo, pos2, vec2};

use super::super::theme::{self, Tokens};
use super::axis::TimeAxis;
use super::curves::Curves;
use super::marks::MERGE_POINTS;
use super::plot::ValueAxis;
use super::ruler::RULER_HEIGHT;
use crate::anim::CurvePoint;
use crate::model::JointIndex;
use crate::session::Session;

/// Room that names and values take left of the lines.
const LEGEND_WIDTH: f32 = 100.0;

/// Colours of x, y, z as the axes have them, and of w.
fn channel_color(ui: &Ui, channel: usize) -> Color32 {
    let tokens = Tokens::of(ui);
    tokens.axes.get(channel).copied().unwrap_or(tokens.muted)
}

/// What stands where there is no joint to show.
pub(super) fn paint_hint(ui: &Ui, plot: Rect) {
    let (font, color) = (FontId::proportional(13.0), Tokens::of(ui).muted);
    let words = "Choose a bone in the dope sheet to see how it moves.";
    let galley = ui.painter().layout(words.to_owned(), font, color, plot.width() - 24.0);
    ui.painter().galley(plot.center() - 0.5 * galley.size(), galley, color);
    let response = ui.interact(plot, ui.scope_id().with("hint"), Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, words));
}

/// The lines, and behind them round values. Where values are.
pub(super) fn paint_lines(ui: &Ui, curves: &Curves, axis: &TimeAxis, rect: Rect, legend_left: f32) -> ValueAxis {
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
pub(super) fn paint_keys(ui: &Ui, curves: &Curves, times_secs: &[f32], axis: &TimeAxis, values: &ValueAxis) {
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

/// The joint and its values at the time that is read, left of the lines.
pub(super) fn paint_legend(
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
