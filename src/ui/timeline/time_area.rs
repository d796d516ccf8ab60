//! What bar, ruler, dope sheet and curves share: the play head, scrubbing, zooming and panning in time.

use egui::{PointerButton, Rangef, Rect, Response, Sense, Stroke, Ui, WidgetInfo, pos2};

use super::super::theme::Tokens;
use super::super::widgets::{by_finger, is_touch};
use super::TimelineState;
use super::axis::TimeAxis;
use crate::model::Clip;
use crate::session::{Command, Session};

/// The pointer carries the time; two fingers move what is seen of it instead.
pub(super) fn scrub(response: &Response, axis: &TimeAxis, commands: &mut Vec<Command>) {
    if response.drag_started_by(PointerButton::Primary) {
        commands.push(Command::BeginScrub);
    }
    let two_fingers = response.ctx.input(egui::InputState::multi_touch).is_some();
    if let Some(pointer) = response.interact_pointer_pos()
        && !two_fingers
        && (response.dragged_by(PointerButton::Primary) || response.clicked())
    {
        let time_secs = axis.seen_time_at(pointer.x);
        commands.push(Command::Seek { time_secs });
    }
    if response.drag_stopped_by(PointerButton::Primary) {
        commands.push(Command::EndScrub);
    }
}

/// A hairline under the pointer.
pub(super) fn paint_pointer(ui: &Ui, response: &Response, axis: &TimeAxis, height: Rangef) {
    if let Some(pointer) = response.hover_pos()
        && !is_touch(ui)
    {
        let x = axis.points().clamp(pointer.x);
        ui.painter().vline(x, height, Stroke::new(1.0, Tokens::of(ui).faint));
    }
}

/// The time as a line, when it is seen.
pub(super) fn paint_head(ui: &Ui, session: &Session, axis: &TimeAxis, height: Rangef) {
    let x = axis.x_of(session.playback().time_secs());
    if axis.points().expand(1.0).contains(x) {
        ui.painter().vline(x, height, Stroke::new(2.0, Tokens::of(ui).accent));
    }
}

/// The play head with a handle in the ruler.
pub(super) fn paint_head_below_ruler(ui: &Ui, session: &Session, axis: &TimeAxis, ruler: Rect, bottom: f32) {
    paint_head(ui, session, axis, Rangef::new(ruler.max.y - 6.0, bottom));
    let x = axis.x_of(session.playback().time_secs());
    if axis.points().expand(1.0).contains(x) {
        let handle = Rect::from_center_size(pos2(x, ruler.max.y - 6.0), egui::vec2(9.0, 9.0));
        ui.painter().rect_filled(handle, 2.5, Tokens::of(ui).accent);
    }
}

/// The ruler as something to press: it carries the time.
pub(super) fn ruler(ui: &Ui, session: &Session, axis: &TimeAxis, rect: Rect, commands: &mut Vec<Command>) -> Response {
    let response = ui.interact(rect, ui.scope_id().with("ruler"), Sense::click_and_drag());
    scrub(&response, axis, commands);
    let time_secs = f64::from(session.playback().time_secs());
    response.widget_info(|| WidgetInfo::slider(true, time_secs, "Ruler in seconds"));
    response
}

/// Wheel with Ctrl, pinch, wheel with Shift, middle drag and two fingers: what of the time is seen. With `finger_pans` a drag of
/// one finger too, where it carries nothing else.
pub(super) fn navigate(
    ui: &Ui,
    response: &Response,
    clip: &Clip,
    axis: &TimeAxis,
    state: &mut TimelineState,
    finger_pans: bool,
) {
    let whole_secs = [clip.start_secs, clip.end_secs];
    let frame_secs = 1.0 / clip.keys_per_sec;
    let pans = response.dragged_by(PointerButton::Middle) || (finger_pans && by_finger(ui) && response.dragged());
    let mut pan_points = if pans { response.drag_delta().x } else { 0.0 };
    let fingers = ui
        .input(egui::InputState::multi_touch)
        .filter(|_| response.dragged() && !pans);
    pan_points += fingers.map_or(0.0, |fingers| fingers.translation_delta.x);
    let pointer = response.hover_pos().or(response.interact_pointer_pos());
    if let Some(pointer) = pointer.filter(|_| response.contains_pointer() || response.dragged()) {
        let (zoom, scroll) = ui.input(|input| (input.zoom_delta(), input.smooth_scroll_delta().x));
        if zoom != 1.0 {
            let around_secs = axis.seen_time_at(pointer.x);
            state.window.zoom(whole_secs, frame_secs, zoom, around_secs);
        }
        pan_points += scroll;
    }
    if pan_points != 0.0 && axis.points_per_sec() > 0.0 {
        let by_secs = -pan_points / axis.points_per_sec();
        state.window.pan(whole_secs, frame_secs, by_secs);
    }
}
