//! Buttons: with an icon, with words, a line of a menu, one of a few choices, a switch.

use egui::{
    Align2, Atom, AtomExt as _, AtomKind, AtomPaintArgs, Atoms, Button, Color32, FontId, Rangef, Rect, Response,
    RichText, Role, Sense, StrokeKind, Ui, UiBuilder, UiKind, Vec2, WidgetInfo, lerp, pos2, vec2,
};

use super::control::{
    MOUSE_CONTROL, TOUCH_CONTROL, control_size, explained, focus_ring, hint_of_name, is_touch, key_hint, note_in_force,
    paint_ground, paint_row_ground, tell_push,
};
use super::keys::arrow_steps;
use super::named::{Label, named};
use super::row::Row;
use crate::actions::Action;
use crate::ui::cx::Cx;
use crate::ui::kit::icons::{self, Icon};
use crate::ui::kit::theme::{self, CONTROL_RADIUS, Tokens};

pub(crate) const ICON_SIZE: f32 = 16.0;
/// Gap between the parts of a button.
const GAP: f32 = 5.0;
/// Width of the chevron of a drop-down.
const CHEVRON_WIDTH: f32 = 13.0;
/// Margin at both ends of a line of a menu.
const MENU_PADDING: f32 = 10.0;
/// Height of a line of a menu where a mouse is the pointer.
const MENU_LINE: f32 = 26.0;

/// A square button with an icon. `on` marks a switch that is on.
pub(crate) fn icon_button(ui: &mut Ui, icon: Icon, label: &str, on: bool) -> Response {
    hint_of_name(bare_icon_button(ui, icon, label, on), label)
}

/// The same without a tooltip.
pub(crate) fn bare_icon_button(ui: &mut Ui, icon: Icon, label: &str, on: bool) -> Response {
    let side = control_size(ui);
    let place = vec2(side - 2.0 * ui.spacing().button_padding.x, ICON_SIZE);
    let response = ui.add(Button::selectable(on, icon_atom(icon, place)).min_size(Vec2::splat(side)));
    focus_ring(ui, response.rect, &response);
    response.widget_info(|| WidgetInfo::selected(Role::Button, ui.is_enabled(), on, label));
    response
}

/// The same without a state: it does something, or opens something.
pub(crate) fn push_button(ui: &mut Ui, icon: Icon, label: &str) -> Response {
    let response = icon_button(ui, icon, label, false);
    tell_push(&response);
    response
}

/// An icon in the middle of a size, in the colour of the words beside it.
fn icon_atom(icon: Icon, size: Vec2) -> Atom<'static> {
    AtomKind::paint(move |ui, args| icons::paint(ui.painter(), args.rect, icon, args.fallback_text_color))
        .atom_size(size)
}

/// A square button of an action of the session, with its key in the tooltip.
pub(in crate::ui) fn action_button<S>(ui: &mut Ui, cx: &mut Cx<'_, S>, action: &Action, icon: Icon) {
    let button = icon_button(ui, icon, &action.hint(), action.is_on(cx.session));
    if named(button, action.control).clicked() {
        cx.act(action);
    }
}

/// The same for an action that does something once.
pub(in crate::ui) fn push_action<S>(ui: &mut Ui, cx: &mut Cx<'_, S>, action: &Action, icon: Icon) {
    if named(push_button(ui, icon, &action.hint()), action.control).clicked() {
        cx.act(action);
    }
}

/// A button with words, as wide as they need within its least and greatest width. Longer words end in an ellipsis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TextButton<'a> {
    text: &'a str,
    label: &'a str,
    icon: Option<Icon>,
    opens_list: bool,
    width: Rangef,
}

impl<'a> TextButton<'a> {
    /// A button with this text. `label` is for screen readers.
    pub(crate) fn new(text: &'a str, label: &'a str) -> Self {
        Self {
            text,
            label,
            icon: None,
            opens_list: false,
            width: Rangef::new(0.0, f32::INFINITY),
        }
    }

    /// With an icon before the words.
    pub(crate) fn icon(self, icon: Icon) -> Self {
        Self {
            icon: Some(icon),
            ..self
        }
    }

