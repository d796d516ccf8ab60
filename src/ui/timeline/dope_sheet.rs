//! The keys of all joints: a row for each, and only those that are seen.

use egui::{Align2, CursorIcon, FontId, PointerButton, Pos2, Rangef, Rect, Response, Role, ScrollArea, Sense, Stroke};
use egui::{StrokeKind, Ui, UiBuilder, WidgetInfo, pos2, vec2};

use super::super::icons::{self, Icon};
use super::super::theme::{CONTROL_RADIUS, Tokens};
use super::super::widgets::{focus_ring, is_touch, paint_elided, pressed_row_height};
use super::super::wording::counted;
use super::axis::{END_ROOM, TimeAxis};
use super::key_box::KeyBox;
use super::marks::{MarkShape, mark_radius};
use super::rows::Row;
use super::ruler::{self, RULER_HEIGHT};
use super::sheet::split_x;
use super::state::TimelineState;
use super::time_area;
use crate::anim::JointActivity;
use crate::model::{Clip, JointIndex};
use crate::session::{Command, JointCommand, OpenModel, Session};

/// How far from a key a click still means it.
const REACH: f32 = 6.0;
const TOUCH_REACH: f32 = 16.0;
/// Room that a branch begins further to the right than its parent.
const INDENT: f32 = 11.0;
/// A column of names slimmer than this has little room for a tree.
const SLIM_NAMES: f32 = 150.0;
/// Opacity of the tint of the row that moves most.
const MOST_TINT: f32 = 0.17;

/// What the rows have in common.
struct Sheet<'a> {
    session: &'a Session,
    open: &'a OpenModel,
    clip_index: usize,
    clip: &'a Clip,
    activity: &'a [JointActivity],
    axis: TimeAxis,
    area: Rect,
    split: f32,
    row_height: f32,
}

/// Fills what is left of the sheet.
pub(super) fn show(ui: &mut Ui, session: &Session, state: &mut TimelineState, commands: &mut Vec<Command>) {
    let (Some(open), Some(clip_index), Some(clip)) = (session.open_model(), session.clip_index(), session.clip())
    else {
        return;
    };
    let area = ui.available_rect_before_wrap();
    let split = split_x(area);
    let span_secs = state.window.span_secs([clip.start_secs, clip.end_secs]);
    let sheet = Sheet {
        session,
        open,
        clip_index,
        clip,
        activity: open.activity(clip_index).unwrap_or_default(),
        axis: TimeAxis::new(Rangef::new(split, area.max.x), END_ROOM, span_secs),
        area,
        split,
        row_height: pressed_row_height(ui),
    };
    sheet.show(ui, state, commands);
}

