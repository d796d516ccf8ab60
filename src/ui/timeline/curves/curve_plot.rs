//! The motion of the selected joint as lines over time: controls, lines, keys as dots, names with values.

use egui::{
    Align, Align2, Color32, FontId, Layout, Rangef, Rect, Role, Sense, Shape, Stroke, Ui, UiBuilder, WidgetInfo, pos2,
};

use super::curve_keys;
use super::value_axis::ValueAxis;
use crate::anim::{CurvePoint, CurveSpace, JointActivity};
use crate::model::JointIndex;
use crate::session::{Command, JointCommand};
use crate::ui::cx::Cx;
use crate::ui::kit::theme::{self, CONTROL_RADIUS, Tokens};
use crate::ui::kit::{Row, TextButton, control_size, focus_ring, is_touch, paint_name, tell_node};
use crate::ui::timeline::axis::TimeAxis;
use crate::ui::timeline::curves::{CurveOf, Curves, Part, RotationAs, SampledOf};
use crate::ui::timeline::marks::MERGE_POINTS;
use crate::ui::timeline::state::TimelineState;
use crate::ui::timeline::time_area::{self, TimeArea, segmented_of_width};

const SAMPLE_SPACING: f32 = 2.0;
/// The most samples, more than any screen needs.
const MOST_SAMPLES: usize = 2048;
/// Gap between a sentence and the button that does what it says.
const OFFER_GAP: f32 = 8.0;

pub(in crate::ui::timeline) fn controls(ui: &mut Ui, curves: &mut Curves) {
    let parts = [
        (Part::Translation, "Translation"),
        (Part::Rotation, "Rotation"),
        (Part::Scale, "Scale"),
    ];
    segmented_of_width(ui, 246.0, "Part", &parts, &mut curves.part);
    if curves.part == Part::Rotation {
        let kinds = [(RotationAs::Quaternion, "Quaternion"), (RotationAs::Euler, "Euler")];
        segmented_of_width(ui, 164.0, "Rotation as", &kinds, &mut curves.rotation);
    }
    let spaces = [(CurveSpace::Local, "Local"), (CurveSpace::Model, "Model")];
    segmented_of_width(ui, 124.0, "Space", &spaces, &mut curves.space);
}

/// The curves. Fills the rest of the sheet.
pub(in crate::ui::timeline) fn show(ui: &mut Ui, cx: &mut Cx<'_, TimelineState>) {
    let Some(time) = TimeArea::new(ui, cx) else { return };
    let (open, clip_index) = (time.open, time.clip_index);
    let Some(joint) = cx.session.joints().selected() else {
        let activity = open.activity(clip_index).unwrap_or_default();
        offer_joint(ui, time.times, activity, cx.commands);
        return;
    };
    let TimeArea { clip, axis, .. } = time;
    let count = (axis.points().span() / SAMPLE_SPACING).ceil().max(1.0) as usize + 1;
    let of = SampledOf {
        curve: CurveOf {
            clips_revision: cx.session.clips_revision(),
            clip: clip_index,
            joint,
            space: cx.state.curves.space,
        },
        span_secs: cx.state.seen.span_secs([clip.start_secs, clip.end_secs]),
        count: count.min(MOST_SAMPLES),
    };
    cx.state.curves.sample(cx.session, open, of);

    time.paint_ruler(ui);
    let lines_rect = time.times.with_min_y(time.ruler.max.y);
    let values = paint_lines(ui, &cx.state.curves, &axis, lines_rect, time.whole.min.x);
    let key_times = open.key_times(clip_index, Some(joint));
    paint_keys(ui, &cx.state.curves, key_times, &axis, &values);

    let response = ui.interact(lines_rect, ui.scope_id().with("curves"), Sense::click_and_drag());
    curve_keys::tell(&response, cx.session, &cx.state.curves, joint);
    focus_ring(ui, lines_rect, &response);
    curve_keys::read(ui, &response, cx, clip, joint);
    let chosen = cx.state.key_box.as_ref();
    if let Some(key_box) = chosen.filter(|key_box| key_box.joints.contains(&joint)) {
        time.paint_chosen(ui, key_box);
    }
    curve_keys::show_cursor(ui, cx, &response, joint, (&axis, &values));
    time_area::scrub(&response, &axis, cx.commands);
    let ruler = time.show_ruler(ui, cx);
    let read_secs = response
        .hover_pos()
        .filter(|_| !response.dragged())
        .map_or(cx.session.playback().time_secs(), |at| axis.seen_time_at(at.x));
    let read = cx.state.curves.point_at(cx.session, open, read_secs);
    let name = cx.session.joint_label(joint);
    paint_legend(ui, &mut cx.state.curves, &name, &read, &time);
    time_area::paint_pointer(ui, &response, &axis, lines_rect.y_range());
    time.paint_head(ui);
    time_area::navigate(ui, &response, clip, &axis, cx.state, false);
    time_area::navigate(ui, &ruler, clip, &axis, cx.state, false);
}

/// Width of names and values, left of the lines.
const LEGEND_WIDTH: f32 = 100.0;
/// Height of a row of the legend, unless there is less room.
const LEGEND_STEP: f32 = 18.0;
const TOUCH_LEGEND_STEP: f32 = 32.0;

