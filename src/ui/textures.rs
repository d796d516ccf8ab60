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
use crate::session::{Checklist, MapSlot, OpenModel, Session, UnreadableMap, UsedMap};

/// Side of a thumbnail, in points.
const THUMBNAIL: f32 = 30.0;
/// Height of a row with one.
const MAP_ROW_HEIGHT: f32 = 38.0;

/// Missing maps that have a row before the rest is counted.
const MISSING_SHOWN: usize = 8;

/// The section's contents. Nothing for a model whose materials name no map.
pub(super) fn show(ui: &mut Ui, session: &Session, open: &OpenModel, thumbnails: &mut Thumbnails) {
    let checklist = session.maps().checklist();
    let tokens = Tokens::of(ui);
    section_name(ui, "Textures");
    count_rows(ui, checklist);
    for map in session.maps().used() {
        map_row(ui, session, open, &map, thumbnails);
    }
    for map in session.maps().unreadable() {
        unreadable_row(ui, open, &map);
    }
    for name in checklist.missing.iter().take(MISSING_SHOWN) {
        let users = users_of_name(open, name);
        let details = format!("{name} is missing\n{}", users.join("\n"));
        absent_row(ui, [name, &in_few_words(&users)], tokens.muted, &details);
    }
    if !checklist.missing.is_empty() {
        let small = |text: String| RichText::new(text).font(FontId::proportional(12.0)).color(tokens.muted);
        ui.add_space(2.0);
        if checklist.missing.len() > MISSING_SHOWN {
            ui.label(small(format!("and {} more", checklist.missing.len() - MISSING_SHOWN)));
        }
        ui.label(small("Drop them any time.".to_owned()));
    }
}

/// How many maps are there, and on the right how many are not; in rows of their own where both kinds of that are.
fn count_rows(ui: &mut Ui, checklist: &Checklist) {
    let tokens = Tokens::of(ui);
    let found = format!("{} of {} found", checklist.found(), checklist.named);
    let lacking: Vec<String> = [(&checklist.missing, "missing"), (&checklist.unreadable, "unreadable")]
        .into_iter()
        .filter(|(names, _)| !names.is_empty())
        .map(|(names, word)| format!("{} {word}", names.len()))
        .collect();
    let height = ROW_HEIGHT * lacking.len().max(1) as f32;
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), height), Sense::hover());
    let font = FontId::proportional(13.0);
    let middle_of = |row: usize| rect.min.y + ROW_HEIGHT * (row as f32 + 0.5);
    ui.painter().text(
        pos2(rect.min.x, middle_of(0)),
        Align2::LEFT_CENTER,
        &found,
        font.clone(),
        tokens.text,
    );
    for (row, words) in lacking.iter().enumerate() {
        let at = pos2(rect.max.x, middle_of(row));
        ui.painter()
            .text(at, Align2::RIGHT_CENTER, words, font.clone(), tokens.warning);
    }
    let all = std::iter::once(&found).chain(&lacking).cloned().collect::<Vec<_>>();
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, format!("Textures: {}", all.join(", "))));
}

/// One map: its thumbnail and name, below them what it holds; its users under the pointer.
fn map_row(ui: &mut Ui, session: &Session, open: &OpenModel, map: &UsedMap<'_>, thumbnails: &mut Thumbnails) {
    let users = words_for(open, map.users).join("\n");
    let details = format!("{}\n{}\n{users}", map.file.path, holds(map.image));
    let thumbnail = thumbnails.of(ui.ctx(), session, map);
    picture_row(ui, thumbnail, map.file.base_name(), map.image, &details);
}

/// A map whose file is there and damaged; what is wrong with it and its users under the pointer.
fn unreadable_row(ui: &mut Ui, open: &OpenModel, map: &UnreadableMap<'_>) {
    let users = words_for(open, map.users).join("\n");
    let words = "could not be read";
    let details = format!("{} {words}\n{}\n{users}", map.file.path, map.finding.message);
    let color = Tokens::of(ui).warning;
    absent_row(ui, [map.file.base_name(), words], color, &details);
}

/// A map that cannot be shown: an empty frame and its name in a colour, and in the second line words about it.
fn absent_row(ui: &mut Ui, [name, words]: [&str; 2], color: Color32, details: &str) {
    let tokens = Tokens::of(ui);
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), MAP_ROW_HEIGHT), Sense::hover());
    let frame = frame_in(rect);
    let outline = Stroke::new(1.0, color.gamma_multiply(0.5));
    ui.painter().rect_stroke(frame, 4.0, outline, StrokeKind::Inside);
    let left = frame.max.x + 8.0;
    for (text, size, color, y) in [(name, 13.0, color, -8.0), (words, 11.0, tokens.muted, 8.0)] {
        let at = pos2(left, rect.center().y + y);
        paint_elided(
            ui.painter(),
            at,
            text,
            FontId::proportional(size),
            color,
            rect.max.x - left,
        );
    }
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, details));
    response.on_hover_text(details);
}

/// Where the thumbnail of a row stands.
fn frame_in(row: Rect) -> Rect {
    let center = pos2(row.min.x + THUMBNAIL * 0.5, row.center().y);
    Rect::from_center_size(center, Vec2::splat(THUMBNAIL))
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
    let picture = frame_in(rect);
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

/// `diffuse map of soldier_head`, for each material that names it so.
fn users_of_name(open: &OpenModel, name: &str) -> Vec<String> {
    let materials = open.model.materials.iter().enumerate();
    let users = materials.flat_map(|(index, material)| {
        let slots = MapSlot::ALL.into_iter();
        let naming = slots.filter(move |slot| slot.name_in(material) == Some(name));
        naming.map(move |slot| (index, slot))
    });
    words_for(open, &users.collect::<Vec<_>>())
}

/// `diffuse map of soldier_head`, for each of these materials.
fn words_for(open: &OpenModel, users: &[(usize, MapSlot)]) -> Vec<String> {
    let name_of = |material: usize| {
        let material = open.model.materials.get(material);
        material.map_or("", |material| material.name.as_str())
    };
    let words = users
        .iter()
        .map(|&(material, slot)| format!("{} of {}", slot.label(), name_of(material)));
    words.collect()
}

/// The first, and how many more there are.
fn in_few_words(users: &[String]) -> String {
    match users {
        [] => String::new(),
        [only] => only.clone(),
        [first, others @ ..] => format!("{first} and {} more", others.len()),
    }
}