    /// With the chevron of a drop-down.
    pub(crate) fn list(self) -> Self {
        Self {
            opens_list: true,
            ..self
        }
    }

    /// Its least and greatest width.
    pub(crate) fn width(self, width: Rangef) -> Self {
        Self { width, ..self }
    }

    /// As wide as what is available.
    pub(crate) fn show_wide(self, ui: &mut Ui) -> Response {
        let width = Rangef::point(ui.available_width());
        self.width(width).show(ui)
    }

    pub(crate) fn show(self, ui: &mut Ui) -> Response {
        let tokens = Tokens::of(ui);
        let icon = self.icon.map_or(0.0, |_| ICON_SIZE + GAP);
        let chevron = if self.opens_list { GAP + CHEVRON_WIDTH } else { 0.0 };
        let others = icon + chevron + 2.0 * ui.spacing().button_padding.x;
        let words = RichText::new(self.text).color(tokens.text);
        let mut atoms = Atoms::default();
        if let Some(icon) = self.icon {
            let color = tokens.text;
            let paint = move |ui: &Ui, args: AtomPaintArgs| icons::paint(ui.painter(), args.rect, icon, color);
            atoms.push_right(AtomKind::paint(paint).atom_size(Vec2::splat(ICON_SIZE)));
        }
        // Words alone are centred. Before a chevron they are at the left.
        let alone = self.icon.is_none() && !self.opens_list;
        if alone {
            atoms.push_right(Atom::grow());
        }
        let words = words.atom_max_width(self.width.max - others);
        atoms.push_right(words.atom_align(Align2::LEFT_CENTER).atom_grow(self.opens_list));
        if alone {
            atoms.push_right(Atom::grow());
        }
        if self.opens_list {
            atoms.push_right(icon_atom(Icon::ChevronDown, vec2(CHEVRON_WIDTH, ICON_SIZE)));
        }
        let button = Button::new(atoms).gap(if alone { 0.0 } else { GAP });
        let response = ui.add(button.min_size(vec2(self.width.min, control_size(ui))));
        focus_ring(ui, response.rect, &response);
        response.widget_info(|| WidgetInfo::labeled(Role::Button, true, self.label));
        response
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum MenuLine {
    Action,
    /// One of a group to choose from, and whether it is the current choice.
    Choice(bool),
    /// It is on or off by itself.
    Switch(bool),
}

/// A line of a menu, or of a page of the drawer.
pub(crate) fn menu_item(ui: &mut Ui, text: &str, line: MenuLine) -> Response {
    menu_line(ui, text, "", theme::mono(11.0), line)
}

/// A line of a menu with the key that does the same.
pub(crate) fn keyed_menu_item(ui: &mut Ui, text: &str, key: &str, line: MenuLine) -> Response {
    let key = key_hint(ui, key);
    menu_line(ui, text, key, theme::mono(11.0), line)
}

/// A line of a menu that is one of several choices, with a value behind it.
pub(crate) fn valued_choice(ui: &mut Ui, text: &str, value: &str, on: bool) -> Response {
    menu_line(ui, text, value, FontId::proportional(12.0), MenuLine::Choice(on))
}

/// A line of a menu that opens a page, with the current choice of that page.
pub(crate) fn valued_menu_item(ui: &mut Ui, text: &str, value: &str, on: bool) -> Response {
    let response = valued_choice(ui, text, value, on);
    let with_value = format!("{text}: {value}");
    let name = if value.is_empty() { text } else { &with_value };
    response.widget_info(|| WidgetInfo::labeled(Role::MenuItem, true, name));
    tell_push(&response);
    response
}

fn menu_line(ui: &mut Ui, text: &str, behind: &str, font_behind: FontId, line: MenuLine) -> Response {
    let tokens = Tokens::of(ui);
    let on = matches!(line, MenuLine::Choice(true) | MenuLine::Switch(true));
    let words = RichText::new(text).color(if on { tokens.accent } else { tokens.text });
    let behind = RichText::new(behind).font(font_behind).color(tokens.faint);
    let height = if is_touch(ui) { TOUCH_CONTROL } else { MENU_LINE };
    let button = Button::selectable(on, words).small().right_text(behind);
    // egui's menus have next to no padding.
    let padding = std::mem::replace(&mut ui.spacing_mut().button_padding.x, MENU_PADDING);
    let response = ui.add(button.min_size(vec2(ui.available_width(), height)));
    ui.spacing_mut().button_padding.x = padding;
    focus_ring(ui, response.rect, &response);
    let in_menu = ui.stack().contained_in(UiKind::Menu);
    let (role, other_role) = match line {
        MenuLine::Action => (Role::MenuItem, Role::Button),
        MenuLine::Choice(_) => (Role::MenuItemRadio, Role::RadioButton),
        MenuLine::Switch(_) => (Role::MenuItemCheckBox, Role::CheckBox),
    };
    let role = if in_menu { role } else { other_role };
    response.widget_info(|| WidgetInfo::selected(role, true, on, text));
    match line {
        MenuLine::Action => tell_push(&response),
        MenuLine::Choice(true) => note_in_force(ui, response.id),
        _ => {}
    }
    response
}

/// A group of choices, one of which is in force, for screen readers. In a menu the lines are that by themselves.
pub(crate) fn choices<R>(ui: &mut Ui, name: &str, contents: impl FnOnce(&mut Ui) -> R) -> R {
    let group = UiBuilder::new().accessibility_role(Role::RadioGroup);
    ui.scope_builder(group.accessibility_label(name), contents).inner
}

/// The least room on either side of the label of a part.
const SEGMENT_ROOM: f32 = 6.0;

/// A switch with a segment for each choice, over the whole width. Returns a new choice. The stable name of a segment is the switch's with
/// its place behind. Painted here: in a row of egui's buttons on a common ground a finger would have less than the whole height.
pub(crate) fn segmented<'a, T: Copy + PartialEq>(
    ui: &mut Ui,
    name: impl Into<Label<'a>>,
    choices: &[(T, &str)],
    in_force: Option<T>,
) -> Option<T> {
    explained_segmented(ui, name.into(), choices, &[], in_force)
}

/// The same for a value of the interface itself.
pub(crate) fn choose<T: Copy + PartialEq>(ui: &mut Ui, name: &str, choices: &[(T, &str)], value: &mut T) {
    if let Some(chosen) = segmented(ui, name, choices, Some(*value)) {
        *value = chosen;
    }
}

/// The same with a sentence about each choice.
pub(crate) fn explained_segmented<'a, T: Copy + PartialEq>(
    ui: &mut Ui,
    name: impl Into<Label<'a>>,
    choices: &[(T, &str)],
    sentences: &[&str],
    in_force: Option<T>,
) -> Option<T> {
    let Label { words: name, control } = name.into();
    let tokens = Tokens::of(ui);
    let size = vec2(ui.available_width(), control_size(ui));
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    paint_ground(ui, rect, tokens.field);
    let group = UiBuilder::new()
        .max_rect(rect)
        .id_salt(response.id)
        .accessibility_role(Role::RadioGroup)
        .accessibility_label(name);
    let group = ui.new_child(group);
    let inner = rect.shrink(2.0);
    let font = FontId::proportional(12.5);
    let labels: Vec<_> = choices
        .iter()
        .map(|&(_, label)| ui.painter().layout_no_wrap(label.to_owned(), font.clone(), tokens.text))
        .map(|label| label.size().x)
        .collect();
    let count = choices.len().max(1) as f32;
    let equal = inner.width() / count;
    // Parts are equally wide, unless a label needs more: then the room around the labels is.
    let around = (inner.width() - labels.iter().sum::<f32>()) / count;
    let all_fit = labels.iter().all(|&label| label + 2.0 * SEGMENT_ROOM <= equal);
    let mut chosen = None;
    let mut left = inner.min.x;
    for (index, (&(choice, label), label_width)) in choices.iter().zip(labels).enumerate() {
        let width = if all_fit { equal } else { label_width + around };
        let place = Rect::from_min_max(pos2(left, inner.min.y), pos2(left + width, inner.max.y));
        left += width;
        // The target has the whole height.
        let target = Rect::from_x_y_ranges(place.x_range(), rect.y_range());
        let part = group.interact(target, response.id.with(index), Sense::click());
        let on = in_force == Some(choice);
        let color = match (on, part.hovered()) {
            (true, _) => tokens.accent,
            (false, true) => tokens.text,
            (false, false) => tokens.muted,
        };
        if on {
            ui.painter()
                .rect_filled(place, CONTROL_RADIUS - 2, tokens.accent_ground);
        }
        focus_ring(ui, place, &part);
        ui.painter()
            .text(place.center(), Align2::CENTER_CENTER, label, font.clone(), color);
        part.widget_info(|| {
            WidgetInfo::selected(Role::RadioButton, group.is_enabled(), on, format!("{name}: {label}"))
        });
        let part = match control {
            Some(control) => named(part, control.at(index)),
            None => part,
        };
        let part = match sentences.get(index) {
            Some(sentence) => explained(part, sentence),
            None => part,
        };
        let beside = index as i32 + arrow_steps(ui, &part) as i32;
        if beside != index as i32
            && let Some(&(choice, _)) = usize::try_from(beside).ok().and_then(|beside| choices.get(beside))
        {
            ui.memory_mut(|memory| memory.request_focus(response.id.with(beside as usize)));
            chosen = Some(choice);
        }
        if part.clicked() {
            chosen = Some(choice);
        }
    }
    chosen
}

