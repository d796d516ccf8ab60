//! The tree of joints: searched, folded, named. Only the rows in view are laid out.

use egui::{EventFilter, Key, Popup, Rect, ScrollArea, TextEdit, Ui, WidgetInfo, pos2, vec2};

use super::SkeletonState;
use super::names;
use super::tree_row::{self, TreeRow};
use crate::model::JointIndex;
use crate::session::{Command, JointCommand, JointRow, Session};
use crate::ui::icons::Icon;
use crate::ui::theme::Tokens;
use crate::ui::widgets::{control_size, icon_button, menu_item, pressed_row_height};

/// Rows that stay in view even in the lowest window.
const LEAST_ROWS: f32 = 4.0;
/// Between the search and the rows.
const GAP: f32 = 8.0;

/// What of the tree is shown.
#[derive(Debug, Default)]
pub(super) struct TreeState {
    query: String,
    rows: Vec<JointRow>,
    /// The selected joint that was scrolled to.
    shown: Option<JointIndex>,
}

impl TreeState {
    /// Shows a joint that the search may have left out, and scrolls to it.
    pub(super) fn reveal(&mut self, joint: JointIndex) {
        if !self.rows.iter().any(|row| row.joint == joint) {
            self.query.clear();
        }
        self.shown = None;
    }

    /// Shows the whole tree, and scrolls to the selected joint anew.
    pub(super) fn reset(&mut self) {
        self.query.clear();
        self.shown = None;
    }

    /// Does not scroll to a joint that is selected by its own row.
    pub(super) fn select_in_place(&mut self, joint: JointIndex) {
        self.shown = Some(joint);
    }

    /// The place of the selected joint among the rows, once after it was selected.
    fn row_to_show(&mut self, selected: Option<JointIndex>) -> Option<usize> {
        if self.shown == selected {
            return None;
        }
        self.shown = selected;
        self.rows.iter().position(|row| Some(row.joint) == selected)
    }
}

/// The page's contents, `room` high at most.
pub(in crate::ui) fn show(
    ui: &mut Ui,
    session: &Session,
    state: &mut SkeletonState,
    room: f32,
    commands: &mut Vec<Command>,
) {
    if state.naming.proposing {
        names::show_proposals(ui, session, &mut state.naming, room, commands);
        return;
    }
    let top = ui.cursor().min.y;
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
    let most = (room - (ui.cursor().min.y - top)).max(LEAST_ROWS * height);
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
                // With the neighbours, so that it is seen where the row stands.
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
        .char_limit(64)
        .margin(vec2(8.0, 6.0))
        .min_size(vec2(0.0, control_size(ui)))
        .align(egui::Align2::LEFT_CENTER)
        .desired_width(width);
    let response = ui.add(field);
    response.widget_info(|| WidgetInfo::labeled(egui::Role::TextInput, true, "Search bones"));
    // Esc takes the words away, and nothing else.
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
            commands.push(JointCommand::ClearNames.into());
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

/// Arrow keys in a row that has the keyboard: up and down select a neighbour, left and right fold and unfold.
fn walk(ui: &Ui, rows: &[JointRow], place: usize, commands: &mut Vec<Command>) {
    let filter = EventFilter {
        horizontal_arrows: true,
        vertical_arrows: true,
        ..EventFilter::default()
    };
    let row = &rows[place];
    ui.memory_mut(|memory| memory.set_focus_lock_filter(tree_row::id(ui, row.joint), filter));
    let pressed = |key| ui.input_mut(|input| input.consume_key(egui::Modifiers::NONE, key));
    let to = match (pressed(Key::ArrowUp), pressed(Key::ArrowDown)) {
        (true, false) => place.checked_sub(1),
        (false, true) => Some(place + 1),
        _ => None,
    };
    if let Some(row) = to.and_then(|to| rows.get(to)) {
        commands.push(JointCommand::Select(Some(row.joint)).into());
        ui.memory_mut(|memory| memory.request_focus(tree_row::id(ui, row.joint)));
    }
    for (key, folded) in [(Key::ArrowLeft, true), (Key::ArrowRight, false)] {
        if pressed(key) && row.has_children {
            let joint = row.joint;
            commands.push(JointCommand::SetFolded { joint, folded }.into());
        }
    }
}
