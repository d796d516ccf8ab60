//! Rows of panels: headings, facts, choices, hairlines.

use egui::{Align2, Color32, FontId, Id, Rect, Response, Role, Sense, Stroke, Ui, Vec2, WidgetInfo, pos2, vec2};

use super::button::push_button;
use super::color::paint_swatch;
use super::control::{
    MOUSE_CONTROL, control_size, explained, focus_ring, hint_beside, is_touch, key_hint, paint_ends, paint_ground,
    paint_name, paint_row_ground, pressed_row_height, walked,
};
use crate::ui::icons::{self, Icon};
use crate::ui::theme::{self, CONTROL_RADIUS, ROW_HEIGHT, Tokens};

/// Height of the heading of a selection.
const SELECTED_HEIGHT: f32 = 22.0;
/// Height of the name of a section.
const SECTION_HEIGHT: f32 = 21.0;

/// A row that can be pressed, over the whole width. Its ground shows whether it is hovered or `selected`.
pub(crate) fn pressed_row(ui: &mut Ui, selected: bool) -> (Rect, Response) {
    let size = vec2(ui.available_width(), pressed_row_height(ui));
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    let over = response.contains_pointer();
    paint_row_ground(ui, rect, &response, selected, over);
    (rect, response)
}

/// A small icon in a row. `on` marks a switch that is on.
pub(crate) fn row_icon(ui: &Ui, place: Rect, row: &Response, icon: Icon, label: &str, on: bool) -> Response {
    let tokens = Tokens::of(ui);
    // It is one control whichever picture it has now.
    let from_right = (row.rect.max.x - place.max.x).round() as i32;
    let response = ui.interact(place, row.id.with(("icon", from_right)), Sense::click());
    let color = match (on, response.hovered() || response.has_focus()) {
        (true, _) => tokens.accent,
        (false, hovered) => tokens.muted_to_text(hovered),
    };
    icons::paint(ui.painter(), place, icon, color);
    focus_ring(ui, place, &response);
    response.widget_info(|| WidgetInfo::selected(Role::Button, true, on, label));
    hint_beside(response, Some(row.rect), label)
}

/// Rows that a page key goes by.
const PAGE: usize = 10;

/// A list of rows, for screen readers and for the arrow keys: they move the focus from row to row.
#[derive(Debug, Default)]
pub(crate) struct RowList {
    rows: Vec<Id>,
    focused: Option<usize>,
}

impl RowList {
    /// Shows a list of this name. The contents tell of each row with [`RowList::row`].
    pub(crate) fn show(ui: &mut Ui, name: &str, contents: impl FnOnce(&mut Ui, &mut Self)) {
        let shown = ui.scope(|ui| {
            let mut list = Self::default();
            contents(ui, &mut list);
            list.walk(ui);
        });
        shown
            .response
            .widget_info(|| WidgetInfo::labeled(Role::List, true, name));
    }

    /// Tells of the next row.
    pub(crate) fn row(&mut self, response: &Response, selected: bool) {
        if response.has_focus() {
            self.focused = Some(self.rows.len());
        }
        if response.gained_focus() {
            response.scroll_to_me(None);
        }
        self.rows.push(response.id);
        response
            .ctx
            .accesskit_node_builder(response.id, |node| node.set_selected(selected));
    }

    fn walk(self, ui: &Ui) {
        let Some((focused, &id)) = self.focused.and_then(|at| Some((at, self.rows.get(at)?))) else {
            return;
        };
        if let Some(to) = walked(ui, id, focused, self.rows.len(), PAGE) {
            ui.memory_mut(|memory| memory.request_focus(self.rows[to]));
        }
    }
}

/// A row of a panel: a quiet label and a value at the right edge.
pub(crate) fn value_row(ui: &mut Ui, label: &str, value: &str) -> Response {
    let tokens = Tokens::of(ui);
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), ROW_HEIGHT), Sense::hover());
    paint_ends(ui, rect, (label, tokens.muted), (value, tokens.text));
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, format!("{label} {value}")));
    response
}

