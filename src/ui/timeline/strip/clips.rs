//! The clips of the model: which one is open, which one is blended into it, and more from other files.

use egui::{Align2, FontId, Popup, Rangef, Rect, Response, Role, Sense, Ui, WidgetInfo, pos2, vec2};

use super::controls::tell_choice;
use crate::actions::{self, Control};
use crate::session::{ClipSummary, Command, DEFAULT_CROSSFADE_SECS, OpenModel, PlayCommand};
use crate::ui::cx::Cx;
use crate::ui::kit::icons::Icon;
use crate::ui::kit::theme::Tokens;
use crate::ui::kit::wording::{counted, trimmed};
use crate::ui::kit::{
    Slider, TextButton, choices, control_size, focus_ring, is_touch, named, paint_elided, paint_list_ground,
    paint_name, row_icon, section_name, section_with_action, switch_row, tell_push,
};
use crate::ui::state::{Request, UiState};
use crate::ui::window::panel::{popover_above, popover_gap, scrolled};

const WIDTH: f32 = 320.0;
/// Clips listed before the list scrolls.
const ROWS: f32 = 6.0;
/// The longest crossfade of the slider, in seconds.
const LONGEST_CROSSFADE: f32 = 2.0;

/// The button with the clip's name, and the list that it opens.
pub(in crate::ui::timeline) fn button(ui: &mut Ui, cx: &mut Cx<'_, UiState>, width: Rangef) {
    let Some(open) = cx.session.open_model() else { return };
    let name = cx.session.clip().map_or("", |clip| clip.name.as_str());
    let response = TextButton::new(name, "Clip").list().width(width).show(ui);
    tell_choice(&response, "Clip", name);
    let response = named(response, Control::new("clips"));
    let response = response.on_hover_text(format!("{name}\nNext clip: {}", actions::NEXT_CLIP.key()));
    popover_above(ui, (&response, "Clip"), WIDTH, |ui| {
        ui.spacing_mut().item_spacing.y = 2.0;
        section_name(ui, &counted(open.model.clips.len(), "clip"));
        let shown = choices(ui, "Clip", |ui| list(ui, cx, open));
        ui.add_space(4.0);
        let add = TextButton::new("Add clips…", "Add clips…").icon(Icon::Plus).show(ui);
        if named(add, Control::new("add-clips")).clicked() {
            cx.state.requests.push(Request::PickClips);
        }
        in_place(ui, cx, open);
        if open.model.clips.len() > 1 {
            popover_gap(ui);
            mixing(ui, cx, open);
        }
        if shown {
            Popup::close_all(ui.ctx());
        }
    });
}

/// A row for each clip. Returns whether one was chosen.
fn list(ui: &mut Ui, cx: &mut Cx<'_, UiState>, open: &OpenModel) -> bool {
    let mut chosen = false;
    let height = row_height(ui);
    let count = open.model.clips.len();
    let list = scrolled("clips", ROWS * (height + 2.0)).auto_shrink([false, true]);
    list.show_rows(ui, height, count, |ui, seen| {
        for (index, summary) in open.clip_list().enumerate().skip(seen.start).take(seen.len()) {
            if row(ui, cx, index, &summary) {
                cx.push(PlayCommand::SelectClip(index));
                chosen = true;
            }
        }
    });
    chosen
}

fn row_height(ui: &Ui) -> f32 {
    control_size(ui).max(40.0)
}

/// One clip: its name, below it its facts. Returns whether it was chosen.
fn row(ui: &mut Ui, cx: &mut Cx<'_, UiState>, index: usize, clip: &ClipSummary<'_>) -> bool {
    let tokens = Tokens::of(ui);
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), row_height(ui)), Sense::click());
    let on = cx.session.clip_index() == Some(index);
    paint_list_ground(ui, rect, on, response.contains_pointer() || response.has_focus());
    focus_ring(ui, rect, &response);
    let facts = format!(
        "{:.2}–{:.2} s · {} · {} a second · {}",
        clip.start_secs,
        clip.end_secs,
        counted(clip.key_count, "key"),
        trimmed(clip.keys_per_sec),
        clip.file_name,
    );
    let icon_width = if is_touch(ui) { rect.height() } else { 28.0 };
    let room = rect.width() - 14.0 - icon_width;
    let color = if on { tokens.accent } else { tokens.text };
    let at = rect.left_center() + vec2(9.0, -8.0);
    paint_name(ui.painter(), at, clip.name, FontId::proportional(13.0), color, room);
    let (at, font) = (rect.left_center() + vec2(9.0, 9.0), FontId::proportional(11.0));
    paint_elided(ui.painter(), at, &facts, font, tokens.muted, room);
    response.widget_info(|| WidgetInfo::selected(Role::RadioButton, true, on, format!("{}, {facts}", clip.name)));
    if !on {
        let place = Rect::from_min_max(pos2(rect.max.x - icon_width, rect.min.y), rect.max);
        blend_icon(ui, cx, index, clip.name, place, &response);
    }
    named(response, Control::new("clip").at(index)).clicked()
}

