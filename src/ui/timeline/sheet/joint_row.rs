//! One row of the dope sheet: a joint's name and its keys.

use std::ops::Range;

use egui::{FontId, Rangef, Rect, RectAlign, Response, Role, Sense, Tooltip, Ui, UiBuilder, WidgetInfo, vec2};

use super::dope_sheet::DopeSheet;
use super::rows::{BoneRow, FoldedBranch, Rows, SeenRow};
use crate::anim::JointActivity;
use crate::model::JointIndex;
use crate::session::{Command, JointCommand};
use crate::ui::cx::Cx;
use crate::ui::kit::theme::Tokens;
use crate::ui::kit::wording::{counted, measured};
use crate::ui::kit::{self, is_touch, paint_fold_mark, paint_list_ground};
use crate::ui::timeline::axis::END_ROOM;
use crate::ui::timeline::marks::{MarkShape, mark_radius};
use crate::ui::timeline::state::TimelineState;

/// Indent of each level of the tree.
const INDENT: f32 = 11.0;
/// A column of names slimmer than this indents less.
const SLIM_NAMES: f32 = 150.0;
/// Size of the marks of folded keys, as a fraction of the row's own.
const FOLDED_SIZE: f32 = 0.85;
/// Opacity of the tint of the row that moves most.
const MOST_TINT: f32 = 0.17;

/// A fraction in per cent.
fn percent(fraction: f32) -> String {
    match fraction * 100.0 {
        small if small > 0.0 && small < 0.5 => "< 1 %".to_owned(),
        percent => format!("{percent:.0} %"),
    }
}

