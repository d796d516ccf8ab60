//! Numbers: a field to drag or type, and a read-out that becomes a field.

use std::ops::RangeInclusive;

use egui::accesskit::{Action, ActionData, Invalid};
use egui::text::{CCursor, CCursorRange};
use egui::text_edit::TextEditState;
use egui::{
    Align, Align2, Color32, CornerRadius, CursorIcon, FontId, Id, Key, LayerId, Modifiers, Order, Rect, Response, Role,
    Sense, Stroke, StrokeKind, TextEdit, Ui, Vec2, WidgetInfo, pos2, vec2,
};

use super::control::{MOUSE_CONTROL, control_size, focus_ring, hint_of_name, tell_node};
use super::keys::arrow_steps;
use super::row::Row;
use crate::ui::input::press_field;
use crate::ui::kit::theme::{self, CONTROL_RADIUS, Tokens};
use crate::ui::kit::wording::trimmed;

/// A field for a number: a drag changes it by `speed` a point, the arrow keys by a step, and a click lets one type it. What is no number of
/// the range is refused. It always shows all `decimals`, so that it stands still. Returns a new value.
pub(crate) fn number_field(
    ui: &mut Ui,
    label: &str,
    size: Vec2,
    value: f32,
    range: RangeInclusive<f32>,
    (speed, decimals): (f32, usize),
) -> Option<f32> {
    let text = format!("{value:.decimals$}");
    // A value of the file may be outside the range. It may stay.
    let read = |typed: &str| match typed == text {
        true => Ok(value),
        false => number_within(typed, &range),
    };
    let field = TypedValue {
        size,
        align: Align::Center,
        number: Some((value, &range)),
        ..TypedValue::new(ui, label, &text, &text)
    };
    let (typed, response) = field.show(ui, read);
    // The number shown is rounded, what a drag adds up is not.
    let dragged_to = response.id.with("dragged to");
    let least = 0.1_f32.powi(decimals as i32);
    let asked = if response.dragged() {
        let before = ui.data(|data| data.get_temp(dragged_to)).unwrap_or(value);
        let now = before + speed * response.drag_delta().x;
        ui.data_mut(|data| data.insert_temp(dragged_to, now));
        now
    } else {
        ui.data_mut(|data| data.remove::<f32>(dragged_to));
        value + speed.max(least) * arrow_steps(ui, &response)
    };
    if asked == value {
        return typed.filter(|typed| *typed != value);
    }
    let rounded = (asked / least).round() * least;
    Some(rounded.clamp(*range.start(), *range.end())).filter(|asked| (asked - value).abs() >= 0.5 * least)
}

/// Reads a number of a range, with a sign behind it or none: `0.3`, `2×`.
pub(crate) fn number_within(typed: &str, range: &RangeInclusive<f32>) -> Result<f32, String> {
    let is_alone = |rest: &str| !rest.contains(char::is_alphanumeric);
    match leading_number(typed.trim()) {
        Some((number, rest)) if is_alone(rest) && range.contains(&(number as f32)) => Ok(number as f32),
        _ => Err(format!(
            "A number from {} to {}",
            trimmed(*range.start()),
            trimmed(*range.end())
        )),
    }
}

/// The number with which a text begins, and the text after it. A comma is a decimal point.
pub(crate) fn leading_number(typed: &str) -> Option<(f64, &str)> {
    let end = typed
        .find(|letter: char| !matches!(letter, '0'..='9' | '.' | ',' | '-' | '−' | '+'))
        .unwrap_or(typed.len());
    let number: f64 = typed[..end].replace(',', ".").replace('−', "-").parse().ok()?;
    number.is_finite().then_some((number, &typed[end..]))
}

/// The most characters that can be typed, more than any number needs.
const MOST_CHARS: usize = 24;

/// A number as the caller writes it. A click turns it into a field. Painted here: egui's `DragValue` drops what is typed when the value
/// changes meanwhile, as the time does while a clip plays.
#[derive(Clone, Debug)]
pub(crate) struct TypedValue<'a> {
    name: &'a str,
    text: &'a str,
    typed: &'a str,
    size: Vec2,
    /// It is a number of a range, to drag and for the arrow keys.
    number: Option<(f32, &'a RangeInclusive<f32>)>,
    /// What is typed is taken as soon as it can be read.
    at_once: bool,
    color: Color32,
    font: FontId,
    ground: Color32,
    align: Align,
}

impl<'a> TypedValue<'a> {
    /// A read-out of this text. Its field begins with `typed`, all selected.
    pub(crate) fn new(ui: &Ui, name: &'a str, text: &'a str, typed: &'a str) -> Self {
        let tokens = Tokens::of(ui);
        Self {
            name,
            text,
            typed,
            size: vec2(72.0, control_size(ui)),
            number: None,
            at_once: false,
            color: tokens.text,
            font: theme::mono(12.0),
            ground: tokens.field,
            align: Align::Max,
        }
    }

    pub(crate) fn width(self, width: f32) -> Self {
        let size = vec2(width, self.size.y);
        Self { size, ..self }
    }

