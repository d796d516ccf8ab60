//! The keys of all joints, a row for each. Only rows in view are laid out. Clicks and drags over them.

use egui::{
    Align2, CursorIcon, FontId, PointerButton, Pos2, Rect, Response, Role, ScrollArea, Sense, Stroke, StrokeKind, Ui,
    UiBuilder, pos2, vec2,
};

use super::rows::{BoneRow, Rows};
use crate::anim::JointActivity;
use crate::model::JointIndex;
use crate::session::JointCommand;
use crate::ui::cx::Cx;
use crate::ui::kit::theme::Tokens;
use crate::ui::kit::wording::counted;
use crate::ui::kit::{by_finger, is_touch, pressed_row_height};
use crate::ui::timeline::axis::END_ROOM;
use crate::ui::timeline::marks::MarkShape;
use crate::ui::timeline::state::{KeyBox, KeyCursor, TimelineState};
use crate::ui::timeline::time_area::{self, TimeArea};

/// How far from a key a click still hits it.
const REACH: f32 = 6.0;
const TOUCH_REACH: f32 = 16.0;

/// What all rows share.
pub(in crate::ui::timeline) struct DopeSheet<'a> {
    pub(in crate::ui::timeline) time: TimeArea<'a>,
    pub(in crate::ui::timeline) activity: &'a [JointActivity],
    pub(in crate::ui::timeline) row_height: f32,
    /// Rows are sorted by motion: a flat list, so nothing folds.
    pub(in crate::ui::timeline) by_motion: bool,
}

/// The dope sheet. Fills the rest of the sheet.
pub(in crate::ui::timeline) fn show(ui: &mut Ui, cx: &mut Cx<'_, TimelineState>) {
    let Some(time) = TimeArea::new(ui, cx) else { return };
    let sheet = DopeSheet {
        activity: time.open.activity(time.clip_index).unwrap_or_default(),
        time,
        row_height: pressed_row_height(ui),
        by_motion: cx.state.rows.by_motion,
    };
    sheet.show(ui, cx);
}

impl DopeSheet<'_> {
    fn show(&self, ui: &mut Ui, cx: &mut Cx<'_, TimelineState>) {
        let TimeArea {
            whole, times, ruler, ..
        } = self.time;
        self.show_heading(ui);
        if let Some(key_box) = &cx.state.key_box {
            self.time.paint_chosen(ui, key_box);
        }
        self.time.paint_ruler(ui);
        let response = self.time.show_ruler(ui, cx);
        time_area::navigate(ui, &response, self.time.clip, &self.time.axis, cx.state, false);

        let body = whole.with_min_y(ruler.max.y);
        self.show_rows(ui, body, cx);
        let over = ui.painter().clip_rect();
        ui.set_clip_rect(over.intersect(times));
        self.paint_range_ends(ui);
        self.time.paint_head(ui);
        ui.set_clip_rect(over);
    }

    /// The heading of the column of names: how many bones there are.
    fn show_heading(&self, ui: &Ui) {
        let count = counted(self.time.open.model.skeleton.joint_count(), "bone");
        let at = pos2(self.time.whole.min.x + 6.0, self.time.ruler.center().y);
        let (font, color) = (FontId::proportional(11.0), Tokens::of(ui).faint);
        ui.painter().text(at, Align2::LEFT_CENTER, count, font, color);
    }

    fn show_rows(&self, ui: &mut Ui, body: Rect, cx: &mut Cx<'_, TimelineState>) {
        let mut rows = std::mem::take(&mut cx.state.rows);
        rows.update(self.time.session, self.time.open, self.time.clip_index);
        let count = rows.all().len();
        let mut ui = ui.new_child(UiBuilder::new().max_rect(body).id_salt("rows"));
        // The scroll bar stands in the panel's margin.
        let with_bar = Rect::from_min_max(body.min, pos2(ui.clip_rect().max.x, body.max.y));
        ui.set_clip_rect(ui.clip_rect().intersect(with_bar));
        ui.spacing_mut().item_spacing.y = 0.0;
        let mut area = ScrollArea::vertical()
            .id_salt("dope sheet")
            .auto_shrink(false)
            .max_height(body.height())
            .min_scrolled_height(body.height());
        if cx.state.keys_open(ui.ctx().cumulative_frame_nr())
            && let Some(offset) = self.offset_of_selected(rows.all(), body.height())
        {
            // At once, so that no other rows are seen before.
            area = area.vertical_scroll_offset(offset);
            cx.state.revealed = self.time.session.joints().selected();
        }
        area.show_rows(&mut ui, self.row_height, count, |ui, seen| {
            rows.merge_folded(seen.clone(), self.time.session, self.time.open, self.time.clip_index);
            let top = ui.max_rect().min.y - seen.start as f32 * self.row_height;
            let keys = Rect::from_x_y_ranges(self.time.times.min.x..=body.max.x, body.y_range());
            let response = ui.interact(keys, ui.scope_id().with("keys"), Sense::click_and_drag());
            self.tell_grid(&response, count);
            let mut shape = MarkShape::new(ui);
            self.reveal(ui, rows.all(), top, cx.state);
            self.on_keyboard(ui, &response, &mut rows, top, cx);
            for (index, row) in seen.clone().zip(rows.seen(seen)) {
                let size = vec2(self.time.whole.width(), self.row_height);
                let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
                let place = UiBuilder::new().max_rect(rect).id_salt(("row", row.row.joint.0));
                let mut ui = ui.new_child(place.accessibility_parent(response.id).accessibility_role(Role::Row));
                ui.ctx()
                    .accesskit_node_builder(ui.unique_id(), |node| node.set_row_index(index));
                let name = self.show_row(&mut ui, row, &response, cx, &mut shape);
                self.show_cursor(&ui, &response, row.row, &name, &rows, cx.state);
            }
            shape.paint(&ui.painter().with_clip_rect(keys.intersect(ui.clip_rect())));
            self.on_pointer(ui, &response, &rows, top, cx);
            time_area::navigate(ui, &response, self.time.clip, &self.time.axis, cx.state, true);
            if by_finger(ui) && response.dragged() {
                ui.scroll_with_delta(vec2(0.0, response.drag_delta().y));
            }
            self.row_tooltip(&response, &rows, top);
            if !response.dragged() {
                time_area::paint_pointer(ui, &response, &self.time.axis, keys.y_range());
            }
        });
        cx.state.rows = rows;
    }

    pub(in crate::ui::timeline) fn key_times(&self, joint: JointIndex) -> &[f32] {
        self.time.open.key_times(self.time.clip_index, Some(joint))
    }

    /// Lines where the range begins and ends.
    fn paint_range_ends(&self, ui: &Ui) {
        let Some(range_secs) = self.time.session.playback().range_secs() else {
            return;
        };
        let color = Tokens::of(ui).accent.gamma_multiply(0.55);
        for secs in range_secs {
            let x = self.time.axis.x_of(secs);
            if self.time.axis.points().expand(END_ROOM).contains(x) {
                ui.painter()
                    .vline(x, self.time.times.y_range(), Stroke::new(1.0, color));
            }
        }
    }
}

