//! The maps of the open model: how many were found, which are missing, what each holds and which materials use it.

use egui::epaint::RectShape;
use egui::{Color32, FontId, Rect, Response, Role, Stroke, StrokeKind, TextureId, Ui, Vec2, pos2, vec2};

use super::thumbnails::Thumbnails;
use crate::image::{Channels, Image, ImageKind};
use crate::model::MapSlot;
use crate::session::{Checklist, OpenModel, Session, UnreadableMap, UsedMap};
use crate::ui::kit::theme::Tokens;
use crate::ui::kit::wording::{counted, grouped};
use crate::ui::kit::{Row, RowList, hint_beside, paint_fold_mark, rows_in_view, tell_node};
use crate::ui::state::UiState;

const THUMBNAIL: f32 = 30.0;
/// Height of a row with one.
const MAP_ROW_HEIGHT: f32 = 38.0;
/// Where the fold mark stands, behind the word before it.
const MARK_AT: f32 = 40.0;

/// The line that opens the list, and the list while it is open.
pub(in crate::ui) fn show(ui: &mut Ui, session: &Session, open: &OpenModel, state: &mut UiState) {
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

/// How many maps are there, and how many are not. A click opens and closes the list.
fn maps_line(ui: &mut Ui, checklist: &Checklist, is_open: &mut bool) {
    let tokens = Tokens::of(ui);
    let mut row = Row::pressable(ui, false);
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
    row.left("Maps", tokens.text);
    row.right(&shown, color);
    let mark = row.rect.left_center() + vec2(MARK_AT, 0.0);
    paint_fold_mark(ui.painter(), mark, !*is_open, tokens.muted);
    let response = row.told(Role::Button, format!("Maps: {}", all.join(", ")));
    tell_node(&response, |node| node.set_expanded(*is_open));
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
    let holds = holds(map.image);
    let details = format!("{}\n{holds}\n{users}", map.file.path);
    let thumbnail = thumbnails.of(ui.ctx(), session, map);
    picture_row(ui, thumbnail, map, &holds, &details)
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
    let outline = color.gamma_multiply(0.5);
    framed_row(ui, outline, |_, _| {}, (name, color), (words, ""), details)
}

/// A row with the thumbnail of a map, its name, and in the second line these words and its size.
pub(in crate::ui) fn picture_row(
    ui: &mut Ui,
    thumbnail: Option<TextureId>,
    map: &UsedMap<'_>,
    words: &str,
    details: &str,
) -> Response {
    let tokens = Tokens::of(ui);
    let size = format!("{}\u{2009}×\u{2009}{}", map.image.width(), map.image.height());
    let picture = |ui: &Ui, frame: Rect| {
        ui.painter().rect_filled(frame, 4.0, tokens.field);
        if let Some(texture) = thumbnail {
            let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
            ui.painter()
                .add(RectShape::filled(frame, 4.0, Color32::WHITE).with_texture(texture, whole));
        }
    };
    let name = map.file.base_name();
    framed_row(
        ui,
        tokens.hairline,
        picture,
        (name, tokens.text),
        (words, &size),
        details,
    )
}

/// A row with a frame, and beside it a name in a colour above words at both ends.
fn framed_row(
    ui: &mut Ui,
    outline: Color32,
    in_frame: impl FnOnce(&Ui, Rect),
    (name, color): (&str, Color32),
    (words, at_end): (&str, &str),
    details: &str,
) -> Response {
    let (muted, small) = (Tokens::of(ui).muted, FontId::proportional(11.0));
    let mut row = Row::new(ui, MAP_ROW_HEIGHT);
    let center = pos2(row.left + THUMBNAIL * 0.5, row.y);
    let frame = Rect::from_center_size(center, Vec2::splat(THUMBNAIL));
    in_frame(ui, frame);
    ui.painter()
        .rect_stroke(frame, 4.0, Stroke::new(1.0, outline), StrokeKind::Inside);
    row.left = frame.max.x + 8.0;
    row.y = center.y - 8.0;
    row.name(name, color);
    row.y = center.y + 8.0;
    if !at_end.is_empty() {
        row.right_in(small.clone(), at_end, muted);
        row.right -= 6.0;
    }
    row.name_in(small, words, muted);
    hint_beside(row.told(Role::ListItem, details), None, details)
}

/// Format, mips and channels: `BC1 · 10 mips · RGB`.
pub(in crate::ui) fn holds(image: &Image) -> String {
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