    /// What is typed is taken as soon as it can be read, not once it ends.
    pub(crate) fn at_once(self) -> Self {
        Self { at_once: true, ..self }
    }

    /// Words in a colour, without a ground.
    pub(crate) fn quiet(self, color: Color32, align: Align) -> Self {
        Self {
            color,
            font: FontId::proportional(13.0),
            ground: Color32::TRANSPARENT,
            align,
            ..self
        }
    }

    /// Shows it. `read` reads what is typed once Enter ends it. Where it refuses, the field stays and says why, until Esc. A click
    /// elsewhere ends it too, and leaves the value where that makes no sense. Returns what was read.
    pub(crate) fn show<T>(self, ui: &mut Ui, read: impl Fn(&str) -> Result<T, String>) -> (Option<T>, Response) {
        let sense = self.number.map_or(Sense::click(), |_| Sense::click_and_drag());
        let (rect, response) = ui.allocate_exact_size(self.size, sense);
        let id = Id::unique(("typed", self.name));
        if response.is_pointer_button_down_on() {
            press_field(ui);
        }
        let begins = response.clicked();
        if begins {
            let typing = Typing::of(ui, self.typed);
            ui.data_mut(|data| data.insert_temp(id, typing));
        }
        let height = if self.number.is_some() {
            rect.height()
        } else {
            MOUSE_CONTROL
        };
        let field = Rect::from_center_size(rect.center(), vec2(rect.width(), height));
        let typing: Option<Typing> = ui.data(|data| data.get_temp(id));
        // A field that went away with its panel does not come back with what was typed.
        if let Some(typing) = typing.filter(|typing| typing.shown_in + 1 >= ui.ctx().cumulative_frame_nr()) {
            return (self.edit(ui, field, id, typing, begins, read), response);
        }
        self.paint(ui, field, &response);
        response.widget_info(|| match self.number {
            Some((value, _)) => WidgetInfo {
                label: Some(self.name.to_owned()),
                ..WidgetInfo::drag_value(true, value.into())
            },
            None => WidgetInfo::labeled(Role::Button, true, format!("{} {}", self.name, self.text)),
        });
        tell_node(&response, |node| {
            node.add_action(Action::SetValue);
            if let Some((_, range)) = self.number {
                node.set_min_numeric_value((*range.start()).into());
                node.set_max_numeric_value((*range.end()).into());
                node.add_action(Action::Increment);
                node.add_action(Action::Decrement);
            }
        });
        let set = ui.input(|input| {
            let mut requests = input.accesskit_action_requests(response.id, Action::SetValue);
            requests.find_map(|request| match &request.data {
                Some(ActionData::Value(text)) => Some(text.to_string()),
                Some(ActionData::NumericValue(number)) => Some(number.to_string()),
                _ => None,
            })
        });
        let value = set.and_then(|text| match read(&text) {
            Ok(value) => Some(value),
            Err(why) => {
                let refused = Some(why);
                let typing = Typing {
                    text,
                    refused,
                    ..Typing::of(ui, self.typed)
                };
                ui.data_mut(|data| data.insert_temp(id, typing));
                ui.memory_mut(|memory| memory.request_focus(id.with("field")));
                ui.ctx().request_repaint();
                None
            }
        });
        let response = match self.number {
            Some(_) => hint_of_name(response, self.name).on_hover_cursor(CursorIcon::ResizeHorizontal),
            None => response.on_hover_cursor(CursorIcon::Text),
        };
        (value, response)
    }

    /// Shows it at the right end of a row, after its name and quiet words, with room `behind` it.
    pub(crate) fn row<T>(
        self,
        ui: &mut Ui,
        behind: f32,
        (beside, hint): (&str, &str),
        read: impl Fn(&str) -> Result<T, String>,
    ) -> Option<T> {
        let tokens = Tokens::of(ui);
        let width = ui.available_width() - self.size.x - behind - ui.spacing().item_spacing.x;
        let mut row = Row::sized(ui, vec2(width, self.size.y));
        row.left(self.name, tokens.muted);
        row.right(beside, tokens.faint);
        let (read, response) = self.show(ui, read);
        response.on_hover_text(hint);
        read
    }

    fn paint(&self, ui: &Ui, field: Rect, response: &Response) {
        let tokens = Tokens::of(ui);
        let active = response.hovered() || response.has_focus();
        let ground = if active { tokens.field_hovered } else { self.ground };
        ui.painter().rect_filled(field, CONTROL_RADIUS, ground);
        focus_ring(ui, field, response);
        let anchor = Align2([self.align, Align::Center]);
        let at = anchor.pos_in_rect(&self.inside(field));
        ui.painter().text(at, anchor, self.text, self.font.clone(), self.color);
    }

    /// Where the text is in its field, typed or not.
    fn inside(&self, field: Rect) -> Rect {
        let margin = match self.align {
            Align::Min => 4.0,
            Align::Center => 2.0,
            Align::Max => 7.0,
        };
        field.shrink2(vec2(margin, 0.0))
    }

