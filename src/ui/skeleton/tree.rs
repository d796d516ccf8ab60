//! The tree of joints: searched, folded, named. Only the rows in view are laid out.

use egui::{
    Align2, Color32, EventFilter, FontId, Id, Key, Popup, Rect, Response, Role, ScrollArea, Sense, TextEdit, Ui,
    WidgetInfo, pos2, vec2,
};

use super::naming::{show_field, show_proposals};
use super::state::{SidePage, SkeletonState};
use crate::model::JointIndex;
use crate::session::{Command, JointCommand, JointRow, NameCommand, Session};
use crate::ui::icons::Icon;
use crate::ui::theme::{self, Tokens};
use crate::ui::widgets::{
    control_size, icon_button, is_touch, menu_item, paint_elided, paint_fold_mark, paint_row_ground,
    pressed_row_height, segmented,
};
use crate::ui::wording::{counted_vertices, grouped};

/// The heading of the side panel: a switch between its pages.
pub(in crate::ui) fn show_pages(ui: &mut Ui, state: &mut SkeletonState) {
    let pages = [(SidePage::Model, "Model"), (SidePage::Skeleton, "Skeleton")];
    if let Some(page) = segmented(ui, "Panel", &pages, Some(state.page)) {
        state.page = page;
    }
}

/// The fewest rows in view, however low the window is.
const LEAST_ROWS: f32 = 4.0;
/// Gap between the search and the rows.
const GAP: f32 = 8.0;

/// The page's contents, no higher than what is available.
pub(in crate::ui) fn show(ui: &mut Ui, session: &Session, state: &mut SkeletonState, commands: &mut Vec<Command>) {
    if state.naming.proposing {
        show_proposals(ui, session, &mut state.naming, commands);
        return;
    }
    ui.horizontal(|ui| {
        search(ui, &mut state.tree.query);
        menu(ui, session, state, commands);
    });
    ui.add_space(GAP);
    session.joint_rows(&state.tree.query, &mut state.tree.rows);
    if state.tree.rows.is_empty() {
        ui.label(egui::RichText::new("No bone has this number or name.").color(Tokens::of(ui).muted));
        return;
    }
    let height = pressed_row_height(ui);
    let most = ui.available_height().max(LEAST_ROWS * height);
    let to_show = state.tree.row_to_show(session.joints().selected());
    let rows = std::mem::take(&mut state.tree.rows);
    ScrollArea::vertical()
        .id_salt("joints")
        .max_height(most)
        .min_scrolled_height(most)
        .auto_shrink([false, true])
        .show_rows(ui, height, rows.len(), |ui, range| {
            if let Some(place) = to_show {
                let top = ui.cursor().min.y + (place as f32 - range.start as f32) * height;
                let row = Rect::from_min_size(pos2(ui.cursor().min.x, top), vec2(1.0, height));
                // Two neighbours on each side come into view too.
                ui.scroll_to_rect(row.expand2(vec2(0.0, 2.0 * height)), None);
            }
            for (place, row) in range.clone().zip(&rows[range]) {
                let response = TreeRow::new(session, state, row).show(ui, session, state, commands);
                if response.has_focus() {
                    walk(ui, &rows, place, commands);
                }
            }
        });
    state.tree.rows = rows;
}

fn search(ui: &mut Ui, query: &mut String) {
    let width = ui.available_width() - control_size(ui) - ui.spacing().item_spacing.x;
    let field = TextEdit::singleline(query)
        .id_salt("search")
        .hint_text("Number or name")
        .text_color(Tokens::of(ui).text)
        .char_limit(64)
        .margin(vec2(8.0, 6.0))
        .min_size(vec2(0.0, control_size(ui)))
        .align(Align2::LEFT_CENTER)
        .desired_width(width);
    let response = ui.add(field);
    response.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, "Search bones"));
    // Esc clears the search and does nothing else.
    if response.lost_focus() && ui.input_mut(|input| input.consume_key(egui::Modifiers::NONE, Key::Escape)) {
        query.clear();
    }
}

