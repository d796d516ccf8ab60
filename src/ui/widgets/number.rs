//! Numbers: a slider, a field to drag or type, and a read-out that becomes a field.

use std::ops::RangeInclusive;

use egui::text::{CCursor, CCursorRange};
use egui::{
    Align, Align2, Color32, CornerRadius, CursorIcon, DragValue, FontId, Id, Key, Modifiers, Rect, Response, Role,
    Sense, Stroke, StrokeKind, TextEdit, TextStyle, Ui, Vec2, WidgetInfo, pos2, vec2,
};

use super::control::{MOUSE_CONTROL, control_size, focus_ring, slider_keys};
use crate::ui::input::press_field;
use crate::ui::theme::{self, CONTROL_RADIUS, Tokens};

/// Width of the label before the track.
const LABEL_WIDTH: f32 = 90.0;
/// Width of the number behind the track. The track stands still while the number changes.
const NUMBER_WIDTH: f32 = 56.0;
const KNOB_RADIUS: f32 = 6.0;
/// Steps of the arrow keys over the whole range.
const KEY_STEPS: f32 = 50.0;

/// A row with a label, a track with a knob, and the number as the caller writes it. Painted here: egui's slider fills its track only
/// from the range's start, and has no default for a double click to restore.
#[derive(Clone, Debug)]
pub(crate) struct Slider<'a> {
    label: &'a str,
    value: f32,
    range: RangeInclusive<f32>,
    text: &'a str,
    reset_to: f32,
}

impl<'a> Slider<'a> {
    /// A slider at a value, which `text` writes out.
    pub(crate) fn new(label: &'a str, value: f32, range: RangeInclusive<f32>, text: &'a str) -> Self {
        let reset_to = *range.start();
        Self {
            label,
            value,
            range,
            text,
            reset_to,
        }
    }

    /// The default: a double click restores it, and the filled part of the track begins there. The range's start unless told.
    pub(crate) fn reset_to(self, reset_to: f32) -> Self {
        Self { reset_to, ..self }
    }

    /// Shows it. Returns a new value.
    pub(crate) fn show(self, ui: &mut Ui) -> Option<f32> {
        let tokens = Tokens::of(ui);
        let height = control_size(ui).max(MOUSE_CONTROL);
        let (row, _) = ui.allocate_exact_size(vec2(ui.available_width(), height), Sense::hover());
        let painter = ui.painter();
        let (font, left) = (FontId::proportional(13.0), row.left_center());
        painter.text(left, Align2::LEFT_CENTER, self.label, font, tokens.muted);
        let font = theme::mono(12.0);
        painter.text(row.right_center(), Align2::RIGHT_CENTER, self.text, font, tokens.text);

        let ends = row.min.x + LABEL_WIDTH + KNOB_RADIUS..=row.max.x - NUMBER_WIDTH - KNOB_RADIUS;
        let target = Rect::from_x_y_ranges(*ends.start() - KNOB_RADIUS..=*ends.end() + KNOB_RADIUS, row.y_range());
        let response = ui.interact(target, ui.next_auto_id().with(self.label), Sense::click_and_drag());
        ui.skip_ahead_auto_ids(1);
        let response = response.on_hover_cursor(CursorIcon::ResizeHorizontal);
        self.paint(ui, *ends.start(), *ends.end(), row.center().y, &response);
        response.widget_info(|| WidgetInfo::slider(true, f64::from(self.value), self.label));
        focus_ring(ui, target, &response);
        self.asked(ui, *ends.start(), *ends.end(), &response)
    }

    /// The value that pointer or keys ask for.
    fn asked(&self, ui: &Ui, left: f32, right: f32, response: &Response) -> Option<f32> {
        let (start, end) = (*self.range.start(), *self.range.end());
        let step = f64::from((end - start) / KEY_STEPS);
        let range = f64::from(start)..=f64::from(end);
        if let Some(value) = slider_keys(ui, response, f64::from(self.value), range, step, self.text) {
            return Some(value as f32);
        }
        if response.double_clicked() {
            return Some(self.reset_to);
        }
        let pressed = response.is_pointer_button_down_on() || response.clicked();
        let pointer = response.interact_pointer_pos().filter(|_| pressed)?;
        let fraction = ((pointer.x - left) / (right - left).max(1.0)).clamp(0.0, 1.0);
        let value = start + fraction * (end - start);
        // The knob snaps to the default, so that it is easy to find again.
        let near = (value - self.reset_to).abs() < 0.015 * (end - start);
        Some(if near { self.reset_to } else { value })
    }

