//! The maps of the open model: how many are there, which are missing, what each holds and who uses it.

use egui::epaint::RectShape;
use egui::{
    Align2, Color32, FontId, Rect, Response, RichText, Role, Sense, Stroke, StrokeKind, TextureId, Ui, Vec2,
    WidgetInfo, pos2, vec2,
};

use super::theme::{ROW_HEIGHT, Tokens};
use super::thumbnails::Thumbnails;
use super::widgets::{paint_elided, section_name};
use super::wording::counted;
use crate::image::{Channels, Image, ImageKind};
use crate::session::{OpenModel, Session, UsedMap};

/// Side of a thumbnail, in points.
const THUMBNAIL: f32 = 30.0;
/// Height of a row with one.
const MAP_ROW_HEIGHT: f32 = 38.0;

/// Missing names that are spelled out before the rest is counted.
const NAMES_SHOWN: usize = 8;

/// The section's contents. Nothing for a model whose materials name no map.
pub(super) fn show(ui: &mut Ui, session: &Session, open: &OpenModel, thumbnails: &mut Thumbnails) {
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
        map_row(ui, session, open, &map, thumbnails);
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

/// One map: its thumbnail and name, below them what it holds; its users under the pointer.
fn map_row(ui: &mut Ui, session: &Session, open: &OpenModel, map: &UsedMap<'_>, thumbnails: &mut Thumbnails) {
    let name_of = |material: usize| {
        let material = open.model.materials.get(material);
        material.map_or("", |material| material.name.as_str())
    };
    let users: Vec<String> = map
        .users
        .iter()
        .map(|&(material, slot)| format!("{} of {}", slot.label(), name_of(material)))
        .collect();
    let details = format!("{}\n{}\n{}", map.file.path, holds(map.image), users.join("\n"));
    let thumbnail = thumbnails.of(ui.ctx(), session, map);
    picture_row(ui, thumbnail, map.file.base_name(), map.image, &details);
}

/// A row with a small picture of a map, its name, and in the second line what it holds.
pub(super) fn picture_row(
    ui: &mut Ui,
    thumbnail: Option<TextureId>,
    name: &str,
    image: &Image,
    details: &str,
) -> Response {
    let tokens = Tokens::of(ui);
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), MAP_ROW_HEIGHT), Sense::hover());
    let picture = Rect::from_center_size(
        pos2(rect.min.x + THUMBNAIL * 0.5, rect.center().y),
        Vec2::splat(THUMBNAIL),
    );
    ui.painter().rect_filled(picture, 4.0, tokens.field);
    if let Some(texture) = thumbnail {
        let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
        ui.painter()
            .add(RectShape::filled(picture, 4.0, Color32::WHITE).with_texture(texture, whole));
    }
    let outline = Stroke::new(1.0, tokens.hairline);
    ui.painter().rect_stroke(picture, 4.0, outline, StrokeKind::Inside);

    let left = picture.max.x + 8.0;
    let size = format!("{}\u{2009}×\u{2009}{}", image.width(), image.height());
    let size_at = pos2(rect.max.x, rect.center().y + 8.0);
    let small = FontId::proportional(11.0);
    let painter = ui.painter();
    let drawn = painter.text(size_at, Align2::RIGHT_CENTER, size, small.clone(), tokens.muted);
    let lines = [
        (name, FontId::proportional(13.0), tokens.text, rect.max.x, -8.0),
        (&holds(image), small, tokens.muted, drawn.min.x - 6.0, 8.0),
    ];
    for (text, font, color, right, y) in lines {
        let at = pos2(left, rect.center().y + y);
        paint_elided(ui.painter(), at, text, font, color, right - left);
    }
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, details));
    response.on_hover_text(details)
}

/// Format, mips and channels: `BC1 · 10 mips · RGB`.
pub(super) fn holds(image: &Image) -> String {
    let kind = match image.kind() {
        ImageKind::Texture2d => String::new(),
        ImageKind::Cube => " cube".to_owned(),
        ImageKind::Array { slices } => format!(", 1 of {slices}"),
    };
    let mips = counted(image.level_count() as usize, "mip");
    let channels = match image.channels() {
        Channels::Grey => "grey",
        Channels::GreyAlpha => "grey, alpha",
        Channels::Alpha => "alpha",
        Channels::RedGreen => "RG",
        Channels::Rgb => "RGB",
        Channels::Rgba => "RGBA",
    };
    // Narrow spaces: the panel on the left has little room.
    format!(
        "{}{kind}\u{2009}·\u{2009}{mips}\u{2009}·\u{2009}{channels}",
        image.source()
    )
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
