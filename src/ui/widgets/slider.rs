//! A number between two ends.

use std::ops::RangeInclusive;

use egui::{Align2, CursorIcon, FontId, Rect, Response, Sense, Stroke, Ui, WidgetInfo, pos2, vec2};

use super::super::theme::{self, Tokens};
use super::{MOUSE_CONTROL, arrow_steps, control_size};

/// Width of the label before the track.
const LABEL_WIDTH: f32 = 90.0;
/// Width of the number behind the track: it stands still while the number changes.
const NUMBER_WIDTH: f32 = 56.0;
const KNOB_RADIUS: f32 = 6.0;
/// Steps of the arrow keys over the whole range.
const KEY_STEPS: f32 = 50.0;

/// A row with a label, a track with a knob, and the number in words of the caller.
#[derive(Clone, Debug)]
pub(crate) struct Slider<'a> {
    label: &'a str,
    value: f32,
    range: RangeInclusive<f32>,
    text: &'a str,
    reset_to: f32,
}

impl<'a> Slider<'a> {
    /// A slider at a value, which `text` gives in words.
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

    /// What a double click brings back, and where the filled part of the track begins. The range's start unless told.
    pub(crate) fn reset_to(self, reset_to: f32) -> Self {
        Self { reset_to, ..self }
    }

    /// Shows it. The new value, when there is one.
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
        self.asked(ui, *ends.start(), *ends.end(), &response)
    }

    /// What pointer and keys ask for.
    fn asked(&self, ui: &Ui, left: f32, right: f32, response: &Response) -> Option<f32> {
        let (start, end) = (*self.range.start(), *self.range.end());
        let steps = arrow_steps(ui, response);
        if steps != 0.0 {
            return Some((self.value + steps * (end - start) / KEY_STEPS).clamp(start, end));
        }
        if response.double_clicked() {
            return Some(self.reset_to);
        }
        let pressed = response.is_pointer_button_down_on() || response.clicked();
        let pointer = response.interact_pointer_pos().filter(|_| pressed)?;
        let share = ((pointer.x - left) / (right - left).max(1.0)).clamp(0.0, 1.0);
        let value = start + share * (end - start);
        // Near what a double click brings back, the knob stays there: a whole place is easier to find again.
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
            .rect_filled(band(left - 2.0, right + 2.0), 1.5, tokens.field_hovered);
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
