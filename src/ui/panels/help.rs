//! What the page is for, and the table of what pointer, fingers and keys do; and a sentence for a first visit.

use egui::style::ScrollAnimation;
use egui::{
    Align2, FontId, Key, Label, Margin, Modifiers, Rangef, Rect, RichText, Role, Sense, Ui, Vec2, WidgetInfo, pos2,
    vec2,
};

use crate::actions::{self, Group};
use crate::session::Session;
use crate::ui::kit::icons::Icon;
use crate::ui::kit::theme::{self, ROW_HEIGHT, Tokens};
use crate::ui::kit::{
    Row, TextButton, arrow_steps, closable_heading, control_size, focus_ring, is_touch, paint_elided, push_button, rule,
};
use crate::ui::state::{Request, UiState};
use crate::ui::window::panel::{Panel, scrolled};

const ABOUT: [&str; 3] = [
    "Bindpose shows models with bones, plays their clips, says what is wrong with them and writes them anew.",
    "Drop .m3d, .glb, .gltf or .fbx, a folder or a .zip; maps may be DDS, PNG, JPEG, TGA or BMP.",
    "Files stay on this machine.",
];

/// Beside the table of actions.
const MOUSE: [(&str, &str); 13] = [
    ("Drag", "orbit"),
    ("Right drag", "pan; middle drag too"),
    ("Right + WASD", "fly; Q E down, up"),
    ("Wheel", "zoom to the pointer"),
    ("Ctrl wheel", "over keys: zoom in time"),
    ("Shift wheel", "over keys: pan in time"),
    ("Click", "Model tab: select a subset"),
    ("", "Skeleton tab: select a bone,"),
    ("", "on coloured skin a vertex"),
    ("Shift drop", "add clips to the model"),
    ("Cube map drop", "it becomes the sky"),
    ("Alt click", "in the list: show alone"),
    ("Alt drag", "turn the environment"),
];
const FINGERS: [(&str, &str); 5] = [
    ("One finger", "orbit"),
    ("Two fingers", "pan and zoom"),
    ("Tap", "select a bone that is drawn,"),
    ("", "on coloured skin a vertex,"),
    ("", "else a subset"),
];

/// What the pointer or fingers do, and what keys of a group do.
#[derive(Clone, Copy, Debug)]
enum Part {
    Gestures(&'static [(&'static str, &'static str)]),
    Keys(Group),
}

use Part::{Gestures, Keys};

/// Parts in two columns of about the same length, one below the other where there is room for one. By touch the second comes first.
const COLUMNS: [&[Part]; 2] = [
    &[Gestures(&MOUSE), Keys(Group::Time), Keys(Group::Bones)],
    &[Gestures(&FINGERS), Keys(Group::Camera), Keys(Group::Picture)],
];

/// Width of a column, and of the gap between two.
const COLUMN_WIDTH: f32 = 280.0;
const BETWEEN: f32 = 20.0;

/// What the page is for, what pointer and fingers do, and the keys: in two columns if there is room, otherwise in one that scrolls.
pub(in crate::ui) fn show(ui: &mut Ui, session: &Session, state: &mut UiState) {
    let columns = if is_touch(ui) {
        [COLUMNS[1], COLUMNS[0]]
    } else {
        COLUMNS
    };
    let most = ui.available_width();
    let in_two = most >= 2.0 * COLUMN_WIDTH + BETWEEN;
    ui.set_width(if in_two {
        2.0 * COLUMN_WIDTH + BETWEEN
    } else {
        COLUMN_WIDTH.min(most)
    });
    if closable_heading(ui, "Help") {
        state.help_open = false;
    }
    let scroll = list_keys(ui);
    scrolled("keys", ui.available_height()).show(ui, |ui| {
        ui.scroll_with_delta_animation(vec2(0.0, scroll), ScrollAnimation::none());
        for words in ABOUT {
            ui.add(Label::new(RichText::new(words).color(Tokens::of(ui).text)).wrap());
        }
        if in_two {
            ui.horizontal_top(|ui| {
                ui.spacing_mut().item_spacing.x = BETWEEN;
                for column in columns {
                    ui.vertical(|ui| {
                        ui.set_width(COLUMN_WIDTH);
                        parts(ui, session, column);
                    });
                }
            });
        } else {
            parts(ui, session, &columns.concat());
        }
    });
}

/// Room between the parts of the greeting.
const SPACING: f32 = 6.0;
/// The least room above the timeline in which there is a greeting.
const LEAST_ROOM: Vec2 = vec2(240.0, 160.0);

/// A sentence for somebody who has opened nothing yet, at the bottom of a room. Returns the rect that it took.
pub(in crate::ui) fn greet(ui: &Ui, state: &mut UiState, room: Rect) -> Option<Rect> {
    let words = state.greeting.clone()?;
    if room.width() < LEAST_ROOM.x || room.height() < LEAST_ROOM.y {
        return None;
    }
    let margin = Margin {
        left: 14,
        ..Margin::same(3)
    };
    let panel = Panel::new("greeting", "Welcome", Align2::CENTER_BOTTOM).margin(margin);
    Some(panel.show(ui, room, |ui| {
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = SPACING;
            let open = TextButton::new("Open…", "Choose files to open").width(Rangef::point(66.0));
            let most = ui.available_width() - 66.0 - control_size(ui) - 2.0 * SPACING;
            ui.scope(|ui| {
                ui.set_max_width(most);
                ui.add(Label::new(RichText::new(words).color(Tokens::of(ui).muted)).wrap());
            });
            if open.show(ui).clicked() {
                state.requests.push(Request::PickFiles);
            }
            if push_button(ui, Icon::Close, "Close the welcome").clicked() {
                state.greeting = None;
                state.requests.push(Request::CloseGreeting);
            }
        });
    }))
}