impl DopeSheet<'_> {
    /// A click goes to a key; a drag draws a box.
    fn on_pointer(&self, ui: &Ui, response: &Response, rows: &Rows, top: f32, cx: &mut Cx<'_, TimelineState>) {
        let row_at = |at: Pos2| (at.y - top) / self.row_height;
        let corner = |at: Pos2| (self.time.axis.seen_time_at(at.x), row_at(at));
        let pointer = response.interact_pointer_pos();
        let boxes = !by_finger(ui);
        if response.drag_started_by(PointerButton::Primary)
            && boxes
            && let Some(origin) = ui.input(|input| input.pointer.press_origin())
        {
            cx.state.key_box = Some(KeyBox::at(corner(origin)));
        }
        if response.dragged_by(PointerButton::Primary)
            && let (true, Some(pointer), Some(key_box)) = (boxes, pointer, &mut cx.state.key_box)
        {
            let pointer = pointer.clamp(response.rect.min, response.rect.max);
            key_box.stretch(corner(pointer), |row| rows.joints_of(self.time.session, row));
            let from = pos2(
                self.time.axis.x_of(key_box.from.0),
                top + key_box.from.1 * self.row_height,
            );
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
        // Enter and Space click too, wherever the pointer is.
        let clicked = response.clicked_by(PointerButton::Primary);
        if let Some((joint, time_secs)) = key {
            ui.ctx().set_cursor_icon(CursorIcon::PointingHand);
            if clicked {
                cx.state.revealed = Some(joint);
                cx.state.cursor = Some(KeyCursor::at(joint, Some(time_secs)));
                cx.push(JointCommand::Select(Some(joint)));
                cx.pause_at(time_secs);
            }
        }
        if clicked {
            cx.state.key_box = None;
        }
    }

    /// The key of a row near an x: of the joint, or of a joint folded below it.
    fn key_near(&self, ui: &Ui, rows: &Rows, row: &BoneRow, x: f32) -> Option<f32> {
        let reach = if is_touch(ui) { TOUCH_REACH } else { REACH };
        let folded = rows.folded_below(row).map_or(&[][..], |branch| &branch.times_secs);
        let nearest = [self.key_times(row.joint), folded].map(|times_secs| self.nearest_key(times_secs, x));
        let away = |secs: &f32| (self.time.axis.x_of(*secs) - x).abs();
        // Of two keys equally near, `min_by` takes the first, the joint's own.
        let nearest = nearest
            .into_iter()
            .flatten()
            .min_by(|a, b| away(a).total_cmp(&away(b)))?;
        (away(&nearest) <= reach).then_some(nearest)
    }

    fn nearest_key(&self, times_secs: &[f32], x: f32) -> Option<f32> {
        let next = times_secs.partition_point(|&secs| self.time.axis.x_of(secs) < x);
        let around = &times_secs[next.saturating_sub(1)..times_secs.len().min(next + 1)];
        let away = |secs: &f32| (self.time.axis.x_of(*secs) - x).abs();
        around.iter().copied().min_by(|a, b| away(a).total_cmp(&away(b)))
    }
}
