//! The curves by keyboard: a key that arrows move along a line, and the keys that Shift chooses. And what screen readers are told.

use egui::accesskit::Action;
use egui::{Key, Rect, Response, Role, Sense, Stroke, Ui, UiBuilder, WidgetInfo, pos2, vec2};

use super::value_axis::ValueAxis;
use crate::model::{Clip, JointIndex};
use crate::session::Session;
use crate::ui::cx::Cx;
use crate::ui::kit::theme::Tokens;
use crate::ui::kit::{focused_keys, tell_node};
use crate::ui::timeline::axis::TimeAxis;
use crate::ui::timeline::curves::Curves;
use crate::ui::timeline::sheet::rows::RowKeys;
use crate::ui::timeline::state::{KeyCursor, TimelineState};
use crate::ui::timeline::time_area::{self, GRID_KEYS};

/// Tells of the curves as a grid, in which the key that the keyboard is on is the only cell. The legend has the values at the time.
pub(in crate::ui::timeline) fn tell(response: &Response, session: &Session, curves: &Curves, joint: JointIndex) {
    response.widget_info(|| {
        let (name, part) = (session.joint_label(joint), curves.part_name());
        WidgetInfo::labeled(Role::Grid, true, format!("Curves of {name}, {part}"))
    });
    tell_node(response, |node| node.remove_action(Action::Click));
}

/// Keys of the focused curves: left and right from key to key, up and down from line to line, Enter goes to the key.
pub(in crate::ui::timeline) fn read(
    ui: &Ui,
    response: &Response,
    cx: &mut Cx<'_, TimelineState>,
    clip: &Clip,
    joint: JointIndex,
) {
    if !response.has_focus() {
        return;
    }
    let keys = RowKeys([cx.session.key_times(Some(joint)), &[]]);
    let here = cx.state.cursor.filter(|cursor| cursor.joint == joint);
    let mut secs = here.and_then(|cursor| cursor.key_secs);
    secs = secs.or_else(|| keys.nearest(cx.session.playback().time_secs()));
    let mut chooses = here.is_some_and(|cursor| cursor.chooses);
    let channels = cx.state.curves.channels().len();
    cx.state.curves.channel = cx.state.curves.channel.min(channels - 1);
    for (key, shift) in focused_keys(ui, response, &GRID_KEYS) {
        let Some(before_secs) = secs else { continue };
        let to_secs = match key {
            Key::ArrowUp => {
                cx.state.curves.channel = (cx.state.curves.channel + channels - 1) % channels;
                continue;
            }
            Key::ArrowDown => {
                cx.state.curves.channel = (cx.state.curves.channel + 1) % channels;
                continue;
            }
            Key::Enter | Key::Space => {
                cx.pause_at(before_secs);
                continue;
            }
            Key::ArrowLeft | Key::PageDown => keys.before(before_secs),
            Key::ArrowRight | Key::PageUp => keys.after(before_secs),
            Key::Home => keys.first(),
            _ => keys.last(),
        };
        let to_secs = to_secs.unwrap_or(before_secs);
        let joints = [joint];
        let corners = [before_secs, to_secs].map(|secs| (secs, 0.5));
        cx.state
            .choose_keys((shift, chooses), corners, |row| (row == 0).then_some(&joints[..]));
        chooses = shift;
        secs = Some(to_secs);
        time_area::bring_into_view(clip, to_secs, cx.state);
    }
    cx.state.cursor = Some(KeyCursor {
        chooses,
        ..KeyCursor::at(joint, secs)
    });
}

/// Draws a ring round the key that the keyboard is on, and tells of it. Before the keyboard was on one it is the first.
pub(in crate::ui::timeline) fn show_cursor(
    ui: &mut Ui,
    Cx { session, state, .. }: &Cx<'_, TimelineState>,
    response: &Response,
    joint: JointIndex,
    (axis, values): (&TimeAxis, &ValueAxis),
) {
    let (Some(open), Some(clip)) = (session.open_model(), session.clip()) else {
        return;
    };
    let times = session.key_times(Some(joint));
    let cursor = state.cursor.filter(|cursor| cursor.joint == joint);
    let secs = cursor.and_then(|cursor| cursor.key_secs).or(times.first().copied());
    let Some(secs) = secs else { return };
    let (curves, channel) = (&state.curves, state.curves.channel);
    let point = curves.point_at(session, open, secs);
    let at = pos2(axis.x_of(secs), values.y_of(curves.value(&point, channel)));
    let painter = ui.painter().with_clip_rect(response.rect);
    if response.has_focus() {
        painter.circle_stroke(at, 5.5, Stroke::new(1.5, Tokens::of(ui).accent));
    }
    let number = times.iter().position(|&key| key == secs).map_or(0, |index| index + 1);
    let words = format!(
        "{} {} {}, key {number} of {}, frame {}, {secs:.2} s",
        curves.part_name(),
        curves.channels()[channel],
        curves.written(&point, channel),
        times.len(),
        clip.frame_at(secs),
    );
    // A cell of its own for each key, so that a screen reader hears of each.
    let id = response.id.with((channel, secs.to_bits()));
    let row = UiBuilder::new().id_salt("key").accessibility_parent(response.id);
    let child = ui.new_child(row.accessibility_role(Role::Row));
    let key = child.interact(Rect::from_center_size(at, vec2(12.0, 12.0)), id, Sense::hover());
    key.widget_info(|| WidgetInfo::labeled(Role::GridCell, true, &words));
    tell_node(response, |node| node.set_active_descendant(id.accesskit_id()));
}