/// How far an arrow key scrolls, in points.
const ARROW_SCROLL: f32 = 2.0 * ROW_HEIGHT;

/// The list as a control: it takes the focus, and keys scroll it. Returns how far its contents move down.
fn list_keys(ui: &Ui) -> f32 {
    let rect = ui.available_rect_before_wrap();
    let list = ui.interact(
        rect,
        ui.scope_id().with("list of keys"),
        Sense::focusable_noninteractive(),
    );
    list.widget_info(|| WidgetInfo::labeled(Role::List, true, "Table of keys"));
    focus_ring(ui, rect, &list);
    if !list.has_focus() {
        return 0.0;
    }
    let page = 0.9 * rect.height();
    let steps = arrow_steps(ui, &list);
    let pressed = |key| ui.input_mut(|input| input.consume_key(Modifiers::NONE, key));
    let mut scroll = steps * ARROW_SCROLL;
    for (key, by) in [
        (Key::PageUp, page),
        (Key::PageDown, -page),
        (Key::Home, f32::MAX),
        (Key::End, f32::MIN),
    ] {
        if pressed(key) {
            scroll = by.clamp(-1e5, 1e5);
        }
    }
    scroll
}

fn parts(ui: &mut Ui, session: &Session, parts: &[Part]) {
    for &part in parts {
        rule(ui, 12.0);
        match part {
            Gestures(gestures) => {
                for (gesture, does) in gestures {
                    row(ui, gesture, does, None);
                }
            }
            Keys(group) => {
                for actions in actions::rows(group) {
                    let in_force = actions.iter().find_map(|action| action.in_force(session));
                    row(ui, &actions::keys_of(actions), actions[0].does, in_force.as_deref());
                }
            }
        }
    }
}

/// Keys, what they do, and the value that is on.
fn row(ui: &mut Ui, keys: &str, does: &str, in_force: Option<&str>) {
    let tokens = Tokens::of(ui);
    let mut row = Row::new(ui, ROW_HEIGHT);
    row.left_in(theme::mono(12.0), keys, tokens.text);
    row.left = row.rect.min.x + 112.0;
    row.left(does, tokens.muted);
    if let Some(in_force) = in_force {
        let (painter, font) = (ui.painter(), FontId::proportional(13.0));
        let galley = painter.layout_no_wrap(in_force.to_owned(), font.clone(), tokens.accent);
        let at = pos2((row.right - galley.size().x).max(row.left + 8.0), row.y);
        paint_elided(painter, at, in_force, font, tokens.accent, row.right - at.x);
    }
    let now = in_force.map_or_else(String::new, |in_force| format!(", now {in_force}"));
    let keys = if keys.is_empty() {
        String::new()
    } else {
        format!("{keys}: ")
    };
    row.told(Role::Label, format!("{keys}{does}{now}"));
}
