//! A number that is dragged or typed.

use std::ops::RangeInclusive;

use egui::{DragValue, TextStyle, Ui, Vec2};

use super::super::keyboard::press_field;

/// A field for a number, dragged by `speed` a point, with `decimals` always shown so that it stands still. The new value,
/// when there is one.
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
            ui.spacing_mut().button_padding = egui::vec2(2.0, 2.0);
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
