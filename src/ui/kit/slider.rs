//! A slider: a row with a label, a track and a number.

use std::ops::RangeInclusive;

use egui::{CursorIcon, Rangef, Rect, Response, Sense, Stroke, Ui, pos2};

use super::control::{MOUSE_CONTROL, control_size, focus_ring};
use super::keys::{SliderNode, slider_keys};
use super::named::Label;
use super::row::Row;
use crate::ui::kit::theme::{self, Tokens};

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
    label: Label<'a>,
    value: f32,
    range: RangeInclusive<f32>,
    text: &'a str,
    reset_to: f32,
}

impl<'a> Slider<'a> {
    /// A slider at a value, which `text` writes out.
    pub(crate) fn new(label: impl Into<Label<'a>>, value: f32, range: RangeInclusive<f32>, text: &'a str) -> Self {
        let reset_to = *range.start();
        Self {
            label: label.into(),
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

    pub(crate) fn show(self, ui: &mut Ui) -> Option<f32> {
        let tokens = Tokens::of(ui);
        let height = control_size(ui).max(MOUSE_CONTROL);
        let mut row = Row::new(ui, height);
        row.left(self.label.words, tokens.muted);
        row.right_in(theme::mono(12.0), self.text, tokens.text);
        let (row, label_end) = (row.rect, row.left);

        let target = row
            .with_min_x((row.min.x + LABEL_WIDTH).max(label_end + 4.0))
            .with_max_x(row.max.x - NUMBER_WIDTH);
        let ends = target.x_range().shrink(KNOB_RADIUS);
        let response = ui.interact(
            target,
            ui.next_auto_id().with(self.label.words),
            Sense::click_and_drag(),
        );
        ui.skip_ahead_auto_ids(1);
        let response = response.on_hover_cursor(CursorIcon::ResizeHorizontal);
        self.paint(ui, ends, row.center().y, &response);
        focus_ring(ui, target, &response);
        self.asked(ui, ends, &response)
    }

    /// The value that pointer or keys ask for.
    fn asked(&self, ui: &Ui, ends: Rangef, response: &Response) -> Option<f32> {
        let (start, end) = (*self.range.start(), *self.range.end());
        let slider = SliderNode {
            name: self.label.words,
            value: f64::from(self.value),
            range: f64::from(start)..=f64::from(end),
            step: f64::from((end - start) / KEY_STEPS),
            text: self.text,
        };
        let keyed = slider_keys(ui, response, &slider);
        self.label.name(response);
        if let Some(value) = keyed {
            return Some(value as f32);
        }
        if response.double_clicked() {
            return Some(self.reset_to);
        }
        let pressed = response.is_pointer_button_down_on() || response.clicked();
        let pointer = response.interact_pointer_pos().filter(|_| pressed)?;
        let fraction = ((pointer.x - ends.min) / ends.span().max(1.0)).clamp(0.0, 1.0);
        let value = start + fraction * (end - start);
        // The knob snaps to the default, so that it is easy to find again.
        let near = (value - self.reset_to).abs() < 0.015 * (end - start);
        Some(if near { self.reset_to } else { value })
    }

    fn paint(&self, ui: &Ui, ends: Rangef, y: f32, response: &Response) {
        let (tokens, painter) = (Tokens::of(ui), ui.painter());
        let (start, end) = (*self.range.start(), *self.range.end());
        let x_of = |value: f32| ends.min + ((value - start) / (end - start)).clamp(0.0, 1.0) * ends.span();
        let (origin, knob) = (x_of(self.reset_to), x_of(self.value));
        let band = |from: f32, to: f32| Rect::from_min_max(pos2(from.min(to), y - 1.5), pos2(from.max(to), y + 1.5));
        painter.rect_filled(band(ends.min - 2.0, ends.max + 2.0), 1.5, tokens.track());
        painter.rect_filled(band(origin, knob), 1.5, tokens.accent);
        let active = response.hovered() || response.is_pointer_button_down_on();
        let center = pos2(knob, y);
        if response.has_focus() || response.is_pointer_button_down_on() {
            painter.circle_filled(center, KNOB_RADIUS + 4.0, tokens.accent_ground);
        }
        let ground = tokens.panel.to_opaque();
        let color = if active { tokens.accent } else { tokens.muted };
        let radius = KNOB_RADIUS - 0.75;
        painter.circle(center, radius, ground, Stroke::new(1.5, color));
    }
}
