//! The tree of joints: searched, folded, named. Only the rows in view are laid out.

use egui::accesskit::HasPopup;
use egui::{
    Align2, Color32, Event, FontId, Id, Key, Popup, Pos2, Rangef, Rect, Response, Role, ScrollArea, Sense, Stroke, Ui,
    UiBuilder, WidgetInfo, pos2, vec2,
};

use super::naming::{show_field, show_proposals};
use super::state::{SkeletonState, TreeState, Typed};
use crate::actions::Control;
use crate::model::JointIndex;
use crate::session::{Command, JointCommand, JointRow, NameCommand, Session};
use crate::ui::cx::Cx;
use crate::ui::kit::icons::Icon;
use crate::ui::kit::theme::{self, Tokens};
use crate::ui::kit::wording::{counted_vertices, grouped};
use crate::ui::kit::{
    DrawnRows, MenuLine, control_size, focus_row, is_touch, labelled, menu_item, paint_fold_mark, paint_name,
    paint_row_ground, pressed_row_height, push_button, retain_plain_keys, row_sense, search_field, tell_folds,
    tell_node, tell_popup, tell_row, walked,
};

/// The fewest rows in view, however low the window is.
const LEAST_ROWS: f32 = 4.0;
/// Gap between the search and the rows.
const GAP: f32 = 8.0;

/// The page's contents, no higher than what is available.
pub(in crate::ui) fn show(ui: &mut Ui, cx: &mut Cx<'_, SkeletonState>) {
    if cx.state.naming.proposing {
        show_proposals(ui, &mut cx.part(|state| &mut state.naming));
        return;
    }
    ui.horizontal(|ui| {
        let width = ui.available_width() - control_size(ui) - ui.spacing().item_spacing.x;
        let query = &mut cx.state.tree.query;
        search_field(ui, "Search bones", "Number or name", width, query);
        menu(ui, cx);
    });
    ui.add_space(GAP);
    cx.session.joint_rows(&cx.state.tree.query, &mut cx.state.tree.rows);
    if cx.state.tree.rows.is_empty() {
        ui.label(egui::RichText::new("No bone has this number or name.").color(Tokens::of(ui).muted));
        return;
    }
    let height = pressed_row_height(ui);
    let most = ui.available_height().max(LEAST_ROWS * height);
    if cx.state.tree.room.replace(most) != Some(most) {
        // What was in view may not be any more.
        cx.state.tree.shown = None;
    }
    let to_show = cx.state.tree.row_to_show(cx.session.joints().selected());
    let rows = std::mem::take(&mut cx.state.tree.rows);
    ScrollArea::vertical()
        .id_salt("joints")
        .max_height(most)
        .min_scrolled_height(most)
        .auto_shrink([false, true])
        .show_rows(ui, height, rows.len(), |ui, range| {
            labelled(ui, Role::Tree, "Bones", rows.len(), |ui| {
                let stop = cx.state.tree.stop(&rows, cx.session.joints().selected());
                let stop = (stop, row_id(ui, rows[stop].joint));
                let drawn = DrawnRows::new(ui, range, height, stop);
                let first = drawn.rect_of(0);
                if let Some(place) = to_show {
                    // Two neighbours on each side come into view too.
                    let rows = drawn.rect_of(place).expand2(vec2(0.0, 2.0 * height));
                    ui.scroll_to_rect(rows.intersect(Rect::everything_below(first.min.y)), None);
                }
                let indent = Indent::new(ui, cx.session, first.x_range());
                let mut walks_to = None;
                for place in drawn.in_view.clone().chain(drawn.out_of_view) {
                    let row = TreeRow::new(cx.session, cx.state, &rows[place], place, place == drawn.tab_stop);
                    let response = row.show(ui, drawn.rect_of(place), &indent, cx);
                    let to = row.walk(ui, &response, (&rows, drawn.page), cx);
                    walks_to = walks_to.or(to);
                    if response.gained_focus() {
                        ui.scroll_to_rect(response.rect, None);
                    }
                }
                // Only now: a row that is no stop yet would lose the focus when it is drawn.
                if let Some(to) = walks_to {
                    let joint = rows[to].joint;
                    cx.state.tree.stop = Some(joint);
                    focus_row(ui, row_id(ui, joint), drawn.rect_of(to));
                }
            });
        });
    cx.state.tree.rows = rows;
}

