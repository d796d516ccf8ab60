//! A row with a switch at its right end.

use egui::{Align2, Color32, FontId, Rect, Response, Role, Sense, StrokeKind, Ui, WidgetInfo, lerp, pos2, vec2};

use super::super::theme::{self, CONTROL_RADIUS, Tokens};
use super::{MOUSE_CONTROL, control_size, focus_ring, key_hint};
use crate::actions::Action;
use crate::session::{Command, Session};

const TRACK_WIDTH: f32 = 26.0;
const TRACK_HEIGHT: f32 = 15.0;

/// A row that turns something on or off, with the key that does the same (or none).
pub(crate) fn switch_row(ui: &mut Ui, label: &str, key: &str, on: bool) -> Response {
    let tokens = Tokens::of(ui);
    let height = control_size(ui).max(MOUSE_CONTROL);
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), height), Sense::click());
    let around = rect.expand2(vec2(6.0, 0.0));
    if response.hovered() {
        ui.painter().rect_filled(around, CONTROL_RADIUS, tokens.field);
    }
    focus_ring(ui, around, &response);
    let font = FontId::proportional(13.0);
    ui.painter()
        .text(rect.left_center(), Align2::LEFT_CENTER, label, font, tokens.text);
    let track = Rect::from_center_size(
        pos2(rect.max.x - TRACK_WIDTH * 0.5, rect.center().y),
        vec2(TRACK_WIDTH, TRACK_HEIGHT),
    );
    paint_track(ui, track, &response, on);
    let key_at = pos2(track.min.x - 10.0, rect.center().y);
    let key = key_hint(ui, key);
    ui.painter()
        .text(key_at, Align2::RIGHT_CENTER, key, theme::mono(11.0), tokens.faint);
    response.widget_info(|| WidgetInfo::selected(Role::Switch, true, on, label));
    response
}

/// The row of an action of the session that is on or off.
pub(crate) fn action_switch(ui: &mut Ui, session: &Session, action: &Action, commands: &mut Vec<Command>) {
    if switch_row(ui, action.label, action.key(), action.is_on(session)).clicked() {
        commands.extend(action.command(session));
    }
}

fn paint_track(ui: &Ui, track: Rect, response: &Response, on: bool) {
    let tokens = Tokens::of(ui);
    let share = ui.ctx().animate_bool_with_time(response.id, on, 0.1);
    let off_ground = tokens.field_hovered;
    let ground = if share > 0.0 {
        off_ground.lerp_to_gamma(tokens.accent, share)
    } else {
        off_ground
    };
    ui.painter().rect_filled(track, TRACK_HEIGHT * 0.5, ground);
    if !on {
        let border = egui::Stroke::new(1.0, tokens.hairline);
        ui.painter()
            .rect_stroke(track, TRACK_HEIGHT * 0.5, border, StrokeKind::Inside);
    }
    let knob_x = lerp(track.min.x + 7.5..=track.max.x - 7.5, share);
    let knob = if on { Color32::WHITE } else { tokens.muted };
    ui.painter().circle_filled(pos2(knob_x, track.center().y), 5.0, knob);
}
