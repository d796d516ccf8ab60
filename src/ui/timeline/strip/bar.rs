//! The bar of the strip: all keys of a clip, the play head, the range that plays.

use std::ops::RangeInclusive;

use egui::{
    CursorIcon, Key, Rangef, Rect, Response, Role, Sense, Shape, Stroke, Tooltip, Ui, Vec2, WidgetInfo, pos2, vec2,
};

use crate::actions::{self, Control};
use crate::model::Clip;
use crate::session::{PlayCommand, Session};
use crate::ui::cx::Cx;
use crate::ui::kit::theme::{CONTROL_RADIUS, Tokens};
use crate::ui::kit::{SliderNode, focus_ring, focused_keys, is_touch, named};
use crate::ui::timeline::axis::TimeAxis;
use crate::ui::timeline::loop_gap::LoopGapReading;
use crate::ui::timeline::marks::{MarkShape, mark_radius};
use crate::ui::timeline::state::TimelineState;
use crate::ui::timeline::time_area::{self, SLIDER_KEYS};

/// Room at both ends for the grips of the range.
const END_ROOM: f32 = 12.0;
/// How far the grip of a range's end reaches: outside and inside of the range.
const GRIP: [f32; 2] = [11.0, 4.0];
const TOUCH_GRIP: [f32; 2] = [28.0, 16.0];
/// The same while the play head is at that end. A finger on the play head moves the time, so the grip is outside only.
const TOUCH_GRIP_BY_HEAD: [f32; 2] = [32.0, -4.0];

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum End {
    In,
    Out,
}

pub(in crate::ui::timeline) fn show(ui: &mut Ui, cx: &mut Cx<'_, TimelineState>, size: Vec2) {
    let tokens = Tokens::of(ui);
    let (rect, response) = ui.allocate_exact_size(size, Sense::click_and_drag());
    let response = response.on_hover_cursor(CursorIcon::PointingHand);
    let Some(clip) = cx.session.clip() else { return };
    ui.painter().rect_filled(rect, CONTROL_RADIUS, tokens.field);
    focus_ring(ui, rect, &response);

    let axis = TimeAxis::new(rect.x_range(), END_ROOM, [clip.start_secs, clip.end_secs]);
    paint_range(ui, cx.session, &axis, rect);
    let mut shape = MarkShape::new(ui);
    let radius = mark_radius(axis.points_per_sec() / clip.keys_per_sec);
    shape.add(cx.session.key_times(None), &axis, rect.center().y, radius, tokens.muted);
    shape.paint(ui.painter());
    time_area::scrub(&response, &axis, cx.commands);
    if !response.dragged() {
        time_area::paint_pointer(ui, &response, &axis, rect.y_range());
    }
    time_area::paint_head(ui, cx.session, &axis, rect.y_range());
    time_area::time_slider(ui, cx, clip, "Time", &response);
    named(response, Control::new("time"));

    for end in [End::In, End::Out] {
        grip(ui, cx, clip, end, &axis, rect);
    }
    loop_gap_tick(ui, &cx.state.loop_gap, &axis, rect);
}

/// The range that plays, unless it is the whole clip.
fn paint_range(ui: &Ui, session: &Session, axis: &TimeAxis, rect: Rect) {
    if let Some([start_secs, end_secs]) = session.playback().range_secs() {
        let points = axis.x_of(start_secs)..=axis.x_of(end_secs);
        let band = Rect::from_x_y_ranges(points, rect.y_range());
        ui.painter().rect_filled(band, 0.0, Tokens::of(ui).accent_ground);
    }
}