const TRACK_WIDTH: f32 = 26.0;
const TRACK_HEIGHT: f32 = 15.0;

/// A row with a switch at its end, and the key that does the same (or none). Painted here: egui has a check box, but no row that can
/// be pressed as a whole with a switch at its end.
pub(crate) fn switch_row(ui: &mut Ui, label: &str, key: &str, on: bool) -> Response {
    let (key, color) = (key_hint(ui, key), Tokens::of(ui).faint);
    noted_switch_row(ui, label, (key, theme::mono(11.0), color), on)
}

/// The same with a note in place of the key.
pub(crate) fn noted_switch_row(
    ui: &mut Ui,
    label: &str,
    (note, note_font, note_color): (&str, FontId, Color32),
    on: bool,
) -> Response {
    let tokens = Tokens::of(ui);
    let height = control_size(ui).max(MOUSE_CONTROL);
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), height), Sense::click());
    paint_row_ground(ui, rect, &response, false, response.contains_pointer());
    let middle = pos2(rect.max.x - TRACK_WIDTH * 0.5, rect.center().y);
    let track = Rect::from_center_size(middle, vec2(TRACK_WIDTH, TRACK_HEIGHT));
    paint_track(ui, track, &response, on);
    let mut row = Row::of(ui, rect, response);
    row.right = track.min.x - 10.0;
    row.right_in(note_font, note, note_color);
    row.right -= 6.0;
    row.name(label, tokens.text);
    row.response
        .widget_info(|| WidgetInfo::selected(Role::Switch, true, on, label));
    row.response
}