fn menu(ui: &mut Ui, cx: &mut Cx<'_, SkeletonState>) {
    let dots = push_button(ui, Icon::Dots, "Names and branches");
    let name = tell_popup(ui, &dots, HasPopup::Menu);
    Popup::menu(&dots).accessible_name(name).show(|ui| {
        ui.set_width(206.0);
        let mut chosen = true;
        if menu_item(ui, "Propose mirrored names…", MenuLine::Action).clicked() {
            cx.state.naming.proposing = true;
        } else if !cx.session.joint_names().is_empty() && menu_item(ui, "Clear names", MenuLine::Action).clicked() {
            cx.push(NameCommand::Clear);
        } else if menu_item(ui, "Fold all", MenuLine::Action).clicked() {
            cx.push(JointCommand::SetAllFolded(true));
        } else if menu_item(ui, "Unfold all", MenuLine::Action).clicked() {
            cx.push(JointCommand::SetAllFolded(false));
        } else {
            chosen = false;
        }
        if chosen {
            ui.close();
        }
    });
}

/// Width of a digit of the column of numbers.
const DIGIT_WIDTH: f32 = 6.7;
/// Indent of each level, unless the tree is so deep that its names would have less than half of the row, or less than they need
/// without a name of their own.
const INDENT: f32 = 9.0;
/// Room for `Bone 999`, and for the count behind it.
const LEAST_LABEL: f32 = 62.0;
const COUNT_WIDTH: f32 = 46.0;
const NUMBER_GAP: f32 = 3.0;
/// The least distance between two guide lines.
const BETWEEN_GUIDES: f32 = 6.0;
/// Width of the chevron where a mouse is the pointer.
const CHEVRON_WIDTH: f32 = 16.0;
/// The middle of the mark that folds, from where its level begins.
const CHEVRON_CENTER: f32 = 0.5 * CHEVRON_WIDTH - 1.0;

/// Where the columns of a row begin.
struct Indent {
    /// The right end of the numbers.
    number: f32,
    /// Each level begins so far to the right of the level above it.
    step: f32,
}

impl Indent {
    fn new(ui: &Ui, session: &Session, rows: Rangef) -> Self {
        let joints = session.joints();
        let digits = joints.count().to_string().len() as f32;
        let tree = joints.tree();
        let deepest = tree.order().iter().map(|&joint| tree.depth(joint)).max();
        let width = rows.span().min(ui.clip_rect().width());
        let number = digits * DIGIT_WIDTH;
        let others = number + NUMBER_GAP + CHEVRON_WIDTH + LEAST_LABEL + COUNT_WIDTH;
        let room = (0.5 * width).min(width - others).max(0.0);
        Self {
            number: rows.min + number,
            step: INDENT.min(room / deepest.unwrap_or_default().max(1) as f32),
        }
    }

    /// Where a level begins.
    fn left(&self, depth: u32) -> f32 {
        self.number + NUMBER_GAP + self.step * depth as f32
    }

    /// A thin line below the mark of each level above a row.
    fn paint_guides(&self, ui: &Ui, depth: u32, y_range: Rangef) {
        let every = (BETWEEN_GUIDES / self.step).ceil().max(1.0) as usize;
        let stroke = Stroke::new(1.0, Tokens::of(ui).hairline);
        for level in (0..depth).step_by(every) {
            let x = self.left(level) + CHEVRON_CENTER;
            ui.painter().vline(x, y_range, stroke);
        }
    }
}

/// The id of a joint's row, wherever the row is.
fn row_id(ui: &Ui, joint: JointIndex) -> Id {
    // It does not depend on the scroll area's id, which changes.
    Id::unique("joint row").with((ui.layer_id(), joint.0))
}

struct TreeRow<'a> {
    row: &'a JointRow,
    place: usize,
    /// Tab stops at it.
    is_stop: bool,
    label: String,
    named: bool,
    selected: bool,
    hovered: bool,
    /// The joint's colour on the skin, if it has one.
    color: Option<Color32>,
}

impl<'a> TreeRow<'a> {
    fn new(session: &Session, state: &SkeletonState, row: &'a JointRow, place: usize, is_stop: bool) -> Self {
        let color = state.reading.colors_srgb.get(row.joint.index());
        Self {
            row,
            place,
            is_stop,
            label: session.joint_label(row.joint),
            named: session.joint_name(row.joint).is_some(),
            selected: session.joints().selected() == Some(row.joint),
            hovered: session.joints().hovered() == Some(row.joint),
            color: color.map(|&[red, green, blue, _]| Color32::from_rgb(red, green, blue)),
        }
    }

