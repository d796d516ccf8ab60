//! One joint of the tree.

use egui::{Align2, Color32, FontId, Id, Rect, Response, Role, Sense, Ui, WidgetInfo, pos2, vec2};

use super::{SkeletonState, names};
use crate::model::JointIndex;
use crate::session::{Command, JointCommand, JointRow, Session};
use crate::ui::theme::{self, CONTROL_RADIUS, Tokens};
use crate::ui::widgets::{focus_ring, is_touch, paint_elided, paint_fold_mark, pressed_row_height};
use crate::ui::wording::grouped;

/// Width of a digit of the column of numbers.
const DIGIT_WIDTH: f32 = 6.7;
/// Each branch begins this much further right …
const INDENT: f32 = 9.0;
/// … down to this depth: what hangs deeper stands below each other, so that names keep their room.
const DEEPEST: u32 = 10;
/// Width of the chevron where a mouse is the pointer.
const CHEVRON_WIDTH: f32 = 16.0;

/// What the row of a joint is known by, wherever it stands.
pub(super) fn id(ui: &Ui, joint: JointIndex) -> Id {
    // Apart from the rows' scroll area, which has another name each time that it is laid out.
    Id::unique("joint row").with((ui.layer_id(), joint.0))
}

/// What a row shows.
pub(super) struct TreeRow<'a> {
    row: &'a JointRow,
    label: String,
    named: bool,
    selected: bool,
    hovered: bool,
    /// The joint's colour on the skin, if it has one.
    color: Option<Color32>,
}

impl<'a> TreeRow<'a> {
    pub(super) fn new(session: &Session, state: &SkeletonState, row: &'a JointRow) -> Self {
        let color = state.reading.colors_srgb.get(row.joint.index());
        Self {
            row,
            label: session.joint_label(row.joint),
            named: session.joint_names().get(row.bone).is_some(),
            selected: session.joints().selected() == Some(row.joint),
            hovered: session.joints().hovered() == Some(row.joint),
            color: color.map(|&[red, green, blue, _]| Color32::from_rgb(red, green, blue)),
        }
    }

    pub(super) fn show(
        &self,
        ui: &mut Ui,
        session: &Session,
        state: &mut SkeletonState,
        commands: &mut Vec<Command>,
    ) -> Response {
        let tokens = Tokens::of(ui);
        let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), pressed_row_height(ui)), Sense::hover());
        let joint = self.row.joint;
        let response = ui.interact(rect, id(ui, joint), Sense::click());
        let around = rect.expand2(vec2(6.0, 0.0));
        let over = response.contains_pointer() && !is_touch(ui);
        if self.selected {
            ui.painter().rect_filled(around, CONTROL_RADIUS, tokens.accent_ground);
        } else if over || self.hovered {
            ui.painter().rect_filled(around, CONTROL_RADIUS, tokens.field);
        }
        focus_ring(ui, around, &response);
        if over {
            state.hovered = Some(joint);
        }

        let digits = session.joints().count().to_string().len() as f32;
        let number_at = pos2(rect.min.x + digits * DIGIT_WIDTH, rect.center().y);
        let number = self.row.bone.to_string();
        ui.painter()
            .text(number_at, Align2::RIGHT_CENTER, number, theme::mono(11.0), tokens.faint);
        let left = number_at.x + 3.0 + INDENT * self.row.depth.min(DEEPEST) as f32;
        let folds = self.show_chevron(ui, &response, pos2(left, rect.center().y), commands);
        let mut at = pos2(left + CHEVRON_WIDTH, rect.center().y);
        if state.naming.of == Some(joint) {
            let field = Rect::from_min_max(pos2(at.x - 4.0, rect.min.y), pos2(rect.max.x + 4.0, rect.max.y));
            names::show_field(ui, &mut state.naming, field, commands);
            return response;
        }
        if let Some(color) = self.color {
            ui.painter().circle_filled(at + vec2(4.0, 0.0), 4.0, color);
            at.x += 13.0;
        }
        let right = self.show_count(ui, rect);
        let color = match (self.selected, self.named || self.row.found) {
            (true, _) => tokens.accent,
            (false, true) => tokens.text,
            (false, false) => tokens.muted,
        };
        let room = right - 6.0 - at.x;
        paint_elided(ui.painter(), at, &self.label, FontId::proportional(13.0), color, room);
        let vertices = counted_vertices(self.row.own_vertices);
        let reader = format!("{}, {vertices}", self.label);
        response.widget_info(|| WidgetInfo::selected(Role::TreeItem, true, self.selected, &reader));

        // A double click soon after another click counts as a triple one, wherever that was.
        if response.double_clicked() || response.triple_clicked() {
            state.naming.begin(ui, session, joint);
        } else if response.clicked() && !folds {
            commands.push(JointCommand::Select(Some(joint)).into());
            // It is in view where it was clicked.
            state.tree.select_in_place(joint);
        }
        let below = counted_vertices(self.row.branch_vertices);
        let branch = if self.row.has_children {
            format!("\nWith its branch {below}")
        } else {
            String::new()
        };
        response.on_hover_text(format!(
            "{} (number {} in the file)\nMoves {vertices}{branch}",
            self.label, self.row.bone
        ))
    }

    /// The mark before a joint from which others hang. Whether it was clicked.
    fn show_chevron(&self, ui: &Ui, row: &Response, left: egui::Pos2, commands: &mut Vec<Command>) -> bool {
        if !self.row.has_children {
            return false;
        }
        let width = if is_touch(ui) { row.rect.height() } else { CHEVRON_WIDTH };
        // A finger reaches to the left of it, where the number is.
        let place = Rect::from_min_max(
            pos2(left.x + CHEVRON_WIDTH - width, row.rect.min.y),
            pos2(left.x + CHEVRON_WIDTH - 1.0, row.rect.max.y),
        );
        let response = ui.interact(place, row.id.with("fold"), Sense::click());
        let color = Tokens::of(ui).muted_to_text(response.hovered() || response.has_focus());
        let center = left + vec2(CHEVRON_WIDTH * 0.5 - 1.0, 0.0);
        paint_fold_mark(ui.painter(), center, self.row.folded, color);
        let verb = if self.row.folded { "Unfold" } else { "Fold" };
        let label = format!("{verb} {}", self.label);
        response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &label));
        if response.clicked() {
            let (joint, folded) = (self.row.joint, !self.row.folded);
            commands.push(JointCommand::SetFolded { joint, folded }.into());
        }
        response.clicked()
    }

    /// Vertices at the right end; of a folded branch all. Where the words begin.
    fn show_count(&self, ui: &Ui, rect: Rect) -> f32 {
        let count = if self.row.folded {
            self.row.branch_vertices
        } else {
            self.row.own_vertices
        };
        let text = if count == 0 {
            "–".to_owned()
        } else {
            grouped(count as usize)
        };
        let (font, color) = (FontId::proportional(11.5), Tokens::of(ui).faint);
        let drawn = ui
            .painter()
            .text(rect.right_center(), Align2::RIGHT_CENTER, text, font, color);
        drawn.min.x
    }
}

/// `1 vertex`, `945 vertices`.
pub(super) fn counted_vertices(count: u32) -> String {
    match count {
        1 => "1 vertex".to_owned(),
        count => format!("{} vertices", grouped(count as usize)),
    }
}