    /// The field. Returns what was read when it ended.
    fn edit<T>(
        &self,
        ui: &mut Ui,
        field: Rect,
        id: Id,
        mut typing: Typing,
        begins: bool,
        read: impl Fn(&str) -> Result<T, String>,
    ) -> Option<T> {
        let tokens = Tokens::of(ui);
        ui.painter().rect_filled(field, CONTROL_RADIUS, tokens.field_hovered);
        let color = if typing.refused.is_some() {
            tokens.error
        } else {
            tokens.accent
        };
        ui.painter().rect_stroke(
            field,
            CornerRadius::same(CONTROL_RADIUS),
            Stroke::new(1.5, color),
            StrokeKind::Inside,
        );
        let inside = self.inside(field);
        let mut child = ui.new_child(egui::UiBuilder::new().max_rect(inside));
        // By touch egui would make the field higher than it is drawn.
        child.spacing_mut().interact_size.y = field.height();
        let output = TextEdit::singleline(&mut typing.text)
            .id(id.with("field"))
            .font(self.font.clone())
            .text_color(tokens.text)
            .frame(egui::Frame::NONE)
            .margin(Vec2::ZERO)
            .char_limit(MOST_CHARS)
            .align(Align2([self.align, Align::Center]))
            .min_size(inside.size())
            .desired_width(inside.width())
            .show(&mut child);
        let response = &output.response;
        response.widget_info(|| WidgetInfo {
            current_text_value: Some(typing.text.clone()),
            ..WidgetInfo::labeled(Role::TextInput, true, format!("Type the {}", self.name.to_lowercase()))
        });
        let mut value = None;
        if response.changed() {
            typing.refused = None;
            value = read(&typing.text).ok().filter(|_| self.at_once);
        }
        if begins {
            response.request_focus();
            select_all(ui, response.id, &typing.text);
        } else if response.lost_focus() || !response.has_focus() {
            let entered = ui.input(|input| input.key_pressed(Key::Enter));
            // Esc ends typing and does nothing else.
            let escaped = ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape));
            let taken = entered || (!escaped && typing.text != typing.begun);
            match taken.then(|| read(&typing.text)) {
                Some(Err(why)) if entered => {
                    typing.refused = Some(why);
                    response.request_focus();
                }
                read => {
                    ui.data_mut(|data| data.remove::<Typing>(id));
                    return read?.ok().filter(|_| !self.at_once);
                }
            }
        }
        if let Some(why) = &typing.refused {
            tell_node(response, |node| {
                node.set_invalid(Invalid::True);
                node.set_description(why.clone());
            });
            say_refused(ui, field, id, why);
        }
        typing.shown_in = ui.ctx().cumulative_frame_nr();
        ui.data_mut(|data| data.insert_temp(id, typing));
        value
    }
}

/// Selects the text of a field, so that typing replaces it.
pub(crate) fn select_all(ui: &Ui, field: Id, text: &str) {
    let mut state = TextEditState::load(ui.ctx(), field).unwrap_or_default();
    let all = CCursorRange::two(CCursor::default(), CCursor::new(text.chars().count()));
    state.cursor.set_char_range(Some(all));
    state.store(ui.ctx(), field);
}

/// What is being typed into a field, and why it was refused.
#[derive(Clone, Debug)]
struct Typing {
    text: String,
    /// The text that was there at first.
    begun: String,
    refused: Option<String>,
    /// The frame in which the field was shown last.
    shown_in: u64,
}

impl Typing {
    fn of(ui: &Ui, text: &str) -> Self {
        Self {
            text: text.to_owned(),
            begun: text.to_owned(),
            refused: None,
            shown_in: ui.ctx().cumulative_frame_nr(),
        }
    }
}

/// Says under a field, or above it at the window's lower edge, why it refused. It lies over what is there, so that nothing moves.
fn say_refused(ui: &Ui, field: Rect, id: Id, why: &str) {
    let tokens = Tokens::of(ui);
    let painter = ui.ctx().layer_painter(LayerId::new(Order::Tooltip, id));
    let galley = painter.layout_no_wrap(why.to_owned(), FontId::proportional(11.5), tokens.error);
    let size = galley.size() + vec2(14.0, 8.0);
    let window = ui.ctx().content_rect().shrink(4.0);
    let left = (field.max.x - size.x).clamp(window.min.x, (window.max.x - size.x).max(window.min.x));
    let below = field.max.y + 3.0;
    let top = if below + size.y <= window.max.y {
        below
    } else {
        field.min.y - 3.0 - size.y
    };
    let rect = Rect::from_min_size(pos2(left, top), size);
    let border = Stroke::new(1.0, tokens.error.gamma_multiply(0.5));
    painter.rect(
        rect,
        CONTROL_RADIUS,
        tokens.panel.to_opaque(),
        border,
        StrokeKind::Inside,
    );
    painter.galley(rect.min + vec2(7.0, 4.0), galley, tokens.error);
    let response = ui.interact(rect, id.with("refused"), Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(Role::Alert, true, why));
}
