//! A field to search a list.

use egui::{Align2, Key, Modifiers, Role, TextEdit, Ui, WidgetInfo, vec2};

use super::control::control_size;
use crate::ui::kit::theme::Tokens;

/// Words to look for, and a hint while there are none.
pub(crate) fn search_field(ui: &mut Ui, name: &str, hint: &str, width: f32, query: &mut String) {
    let field = TextEdit::singleline(query)
        .id_salt(name)
        .hint_text(hint)
        .text_color(Tokens::of(ui).text)
        .char_limit(64)
        .margin(vec2(8.0, 6.0))
        .min_size(vec2(0.0, control_size(ui)))
        .align(Align2::LEFT_CENTER)
        .desired_width(width);
    let response = ui.add(field);
    response.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, name));
    // Esc clears the search and does nothing else.
    if response.lost_focus() && ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape)) {
        query.clear();
    }
}
