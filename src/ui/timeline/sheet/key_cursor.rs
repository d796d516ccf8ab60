//! The dope sheet by keyboard: a cell that arrows move from key to key and from row to row, and the keys that Shift chooses.
//!
//! The sheet is one stop of Tab: the cell is the active descendant of the focused grid. Rows are no stops, since there may be thousands.

use egui::accesskit::Action;
use egui::{Key, Rect, Response, Role, Sense, Stroke, StrokeKind, Ui, WidgetInfo, pos2, vec2};

use super::dope_sheet::DopeSheet;
use super::rows::{BoneRow, RowKeys, Rows};
use crate::session::JointCommand;
use crate::ui::cx::Cx;
use crate::ui::kit::theme::{CONTROL_RADIUS, Tokens};
use crate::ui::kit::wording::counted;
use crate::ui::kit::{focused_keys, tell_node};
use crate::ui::timeline::state::{KeyCursor, TimelineState};
use crate::ui::timeline::time_area::{self, GRID_KEYS};

/// Rows that the page keys go by.
const PAGE: i32 = 8;

impl DopeSheet<'_> {
    /// Tells of the sheet as a grid of so many rows.
    pub(in crate::ui::timeline) fn tell_grid(&self, response: &Response, rows: usize) {
        response.widget_info(|| WidgetInfo::labeled(Role::Grid, true, "Keys of all bones"));
        tell_node(response, |node| {
            node.set_row_count(rows);
            node.remove_action(Action::Click);
        });
    }

    /// Moves the cell by keys while the sheet is focused.
    pub(in crate::ui::timeline) fn on_keyboard(
        &self,
        ui: &Ui,
        response: &Response,
        rows: &mut Rows,
        top: f32,
        cx: &mut Cx<'_, TimelineState>,
    ) {
        if !response.has_focus() || rows.all().is_empty() {
            return;
        }
        let row_of = |rows: &Rows, joint| rows.all().iter().position(|row| row.joint == joint);
        let before = cx.state.cursor;
        let place = before.and_then(|cursor| Some((cursor, row_of(rows, cursor.joint)?)));
        let (mut cursor, mut index) = place.unwrap_or_else(|| {
            let selected = self.time.session.joints().selected();
            let index = selected.and_then(|joint| row_of(rows, joint)).unwrap_or(0);
            let joint = rows.all()[index].joint;
            let now_secs = self.time.session.playback().time_secs();
            let key_secs = RowKeys([self.key_times(joint), &[]]).nearest(now_secs);
            (KeyCursor::at(joint, key_secs), index)
        });
        let came = before.is_none() || response.gained_focus();
        let keys = focused_keys(ui, response, &GRID_KEYS);
        let moved = came || !keys.is_empty();
        for (key, shift) in keys {
            let before = (cursor, index);
            let last = rows.all().len() - 1;
            match key {
                Key::Enter | Key::Space => {
                    self.press_cell(&cursor, cx);
                    continue;
                }
                Key::ArrowUp => index = index.saturating_sub(1),
                Key::ArrowDown => index = (index + 1).min(last),
                Key::PageUp => index = index.saturating_add_signed(-PAGE as isize),
                Key::PageDown => index = (index + PAGE as usize).min(last),
                _ => {}
            }
            rows.merge_folded(
                index..index + 1,
                self.time.session,
                self.time.open,
                self.time.clip_index,
            );
            let row = rows.all()[index];
            let keys = self.keys_of(rows, &row);
            if index == before.1 {
                let name = cursor.key_secs.is_none();
                let joint = row.joint;
                match key {
                    Key::ArrowLeft | Key::ArrowRight if name && row.below > 0 && !shift => {
                        let folded = key == Key::ArrowLeft;
                        if row.folded != folded {
                            cx.push(JointCommand::SetFolded { joint, folded });
                            continue;
                        }
                        if key == Key::ArrowRight {
                            cursor.key_secs = keys.first();
                        }
                    }
                    Key::ArrowLeft => cursor.key_secs = cursor.key_secs.and_then(|secs| keys.before(secs)),
                    Key::ArrowRight => match cursor.key_secs {
                        Some(secs) => cursor.key_secs = keys.after(secs).or(Some(secs)),
                        None => cursor.key_secs = keys.first(),
                    },
                    Key::Home => cursor.key_secs = keys.first(),
                    Key::End => cursor.key_secs = keys.last(),
                    _ => {}
                }
                cursor.wanted_secs = cursor.key_secs;
            } else {
                cursor.joint = row.joint;
                cursor.key_secs = cursor.wanted_secs.and_then(|secs| keys.nearest(secs));
            }
            let corners = [before, (cursor, index)].map(|(cursor, index)| {
                let secs = cursor.key_secs.or(cursor.wanted_secs);
                (secs.unwrap_or(self.time.clip.start_secs), index as f32 + 0.5)
            });
            let joints_of = |row| rows.joints_of(self.time.session, row);
            cx.state.choose_keys((shift, before.0.chooses), corners, joints_of);
            cursor.chooses = shift;
        }
        if moved {
            self.bring_into_view(ui, &cursor, index, top, cx.state);
        }
        cx.state.cursor = Some(cursor);
    }

    fn keys_of<'a>(&'a self, rows: &'a Rows, row: &BoneRow) -> RowKeys<'a> {
        let folded = rows.folded_below(row).map_or(&[][..], |branch| &branch.times_secs);
        RowKeys([self.key_times(row.joint), folded])
    }

    /// Enter on a key goes there; on a name it selects the bone.
    fn press_cell(&self, cursor: &KeyCursor, cx: &mut Cx<'_, TimelineState>) {
        let joint = Some(cursor.joint);
        cx.state.revealed = joint;
        match cursor.key_secs {
            Some(time_secs) => {
                cx.push(JointCommand::Select(joint));
                cx.pause_at(time_secs);
            }
            None => {
                let selected = self.time.session.joints().selected() == joint;
                cx.push(JointCommand::Select(joint.filter(|_| !selected)));
            }
        }
    }

    /// Scrolls to its row, and its key into what is seen of the time.
    fn bring_into_view(&self, ui: &Ui, cursor: &KeyCursor, index: usize, top: f32, state: &mut TimelineState) {
        let y = top + index as f32 * self.row_height;
        let row = Rect::from_x_y_ranges(self.time.whole.x_range(), y..=y + self.row_height);
        ui.scroll_to_rect(row, None);
        if let Some(secs) = cursor.key_secs {
            time_area::bring_into_view(self.time.clip, secs, state);
        }
    }

    /// Draws the cell of a row that has the keyboard, and tells of it. `name`: the cell of the row's name.
    pub(in crate::ui::timeline) fn show_cursor(
        &self,
        ui: &Ui,
        grid: &Response,
        row: &BoneRow,
        name: &Response,
        rows: &Rows,
        state: &TimelineState,
    ) {
        let Some(cursor) = state.cursor.filter(|cursor| cursor.joint == row.joint) else {
            return;
        };
        if !grid.has_focus() {
            return;
        }
        let cell = match cursor.key_secs {
            Some(secs) => {
                let side = self.row_height.min(20.0) - 2.0;
                let center = pos2(self.time.axis.x_of(secs), name.rect.center().y);
                // A cell of its own for each key, so that a screen reader hears of each.
                let id = name.id.with(secs.to_bits());
                let cell = ui.interact(Rect::from_center_size(center, vec2(side, side)), id, Sense::hover());
                cell.widget_info(|| WidgetInfo::labeled(Role::GridCell, true, self.cell_words(rows, row, secs)));
                cell
            }
            None => name.clone(),
        };
        let stroke = Stroke::new(1.5, Tokens::of(ui).accent);
        ui.painter()
            .rect_stroke(cell.rect, CONTROL_RADIUS, stroke, StrokeKind::Inside);
        tell_node(grid, |node| node.set_active_descendant(cell.id.accesskit_id()));
    }

    fn cell_words(&self, rows: &Rows, row: &BoneRow, secs: f32) -> String {
        let name = self.time.session.joint_label(row.joint);
        let times = self.key_times(row.joint);
        let own = times.iter().position(|&key| key == secs);
        let number = match own {
            Some(index) => format!("key {} of {}", index + 1, times.len()),
            None => {
                let folded = rows.folded_below(row).map_or(0, |_| row.below);
                format!("key of {} folded away", counted(folded, "bone"))
            }
        };
        format!("{number}, frame {}, {secs:.2} s, {name}", self.time.clip.frame_at(secs))
    }
}
