//! What pressing and dragging over the keys of the dope sheet does.

use egui::{CursorIcon, PointerButton, Pos2, Rect, Response, Stroke, StrokeKind, Ui, pos2};

use super::super::theme::Tokens;
use super::super::widgets::{by_finger, is_touch};
use super::dope_sheet::Sheet;
use super::key_box::KeyBox;
use super::rows::{Row, Rows};
use super::state::TimelineState;
use crate::session::{Command, JointCommand};

/// How far from a key a click still means it.
const REACH: f32 = 6.0;
const TOUCH_REACH: f32 = 16.0;

impl Sheet<'_> {
    /// A click goes to a key; a drag draws a box.
    pub(super) fn press_keys(
        &self,
        ui: &Ui,
        response: &Response,
        rows: &Rows,
        top: f32,
        state: &mut TimelineState,
        commands: &mut Vec<Command>,
    ) {
        let row_at = |at: Pos2| (at.y - top) / self.row_height;
        let corner = |at: Pos2| (self.axis.seen_time_at(at.x), row_at(at));
        let pointer = response.interact_pointer_pos();
        let boxes = !by_finger(ui);
        if response.drag_started_by(PointerButton::Primary)
            && boxes
            && let Some(origin) = ui.input(|input| input.pointer.press_origin())
        {
            state.key_box = Some(KeyBox::at(corner(origin)));
        }
        if response.dragged_by(PointerButton::Primary)
            && let (true, Some(pointer), Some(key_box)) = (boxes, pointer, &mut state.key_box)
        {
            let pointer = pointer.clamp(response.rect.min, response.rect.max);
            key_box.stretch(corner(pointer), |row| rows.joints_of(self.session, row));
            let from = pos2(self.axis.x_of(key_box.from.0), top + key_box.from.1 * self.row_height);
            let drawn = Rect::from_two_pos(from, pointer);
            let tokens = Tokens::of(ui);
            ui.painter().rect_filled(drawn, 2.0, tokens.accent_ground);
            ui.painter()
                .rect_stroke(drawn, 2.0, Stroke::new(1.0, tokens.accent), StrokeKind::Inside);
        }
        let Some(at) = pointer.or(response.hover_pos()) else {
            return;
        };
        let row = rows.all().get(row_at(at).max(0.0) as usize);
        let key = row.and_then(|row| Some((row.joint, self.key_near(ui, rows, row, at.x)?)));
        if let Some((joint, time_secs)) = key {
            ui.ctx().set_cursor_icon(CursorIcon::PointingHand);
            if response.clicked() {
                state.revealed = Some(joint);
                commands.push(JointCommand::Select(Some(joint)).into());
                // Played on, the key would be left at once.
                commands.push(Command::Pause);
                commands.push(Command::Seek { time_secs });
            }
        }
        if response.clicked() {
            state.key_box = None;
        }
    }

    /// The key of a row that is meant by a place: the joint's own, or one that is folded away below it.
    fn key_near(&self, ui: &Ui, rows: &Rows, row: &Row, x: f32) -> Option<f32> {
        let reach = if is_touch(ui) { TOUCH_REACH } else { REACH };
        let folded = rows.folded_below(row).map_or(&[][..], |branch| &branch.times_secs);
        let nearest = [self.key_times(row.joint), folded].map(|times_secs| self.nearest_key(times_secs, x));
        let away = |secs: &f32| (self.axis.x_of(*secs) - x).abs();
        // Of equal ones the first: the joint's own.
        let nearest = nearest
            .into_iter()
            .flatten()
            .min_by(|a, b| away(a).total_cmp(&away(b)))?;
        (away(&nearest) <= reach).then_some(nearest)
    }

    fn nearest_key(&self, times_secs: &[f32], x: f32) -> Option<f32> {
        let next = times_secs.partition_point(|&secs| self.axis.x_of(secs) < x);
        let around = &times_secs[next.saturating_sub(1)..times_secs.len().min(next + 1)];
        let away = |secs: &f32| (self.axis.x_of(*secs) - x).abs();
        around.iter().copied().min_by(|a, b| away(a).total_cmp(&away(b)))
    }
}