/// Colours of x, y and z, those of the axes, and of w.
fn channel_color(ui: &Ui, channel: usize) -> Color32 {
    let tokens = Tokens::of(ui);
    tokens.axes.get(channel).copied().unwrap_or(tokens.muted)
}

/// Says what to do without a selected joint, and offers the one that moves most.
fn offer_joint(ui: &mut Ui, plot: Rect, activity: &[JointActivity], commands: &mut Vec<Command>) {
    let (font, color) = (FontId::proportional(13.0), Tokens::of(ui).muted);
    let words = "Curves are those of one bone. Choose it in the dope sheet or in the skeleton.";
    let galley = ui.painter().layout(words.to_owned(), font, color, plot.width() - 24.0);
    let most = (0u32..)
        .map(JointIndex)
        .zip(activity)
        .filter(|(_, activity)| activity.fraction > 0.0);
    let most = most.max_by(|(_, a), (_, b)| a.fraction.total_cmp(&b.fraction));
    let below = most.map_or(0.0, |_| OFFER_GAP + control_size(ui));
    let top = plot.center().y - 0.5 * (galley.size().y + below);
    let text = Align2::CENTER_TOP.anchor_size(pos2(plot.center().x, top), galley.size());
    ui.painter().galley(text.min, galley, color);
    let response = ui.interact(text, ui.scope_id().with("hint"), Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, words));
    if let Some((joint, _)) = most {
        let place = Rect::from_min_max(pos2(plot.min.x, text.max.y + OFFER_GAP), plot.max);
        let mut below = ui.new_child(UiBuilder::new().max_rect(place).layout(Layout::top_down(Align::Center)));
        let offer = "Choose the bone that moves most";
        if TextButton::new(offer, offer).show(&mut below).clicked() {
            commands.push(JointCommand::Select(Some(joint)).into());
        }
    }
}

/// The lines, over lines at round values. Returns the value axis.
fn paint_lines(ui: &Ui, curves: &Curves, axis: &TimeAxis, rect: Rect, legend_left: f32) -> ValueAxis {
    let (tokens, split) = (Tokens::of(ui), rect.min.x);
    let all = curves
        .points
        .iter()
        .flat_map(|point| curves.shown().map(move |channel| curves.value(point, channel)));
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
    for channel in curves.shown().rev() {
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
        for channel in curves.shown().rev() {
            if let Some(value) = curves.value_at(channel, time_secs) {
                let at = pos2(x, values.y_of(value));
                ui.painter().circle_filled(at, radius, channel_color(ui, channel));
            }
        }
    }
}

/// The joint and its values at a time, left of the lines.
fn paint_legend(ui: &Ui, curves: &mut Curves, joint_name: &str, read: &CurvePoint, time: &TimeArea<'_>) {
    let tokens = Tokens::of(ui);
    let painter = ui.painter();
    let (left, split, top) = (time.whole.min.x + 6.0, time.times.min.x, time.ruler.max.y);
    let at = pos2(left, time.ruler.center().y);
    paint_name(
        painter,
        at,
        joint_name,
        theme::semibold(12.5),
        tokens.text,
        split - 4.0 - left,
    );
    let most = if is_touch(ui) { TOUCH_LEGEND_STEP } else { LEGEND_STEP };
    let step = most.min((time.whole.max.y - top) / 5.5);
    let end = (left + LEGEND_WIDTH).min(split - 4.0);
    let font = || theme::mono(12.0);
    let y_of = |row: usize| top + (row as f32 + 0.6) * step;
    let secs = format!("{:.3} s", read.time_secs);
    let time_row = Rect::from_x_y_ranges(left..=end, y_of(0) - 0.5 * step..=y_of(0) + 0.5 * step);
    let response = ui.interact(time_row, ui.scope_id().with("time"), Sense::hover());
    let mut row = Row::of(ui, time_row, response);
    row.left_in(font(), "t", tokens.muted);
    row.right_in(font(), &secs, tokens.text);
    row.told(Role::Label, format!("t {secs}"));
    let part = curves.part_name();
    for (channel, name) in curves.channels().iter().enumerate() {
        let (y, shown) = (y_of(channel + 1), !curves.hidden[channel]);
        let row = Rect::from_x_y_ranges(left - 4.0..=end + 2.0, y - 0.5 * step..=y + 0.5 * step);
        let response = ui.interact(row, ui.scope_id().with(("channel", channel)), Sense::click());
        if response.hovered() {
            painter.rect_filled(row, CONTROL_RADIUS, tokens.field_hovered);
        }
        focus_ring(ui, row, &response);
        let (name_color, color) = if shown {
            (channel_color(ui, channel), tokens.text)
        } else {
            (tokens.faint, tokens.faint)
        };
        painter.text(pos2(left, y), Align2::LEFT_CENTER, name, font(), name_color);
        let value = curves.written(read, channel);
        painter.text(pos2(end, y), Align2::RIGHT_CENTER, &value, font(), color);
        response.widget_info(|| WidgetInfo::selected(Role::CheckBox, true, shown, format!("{part} {name}")));
        tell_node(&response, |node| node.set_value(value.as_str()));
        let hint = if shown { "Hide this line" } else { "Show this line" };
        if response.on_hover_text(hint).clicked() {
            curves.hidden[channel] = shown;
        }
    }
}
