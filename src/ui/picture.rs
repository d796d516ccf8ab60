//! Saves the view as a picture: its size, its background, its name.

use egui::{Rangef, Ui, vec2};

use super::panel::popover_gap;
use super::state::{MAX_PICTURE_SIDE, PictureChoice, UiState};
use super::theme::Tokens;
use super::widgets::{MenuLine, TextButton, control_size, menu_item, number_field, section_name, switch_row};
use crate::actions;
use crate::session::Session;

/// Sizes with a name, in pixels.
const PRESETS: [(&str, [u32; 2]); 3] = [
    ("Full HD  1920 × 1080", [1920, 1080]),
    ("4K  3840 × 2160", [3840, 2160]),
    ("Square  2048 × 2048", [2048, 2048]),
];

/// The popover's contents.
pub(super) fn show(ui: &mut Ui, state: &mut UiState) {
    let size = state.picture.size_in_pixels(ui);
    section_name(ui, "Picture");
    if menu_item(ui, "As the window", MenuLine::Choice(state.picture.size.is_none())).clicked() {
        state.picture.size = None;
    }
    for (label, preset) in PRESETS {
        if menu_item(ui, label, MenuLine::Choice(state.picture.size == Some(preset))).clicked() {
            state.picture.size = Some(preset);
        }
    }
    ui.add_space(8.0);
    size_fields(ui, size, &mut state.picture);
    ui.add_space(6.0);
    let response = switch_row(ui, "Transparent ground", "", state.picture.transparent);
    if response.clicked() {
        state.picture.transparent = !state.picture.transparent;
    }
    popover_gap(ui);
    let width = Rangef::point(ui.available_width());
    if TextButton::new(actions::SAVE_PICTURE.label, &actions::SAVE_PICTURE.hint())
        .width(width)
        .show(ui)
        .clicked()
    {
        state.save_picture(ui, false);
    }
}

/// Width × height, dragged or typed.
fn size_fields(ui: &mut Ui, size: [u32; 2], choice: &mut PictureChoice) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 8.0;
        let field = vec2((ui.available_width() - 60.0) * 0.5, control_size(ui));
        let mut typed = size;
        let range = 1.0..=MAX_PICTURE_SIDE as f32;
        for (index, label) in ["Width in pixels", "Height in pixels"].into_iter().enumerate() {
            if index == 1 {
                words(ui, "×", 10.0);
            }
            if let Some(side) = number_field(ui, label, field, size[index] as f32, range.clone(), (4.0, 0)) {
                typed[index] = (side.round() as u32).clamp(1, MAX_PICTURE_SIDE);
            }
        }
        words(ui, "px", 18.0);
        if typed != size {
            choice.size = Some(typed);
        }
    });
}

fn words(ui: &mut Ui, text: &str, width: f32) {
    let color = Tokens::of(ui).muted;
    let (rect, _) = ui.allocate_exact_size(vec2(width, control_size(ui)), egui::Sense::hover());
    let font = egui::FontId::proportional(13.0);
    ui.painter()
        .text(rect.center(), egui::Align2::CENTER_CENTER, text, font, color);
}

/// The name of a picture: model, clip and frame, as in `soldier-Take1-31.png`.
pub fn picture_name(session: &Session) -> String {
    let mut parts = model_name(session);
    if let Some(clip) = session.clip() {
        parts.push(clip.name.clone());
        parts.push(clip.frame_at(session.playback().time_secs()).to_string());
    }
    file_name(&parts, "png")
}

/// The name of a report, as in `soldier.sarif`.
pub fn report_name(session: &Session) -> String {
    file_name(&model_name(session), "sarif")
}

/// The name of the open model without its extension.
fn model_name(session: &Session) -> Vec<String> {
    let open = session.open_model().into_iter();
    open.map(|open| {
        let name = open.file.base_name();
        name.rsplit_once('.').map_or(name, |(stem, _)| stem).to_owned()
    })
    .collect()
}

/// The parts with dashes between them. Characters that file systems refuse become dashes.
fn file_name(parts: &[String], extension: &str) -> String {
    let safe = |c: char| {
        if c.is_alphanumeric() || "-_.".contains(c) {
            c
        } else {
            '-'
        }
    };
    let parts: Vec<String> = parts
        .iter()
        .map(|part| part.trim().chars().map(safe).collect::<String>())
        .filter(|part| !part.is_empty())
        .collect();
    let name = parts.join("-");
    let name = name.trim_start_matches('.');
    format!("{}.{extension}", if name.is_empty() { "bindpose" } else { name })
}
