//! Headings: of panels, of a selection, of sections.

use egui::{Color32, FontId, Rect, Response, Role, Sense, Ui, Vec2, WidgetInfo, pos2, vec2};

use super::button::push_button;
use super::color::paint_swatch;
use super::control::{MOUSE_CONTROL, control_size, explained, focus_ring, is_touch, key_hint};
use super::named::Label;
use super::row::Row;
use crate::ui::kit::icons::Icon;
use crate::ui::kit::theme::{self, CONTROL_RADIUS, Tokens};

const SELECTED_HEIGHT: f32 = 22.0;
const SECTION_HEIGHT: f32 = 21.0;

/// The title of a panel with a button that closes it. Returns whether it was clicked.
pub(crate) fn closable_heading(ui: &mut Ui, title: &str) -> bool {
    heading_with_close(ui, title).clicked()
}

/// The same. Returns the button.
pub(crate) fn heading_with_close(ui: &mut Ui, title: &str) -> Response {
    ui.horizontal(|ui| {
        let width = ui.available_width() - control_size(ui) - 6.0;
        let mut heading = Row::sized(ui, vec2(width, MOUSE_CONTROL));
        heading.left_in(theme::semibold(13.0), title, Tokens::of(ui).text);
        heading.told(Role::Heading, title);
        push_button(ui, Icon::Close, "Close")
    })
    .inner
}

/// The name of the selection, after a swatch in its colour (linear) if any, and a button that clears it. Returns whether it was
/// clicked.
pub(crate) fn selected_heading(ui: &mut Ui, name: &str, color: Color32, swatch: Option<[f32; 3]>) -> bool {
    let mut heading = Row::new(ui, SELECTED_HEIGHT);
    if let Some(swatch) = swatch {
        paint_swatch(ui, heading.rect.left_center() + vec2(5.0, 0.0), swatch, 1.0);
        heading.left += 18.0;
    }
    let side = control_size(ui);
    heading.right -= side;
    heading.name_in(theme::semibold(13.0), name, color);
    let rect = heading.told(Role::Heading, format!("Selected: {name}")).rect;
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
    let mut row = Row::new(ui, SECTION_HEIGHT);
    // The words are a little above the middle.
    row.y -= 1.0;
    row.left_in(theme::semibold(11.0), &name.to_uppercase(), tokens.muted);
    row.right_in(theme::mono(11.0), key_hint(ui, key), tokens.faint);
    row.told(Role::Heading, name)
}

/// The name of a section, and an action at its right end, whose stable name stands with the section's. Returns whether the action was
/// clicked.
pub(crate) fn section_with_action<'a>(ui: &mut Ui, name: impl Into<Label<'a>>, action: Option<&str>) -> bool {
    section_with_labelled_action(ui, name.into(), action.map(|action| (action, action)))
}

/// The same with a longer label of the action, for screen readers.
pub(crate) fn section_with_labelled_action<'a>(
    ui: &mut Ui,
    name: impl Into<Label<'a>>,
    action: Option<(&str, &str)>,
) -> bool {
    explained_section(ui, name.into(), "", action)
}

/// The same with a sentence about the section, or none.
pub(crate) fn explained_section<'a>(
    ui: &mut Ui,
    name: impl Into<Label<'a>>,
    sentence: &str,
    action: Option<(&str, &str)>,
) -> bool {
    let label = name.into();
    let name = label.words;
    let top = ui.cursor().min;
    let heading = section_name(ui, name);
    if !sentence.is_empty() {
        explained(heading, sentence);
    }
    let Some((action, words)) = action else { return false };
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
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, words));
    label.name(&response);
    response.clicked()
}
