//! What keys, pointer and fingers do.

use egui::{Align2, FontId, Role, Sense, Ui, Vec2, WidgetInfo, pos2, vec2};

use super::UiState;
use super::panel::scrolled;
use super::theme::{self, ROW_HEIGHT, Tokens};
use super::view_modes;
use super::widgets::{closable_heading, paint_elided, rule};
use super::wording::trimmed;
use crate::anim::SkinView;
use crate::scene::{Overlay, Projection};
use crate::session::Session;

/// What does something, what it does, and what of that is in force now.
#[derive(Clone, Copy)]
struct Row {
    keys: &'static str,
    does: &'static str,
    now: fn(&Session) -> Option<String>,
}

const fn row(keys: &'static str, does: &'static str) -> Row {
    Row {
        keys,
        does,
        now: |_| None,
    }
}

impl Row {
    const fn now(self, now: fn(&Session) -> Option<String>) -> Self {
        Self { now, ..self }
    }
}

fn on(is_on: bool) -> Option<String> {
    is_on.then(|| "on".to_owned())
}

fn overlay(session: &Session, overlay: Overlay) -> Option<String> {
    on(session.look().overlays.has(overlay))
}

fn plays(session: &Session, backward: bool) -> Option<String> {
    let playback = session.playback();
    on(playback.is_playing() && playback.is_backward() == backward)
}

const TIME: &[Row] = &[
    row("Space", "play or pause").now(|session| plays(session, false)),
    row("Shift Space", "play backward").now(|session| plays(session, true)),
    row("← →", "one frame"),
    row("Shift ← →", "ten frames"),
    row("↑ ↓", "next, previous key"),
    row("Home End", "first, last frame"),
    row("I O", "range in, out").now(|session| on(session.playback().range_secs().is_some())),
    row("Shift I", "no range"),
    row("[ ] \\", "slower, faster, 1×").now(|session| Some(format!("{}×", trimmed(session.playback().speed())))),
    row("L", "next loop mode").now(|session| Some(session.playback().loop_mode().label().to_owned())),
    row("C", "next clip"),
    row("Shift C", "previous clip"),
    row("Ctrl wheel", "over keys: zoom in time"),
    row("Shift wheel", "over keys: pan in time"),
];
const CAMERA: &[Row] = &[
    row("Drag", "orbit"),
    row("Right drag", "pan; middle drag too"),
    row("Right + WASD", "fly; Q E down, up"),
    row("Wheel", "zoom to the pointer"),
    row("F, Shift F", "frame the selection, all"),
    row("1 3 7", "front, right, top"),
    row("Ctrl 1 3 7", "the opposite side"),
    row("5", "orthographic").now(|session| on(session.camera().projection == Projection::Orthographic)),
    row("9 0", "isometric, reset"),
];
const FINGERS: &[Row] = &[
    row("One finger", "orbit"),
    row("Two fingers", "pan and zoom"),
    row("Tap", "select what is shown"),
];
const BONES: &[Row] = &[
    row("B", "bones").now(|session| on(session.joints().bones_visible())),
    row("Shift B", "names of bones").now(|session| on(session.joints().labels_visible())),
    row("W", "weights of the bone").now(|session| on(session.joints().skin_view() == Some(SkinView::Weight))),
    row("K", "bind pose, clip").now(|session| on(session.bind_share() >= 1.0)),
    row("F2", "name the bone"),
];
const PICTURE: &[Row] = &[
    row("T", "view mode").now(|session| Some(view_modes::shown(session).to_owned())),
    row("Shift T", "previous view mode"),
    row("V", "the other light").now(|session| Some(session.look().light.label().to_owned())),
    row("Alt drag", "turn the surroundings"),
    row("Click", "select what is shown"),
    row("Alt click", "in the list: show alone"),
    row("G", "ground grid").now(|session| overlay(session, Overlay::Grid)),
    row("Z", "wireframe").now(|session| overlay(session, Overlay::Wireframe)),
    row("N", "vertex normals").now(|session| overlay(session, Overlay::Normals)),
    row("X", "axes").now(|session| overlay(session, Overlay::Axes)),
    row("R", "read the files again"),
    row("P", "save a picture"),
    row("Shift P", "with transparent ground"),
    row("?", "this table"),
    row("Esc", "close, then leave with Tab"),
];

/// Groups in two columns that are about as long, or all in one. Where there are fingers they come first.
const COLUMNS: [&[&[Row]]; 2] = [&[TIME, CAMERA], &[PICTURE, BONES, FINGERS]];
const COLUMNS_BY_TOUCH: [&[&[Row]]; 2] = [&[FINGERS, TIME, CAMERA], &[PICTURE, BONES]];
const LIST: &[&[Row]] = &[TIME, CAMERA, BONES, PICTURE, FINGERS];
const LIST_BY_TOUCH: &[&[Row]] = &[FINGERS, TIME, CAMERA, BONES, PICTURE];

/// Width of a column, and of what is between two.
const COLUMN_WIDTH: f32 = 280.0;
const BETWEEN: f32 = 20.0;
/// Height of the heading.
const HEADING: f32 = 40.0;

/// The table, of a size of `most`: in two columns where there is room for them, else in one that scrolls.
pub(super) fn show(ui: &mut Ui, session: &Session, state: &mut UiState, most: Vec2, touch: bool) {
    let in_two = most.x >= 2.0 * COLUMN_WIDTH + BETWEEN;
    ui.set_width(if in_two {
        2.0 * COLUMN_WIDTH + BETWEEN
    } else {
        COLUMN_WIDTH.min(most.x)
    });
    if closable_heading(ui, "Keys") {
        state.help_open = false;
    }
    scrolled("keys", most.y - HEADING).show(ui, |ui| {
        if in_two {
            ui.horizontal_top(|ui| {
                ui.spacing_mut().item_spacing.x = BETWEEN;
                for column in if touch { COLUMNS_BY_TOUCH } else { COLUMNS } {
                    ui.vertical(|ui| {
                        ui.set_width(COLUMN_WIDTH);
                        groups(ui, session, column);
                    });
                }
            });
        } else {
            groups(ui, session, if touch { LIST_BY_TOUCH } else { LIST });
        }
    });
}

fn groups(ui: &mut Ui, session: &Session, groups: &[&[Row]]) {
    let tokens = Tokens::of(ui);
    for group in groups {
        rule(ui, 12.0);
        for Row { keys, does, now } in *group {
            let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), ROW_HEIGHT), Sense::hover());
            let now = now(session);
            let painter = ui.painter();
            let at = rect.left_center();
            painter.text(at, Align2::LEFT_CENTER, *keys, theme::mono(12.0), tokens.text);
            let at = at + vec2(112.0, 0.0);
            let font = FontId::proportional(13.0);
            let does_rect = painter.text(at, Align2::LEFT_CENTER, *does, font.clone(), tokens.muted);
            if let Some(now) = &now {
                let width = painter
                    .layout_no_wrap(now.clone(), font.clone(), tokens.accent)
                    .size()
                    .x;
                let first = does_rect.max.x + 8.0;
                let at = pos2((rect.max.x - width).max(first), rect.center().y);
                paint_elided(painter, at, now, font, tokens.accent, rect.max.x - at.x);
            }
            let now = now.map_or_else(String::new, |now| format!(", now {now}"));
            response.widget_info(|| WidgetInfo::labeled(Role::Label, true, format!("{keys}: {does}{now}")));
        }
    }
}
