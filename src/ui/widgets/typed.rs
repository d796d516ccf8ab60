//! A read-out that can be typed into: a click makes a field of it, Enter takes what was typed, Esc leaves it.

use egui::text::{CCursor, CCursorRange};
use egui::{
    Align, Align2, Color32, CornerRadius, CursorIcon, FontId, Id, Key, Modifiers, Response, Role, Sense, Stroke,
    StrokeKind, TextEdit, Ui, Vec2, WidgetInfo, vec2,
};

use super::super::keyboard::press_field;
use super::super::theme::{self, CONTROL_RADIUS, Tokens};
use super::{MOUSE_CONTROL, control_size, focus_ring};

/// Characters that can be typed: more than any number needs.
const MOST_CHARS: usize = 24;

/// A number in words of the caller.
#[derive(Clone, Debug)]
pub(crate) struct TypedValue<'a> {
    /// Tells it apart from others.
    name: &'static str,
    text: &'a str,
    typed: &'a str,
    width: f32,
    color: Color32,
    font: FontId,
    ground: Color32,
    align: Align,
}

impl<'a> TypedValue<'a> {
    /// A read-out of this text. Its field begins with `typed`, all of it marked.
    pub(crate) fn new(ui: &Ui, name: &'static str, text: &'a str, typed: &'a str) -> Self {
        let tokens = Tokens::of(ui);
        Self {
            name,
            text,
            typed,
            width: 72.0,
            color: tokens.text,
            font: theme::mono(12.0),
            ground: tokens.field,
            align: Align::Max,
        }
    }

    /// Its width, whatever it says.
    pub(crate) fn width(self, width: f32) -> Self {
        Self { width, ..self }
    }

    /// Quiet words on no ground.
    pub(crate) fn quiet(self, color: Color32, align: Align) -> Self {
        Self {
            color,
            font: FontId::proportional(13.0),
            ground: Color32::TRANSPARENT,
            align,
            ..self
        }
    }

    /// Shows it. What was typed when Enter ended it, and the read-out itself while it is one.
    pub(crate) fn show(self, ui: &mut Ui) -> (Option<String>, Response) {
        let (rect, response) = ui.allocate_exact_size(vec2(self.width, control_size(ui)), Sense::click());
        let id = Id::unique(("typed", self.name));
        if response.is_pointer_button_down_on() {
            press_field(ui);
        }
        if response.clicked() {
            ui.data_mut(|data| data.insert_temp(id, self.typed.to_owned()));
        }
        let field = egui::Rect::from_center_size(rect.center(), vec2(rect.width(), MOUSE_CONTROL));
        let typed: Option<String> = ui.data(|data| data.get_temp(id));
        match typed {
            Some(typed) => (self.edit(ui, field, id, typed, response.clicked()), response),
            None => {
                self.paint(ui, field, &response);
                let label = format!("{} {}", self.name, self.text);
                response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &label));
                (None, response.on_hover_cursor(CursorIcon::Text))
            }
        }
    }

    fn paint(&self, ui: &Ui, field: egui::Rect, response: &Response) {
        let tokens = Tokens::of(ui);
        let active = response.hovered() || response.has_focus();
        let ground = if active { tokens.field_hovered } else { self.ground };
        ui.painter().rect_filled(field, CONTROL_RADIUS, ground);
        focus_ring(ui, field, response);
        let (at, anchor) = match self.align {
            Align::Min => (field.left_center() + vec2(4.0, 0.0), Align2::LEFT_CENTER),
            Align::Center => (field.center(), Align2::CENTER_CENTER),
            Align::Max => (field.right_center() - vec2(7.0, 0.0), Align2::RIGHT_CENTER),
        };
        ui.painter().text(at, anchor, self.text, self.font.clone(), self.color);
    }

    /// The field. What was typed when Enter ended it.
    fn edit(&self, ui: &mut Ui, field: egui::Rect, id: Id, mut typed: String, begins: bool) -> Option<String> {
        let tokens = Tokens::of(ui);
        ui.painter().rect_filled(field, CONTROL_RADIUS, tokens.field_hovered);
        let outline = Stroke::new(1.5, tokens.accent);
        ui.painter()
            .rect_stroke(field, CornerRadius::same(CONTROL_RADIUS), outline, StrokeKind::Inside);
        let inside = field.shrink2(vec2(6.0, 0.0));
        let mut child = ui.new_child(egui::UiBuilder::new().max_rect(inside));
        let mut output = TextEdit::singleline(&mut typed)
            .id(id.with("field"))
            .font(theme::mono(12.0))
            .frame(egui::Frame::NONE)
            .margin(Vec2::ZERO)
            .char_limit(MOST_CHARS)
            .align(Align2::LEFT_CENTER)
            .min_size(inside.size())
            .desired_width(inside.width())
            .show(&mut child);
        let response = &output.response;
        response.widget_info(|| {
            WidgetInfo::labeled(Role::TextInput, true, format!("Type the {}", self.name.to_lowercase()))
        });
        if begins {
            response.request_focus();
            let all = CCursorRange::two(CCursor::new(0), CCursor::new(typed.chars().count()));
            output.state.cursor.set_char_range(Some(all));
            output.state.clone().store(ui.ctx(), response.id);
        } else if response.lost_focus() || !response.has_focus() {
            ui.data_mut(|data| data.remove::<String>(id));
            let entered = ui.input(|input| input.key_pressed(Key::Enter));
            // What Esc shut, it has shut.
            ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape));
            return entered.then_some(typed);
        }
        ui.data_mut(|data| data.insert_temp(id, typed));
        None
    }
}

/// The first number in what was typed: `1.25 s`, `1,25`, `31 of 75`. None when there is none.
pub(crate) fn typed_number(typed: &str) -> Option<f64> {
    let typed = typed.trim().replace(',', ".").replace('−', "-");
    let end = typed
        .find(|letter: char| !matches!(letter, '0'..='9' | '.' | '-' | '+'))
        .unwrap_or(typed.len());
    let number: f64 = typed[..end].parse().ok()?;
    number.is_finite().then_some(number)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_as_people_write_them() {
        for (typed, number) in [
            ("1.25", Some(1.25)),
            (" 1,25 s", Some(1.25)),
            ("31 of 75", Some(31.0)),
            ("0.5×", Some(0.5)),
            ("−2", Some(-2.0)),
            (".5", Some(0.5)),
            ("", None),
            ("soon", None),
            ("1.2.3", None),
        ] {
            assert_eq!(typed_number(typed), number, "{typed:?}");
        }
    }
}