/// An end of the range: a bracket that is dragged from frame to frame.
fn grip(ui: &Ui, cx: &mut Cx<'_, TimelineState>, clip: &Clip, end: End, axis: &TimeAxis, rect: Rect) {
    let [in_secs, out_secs] = cx.session.playback().played_secs();
    // A clip of one frame has no range.
    if clip.last_frame() == 0 {
        return;
    }
    let (secs, sign, name, here) = match end {
        End::In => (in_secs, 1.0, "Range in", &actions::RANGE_IN),
        End::Out => (out_secs, -1.0, "Range out", &actions::RANGE_OUT),
    };
    let x = axis.x_of(secs);
    let head = axis.x_of(cx.session.playback().time_secs());
    let [outside, inside] = match is_touch(ui) {
        true if (head - x).abs() < 2.0 * TOUCH_GRIP[1] => TOUCH_GRIP_BY_HEAD,
        true => TOUCH_GRIP,
        false => GRIP,
    };
    let (from, to) = (x - sign * outside, x + sign * inside);
    let target = Rect::from_x_y_ranges(from.min(to)..=from.max(to), rect.y_range());
    let response = ui
        .interact(target, ui.scope_id().with(("range", end)), Sense::click_and_drag())
        .on_hover_cursor(CursorIcon::ResizeHorizontal);
    let [in_frame, out_frame] = [in_secs, out_secs].map(|secs| clip.frame_at(secs));
    let frames = match end {
        End::In => 0..=out_frame.saturating_sub(1),
        End::Out => in_frame + 1..=clip.last_frame(),
    };
    let words = format!("{secs:.3} s, frame {}", clip.frame_at(secs));
    let node = SliderNode {
        name,
        value: f64::from(secs),
        range: f64::from(clip.time_of_frame(*frames.start()))..=f64::from(clip.time_of_frame(*frames.end())),
        step: 1.0 / f64::from(clip.keys_per_sec),
        text: &words,
    };
    let (steps, value) = node.tell(ui, &response);
    let asked_frame = value.map(|secs| clip.frame_at(secs as f32)).or_else(|| {
        let frame = clip.frame_at(secs);
        match steps + steps_of_keys(ui, &response, frame, &frames) {
            0 => dragged_frame(clip, axis, &response),
            steps => Some(frame.saturating_add_signed(steps)),
        }
    });
    if let Some(frame) = asked_frame {
        cx.commands.push(match end {
            End::In => PlayCommand::SetRangeStart(Some(clip.time_of_frame(frame.min(*frames.end())))).into(),
            End::Out => PlayCommand::SetRangeEnd(Some(clip.time_of_frame(frame.max(*frames.start())))).into(),
        });
    }
    if response.double_clicked() {
        cx.push(PlayCommand::ClearRange);
    }
    paint_bracket(ui, cx.session, &response, pos2(x, rect.center().y), sign, rect.height());
    let response = named(response, here.control);
    let (here, all) = (here.key(), actions::CLEAR_RANGE.key());
    if response.dragged() || response.has_focus() {
        // Below the pointer egui shows no tooltip while a button is held.
        Tooltip::always_open(ui.ctx().clone(), ui.layer_id(), response.id, target).show(|ui| {
            ui.label(format!("{name} {words}"));
        });
    } else {
        response.on_hover_text(format!("{name} {words}\n{here}: here; {all}: all"));
    }
}

/// Frames that keys move an end by: arrows by one, with Shift or the page keys by ten.
fn steps_of_keys(ui: &Ui, response: &Response, frame: u32, frames: &RangeInclusive<u32>) -> i32 {
    let keys = focused_keys(ui, response, SLIDER_KEYS).into_iter();
    let steps = keys.map(|(key, shift)| match key {
        Key::ArrowRight | Key::ArrowUp if shift => 10,
        Key::ArrowRight | Key::ArrowUp => 1,
        Key::ArrowLeft | Key::ArrowDown if shift => -10,
        Key::ArrowLeft | Key::ArrowDown => -1,
        Key::PageUp => 10,
        Key::PageDown => -10,
        Key::Home => *frames.start() as i32 - frame as i32,
        _ => *frames.end() as i32 - frame as i32,
    });
    steps.sum()
}

/// The frame to which the pointer drags an end.
fn dragged_frame(clip: &Clip, axis: &TimeAxis, response: &Response) -> Option<u32> {
    let pointer = response.interact_pointer_pos().filter(|_| response.dragged())?;
    Some(clip.frame_at(axis.seen_time_at(pointer.x)))
}

fn paint_bracket(ui: &Ui, session: &Session, response: &Response, at: egui::Pos2, sign: f32, height: f32) {
    let tokens = Tokens::of(ui);
    let active = response.hovered() || response.dragged() || response.has_focus();
    let color = match (active, session.playback().range_secs()) {
        (true, _) | (false, Some(_)) => tokens.accent,
        (false, None) => tokens.faint.gamma_multiply(0.6),
    };
    let (half, foot) = (height * 0.5 - 4.0, sign * 3.5);
    let x = at.x - sign * 6.5;
    let points = [(foot, -half), (0.0, -half), (0.0, half), (foot, half)];
    let points = points.map(|(right, down)| pos2(x + right, at.y + down));
    ui.painter().add(Shape::line(points.into(), Stroke::new(1.6, color)));
}

/// A mark at the end of a loop whose gap is visible.
fn loop_gap_tick(ui: &Ui, gap: &LoopGapReading, axis: &TimeAxis, rect: Rect) {
    let (Some(words), Some(at_secs)) = (gap.words(), gap.seen_at_secs()) else {
        return;
    };
    let (painter, color) = (ui.painter(), Tokens::of(ui).warning);
    let x = axis.x_of(at_secs);
    let at = pos2(x, rect.min.y + 1.0);
    let corners = [vec2(-4.0, 0.0), vec2(4.0, 0.0), vec2(0.0, 5.5)].map(|offset| at + offset);
    painter.add(Shape::convex_polygon(corners.into(), color, Stroke::NONE));
    let below = Rangef::new(rect.min.y + 4.0, rect.max.y - 1.0);
    painter.vline(x, below, Stroke::new(1.0, color.gamma_multiply(0.5)));
    let target = Rect::from_center_size(at + vec2(0.0, 4.0), vec2(14.0, 12.0));
    let response = ui.interact(target, ui.scope_id().with("loop gap"), Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, words));
    response.on_hover_text(format!(
        "{words}\nThe triangle marks where the loop jumps. The speed's popover lists the jump of each bone."
    ));
}