impl Sheet<'_> {
    fn show(&self, ui: &mut Ui, state: &mut TimelineState, commands: &mut Vec<Command>) {
        let tokens = Tokens::of(ui);
        let area = self.area;
        let ruler_rect = Rect::from_min_max(
            pos2(self.split, area.min.y),
            pos2(area.max.x, area.min.y + RULER_HEIGHT),
        );
        let time_rect = Rect::from_min_max(ruler_rect.min, area.max);
        ui.painter().rect_filled(time_rect, CONTROL_RADIUS, tokens.field);
        let count = counted(self.open.model.skeleton.joint_count(), "bone");
        let at = pos2(area.min.x + 6.0, ruler_rect.center().y);
        ui.painter()
            .text(at, Align2::LEFT_CENTER, count, FontId::proportional(11.0), tokens.faint);
        self.paint_box_span(ui, state, ruler_rect);
        ruler::paint(ui, self.clip, &self.axis, ruler_rect, area.max.y);
        let response = time_area::ruler(ui, self.session, &self.axis, ruler_rect, commands);
        time_area::navigate(ui, &response, self.clip, &self.axis, state);

        let body = Rect::from_min_max(pos2(area.min.x, ruler_rect.max.y), area.max);
        self.show_rows(ui, body, state, commands);
        let over = ui.painter().clip_rect();
        ui.set_clip_rect(over.intersect(time_rect));
        self.paint_range_ends(ui, ruler_rect);
        time_area::paint_head_below_ruler(ui, self.session, &self.axis, ruler_rect, area.max.y);
        ui.set_clip_rect(over);
    }

    fn show_rows(&self, ui: &mut Ui, body: Rect, state: &mut TimelineState, commands: &mut Vec<Command>) {
        let mut rows = std::mem::take(&mut state.rows);
        let by_motion = rows.by_motion;
        let shown = rows.update(self.session, self.open, self.clip_index);
        let mut ui = ui.new_child(UiBuilder::new().max_rect(body).id_salt("rows"));
        // The scroll bar stands in the panel's margin.
        let with_bar = Rect::from_min_max(body.min, pos2(ui.clip_rect().max.x, body.max.y));
        ui.set_clip_rect(ui.clip_rect().intersect(with_bar));
        ui.spacing_mut().item_spacing.y = 0.0;
        ScrollArea::vertical()
            .id_salt("dope sheet")
            .auto_shrink(false)
            .max_height(body.height())
            .min_scrolled_height(body.height())
            .show_rows(&mut ui, self.row_height, shown.len(), |ui, seen| {
                let top = ui.max_rect().min.y - seen.start as f32 * self.row_height;
                let keys = Rect::from_x_y_ranges(self.split..=body.max.x, body.y_range());
                let response = ui.interact(keys, ui.scope_id().with("keys"), Sense::click_and_drag());
                response.widget_info(|| WidgetInfo::labeled(Role::Image, true, "Keys of all bones"));
                let mut shape = MarkShape::new(ui);
                self.reveal(ui, shown, top, state);
                for row in &shown[seen] {
                    self.show_row(ui, row, by_motion, &response, state, &mut shape, commands);
                }
                shape.paint(&ui.painter().with_clip_rect(keys.intersect(ui.clip_rect())));
                self.press_keys(ui, &response, shown, top, state, commands);
                time_area::navigate(ui, &response, self.clip, &self.axis, state);
                if is_touch(ui) && response.dragged() {
                    ui.scroll_with_delta(vec2(0.0, response.drag_delta().y));
                }
                if !response.dragged() {
                    time_area::paint_pointer(ui, &response, &self.axis, keys.y_range());
                }
            });
        state.rows = rows;
    }

    fn key_times(&self, joint: JointIndex) -> &[f32] {
        self.open.key_times(self.clip_index, Some(joint))
    }

    /// Brings the row of a joint that was selected elsewhere into sight.
    fn reveal(&self, ui: &Ui, rows: &[Row], top: f32, state: &mut TimelineState) {
        let selected = self.session.joints().selected();
        if state.revealed == selected {
            return;
        }
        state.revealed = selected;
        if let Some(index) = rows.iter().position(|row| Some(row.joint) == selected) {
            let y = top + index as f32 * self.row_height;
            let row = Rect::from_x_y_ranges(self.area.x_range(), y..=y + self.row_height);
            ui.scroll_to_rect(row, None);
        }
    }

    #[expect(
        clippy::too_many_arguments,
        reason = "a row reads and tells what a sheet reads and tells"
    )]
    fn show_row(
        &self,
        ui: &mut Ui,
        row: &Row,
        by_motion: bool,
        keys: &Response,
        state: &mut TimelineState,
        shape: &mut MarkShape,
        commands: &mut Vec<Command>,
    ) {
        let tokens = Tokens::of(ui);
        let size = vec2(self.area.width(), self.row_height);
        let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
        let name_rect = Rect::from_x_y_ranges(rect.min.x..=self.split - 4.0, rect.y_range());
        let time_rect = Rect::from_x_y_ranges(self.split..=rect.max.x, rect.y_range());
        let activity = self.activity.get(row.joint.index()).copied().unwrap_or_default();
        let tint = MOST_TINT * activity.share;
        if tint > 0.0 {
            let tint = tokens.warning.gamma_multiply(tint);
            ui.painter().rect_filled(time_rect, 0.0, tint);
        }
        let pointed = keys.hover_pos().is_some_and(|at| rect.y_range().contains(at.y));
        if pointed {
            state.hovered = Some(row.joint);
        }
        if self.session.joints().hovered() == Some(row.joint) {
            ui.painter().rect_filled(time_rect, 0.0, tokens.field);
        }
        self.name_cell(ui, row, by_motion, name_rect, state, commands);
        self.add_marks(row.joint, activity, rect.center().y, state, &tokens, shape);
    }

    /// The name of a joint, which selects it, and what folds its branch.
    fn name_cell(
        &self,
        ui: &Ui,
        row: &Row,
        by_motion: bool,
        rect: Rect,
        state: &mut TimelineState,
        commands: &mut Vec<Command>,
    ) {
        let tokens = Tokens::of(ui);
        let id = ui.scope_id().with(("row", row.joint.0));
        let response = ui.interact(rect, id, Sense::click());
        let joints = self.session.joints();
        let selected = joints.selected() == Some(row.joint);
        if response.contains_pointer() && !is_touch(ui) {
            state.hovered = Some(row.joint);
        }
        if selected {
            ui.painter().rect_filled(rect, CONTROL_RADIUS, tokens.accent_ground);
        } else if joints.hovered() == Some(row.joint) {
            ui.painter().rect_filled(rect, CONTROL_RADIUS, tokens.field_hovered);
        }
        focus_ring(ui, rect, &response);
        let name = self.session.joint_label(row.joint);
        let key_count = counted(self.key_times(row.joint).len(), "key");
        response.widget_info(|| WidgetInfo::selected(Role::ListItem, true, selected, format!("{name}, {key_count}")));
        if response.clicked() {
            let joint = (!selected).then_some(row.joint);
            state.revealed = joint;
            commands.push(JointCommand::Select(joint).into());
        }

        // Deep joints of a slim column keep room for their names.
        let slim = rect.width() < SLIM_NAMES;
        let (indent, deepest) = if slim { (0.5 * INDENT, 0.2) } else { (INDENT, 0.4) };
        let left = rect.min.x + 4.0 + (row.depth as f32 * indent).min(deepest * rect.width());
        let chevron_width = if by_motion { 4.0 } else { 16.0 };
        let mut right = rect.max.x - 6.0;
        if row.folded {
            let at = pos2(right, rect.center().y);
            let count = format!("+{}", row.below);
            let font = FontId::proportional(11.0);
            let drawn = ui.painter().text(at, Align2::RIGHT_CENTER, count, font, tokens.faint);
            right = drawn.min.x - 4.0;
        }
        let color = if selected { tokens.accent } else { tokens.text };
        let at = pos2(left + chevron_width, rect.center().y);
        paint_elided(ui.painter(), at, &name, FontId::proportional(12.5), color, right - at.x);
        if row.below > 0 {
            let place = Rect::from_x_y_ranges(left..=left + 16.0, rect.y_range());
            self.fold(ui, row, &name, place, commands);
        }
    }

    fn fold(&self, ui: &Ui, row: &Row, name: &str, place: Rect, commands: &mut Vec<Command>) {
        let tokens = Tokens::of(ui);
        let target = if is_touch(ui) {
            let right = place.max.x.max(self.area.min.x + 44.0);
            Rect::from_x_y_ranges(self.area.min.x..=right, place.y_range())
        } else {
            place
        };
        let response = ui.interact(target, ui.scope_id().with(("fold", row.joint.0)), Sense::click());
        let icon = if row.folded {
            Icon::ChevronRight
        } else {
            Icon::ChevronDown
        };
        icons::paint(ui.painter(), place, icon, tokens.muted_to_text(response.hovered()));
        let verb = if row.folded { "Unfold" } else { "Fold" };
        response.widget_info(|| WidgetInfo::labeled(Role::Button, true, format!("{verb} {name}")));
        if response.clicked() {
            let (joint, folded) = (row.joint, !row.folded);
            commands.push(JointCommand::SetFolded { joint, folded }.into());
        }
    }

    fn add_marks(
        &self,
        joint: JointIndex,
        activity: JointActivity,
        y: f32,
        state: &TimelineState,
        tokens: &Tokens,
        shape: &mut MarkShape,
    ) {
        let times_secs = self.key_times(joint);
        let (Some(&first), Some(&last)) = (times_secs.first(), times_secs.last()) else {
            return;
        };
        let chosen = state
            .key_box
            .as_ref()
            .map_or(0..0, |key_box| key_box.part_of(joint, times_secs));
        if activity.constant && times_secs.len() > 1 {
            let seen = self.axis.points().expand(END_ROOM);
            let points = Rangef::new(seen.clamp(self.axis.x_of(first)), seen.clamp(self.axis.x_of(last)));
            shape.bar(points, y, 1.0, tokens.faint.gamma_multiply(0.6));
        } else {
            let radius = mark_radius(self.axis.points_per_sec() / self.clip.keys_per_sec);
            shape.add(&times_secs[..chosen.start], &self.axis, y, radius, tokens.muted);
            shape.add(&times_secs[chosen.end..], &self.axis, y, radius, tokens.muted);
        }
        let radius = mark_radius(self.axis.points_per_sec() / self.clip.keys_per_sec) + 0.6;
        shape.add(&times_secs[chosen], &self.axis, y, radius, tokens.accent);
    }

    /// A click goes to a key; a drag draws a box.
    fn press_keys(
        &self,
        ui: &Ui,
        response: &Response,
        rows: &[Row],
        top: f32,
        state: &mut TimelineState,
        commands: &mut Vec<Command>,
    ) {
        let row_at = |at: Pos2| (at.y - top) / self.row_height;
        let corner = |at: Pos2| (self.axis.seen_time_at(at.x), row_at(at));
        let joint_of = |row: usize| rows.get(row).map(|row| row.joint);
        let pointer = response.interact_pointer_pos();
        let boxes = !is_touch(ui);
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
            key_box.stretch(corner(pointer), joint_of);
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
        let key =
            joint_of(row_at(at).max(0.0) as usize).and_then(|joint| Some((joint, self.key_near(ui, joint, at.x)?)));
        if let Some((joint, time_secs)) = key {
            ui.ctx().set_cursor_icon(CursorIcon::PointingHand);
            if response.clicked() {
                state.revealed = Some(joint);
                commands.push(JointCommand::Select(Some(joint)).into());
                commands.push(Command::Seek { time_secs });
            }
        }
        if response.clicked() {
            state.key_box = None;
        }
    }

    /// The key of a joint that is meant by a place.
    fn key_near(&self, ui: &Ui, joint: JointIndex, x: f32) -> Option<f32> {
        let reach = if is_touch(ui) { TOUCH_REACH } else { REACH };
        let times_secs = self.key_times(joint);
        let next = times_secs.partition_point(|&secs| self.axis.x_of(secs) < x);
        let around = &times_secs[next.saturating_sub(1)..times_secs.len().min(next + 1)];
        let away = |secs: &f32| (self.axis.x_of(*secs) - x).abs();
        let nearest = around.iter().min_by(|a, b| away(a).total_cmp(&away(b)))?;
        (away(nearest) <= reach).then_some(*nearest)
    }

    /// The stretch of the box on the ruler.
    fn paint_box_span(&self, ui: &Ui, state: &TimelineState, ruler_rect: Rect) {
        let Some(key_box) = &state.key_box else { return };
        let [start, end] = key_box
            .span_secs
            .map(|secs| self.axis.points().clamp(self.axis.x_of(secs)));
        let band = Rect::from_x_y_ranges(start..=end, ruler_rect.y_range());
        ui.painter().rect_filled(band, 0.0, Tokens::of(ui).accent_ground);
    }

    /// Lines where the range begins and ends.
    fn paint_range_ends(&self, ui: &Ui, ruler_rect: Rect) {
        let Some(range_secs) = self.session.playback().range_secs() else {
            return;
        };
        let color = Tokens::of(ui).accent.gamma_multiply(0.55);
        for secs in range_secs {
            let x = self.axis.x_of(secs);
            if self.axis.points().expand(END_ROOM).contains(x) {
                ui.painter()
                    .vline(x, ruler_rect.min.y..=self.area.max.y, Stroke::new(1.0, color));
            }
        }
    }
}
