//! The values of a material, to be changed while the model is looked at.

use egui::{Align2, FontId, Role, Sense, Ui, Vec2, WidgetInfo, vec2};

use super::theme::Tokens;
use super::widgets::{Slider, color_button, control_size, is_touch, number_field, switch_row};
use crate::model::{Material, Reflectance};
use crate::scene::{linear_from_srgb8, srgb8_from_linear};
use crate::session::MAX_SPEC_POWER;

/// Width of the labels.
const LABEL_WIDTH: f32 = 90.0;
/// Room between fields.
const SPACING: f32 = 5.0;

/// The fields. The material with what was changed, when something was.
pub(super) fn show(ui: &mut Ui, material: &Material) -> Option<Material> {
    let mut edited = material.clone();
    match &mut edited.reflectance {
        Reflectance::Fresnel { fresnel0, roughness } => {
            color_row(ui, "Diffuse", &mut edited.diffuse);
            color_row(ui, "Fresnel R0", fresnel0);
            let text = format!("{roughness:.2}");
            if let Some(rougher) = Slider::new("Roughness", *roughness, 0.0..=1.0, &text).show(ui) {
                *roughness = rougher;
            }
        }
        Reflectance::Phong {
            ambient,
            specular,
            spec_power,
            reflectivity,
        } => {
            color_row(ui, "Ambient", ambient);
            color_row(ui, "Diffuse", &mut edited.diffuse);
            color_row(ui, "Specular", specular);
            power_row(ui, spec_power);
            color_row(ui, "Reflectivity", reflectivity);
        }
    }
    if switch_row(ui, "Alpha clip", "", material.alpha_clip).clicked() {
        edited.alpha_clip = !material.alpha_clip;
    }
    (edited != *material).then_some(edited)
}

/// A linear colour: to choose by eye, and its three numbers.
fn color_row(ui: &mut Ui, label: &str, color: &mut [f32; 3]) {
    row(ui, label, |ui, height| {
        let side = Vec2::splat(height);
        let shown = color.map(srgb8_from_linear);
        if let Some(chosen) = color_button(ui, label, side, shown) {
            // Only the channels that were changed: the others keep what eight bits cannot say.
            for channel in 0..3 {
                if chosen[channel] != shown[channel] {
                    color[channel] = linear_from_srgb8(chosen[channel]);
                }
            }
        }
        let width = (ui.available_width() - 2.0 * SPACING) / 3.0;
        for (value, name) in color.iter_mut().zip(["red", "green", "blue"]) {
            let label = format!("{label}: {name}");
            let size = vec2(width, height);
            if let Some(number) = number_field(ui, &label, size, *value, 0.0..=1.0, (0.005, 3)) {
                *value = number;
            }
        }
    });
}

fn power_row(ui: &mut Ui, power: &mut f32) {
    row(ui, "Power", |ui, height| {
        let size = vec2(ui.available_width(), height);
        let speed = 0.25 + *power * 0.01;
        if let Some(number) = number_field(ui, "Power: number", size, *power, 0.0..=MAX_SPEC_POWER, (speed, 1)) {
            *power = number;
        }
    });
}

/// A label, and fields of a height behind it.
fn row(ui: &mut Ui, label: &str, fields: impl FnOnce(&mut Ui, f32)) {
    let height = if is_touch(ui) { 40.0 } else { 22.0 };
    let row_height = control_size(ui).max(height + 4.0);
    let size = vec2(ui.available_width(), row_height);
    ui.allocate_ui_with_layout(size, egui::Layout::left_to_right(egui::Align::Center), |ui| {
        ui.set_min_height(row_height);
        ui.spacing_mut().item_spacing.x = SPACING;
        let (rect, response) = ui.allocate_exact_size(vec2(LABEL_WIDTH - SPACING, row_height), Sense::hover());
        let font = FontId::proportional(13.0);
        let color = Tokens::of(ui).muted;
        ui.painter()
            .text(rect.left_center(), Align2::LEFT_CENTER, label, font, color);
        response.widget_info(|| WidgetInfo::labeled(Role::Label, true, label));
        fields(ui, height);
    });
}
