//! What keys, pointer and fingers do.

use egui::{Align2, FontId, Role, Sense, Ui, Vec2, WidgetInfo, vec2};

use super::UiState;
use super::panel::scrolled;
use super::theme::{self, ROW_HEIGHT, Tokens};
use super::widgets::{closable_heading, rule};

/// What does something, and what it does.
type Row = (&'static str, &'static str);

const TIME: &[Row] = &[
    ("Space", "play or pause"),
    ("Shift Space", "play backward"),
    ("← →", "one frame"),
    ("Shift ← →", "ten frames"),
    ("↑ ↓", "next, previous key"),
    ("Home End", "first, last frame"),
    ("I O", "range in, out"),
    ("Shift I", "no range"),
    ("[ ] \\", "slower, faster, 1×"),
    ("L", "once, loop, there and back"),
    ("C", "next clip"),
    ("Shift C", "previous clip"),
    ("Ctrl wheel", "over keys: zoom in time"),
    ("Shift wheel", "over keys: pan in time"),
];
const CAMERA: &[Row] = &[
    ("Drag", "orbit"),
    ("Right drag", "pan; middle drag too"),
    ("Right + WASD", "fly; Q E down, up"),
    ("Wheel", "zoom to the pointer"),
    ("F, Shift F", "frame the selection, all"),
    ("1 3 7", "front, right, top"),
    ("Ctrl 1 3 7", "the opposite side"),
    ("5", "orthographic"),
    ("9 0", "isometric, reset"),
];
const FINGERS: &[Row] = &[
    ("One finger", "orbit"),
    ("Two fingers", "pan and zoom"),
    ("Tap", "select what is shown"),
];
const BONES: &[Row] = &[
    ("B", "bones"),
    ("Shift B", "names of bones"),
    ("W", "weights of the bone"),
    ("K", "bind pose, clip"),
    ("F2", "name the bone"),
];
const PICTURE: &[Row] = &[
    ("T", "next view mode"),
    ("Shift T", "previous view mode"),
    ("V", "studio light, book light"),
    ("Alt drag", "turn the surroundings"),
    ("Click", "select what is shown"),
    ("Alt click", "in the list: show alone"),
    ("G", "ground grid"),
    ("Z", "wireframe"),
    ("N X", "vertex normals, axes"),
    ("R", "read the files again"),
    ("P", "save a picture"),
    ("Shift P", "with transparent ground"),
    ("?", "this table"),
    ("Esc", "close, then leave with Tab"),
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
pub(super) fn show(ui: &mut Ui, state: &mut UiState, most: Vec2, touch: bool) {
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
                        groups(ui, column);
                    });
                }
            });
        } else {
            groups(ui, if touch { LIST_BY_TOUCH } else { LIST });
        }
    });
}

fn groups(ui: &mut Ui, groups: &[&[Row]]) {
    let tokens = Tokens::of(ui);
    for group in groups {
        rule(ui, 12.0);
        for (keys, does) in *group {
            let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), ROW_HEIGHT), Sense::hover());
            let painter = ui.painter();
            let at = rect.left_center();
            painter.text(at, Align2::LEFT_CENTER, *keys, theme::mono(12.0), tokens.text);
            let at = at + vec2(112.0, 0.0);
            let font = FontId::proportional(13.0);
            painter.text(at, Align2::LEFT_CENTER, *does, font, tokens.muted);
            response.widget_info(|| WidgetInfo::labeled(Role::Label, true, format!("{keys}: {does}")));
        }
    }
}