    fn show(&self, ui: &mut Ui, rect: Rect, indent: &Indent, cx: &mut Cx<'_, SkeletonState>) -> Response {
        let tokens = Tokens::of(ui);
        let joint = self.row.joint;
        let response = ui.interact(rect, row_id(ui, joint), row_sense(self.is_stop));
        let over = response.contains_pointer() && !is_touch(ui);
        paint_row_ground(ui, rect, &response, self.selected, over || self.hovered);
        if over {
            cx.state.hovered = Some(joint);
        }
        if response.has_focus() {
            cx.state.tree.focused = Some(joint);
        }
        self.tell(ui, &response, cx);

        let middle = rect.center().y;
        let number = self.row.bone.to_string();
        let (at, font) = (pos2(indent.number, middle), theme::mono(11.0));
        ui.painter().text(at, Align2::RIGHT_CENTER, number, font, tokens.faint);
        indent.paint_guides(ui, self.row.depth, rect.y_range());
        let left = indent.left(self.row.depth);
        let folds = self.show_chevron(ui, &response, pos2(left, middle), cx.commands);
        let mut at = pos2(left + CHEVRON_WIDTH, middle);
        if let Some(color) = self.color {
            ui.painter().circle_filled(at + vec2(4.0, 0.0), 4.0, color);
            at.x += 13.0;
        }
        let right = self.show_count(ui, rect);
        let name = Rect::from_min_max(pos2(at.x, rect.min.y), pos2(right - 6.0, rect.max.y));
        if cx.state.naming.of == Some(joint) {
            if show_field(ui, &mut cx.part(|state| &mut state.naming), name, &self.label) {
                cx.state.tree.stop = Some(joint);
                focus_row(ui, response.id, rect);
            }
            return response;
        }
        let color = match (self.selected, self.named || self.row.found) {
            (true, _) => tokens.accent,
            (false, true) => tokens.text,
            (false, false) => tokens.muted,
        };
        let font = FontId::proportional(13.0);
        paint_name(ui.painter(), at, &self.label, font, color, name.width());

        // egui counts a double click soon after any other click as a triple click.
        if response.double_clicked() || response.triple_clicked() {
            cx.state.naming.begin(ui, cx.session, joint);
        } else if response.clicked() && !folds {
            cx.push(JointCommand::Select(Some(joint)));
            // The row is in view, since it was clicked.
            cx.state.tree.select_in_place(joint);
        }
        response.on_hover_text(self.details())
    }

    /// The whole name, and what the bone moves.
    fn details(&self) -> String {
        let mut text = format!(
            "{} (number {} in the file)\nMoves {}",
            self.label,
            self.row.bone,
            counted_vertices(self.row.own_vertices)
        );
        if self.row.has_children {
            text += &format!("\nWith its branch {}", counted_vertices(self.row.branch_vertices));
        }
        text
    }

    /// Tells screen readers about the row, and does what they ask for.
    fn tell(&self, ui: &Ui, response: &Response, cx: &mut Cx<'_, SkeletonState>) {
        let label = format!("{}, {}", self.label, counted_vertices(self.row.own_vertices));
        if tell_row(ui, response, Role::TreeItem, &label, self.place, self.selected) {
            cx.state.tree.stop = Some(self.row.joint);
            focus_row(ui, response.id, response.rect);
        }
        tell_node(response, |node| {
            node.set_level(self.row.depth as usize);
            node.set_author_id(Control::new("bone").at(self.row.bone as usize).to_string());
        });
        if self.row.has_children && tell_folds(ui, response.id, !self.row.folded) {
            self.fold(!self.row.folded, cx.commands);
        }
    }

    fn fold(&self, folded: bool, commands: &mut Vec<Command>) {
        let joint = self.row.joint;
        commands.push(JointCommand::SetFolded { joint, folded }.into());
    }

