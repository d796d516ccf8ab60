//! Which costly steps of drawing are on, and which the device is too slow for.

use egui::{Align2, Color32, FontId, Response, RichText, Role, Sense, Ui, WidgetInfo, vec2};

use super::theme::{CONTROL_RADIUS, Tokens};
use super::widgets::{focus_ring, pressed_row_height, section_name};
use crate::scene::Pass;
use crate::session::{Command, PassChoice, PassState, Session};

/// The section's contents.
pub(super) fn show(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let tokens = Tokens::of(ui);
    section_name(ui, "Passes");
    let quality = session.quality();
    for pass in Pass::ALL {
        let state = quality.state(pass);
        let (words, color) = match state {
            PassState::Drawn => ("on", tokens.text),
            PassState::Off => ("off", tokens.faint),
            PassState::TooSlow => ("too slow here", tokens.warning),
        };
        let (choice, hint) = match state {
            PassState::Drawn => (PassChoice::Off, "Leave it out"),
            PassState::Off => (PassChoice::Auto, "Draw it while frames are quick"),
            PassState::TooSlow => (PassChoice::On, "Draw it however long frames take"),
        };
        if row(ui, pass.label(), words, color).on_hover_text(hint).clicked() {
            commands.push(Command::SetPass(pass, choice));
        }
    }
    if let Some(note) = note(session) {
        ui.add_space(4.0);
        let small = RichText::new(note).font(FontId::proportional(12.0));
        ui.label(small.color(tokens.warning));
    }
}

/// `Ambient occlusion is off: frames took too long`; nothing while the device keeps up.
pub(super) fn note(session: &Session) -> Option<String> {
    let quality = session.quality();
    let slow: Vec<&str> = Pass::ALL
        .into_iter()
        .filter(|&pass| quality.state(pass) == PassState::TooSlow)
        .map(Pass::label)
        .collect();
    let (last, others) = slow.split_last()?;
    let names = match others {
        [] => (*last).to_owned(),
        others => format!("{} and {}", others.join(", "), last.to_lowercase()),
    };
    let verb = if others.is_empty() { "is" } else { "are" };
    Some(format!("{names} {verb} off: frames took too long"))
}

fn row(ui: &mut Ui, label: &str, words: &str, color: Color32) -> Response {
    let tokens = Tokens::of(ui);
    let size = vec2(ui.available_width(), pressed_row_height(ui));
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    let around = rect.expand2(vec2(6.0, 0.0));
    if response.hovered() {
        ui.painter().rect_filled(around, CONTROL_RADIUS, tokens.field);
    }
    focus_ring(ui, around, &response);
    let font = FontId::proportional(13.0);
    let painter = ui.painter();
    painter.text(
        rect.left_center(),
        Align2::LEFT_CENTER,
        label,
        font.clone(),
        tokens.text,
    );
    painter.text(rect.right_center(), Align2::RIGHT_CENTER, words, font, color);
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, format!("{label}: {words}")));
    response
}
