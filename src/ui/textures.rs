//! The maps of the open model: how many are there, which are missing, what each holds and who uses it.

use egui::{Align2, FontId, RichText, Role, Sense, Ui, WidgetInfo, vec2};

use super::theme::{ROW_HEIGHT, Tokens};
use super::timeline::shortened;
use super::widgets::section_name;
use crate::session::{OpenModel, Session, UsedMap};

/// Missing names that are spelled out before the rest is counted.
const NAMES_SHOWN: usize = 8;

/// The section's contents. Nothing for a model whose materials name no map.
pub(super) fn show(ui: &mut Ui, session: &Session, open: &OpenModel) {
    let checklist = session.maps().checklist();
    let tokens = Tokens::of(ui);
    section_name(ui, "Textures");
    let found = checklist.named - checklist.missing.len();
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), ROW_HEIGHT), Sense::hover());
    let font = FontId::proportional(13.0);
    let count = format!("{found} of {} found", checklist.named);
    ui.painter().text(
        rect.left_center(),
        Align2::LEFT_CENTER,
        &count,
        font.clone(),
        tokens.text,
    );
    if !checklist.missing.is_empty() {
        let missing = format!("{} missing", checklist.missing.len());
        ui.painter()
            .text(rect.right_center(), Align2::RIGHT_CENTER, missing, font, tokens.warning);
    }
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, format!("Textures: {count}")));
    for map in session.maps().used() {
        map_row(ui, open, &map);
    }
    if !checklist.missing.is_empty() {
        let mut names = checklist
            .missing
            .iter()
            .take(NAMES_SHOWN)
            .cloned()
            .collect::<Vec<_>>()
            .join(", ");
        if checklist.missing.len() > NAMES_SHOWN {
            names.push_str(&format!(" and {} more", checklist.missing.len() - NAMES_SHOWN));
        }
        let small = |text: String| RichText::new(text).font(FontId::proportional(12.0)).color(tokens.muted);
        ui.add_space(2.0);
        ui.label(small(format!("Missing: {names}")))
            .on_hover_text(users_of_missing(open, &checklist.missing));
        ui.label(small("Drop them any time.".to_owned()));
    }
}

/// One map: its name, and what it holds; its users under the pointer.
fn map_row(ui: &mut Ui, open: &OpenModel, map: &UsedMap<'_>) {
    let tokens = Tokens::of(ui);
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), ROW_HEIGHT), Sense::hover());
    let name = shortened(map.file.base_name(), 20);
    let size = format!("{} × {}", map.image.width(), map.image.height());
    ui.painter().text(
        rect.left_center(),
        Align2::LEFT_CENTER,
        name,
        FontId::proportional(13.0),
        tokens.text,
    );
    ui.painter().text(
        rect.right_center(),
        Align2::RIGHT_CENTER,
        size,
        FontId::proportional(12.0),
        tokens.muted,
    );
    let users = map.users.iter().map(|(material, slot)| {
        let name = open
            .model
            .materials
            .get(*material)
            .map_or("", |material| material.name.as_str());
        format!("{} of {name}", slot.label())
    });
    let users = users.collect::<Vec<_>>().join("\n");
    let channels = match map.image.channels().count() {
        1 => "1 channel".to_owned(),
        count => format!("{count} channels"),
    };
    let details = format!("{}\n{}, {channels}\n{users}", map.file.path, map.image.description());
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, &details));
    response.on_hover_text(details);
}

/// `head_diff.dds: diffuse map of soldier_head`, a line each.
fn users_of_missing(open: &OpenModel, missing: &[String]) -> String {
    let mut lines = Vec::new();
    for name in missing {
        for material in &open.model.materials {
            for slot in crate::session::MapSlot::ALL {
                if slot.name_in(material) == Some(name) {
                    lines.push(format!("{name}: {} of {}", slot.label(), material.name));
                }
            }
        }
    }
    lines.join("\n")
}