impl DopeSheet<'_> {
    /// Scrolls to the row of a joint that was selected elsewhere.
    pub(in crate::ui::timeline) fn reveal(&self, ui: &Ui, rows: &[BoneRow], top: f32, state: &mut TimelineState) {
        let selected = self.time.session.joints().selected();
        if state.revealed == selected {
            return;
        }
        state.revealed = selected;
        if let Some(index) = rows.iter().position(|row| Some(row.joint) == selected) {
            let y = top + index as f32 * self.row_height;
            let row = Rect::from_x_y_ranges(self.time.whole.x_range(), y..=y + self.row_height);
            ui.scroll_to_rect(row, None);
        }
    }

    /// How far the sheet is scrolled with the row of the selected joint in its middle.
    pub(in crate::ui::timeline) fn offset_of_selected(&self, rows: &[BoneRow], height: f32) -> Option<f32> {
        let selected = self.time.session.joints().selected()?;
        let index = rows.iter().position(|row| row.joint == selected)?;
        let most = (rows.len() as f32 * self.row_height - height).max(0.0);
        let middle = (index as f32 + 0.5) * self.row_height;
        Some((middle - 0.5 * height).clamp(0.0, most))
    }

    /// What a row's tint means, beside the sheet so that it covers no row.
    pub(in crate::ui::timeline) fn row_tooltip(&self, keys: &Response, rows: &Rows, top: f32) {
        let Some(at) = keys.hover_pos().filter(|_| !keys.dragged()) else {
            return;
        };
        if let Some(row) = rows.all().get(((at.y - top) / self.row_height).max(0.0) as usize) {
            self.tooltip(keys, &self.motion_words(row, rows.folded_below(row)));
        }
    }

    fn tooltip(&self, response: &Response, words: &str) {
        let mut tooltip = Tooltip::for_enabled(response);
        let above = Rect::from_min_size(self.time.whole.min, vec2(self.time.whole.width(), 0.0));
        tooltip.popup = tooltip.popup.anchor(above).align(RectAlign::TOP_END);
        tooltip.show(|ui| ui.label(words));
    }

    /// How much the bone of a row moves in the clip, and what that has to do with its tint.
    fn motion_words(&self, row: &BoneRow, folded: Option<&FoldedBranch>) -> String {
        let name = self.time.session.joint_label(row.joint);
        let activity = self.activity_of(row.joint);
        let amounts = [
            (activity.path > 0.0).then(|| format!("moves by {}", measured(activity.path))),
            (activity.turned_degrees >= 0.05).then(|| format!("turns by {:.1}°", activity.turned_degrees)),
            (activity.scaled >= 0.0005).then(|| format!("scales by {:.1} %", activity.scaled * 100.0)),
        ];
        let amounts: Vec<String> = amounts.into_iter().flatten().collect();
        if activity.constant || amounts.is_empty() {
            let below = folded.filter(|branch| branch.most_motion > 0.0);
            let tint = below.map_or(String::new(), |branch| {
                format!(
                    " A bone below it has {} of the most motion, which tints the row.",
                    percent(branch.most_motion)
                )
            });
            return format!("{name} stands still in this clip.{tint}");
        }
        format!(
            "{name} {} in all, relative to its parent: {} of the most motion.\nThe more a bone moves, the stronger its row is tinted.",
            amounts.join(", "),
            percent(activity.fraction),
        )
    }

    fn activity_of(&self, joint: JointIndex) -> JointActivity {
        self.activity.get(joint.index()).copied().unwrap_or_default()
    }

    /// Shows it over the whole of `ui`, and adds its marks to those of the other rows. Returns its name.
    pub(in crate::ui::timeline) fn show_row(
        &self,
        ui: &mut Ui,
        SeenRow { row, folded }: SeenRow<'_>,
        keys: &Response,
        cx: &mut Cx<'_, TimelineState>,
        shape: &mut MarkShape,
    ) -> Response {
        let (tokens, rect) = (Tokens::of(ui), ui.max_rect());
        let name_rect = Rect::from_x_y_ranges(rect.min.x..=self.time.times.min.x - 4.0, rect.y_range());
        let time_rect = Rect::from_x_y_ranges(self.time.times.min.x..=rect.max.x, rect.y_range());
        let activity = self.activity_of(row.joint);
        let fraction = folded.map_or(activity.fraction, |branch| branch.most_motion.max(activity.fraction));
        let tint = MOST_TINT * fraction;
        if tint > 0.0 {
            let tint = tokens.warning.gamma_multiply(tint);
            ui.painter().rect_filled(time_rect, 0.0, tint);
        }
        let pointed = keys.hover_pos().is_some_and(|at| rect.y_range().contains(at.y));
        if pointed {
            cx.state.hovered = Some(row.joint);
        }
        if self.time.session.joints().hovered() == Some(row.joint) {
            ui.painter().rect_filled(time_rect, 0.0, tokens.field);
        }
        let name = self.name_cell(ui, row, folded, name_rect, cx);
        let (key_box, y) = (cx.state.key_box.as_ref(), rect.center().y);
        if let Some(branch) = folded {
            let (times_secs, tree) = (&branch.times_secs, self.time.session.joints().tree());
            let is_below = |below| below != row.joint && tree.is_in_branch(below, row.joint);
            let chosen = key_box.map_or(0..0, |key_box| key_box.part_of_any(is_below, times_secs));
            self.add_marks(times_secs, chosen, (branch.constant, true), y, &tokens, shape);
        }
        let times_secs = self.key_times(row.joint);
        let chosen = key_box.map_or(0..0, |key_box| key_box.part_of(row.joint, times_secs));
        let constant = activity.constant && times_secs.len() > 1;
        self.add_marks(times_secs, chosen, (constant, false), y, &tokens, shape);
        name
    }

    /// The name of a joint, which selects it, and what folds its branch.
    fn name_cell(
        &self,
        ui: &mut Ui,
        row: &BoneRow,
        folded: Option<&FoldedBranch>,
        rect: Rect,
        cx: &mut Cx<'_, TimelineState>,
    ) -> Response {
        let tokens = Tokens::of(ui);
        let id = ui.scope_id().with(("row", row.joint.0));
        // Tab goes to the sheet as a whole, whose arrow keys come here.
        let response = ui.interact(rect, id, Sense::CLICK);
        let joints = self.time.session.joints();
        let selected = joints.selected() == Some(row.joint);
        if response.contains_pointer() && !is_touch(ui) {
            cx.state.hovered = Some(row.joint);
        }
        paint_list_ground(ui, rect, selected, joints.hovered() == Some(row.joint));
        let name = self.time.session.joint_label(row.joint);
        response.widget_info(|| {
            let mut label = format!("{name}, {}", counted(self.key_times(row.joint).len(), "key"));
            if let Some(branch) = folded {
                let bones = counted(row.below, "bone");
                let times = counted(branch.times_secs.len(), "time");
                label += &format!("; folded away: {bones} with keys at {times}");
            }
            if self.by_motion {
                label += &format!(", {} of the most motion", percent(self.activity_of(row.joint).fraction));
            }
            WidgetInfo::labeled(Role::RowHeader, true, label)
        });
        ui.ctx().accesskit_node_builder(id, |node| node.set_selected(selected));
        if row.below > 0 && kit::tell_folds(ui, id, !row.folded) {
            let (joint, folded) = (row.joint, !row.folded);
            cx.push(JointCommand::SetFolded { joint, folded });
        }
        if response.clicked() {
            let joint = (!selected).then_some(row.joint);
            cx.state.revealed = joint;
            cx.push(JointCommand::Select(joint));
        }

        // Deep joints of a slim column keep room for their names.
        let slim = rect.width() < SLIM_NAMES;
        let (indent, deepest) = if slim { (0.5 * INDENT, 0.2) } else { (INDENT, 0.4) };
        let left = rect.min.x + 4.0 + (row.depth as f32 * indent).min(deepest * rect.width());
        let chevron_width = if self.by_motion { 4.0 } else { 16.0 };
        let mut words = kit::Row::of(ui, rect, response);
        words.right -= 6.0;
        let amount = self.by_motion.then(|| percent(self.activity_of(row.joint).fraction));
        if let Some(count) = amount.or_else(|| row.folded.then(|| format!("+{}", row.below))) {
            words.right_in(FontId::proportional(11.0), &count, tokens.faint);
            words.right -= 4.0;
        }
        let color = if selected { tokens.accent } else { tokens.text };
        words.left = left + chevron_width;
        words.name_in(FontId::proportional(12.5), &name, color);
        let response = words.response;
        if row.below > 0 {
            let place = Rect::from_x_y_ranges(left..=left + 16.0, rect.y_range());
            let inside = UiBuilder::new().id_salt("fold").accessibility_parent(id);
            self.fold(&ui.new_child(inside), row, &name, place, cx.commands);
        }
        self.tooltip(&response, &self.motion_words(row, folded));
        response
    }

    fn fold(&self, ui: &Ui, row: &BoneRow, name: &str, place: Rect, commands: &mut Vec<Command>) {
        let tokens = Tokens::of(ui);
        let target = if is_touch(ui) {
            let right = place.max.x.max(self.time.whole.min.x + 44.0);
            Rect::from_x_y_ranges(self.time.whole.min.x..=right, place.y_range())
        } else {
            place
        };
        let response = ui.interact(target, ui.scope_id().with(("fold", row.joint.0)), Sense::CLICK);
        let color = tokens.muted_to_text(response.hovered());
        paint_fold_mark(ui.painter(), place.center(), row.folded, color);
        let verb = if row.folded { "Unfold" } else { "Fold" };
        response.widget_info(|| WidgetInfo::labeled(Role::Button, true, format!("{verb} {name}")));
        if response.clicked() {
            let (joint, folded) = (row.joint, !row.folded);
            commands.push(JointCommand::SetFolded { joint, folded }.into());
        }
    }

    /// Marks of the keys of a row, or a bar where nothing moves, and over them those that are chosen. `folded`: keys of joints folded
    /// below it, hollow and smaller.
    fn add_marks(
        &self,
        times_secs: &[f32],
        chosen: Range<usize>,
        (constant, folded): (bool, bool),
        y: f32,
        tokens: &Tokens,
        shape: &mut MarkShape,
    ) {
        let (Some(&first), Some(&last)) = (times_secs.first(), times_secs.last()) else {
            return;
        };
        let radius = mark_radius(self.time.axis.points_per_sec() / self.time.clip.keys_per_sec);
        let (radius, chosen_radius, color) = if folded {
            let radius = FOLDED_SIZE * radius;
            (radius, radius, tokens.muted.gamma_multiply(0.85))
        } else {
            (radius, radius + 0.6, tokens.muted)
        };
        if constant {
            let seen = self.time.axis.points().expand(END_ROOM);
            let [first, last] = [first, last].map(|secs| seen.clamp(self.time.axis.x_of(secs)));
            shape.bar(Rangef::new(first, last), y, 1.0, tokens.faint.gamma_multiply(0.6));
        }
        let mut add = |times_secs: &[f32], radius, color| match folded {
            true => shape.add_hollow(times_secs, &self.time.axis, y, radius, color),
            false => shape.add(times_secs, &self.time.axis, y, radius, color),
        };
        if !constant {
            add(&times_secs[..chosen.start], radius, color);
            add(&times_secs[chosen.end..], radius, color);
        }
        add(&times_secs[chosen], chosen_radius, tokens.accent);
    }
}
