//! Saves the view as a picture: its size, its background, its name; and contact sheets.

use egui::{Id, Rangef, Ui, UiBuilder, vec2};

use crate::actions::{self, Control};
use crate::scene::FrameOptions;
use crate::session::Session;
use crate::ui::kit::theme::Tokens;
use crate::ui::kit::{
    MenuLine, Slider, TextButton, choices, choose, control_size, menu_item, number_field, progress_bar, section_name,
    switch_row,
};
use crate::ui::state::{MAX_PICTURE_SIDE, UiState};
use crate::ui::window::panel::popover_gap;

/// Sizes with a name, in pixels.
const PRESETS: [(&str, [u32; 2]); 3] = [
    ("Full HD  1920 × 1080", [1920, 1080]),
    ("4K  3840 × 2160", [3840, 2160]),
    ("Square  2048 × 2048", [2048, 2048]),
];

/// The most columns, and the most rows, of a contact sheet.
const MOST_CELLS: u32 = 24;
const CANCEL_WIDTH: f32 = 70.0;

/// The contents of the popover and of the drawer's page, below their title.
pub(in crate::ui) fn show(ui: &mut Ui, session: &Session, state: &mut UiState) {
    let size = state.picture.size_in_pixels(ui);
    choices(ui, "Size", |ui| {
        let sizes = PRESETS.map(|(label, preset)| (label, Some(preset)));
        for (label, size) in [("As the window", None)].into_iter().chain(sizes) {
            if menu_item(ui, label, MenuLine::Choice(state.picture.size == size)).clicked() {
                state.picture.size = size;
            }
        }
    });
    ui.add_space(8.0);
    if let Some(typed) = pair_fields(
        ui,
        ["Width in pixels", "Height in pixels"],
        size,
        MAX_PICTURE_SIDE,
        (4.0, "px"),
    ) {
        state.picture.size = Some(typed);
    }
    ui.add_space(6.0);
    let transparent = &mut state.picture.transparent;
    *transparent ^= switch_row(ui, "Transparent ground", "", *transparent).clicked();
    ui.add_space(6.0);
    if !session.view_state().camera.orthographic {
        let aperture = state.picture.aperture;
        let text = if aperture > 0.0 {
            format!("{:.0} %", aperture * 100.0)
        } else {
            "Off".to_owned()
        };
        let named = ("Depth of field", Control::new("depth-of-field"));
        let slider = Slider::new(named, aperture, 0.0..=FrameOptions::WIDEST_APERTURE, &text);
        if let Some(chosen) = slider.reset_to(0.0).show(ui) {
            state.picture.aperture = chosen;
        }
    }
    popover_gap(ui);
    let save = &actions::SAVE_PICTURE;
    if TextButton::new(save.label, &save.hint()).show_wide(ui).clicked() {
        state.save_picture(ui, false);
    }
    if session.open_model().is_some() {
        popover_gap(ui);
        contact_sheet(ui, session, state);
    }
}

/// Many pictures on one of the size above.
fn contact_sheet(ui: &mut Ui, session: &Session, state: &mut UiState) {
    section_name(ui, "Contact sheet");
    if session.clip().is_some() {
        let choices = [(false, "Clip"), (true, "Turntable")];
        choose(ui, "Contact sheet of", &choices, &mut state.picture.turntable);
        ui.add_space(8.0);
    }
    let cells = state.picture.cells;
    if let Some(typed) = pair_fields(ui, ["Columns", "Rows"], cells, MOST_CELLS, (0.1, "")) {
        state.picture.cells = typed;
    }
    ui.add_space(6.0);
    let transparent = &mut state.picture.sheet_transparent;
    *transparent ^= switch_row(ui, "Transparent sheet", "", *transparent).clicked();
    ui.add_space(8.0);
    // One button in two shapes: the focus stays on it.
    let button = || UiBuilder::new().scope_id(Id::unique("contact sheet"));
    let Some(drawn) = &mut state.drawn_sheet else {
        let label = "Save contact sheet";
        let save = TextButton::new(label, label);
        if ui.scope_builder(button(), |ui| save.show_wide(ui)).inner.clicked() {
            state.save_contact_sheet(ui);
        }
        return;
    };
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 8.0;
        let size = vec2(ui.available_width() - CANCEL_WIDTH - 8.0, control_size(ui));
        progress_bar(ui, "Pictures drawn", size, [drawn.done, drawn.count]);
        let cancel = TextButton::new("Cancel", "Cancel the contact sheet").width(Rangef::point(CANCEL_WIDTH));
        if ui.scope_builder(button(), |ui| cancel.show(ui)).inner.clicked() {
            drawn.cancelled = true;
        }
    });
}

/// Two whole numbers from 1 on with a cross between them, dragged or typed. Returns both when one is new.
fn pair_fields(
    ui: &mut Ui,
    labels: [&str; 2],
    pair: [u32; 2],
    most: u32,
    (speed, unit): (f32, &str),
) -> Option<[u32; 2]> {
    let mut typed = pair;
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 8.0;
        let unit_width = if unit.is_empty() { 0.0 } else { 26.0 };
        let field = vec2((ui.available_width() - 26.0 - unit_width) * 0.5, control_size(ui));
        for (index, label) in labels.into_iter().enumerate() {
            if index == 1 {
                words(ui, "×", 10.0);
            }
            let range = 1.0..=most as f32;
            if let Some(number) = number_field(ui, label, field, pair[index] as f32, range, (speed, 0)) {
                typed[index] = (number.round() as u32).clamp(1, most);
            }
        }
        if !unit.is_empty() {
            words(ui, unit, 18.0);
        }
    });
    (typed != pair).then_some(typed)
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

/// The name of a contact sheet, as in `soldier-Take1-sheet.png`.
pub fn contact_sheet_name(session: &Session) -> String {
    let mut parts = model_name(session);
    parts.extend(session.clip().map(|clip| clip.name.clone()));
    parts.push("sheet".to_owned());
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