fn menu(ui: &mut Ui, session: &Session, state: &mut SkeletonState, commands: &mut Vec<Command>) {
    let dots = icon_button(ui, Icon::Dots, "Names and branches", false);
    Popup::menu(&dots).show(|ui| {
        ui.set_width(206.0);
        let mut chosen = true;
        if menu_item(ui, "Propose mirrored names…", false).clicked() {
            state.naming.proposing = true;
        } else if !session.joint_names().is_empty() && menu_item(ui, "Clear names", false).clicked() {
            commands.push(NameCommand::Clear.into());
        } else if menu_item(ui, "Fold all", false).clicked() {
            commands.push(JointCommand::SetAllFolded(true).into());
        } else if menu_item(ui, "Unfold all", false).clicked() {
            commands.push(JointCommand::SetAllFolded(false).into());
        } else {
            chosen = false;
        }
        if chosen {
            ui.close();
        }
    });
}

/// Arrow keys in a focused row: up and down select a neighbour, left and right fold and unfold.
fn walk(ui: &Ui, rows: &[JointRow], place: usize, commands: &mut Vec<Command>) {
    let filter = EventFilter {
        horizontal_arrows: true,
        vertical_arrows: true,
        ..EventFilter::default()
    };
    let row = &rows[place];
    ui.memory_mut(|memory| memory.set_focus_lock_filter(row_id(ui, row.joint), filter));
    let pressed = |key| ui.input_mut(|input| input.consume_key(egui::Modifiers::NONE, key));
    let to = match (pressed(Key::ArrowUp), pressed(Key::ArrowDown)) {
        (true, false) => place.checked_sub(1),
        (false, true) => Some(place + 1),
        _ => None,
    };
    if let Some(row) = to.and_then(|to| rows.get(to)) {
        commands.push(JointCommand::Select(Some(row.joint)).into());
        ui.memory_mut(|memory| memory.request_focus(row_id(ui, row.joint)));
    }
    for (key, folded) in [(Key::ArrowLeft, true), (Key::ArrowRight, false)] {
        if pressed(key) && row.has_children {
            let joint = row.joint;
            commands.push(JointCommand::SetFolded { joint, folded }.into());
        }
    }
}

/// Width of a digit of the column of numbers.
const DIGIT_WIDTH: f32 = 6.7;
/// Indent of each level …
const INDENT: f32 = 9.0;
/// … down to this depth. Deeper levels are not indented further, so that names keep their room.
const DEEPEST: u32 = 10;
/// Width of the chevron where a mouse is the pointer.
const CHEVRON_WIDTH: f32 = 16.0;

/// The id of a joint's row, wherever the row is.
fn row_id(ui: &Ui, joint: JointIndex) -> Id {
    // It does not depend on the scroll area's id, which changes.
    Id::unique("joint row").with((ui.layer_id(), joint.0))
}

/// What a row shows.
struct TreeRow<'a> {
    row: &'a JointRow,
    label: String,
    named: bool,
    selected: bool,
    hovered: bool,
    /// The joint's colour on the skin, if it has one.
    color: Option<Color32>,
}

impl<'a> TreeRow<'a> {
    fn new(session: &Session, state: &SkeletonState, row: &'a JointRow) -> Self {
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

    fn show(&self, ui: &mut Ui, session: &Session, state: &mut SkeletonState, commands: &mut Vec<Command>) -> Response {
        let tokens = Tokens::of(ui);
        let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), pressed_row_height(ui)), Sense::hover());
        let joint = self.row.joint;
        let response = ui.interact(rect, row_id(ui, joint), Sense::click());
        let over = response.contains_pointer() && !is_touch(ui);
        paint_row_ground(ui, rect, &response, self.selected, over || self.hovered);
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
            show_field(ui, &mut state.naming, field, commands);
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

        // egui counts a double click soon after any other click as a triple click.
        if response.double_clicked() || response.triple_clicked() {
            state.naming.begin(ui, session, joint);
        } else if response.clicked() && !folds {
            commands.push(JointCommand::Select(Some(joint)).into());
            // The row is in view, since it was clicked.
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

    /// The mark before a joint with children. Returns whether it was clicked.
    fn show_chevron(&self, ui: &Ui, row: &Response, left: egui::Pos2, commands: &mut Vec<Command>) -> bool {
        if !self.row.has_children {
            return false;
        }
        let width = if is_touch(ui) { row.rect.height() } else { CHEVRON_WIDTH };
        // By touch its target reaches to the left, over the number.
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

    /// The count of vertices at the right end (of the whole branch if folded). Returns its left edge.
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