/// The row of an action of the session that is on or off.
pub(in crate::ui) fn action_switch<S>(ui: &mut Ui, cx: &mut Cx<'_, S>, action: &Action) {
    let switch = switch_row(ui, action.label, action.key(), action.is_on(cx.session));
    if named(switch, action.control).clicked() {
        cx.act(action);
    }
}

fn paint_track(ui: &Ui, track: Rect, response: &Response, on: bool) {
    let tokens = Tokens::of(ui);
    let fraction = ui.ctx().animate_bool_with_time(response.id, on, 0.1);
    let off_ground = tokens.field_hovered;
    let ground = if fraction > 0.0 {
        off_ground.lerp_to_gamma(tokens.accent, fraction)
    } else {
        off_ground
    };
    ui.painter().rect_filled(track, TRACK_HEIGHT * 0.5, ground);
    if !on {
        let border = egui::Stroke::new(1.0, tokens.hairline);
        ui.painter()
            .rect_stroke(track, TRACK_HEIGHT * 0.5, border, StrokeKind::Inside);
    }
    let knob_x = lerp(track.min.x + 7.5..=track.max.x - 7.5, fraction);
    let knob = if on { Color32::WHITE } else { tokens.muted };
    ui.painter().circle_filled(pos2(knob_x, track.center().y), 5.0, knob);
}