    fn paint(&self, ui: &Ui, left: f32, right: f32, y: f32, response: &Response) {
        let tokens = Tokens::of(ui);
        let (start, end) = (*self.range.start(), *self.range.end());
        let x_of = |value: f32| left + ((value - start) / (end - start)).clamp(0.0, 1.0) * (right - left);
        let (origin, knob) = (x_of(self.reset_to), x_of(self.value));
        let band = |from: f32, to: f32| Rect::from_min_max(pos2(from.min(to), y - 1.5), pos2(from.max(to), y + 1.5));
        ui.painter()
            .rect_filled(band(left - 2.0, right + 2.0), 1.5, tokens.track());
        ui.painter().rect_filled(band(origin, knob), 1.5, tokens.accent);
        let active = response.hovered() || response.is_pointer_button_down_on();
        let center = pos2(knob, y);
        if response.has_focus() || response.is_pointer_button_down_on() {
            ui.painter()
                .circle_filled(center, KNOB_RADIUS + 4.0, tokens.accent_ground);
        }
        let ground = tokens.panel.to_opaque();
        let color = if active { tokens.accent } else { tokens.muted };
        let radius = KNOB_RADIUS - 0.75;
        ui.painter().circle(center, radius, ground, Stroke::new(1.5, color));
    }
}

/// A field for a number. A drag changes it by `speed` a point. It always shows all `decimals`, so that it stands still. Returns a new
/// value.
pub(crate) fn number_field(
    ui: &mut Ui,
    label: &str,
    size: Vec2,
    value: f32,
    range: RangeInclusive<f32>,
    (speed, decimals): (f32, usize),
) -> Option<f32> {
    let mut changed = value;
    let response = ui
        .scope(|ui| {
            ui.style_mut().drag_value_text_style = TextStyle::Monospace;
            ui.visuals_mut().widgets.inactive.fg_stroke.color = Tokens::of(ui).text;
            ui.spacing_mut().button_padding = vec2(2.0, 2.0);
            ui.spacing_mut().interact_size = size;
            let field = DragValue::new(&mut changed)
                .range(range)
                .speed(speed)
                .fixed_decimals(decimals)
                .update_while_editing(false);
            ui.add_sized(size, field)
        })
        .inner;
    if response.is_pointer_button_down_on() {
        press_field(ui);
    }
    response.widget_info(|| {
        let mut info = egui::WidgetInfo::drag_value(true, f64::from(value));
        info.label = Some(label.to_owned());
        info
    });
    response.on_hover_text(label);
    (changed != value).then_some(changed)
}

/// The most characters that can be typed, more than any number needs.
const MOST_CHARS: usize = 24;

/// A number as the caller writes it. A click turns it into a field. Painted here: egui's `DragValue` drops what is typed when the value
/// changes meanwhile, as the time does while a clip plays.
#[derive(Clone, Debug)]
pub(crate) struct TypedValue<'a> {
    /// Unique among the read-outs.
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
    /// A read-out of this text. Its field begins with `typed`, all selected.
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

    /// Its width, whatever the text.
    pub(crate) fn width(self, width: f32) -> Self {
        Self { width, ..self }
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

    /// Shows it. Returns what was typed if Enter ended it.
    pub(crate) fn show(self, ui: &mut Ui) -> (Option<String>, Response) {
        let (rect, response) = ui.allocate_exact_size(vec2(self.width, control_size(ui)), Sense::click());
        let id = Id::unique(("typed", self.name));
        if response.is_pointer_button_down_on() {
            press_field(ui);
        }
        if response.clicked() {
            ui.data_mut(|data| data.insert_temp(id, self.typed.to_owned()));
        }
        let field = Rect::from_center_size(rect.center(), vec2(rect.width(), MOUSE_CONTROL));
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

    fn paint(&self, ui: &Ui, field: Rect, response: &Response) {
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

    /// The field. Returns what was typed if Enter ended it.
    fn edit(&self, ui: &mut Ui, field: Rect, id: Id, mut typed: String, begins: bool) -> Option<String> {
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
            .text_color(tokens.text)
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
            // Esc ends typing and does nothing else.
            ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape));
            return entered.then_some(typed);
        }
        ui.data_mut(|data| data.insert_temp(id, typed));
        None
    }
}

/// The first number in a text: `1.25 s`, `1,25`, `31 of 75`. None if there is none.
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
