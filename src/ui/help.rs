//! What the keys do.

use egui::{Align2, FontId, Sense, Ui, vec2};

use super::UiState;
use super::panel::scrolled;
use super::theme::{self, ROW_HEIGHT, Tokens};
use super::widgets::{closable_heading, rule};

/// Keys and what they do, in groups.
const KEYS: [&[(&str, &str)]; 4] = [
    &[
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
    ],
    &[
        ("Drag", "orbit"),
        ("Right drag", "pan; middle drag too"),
        ("Right + WASD", "fly; Q E down, up"),
        ("Wheel", "zoom to the pointer"),
        ("One finger", "orbit"),
        ("Two fingers", "pan and zoom"),
        ("F, Shift F", "frame the selection, all"),
        ("1 3 7", "front, right, top"),
        ("Ctrl 1 3 7", "the opposite side"),
        ("5", "orthographic"),
        ("9 0", "isometric, reset"),
    ],
    &[
        ("B", "bones"),
        ("Shift B", "names of bones"),
        ("W", "weights of the bone"),
        ("K", "bind pose, clip"),
        ("F2", "name the bone"),
    ],
    &[
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
    ],
];

/// The table.
pub(super) fn show(ui: &mut Ui, state: &mut UiState) {
    let tokens = Tokens::of(ui);
    if closable_heading(ui, "Keys") {
        state.help_open = false;
    }
    let most = ui.ctx().content_rect().height() - 160.0;
    scrolled("keys", most).show(ui, |ui| {
        for group in KEYS {
            rule(ui, 12.0);
            for (keys, does) in group {
                let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), ROW_HEIGHT), Sense::hover());
                ui.painter().text(
                    rect.left_center(),
                    Align2::LEFT_CENTER,
                    *keys,
                    theme::mono(12.0),
                    tokens.text,
                );
                let at = rect.left_center() + vec2(112.0, 0.0);
                ui.painter()
                    .text(at, Align2::LEFT_CENTER, *does, FontId::proportional(13.0), tokens.muted);
                response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, true, format!("{keys}: {does}")));
            }
        }
    });
}