/// A row of a panel whose value opens a menu.
pub(crate) fn choice_row(ui: &mut Ui, label: &str, value: &str, how: &str) -> Response {
    let tokens = Tokens::of(ui);
    let (rect, response) = pressed_row(ui, false);
    let font = FontId::proportional(13.0);
    ui.painter().text(
        rect.left_center(),
        Align2::LEFT_CENTER,
        label,
        font.clone(),
        tokens.muted,
    );
    let chevron = Rect::from_center_size(pos2(rect.max.x - 5.0, rect.center().y), Vec2::splat(16.0));
    icons::paint(ui.painter(), chevron, Icon::ChevronDown, tokens.muted);
    let mut right = rect.max.x - 15.0;
    for (text, color) in [(how, tokens.muted), (value, tokens.text)] {
        let drawn = ui.painter().text(
            pos2(right, rect.center().y),
            Align2::RIGHT_CENTER,
            text,
            font.clone(),
            color,
        );
        right = drawn.min.x - 4.0;
    }
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, format!("{label}: {value} {how}")));
    response
}

/// The title of a panel with a button that closes it. Returns whether it was clicked.
pub(crate) fn closable_heading(ui: &mut Ui, title: &str) -> bool {
    heading_with_close(ui, title).clicked()
}

/// The same. Returns the button.
pub(crate) fn heading_with_close(ui: &mut Ui, title: &str) -> Response {
    ui.horizontal(|ui| {
        let width = ui.available_width() - control_size(ui) - 6.0;
        let (heading, response) = ui.allocate_exact_size(vec2(width, MOUSE_CONTROL), Sense::hover());
        let (at, color) = (heading.left_center(), Tokens::of(ui).text);
        ui.painter()
            .text(at, Align2::LEFT_CENTER, title, theme::semibold(13.0), color);
        response.widget_info(|| WidgetInfo::labeled(Role::Heading, true, title));
        push_button(ui, Icon::Close, "Close")
    })
    .inner
}

/// The name of the selection, after a swatch in its colour (linear) if any, and a button that clears it. Returns whether it was
/// clicked.
pub(crate) fn selected_heading(ui: &mut Ui, name: &str, color: Color32, swatch: Option<[f32; 3]>) -> bool {
    let size = vec2(ui.available_width(), SELECTED_HEIGHT);
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    let mut at = rect.left_center();
    if let Some(swatch) = swatch {
        paint_swatch(ui, at + vec2(5.0, 0.0), swatch, 1.0);
        at.x += 18.0;
    }
    let side = control_size(ui);
    paint_name(
        ui.painter(),
        at,
        name,
        theme::semibold(13.0),
        color,
        rect.max.x - side - at.x,
    );
    response.widget_info(|| WidgetInfo::labeled(Role::Heading, true, format!("Selected: {name}")));
    // The cross aligns with the right edge of the rows below.
    let place = Rect::from_center_size(rect.right_center() - vec2(8.0, 0.0), Vec2::splat(side));
    // In a child of its own, so that it does not widen the rows.
    let mut corner = ui.new_child(egui::UiBuilder::new().max_rect(place));
    push_button(&mut corner, Icon::Close, "Clear the selection (Esc)").clicked()
}

/// The name of a section: 11 points, capitals.
pub(crate) fn section_name(ui: &mut Ui, name: &str) -> Response {
    keyed_section_name(ui, name, "")
}

/// The name of a section with the key that changes it.
pub(crate) fn keyed_section_name(ui: &mut Ui, name: &str, key: &str) -> Response {
    let tokens = Tokens::of(ui);
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), SECTION_HEIGHT), Sense::hover());
    // The words are a little above the middle.
    let y = rect.center().y - 1.0;
    let font = theme::semibold(11.0);
    ui.painter().text(
        pos2(rect.min.x, y),
        Align2::LEFT_CENTER,
        name.to_uppercase(),
        font,
        tokens.muted,
    );
    let (font, key) = (theme::mono(11.0), key_hint(ui, key));
    ui.painter()
        .text(pos2(rect.max.x, y), Align2::RIGHT_CENTER, key, font, tokens.faint);
    response.widget_info(|| WidgetInfo::labeled(Role::Heading, true, name));
    response
}

/// The name of a section, and an action at its right end. Returns whether the action was clicked.
pub(crate) fn section_with_action(ui: &mut Ui, name: &str, action: Option<&str>) -> bool {
    section_with_labelled_action(ui, name, action.map(|action| (action, action)))
}

