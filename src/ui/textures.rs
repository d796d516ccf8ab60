//! The maps of the open model: how many were found, which are missing, what each holds and which materials use it.

use egui::epaint::RectShape;
use egui::{
    Align2, Color32, FontId, Rect, Response, Role, Sense, Stroke, StrokeKind, TextureId, Ui, Vec2, WidgetInfo, pos2,
    vec2,
};

use super::state::UiState;
use super::theme::Tokens;
use super::thumbnails::Thumbnails;
use super::widgets::{RowList, hint_beside, paint_ends, paint_fold_mark, paint_name, pressed_row};
use super::wording::{counted, grouped};
use crate::image::{Channels, Image, ImageKind};
use crate::model::MapSlot;
use crate::session::{Checklist, OpenModel, Session, UnreadableMap, UsedMap};

const THUMBNAIL: f32 = 30.0;
/// Height of a row with one.
const MAP_ROW_HEIGHT: f32 = 38.0;
/// Where the fold mark stands, behind the word before it.
const MARK_AT: f32 = 40.0;

/// The line that opens the list, and the list while it is open.
pub(super) fn show(ui: &mut Ui, session: &Session, open: &OpenModel, state: &mut UiState) {
    let maps = session.maps();
    let checklist = maps.checklist();
    maps_line(ui, checklist, &mut state.maps_open);
    if !state.maps_open {
        return;
    }
    RowList::show(ui, "Maps", |ui, list| {
        for map in maps.used() {
            list.row(&map_row(ui, session, open, &map, &mut state.thumbnails), false);
        }
        for map in maps.unreadable() {
            list.row(&unreadable_row(ui, open, &map), false);
        }
        rows_in_view(ui, MAP_ROW_HEIGHT, checklist.missing.len(), |ui, index| {
            let name = &checklist.missing[index];
            let users = users_of_name(open, name);
            let details = format!("{name} is missing\n{}", users.join("\n"));
            let color = Tokens::of(ui).muted;
            let words = format!("missing · {}", in_few_words(&users));
            list.row(&absent_row(ui, [name, &words], color, &details), false);
        });
        if !checklist.missing.is_empty() {
            let words = egui::RichText::new("Drop missing textures here at any time.").size(11.5);
            ui.label(words.color(Tokens::of(ui).muted));
        }
    });
}

/// Lays out those of some rows that are seen.
fn rows_in_view(ui: &mut Ui, height: f32, count: usize, mut row: impl FnMut(&mut Ui, usize)) {
    let (top, seen) = (ui.cursor().min.y, ui.clip_rect());
    let place = |y: f32| ((y - top) / height).clamp(0.0, count as f32);
    let (first, end) = (place(seen.min.y).floor() as usize, place(seen.max.y).ceil() as usize);
    ui.add_space(first as f32 * height);
    for index in first..end {
        row(ui, index);
    }
    ui.add_space(count.saturating_sub(end.max(first)) as f32 * height);
}

/// How many maps are there, and how many are not. A click opens and closes the list.
fn maps_line(ui: &mut Ui, checklist: &Checklist, is_open: &mut bool) {
    let tokens = Tokens::of(ui);
    let (rect, response) = pressed_row(ui, false);
    let found = format!("{} of {}", checklist.found(), checklist.named);
    let counts = [
        (checklist.missing.len(), "missing"),
        (checklist.unreadable.len(), "unreadable"),
    ];
    let absent: Vec<String> = counts
        .into_iter()
        .filter(|&(count, _)| count > 0)
        .map(|(count, what)| format!("{} {what}", grouped(count)))
        .collect();
    let all: Vec<&str> = std::iter::once(found.as_str())
        .chain(absent.iter().map(String::as_str))
        .collect();
    // The panel has room for two of the three.
    let shown = all[all.len().saturating_sub(2)..].join(", ");
    let color = if absent.is_empty() { tokens.text } else { tokens.warning };
    paint_ends(ui, rect, ("Maps", tokens.text), (&shown, color));
    let words = all.join(", ");
    let mark = rect.left_center() + vec2(MARK_AT, 0.0);
    paint_fold_mark(ui.painter(), mark, !*is_open, tokens.muted);
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, format!("Maps: {words}")));
    ui.ctx()
        .accesskit_node_builder(response.id, |node| node.set_expanded(*is_open));
    if response.clicked() {
        *is_open = !*is_open;
    }
}

/// One map: its thumbnail and name, below the name what it holds, in the tooltip its users.
fn map_row(
    ui: &mut Ui,
    session: &Session,
    open: &OpenModel,
    map: &UsedMap<'_>,
    thumbnails: &mut Thumbnails,
) -> Response {
    let users = words_for(open, map.users).join("\n");
    let details = format!("{}\n{}\n{users}", map.file.path, holds(map.image));
    let thumbnail = thumbnails.of(ui.ctx(), session, map);
    picture_row(ui, thumbnail, map.file.base_name(), map.image, &details)
}

/// A map whose file is damaged. The tooltip says why, and who uses it.
fn unreadable_row(ui: &mut Ui, open: &OpenModel, map: &UnreadableMap<'_>) -> Response {
    let users = words_for(open, map.users).join("\n");
    let words = "could not be read";
    let details = format!("{} {words}\n{}\n{users}", map.file.path, map.diagnostic.message);
    let color = Tokens::of(ui).warning;
    absent_row(ui, [map.file.base_name(), words], color, &details)
}

/// A map that cannot be shown: an empty frame and its name in a colour, and words in the second line.
fn absent_row(ui: &mut Ui, [name, words]: [&str; 2], color: Color32, details: &str) -> Response {
    let tokens = Tokens::of(ui);
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), MAP_ROW_HEIGHT), Sense::hover());
    let frame = frame_in(rect);
    let outline = Stroke::new(1.0, color.gamma_multiply(0.5));
    ui.painter().rect_stroke(frame, 4.0, outline, StrokeKind::Inside);
    let left = frame.max.x + 8.0;
    for (text, size, color, y) in [(name, 13.0, color, -8.0), (words, 11.0, tokens.muted, 8.0)] {
        let at = pos2(left, rect.center().y + y);
        paint_name(
            ui.painter(),
            at,
            text,
            FontId::proportional(size),
            color,
            rect.max.x - left,
        );
    }
    response.widget_info(|| WidgetInfo::labeled(Role::ListItem, true, details));
    hint_beside(response, None, details)
}

/// The rect of a row's thumbnail.
fn frame_in(row: Rect) -> Rect {
    let center = pos2(row.min.x + THUMBNAIL * 0.5, row.center().y);
    Rect::from_center_size(center, Vec2::splat(THUMBNAIL))
}

/// A row with the thumbnail of a map, its name, and in the second line what it holds.
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
        paint_name(ui.painter(), at, text, font, color, right - left);
    }
    response.widget_info(|| WidgetInfo::labeled(Role::ListItem, true, details));
    hint_beside(response, None, details)
}

/// Format, mips and channels: `BC1 · 10 mips · RGB`.
pub(super) fn holds(image: &Image) -> String {
    let kind = match image.kind() {
        ImageKind::Texture2d => String::new(),
        ImageKind::Cube => " cube".to_owned(),
        ImageKind::Array { slices } => format!(", 1 of {slices}"),
    };
    let mips = counted(image.file_level_count() as usize, "mip");
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
        let naming = slots.filter(move |&slot| material.map_name(slot) == Some(name));
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
