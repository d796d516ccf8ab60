//! The keys of a joint's track in the clip on show. Only the rows in view are laid out; a click goes to the key.

use egui::{Align2, Role, ScrollArea, Sense, Ui, WidgetInfo, pos2, vec2};

use super::digits::fitted;
use crate::anim::{KeyRow, key_rows, key_table};
use crate::model::JointIndex;
use crate::session::{Command, Session};
use crate::ui::theme::{self, CONTROL_RADIUS, MARGIN, Tokens};
use crate::ui::widgets::{focus_ring, is_touch, pressed_row_height, rule, section_with_labelled_action, segmented};
use crate::ui::wording::{counted, grouped};

/// Keys listed before the list scrolls.
const ROWS: f32 = 8.0;
/// Right ends of the columns of frame and time.
const FRAME_END: f32 = 34.0;
const TIME_END: f32 = 86.0;
/// Width of a column of numbers.
const COLUMN: f32 = 56.0;

/// What of the keys is listed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum KeyPart {
    #[default]
    Position,
    Rotation,
    Scale,
}

/// The section's contents.
pub(super) fn show(ui: &mut Ui, session: &Session, part: &mut KeyPart, joint: JointIndex, commands: &mut Vec<Command>) {
    rule(ui, MARGIN);
    let clip = session.clip();
    let track = clip.and_then(|clip| clip.tracks.get(joint.index()));
    let (Some(clip), Some(track)) = (clip, track.filter(|track| track.has_keys())) else {
        section_with_labelled_action(ui, "Keys", None);
        ui.label(egui::RichText::new("No keys: it stays at rest.").color(Tokens::of(ui).muted));
        return;
    };
    let copy = ("Copy", "Copy: keys as a table");
    if section_with_labelled_action(ui, &counted(track.key_count(), "key"), Some(copy)) {
        ui.ctx().copy_text(key_table(clip, track));
    }
    let parts = [
        (KeyPart::Position, "Position"),
        (KeyPart::Rotation, "Euler"),
        (KeyPart::Scale, "Scale"),
    ];
    if let Some(chosen) = segmented(ui, "Keys", &parts, Some(*part)) {
        *part = chosen;
    }
    ui.add_space(4.0);
    let height = pressed_row_height(ui);
    let rows = key_rows(clip, track);
    // The key that is in force now: the last one that is not after it.
    let now_secs = session.playback().time_secs();
    let now = track.times_secs().partition_point(|&secs| secs <= now_secs);
    ScrollArea::vertical()
        .id_salt(("keys", joint.0))
        .max_height(ROWS * height)
        .min_scrolled_height(ROWS * height)
        .auto_shrink([false, true])
        .show_rows(ui, height, rows.len(), |ui, range| {
            for row in rows.skip(range.start).take(range.len()) {
                let in_force = row.key + 1 == now;
                if show_row(ui, &row, *part, in_force) {
                    let time_secs = row.time_secs;
                    commands.extend([Command::Pause, Command::Seek { time_secs }]);
                }
            }
        });
}

/// Whether it was clicked.
fn show_row(ui: &mut Ui, row: &KeyRow, part: KeyPart, in_force: bool) -> bool {
    let tokens = Tokens::of(ui);
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), pressed_row_height(ui)), Sense::click());
    let around = rect.expand2(vec2(6.0, 0.0));
    if in_force {
        ui.painter().rect_filled(around, CONTROL_RADIUS, tokens.accent_ground);
    } else if response.hovered() && !is_touch(ui) {
        ui.painter().rect_filled(around, CONTROL_RADIUS, tokens.field);
    }
    focus_ring(ui, around, &response);
    let numbers = match part {
        KeyPart::Position => row.parts.position.to_array().map(|number| fitted(number, 3)),
        KeyPart::Rotation => row.parts.euler_xyz_degrees.to_array().map(|number| fitted(number, 2)),
        KeyPart::Scale => row.parts.scale.to_array().map(|number| fitted(number, 4)),
    };
    let (frame, time) = (grouped(row.frame as usize), format!("{:.3}", row.time_secs));
    // The scroll bar lies over the last points of the row.
    let right = rect.max.x - 8.0;
    let cells = [
        (rect.min.x + FRAME_END, &frame, tokens.faint),
        (rect.min.x + TIME_END, &time, tokens.muted),
        (right - 2.0 * COLUMN, &numbers[0], tokens.text),
        (right - COLUMN, &numbers[1], tokens.text),
        (right, &numbers[2], tokens.text),
    ];
    for (end, text, color) in cells {
        let at = pos2(end, rect.center().y);
        ui.painter()
            .text(at, Align2::RIGHT_CENTER, text, theme::mono(10.5), color);
    }
    let label = format!("Key {}, {time} s: {}", row.key, numbers.join(" "));
    response.widget_info(|| WidgetInfo::selected(Role::ListItem, true, in_force, &label));
    response.clicked()
}