/// The same with a longer label of the action, for screen readers.
pub(crate) fn section_with_labelled_action(ui: &mut Ui, name: &str, action: Option<(&str, &str)>) -> bool {
    explained_section(ui, name, "", action)
}

/// The same with a sentence about the section, or none.
pub(crate) fn explained_section(ui: &mut Ui, name: &str, sentence: &str, action: Option<(&str, &str)>) -> bool {
    let top = ui.cursor().min;
    let heading = section_name(ui, name);
    if !sentence.is_empty() {
        explained(heading, sentence);
    }
    let Some((action, label)) = action else { return false };
    let tokens = Tokens::of(ui);
    let galley = ui
        .painter()
        .layout_no_wrap(action.to_owned(), FontId::proportional(11.5), tokens.accent);
    let middle = top.y + 0.5 * SECTION_HEIGHT - 1.0;
    let height = if is_touch(ui) { control_size(ui) } else { SECTION_HEIGHT };
    let size = vec2(galley.size().x + 12.0, height);
    let right = top.x + ui.available_width() + 6.0;
    let place = Rect::from_center_size(pos2(right - 0.5 * size.x, middle), size);
    let response = ui.interact(place, ui.scope_id().with(("action", name)), Sense::click());
    let ground = Rect::from_center_size(place.center(), vec2(size.x, 19.0));
    if response.hovered() || response.has_focus() {
        ui.painter().rect_filled(ground, CONTROL_RADIUS, tokens.accent_ground);
    }
    let at = place.center() - galley.size() * 0.5;
    ui.painter().galley(at, galley, tokens.accent);
    focus_ring(ui, ground, &response);
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, label));
    response.clicked()
}

/// How much of a work is done, as a bar and as `5 of 12`.
pub(crate) fn progress_bar(ui: &mut Ui, name: &str, size: Vec2, [done, count]: [usize; 2]) {
    let tokens = Tokens::of(ui);
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    paint_ground(ui, rect, tokens.field);
    let fraction = done as f32 / count.max(1) as f32;
    let filled = rect.with_max_x(rect.min.x + rect.width() * fraction.min(1.0));
    ui.painter().rect_filled(filled, CONTROL_RADIUS, tokens.accent_ground);
    let words = format!("{done} of {count}");
    let font = FontId::proportional(12.5);
    ui.painter()
        .text(rect.center(), Align2::CENTER_CENTER, &words, font, tokens.text);
    response.widget_info(|| WidgetInfo::labeled(Role::ProgressIndicator, true, name));
    ui.ctx().accesskit_node_builder(response.id, |node| {
        node.set_min_numeric_value(0.0);
        node.set_max_numeric_value(count as f64);
        node.set_numeric_value(done as f64);
        node.set_value(words);
    });
}

/// A hairline across a panel, from border to border.
pub(crate) fn rule(ui: &mut Ui, panel_margin: f32) {
    let tokens = Tokens::of(ui);
    ui.add_space(7.0);
    let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), 1.0), Sense::hover());
    let rect = rect.expand2(vec2(panel_margin, 0.0));
    ui.painter()
        .hline(rect.x_range(), rect.center().y, Stroke::new(1.0, tokens.hairline));
    ui.add_space(7.0);
}

/// Height of the handle of a sheet.
const SHEET_HANDLE_HEIGHT: f32 = 24.0;

/// The grip of the bottom sheet. `label`: what it opens or closes.
pub(crate) fn sheet_handle(ui: &mut Ui, label: &str) -> Response {
    let tokens = Tokens::of(ui);
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), SHEET_HANDLE_HEIGHT), Sense::hover());
    // By touch its target reaches a little above the sheet.
    let above = (control_size(ui) - rect.height()).max(0.0);
    let target = Rect::from_min_max(pos2(rect.min.x, rect.min.y - above), rect.max);
    let response = ui.interact(target, response.id.with("grip"), Sense::click_and_drag());
    focus_ring(ui, rect, &response);
    let grip = Rect::from_center_size(rect.center(), vec2(38.0, 4.0));
    ui.painter().rect_filled(
        grip,
        2.0,
        if response.hovered() {
            tokens.faint
        } else {
            tokens.hairline
        },
    );
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, label));
    response
}