    /// Keys of the focused row: ← folds the branch or goes to the parent, → unfolds it or goes to the first child, F2 names the bone,
    /// letters and digits go to the next bone with such a name or number. Returns the place of the row that gets the focus.
    fn walk(
        &self,
        ui: &Ui,
        response: &Response,
        (rows, page): (&[JointRow], usize),
        cx: &mut Cx<'_, SkeletonState>,
    ) -> Option<usize> {
        if !response.has_focus() {
            return None;
        }
        let mut to = walked(ui, response.id, self.place, rows.len(), page);
        // A search shows all branches unfolded.
        let folds = self.row.has_children && cx.state.tree.query.is_empty();
        let mut names = false;
        let mut types = cx.state.tree.typed.goes_on(ui.input(|input| input.time));
        retain_plain_keys(ui, |key, _| {
            match key {
                Key::ArrowLeft if folds && !self.row.folded => self.fold(true, cx.commands),
                Key::ArrowLeft => {
                    let above = rows[..self.place].iter();
                    to = above.clone().rposition(|row| row.depth < self.row.depth).or(to);
                }
                Key::ArrowRight if folds && self.row.folded => self.fold(false, cx.commands),
                Key::ArrowRight if self.row.has_children => to = Some(self.place + 1),
                Key::ArrowRight => {}
                Key::F2 => names = true,
                // What is typed comes as text too. A letter is a shortcut only where no bone begins with it.
                key if is_letter_or_digit(key) => {
                    let letter = key.name().to_lowercase();
                    types |= rows.iter().any(|row| begins(row, cx.session, &letter));
                    return !types;
                }
                _ => return true,
            }
            false
        });
        if names {
            cx.state.naming.begin_by_key(ui, cx.session, self.row.joint);
        }
        self.jump(ui, rows, cx.session, &mut cx.state.tree).or(to)
    }

    /// The place of the next row that what was typed begins: its number, its name or a word of it.
    fn jump(&self, ui: &Ui, rows: &[JointRow], session: &Session, tree: &mut TreeState) -> Option<usize> {
        let mut typed = String::new();
        ui.input_mut(|input| {
            input.events.retain(|event| match event {
                Event::Text(text) if text.chars().all(char::is_alphanumeric) => {
                    typed += &text.to_lowercase();
                    false
                }
                _ => true,
            });
        });
        if typed.is_empty() {
            return None;
        }
        let (words, more) = tree.typed.add(&typed, ui.input(|input| input.time));
        // A second letter may leave the focus where the first one brought it.
        let first = self.place + usize::from(!more);
        let mut places = (0..rows.len()).map(|step| (first + step) % rows.len());
        let found = places.find(|&place| begins(&rows[place], session, words));
        if found.is_none() && !more {
            // It was a shortcut.
            tree.typed = Typed::default();
        }
        found
    }

    /// The mark before a joint with children. Returns whether it was clicked.
    fn show_chevron(&self, ui: &mut Ui, row: &Response, left: Pos2, commands: &mut Vec<Command>) -> bool {
        if !self.row.has_children {
            return false;
        }
        let width = if is_touch(ui) { row.rect.height() } else { CHEVRON_WIDTH };
        // By touch its target reaches to the left, over the number.
        let place = Rect::from_min_max(
            pos2(left.x + CHEVRON_WIDTH - width, row.rect.min.y),
            pos2(left.x + CHEVRON_WIDTH - 1.0, row.rect.max.y),
        );
        let inside = UiBuilder::new().max_rect(place).accessibility_parent(row.id);
        let inside = ui.new_child(inside.id_salt(("fold", row.id)));
        // Keys fold the focused row.
        let response = inside.interact(place, row.id.with("fold"), Sense::CLICK);
        let color = Tokens::of(ui).muted_to_text(response.hovered());
        paint_fold_mark(ui.painter(), left + vec2(CHEVRON_CENTER, 0.0), self.row.folded, color);
        let verb = if self.row.folded { "Unfold" } else { "Fold" };
        let label = format!("{verb} {}", self.label);
        response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &label));
        if response.clicked() {
            self.fold(!self.row.folded, commands);
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
        let (painter, font, color) = (ui.painter(), FontId::proportional(11.5), Tokens::of(ui).faint);
        painter
            .text(rect.right_center(), Align2::RIGHT_CENTER, text, font, color)
            .min
            .x
    }
}

/// Whether a number, a name or a word of it begins with these lowercase letters.
fn begins(row: &JointRow, session: &Session, letters: &str) -> bool {
    let label = session.joint_label(row.joint).to_lowercase();
    let mut parts = label.split_whitespace();
    row.bone.to_string().starts_with(letters) || parts.any(|part| part.starts_with(letters))
}

fn is_letter_or_digit(key: Key) -> bool {
    let name = key.name();
    name.len() == 1 && name.bytes().all(|byte| byte.is_ascii_alphanumeric())
}