/// The icon that blends a clip into the open one, or ends the blend.
fn blend_icon(ui: &Ui, cx: &mut Cx<'_, UiState>, index: usize, name: &str, place: Rect, row: &Response) {
    let on = cx.session.blend().is_some_and(|blend| blend.clip == index);
    let label = if on {
        format!("End the blend with {name}")
    } else {
        format!("Blend with {name}")
    };
    let icon = row_icon(ui, place, row, Icon::Blend, &label, on);
    tell_push(&icon);
    if named(icon, Control::new("blend-clip").at(index)).clicked() {
        cx.commands.push(if on {
            PlayCommand::ClearBlend.into()
        } else {
            Command::Play(PlayCommand::SetBlend {
                clip: index,
                weight: 0.5,
            })
        });
    }
}

/// Whether the open clip stays over where it starts; nothing for one that goes nowhere.
fn in_place(ui: &mut Ui, cx: &mut Cx<'_, UiState>, open: &OpenModel) {
    let Some(index) = cx.session.clip_index() else { return };
    let Some(on) = open.clip_list().nth(index).map(|clip| clip.in_place) else {
        return;
    };
    if !on && !open.leads_away(index) {
        return;
    }
    let row = switch_row(ui, "In place", "", on).on_hover_text("What walks away walks on the spot");
    if named(row, Control::new("in-place")).clicked() {
        cx.push(PlayCommand::SetInPlace { clip: index, on: !on });
    }
}

fn mixing(ui: &mut Ui, cx: &mut Cx<'_, UiState>, open: &OpenModel) {
    let secs = cx.session.crossfade_secs();
    let text = format!("{secs:.2} s");
    let fade = Slider::new(
        ("Crossfade", Control::new("crossfade")),
        secs,
        0.0..=LONGEST_CROSSFADE,
        &text,
    )
    .reset_to(DEFAULT_CROSSFADE_SECS);
    if let Some(secs) = fade.show(ui) {
        cx.push(PlayCommand::SetCrossfade(secs));
    }
    let Some(blend) = cx.session.blend() else { return };
    let names = [cx.session.clip_index(), Some(blend.clip)].map(|clip| {
        let clip = clip.and_then(|clip| open.model.clips.get(clip));
        clip.map_or("", |clip| clip.name.as_str())
    });
    popover_gap(ui);
    if section_with_action(ui, ("Blend", Control::new("end-blend")), Some("End")) {
        cx.push(PlayCommand::ClearBlend);
    }
    let text = format!("{:.0} %", blend.weight * 100.0);
    let weight = Slider::new(("Weight", Control::new("blend-weight")), blend.weight, 0.0..=1.0, &text).reset_to(0.5);
    if let Some(weight) = weight.show(ui) {
        cx.push(PlayCommand::SetBlend {
            clip: blend.clip,
            weight,
        });
    }
    paint_clip_names(ui, names);
}

/// The names of the clips at the ends of the slider above.
fn paint_clip_names(ui: &mut Ui, [left, right]: [&str; 2]) {
    let color = Tokens::of(ui).muted;
    let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), 16.0), Sense::hover());
    let font = FontId::proportional(11.0);
    let ends = Rangef::new(rect.min.x + 90.0, rect.max.x - 56.0);
    let half = ends.span() * 0.5 - 4.0;
    let [left_at, right_at] = [ends.min, ends.max].map(|x| pos2(x, rect.center().y));
    let painter = ui.painter();
    paint_name(painter, left_at, left, font.clone(), color, half);
    let clipped = painter.with_clip_rect(Rect::from_x_y_ranges(ends.center()..=ends.max, rect.y_range()));
    clipped.text(right_at, Align2::RIGHT_CENTER, right, font, color);
}
