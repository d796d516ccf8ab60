//! The card over the view when a file could not be opened. It stays until it is dismissed or another load succeeds.

use egui::{Align, Align2, Layout, Rangef, RichText, Sense, Ui, vec2};

use super::excerpt;
use super::icons::Icon;
use super::theme::{self, Tokens};
use super::widgets::{TextButton, control_size, icon_button, rule};
use crate::session::{Command, GPU_REFUSED, LoadError, Session};

const CARD_MARGIN: f32 = 12.0;

/// The card's contents.
pub(super) fn show(ui: &mut Ui, session: &Session, error: &LoadError, commands: &mut Vec<Command>) {
    let tokens = Tokens::of(ui);
    let is_sound = error.diagnostic.code == GPU_REFUSED;
    let title = match super::wording::shortened(&error.file_name, 40) {
        name if name.is_empty() && is_sound => "The view could not be drawn".to_owned(),
        name if name.is_empty() => "Nothing to open".to_owned(),
        name => format!("{name} could not be {}", if is_sound { "drawn" } else { "read" }),
    };
    ui.horizontal(|ui| {
        let (heading, response) = ui.allocate_exact_size(vec2(ui.available_width() - 106.0, 28.0), Sense::hover());
        let clip = ui.painter().with_clip_rect(heading);
        clip.text(
            heading.left_center(),
            Align2::LEFT_CENTER,
            &title,
            theme::semibold(13.5),
            tokens.error,
        );
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, true, &title));
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            if icon_button(ui, Icon::Close, "Dismiss (Esc)", false).clicked() {
                commands.push(Command::DismissError);
            }
            let copy = TextButton::new("Copy", "Copy the error");
            let copy = copy.width(Rangef::new(control_size(ui), f32::INFINITY));
            if copy.show(ui).clicked() {
                ui.ctx().copy_text(error.to_text());
            }
        });
    });
    rule(ui, CARD_MARGIN);
    ui.label(RichText::new(&error.diagnostic.message).color(tokens.text));
    if let Some(lines) = &error.excerpt {
        ui.add_space(9.0);
        let place = error
            .diagnostic
            .position
            .map(|p| format!("{}:{}:{}", error.file_name, p.line, p.column));
        let expected = error
            .diagnostic
            .expected
            .as_ref()
            .map(|expected| format!("expected {expected}"));
        let words = (place.unwrap_or_default(), expected.unwrap_or_default());
        excerpt::show(ui, lines, Some((&words.0, &words.1)), tokens.error);
    }
    ui.add_space(9.0);
    let after = if session.open_model().is_some() {
        "The model that was open stays open."
    } else {
        "Nothing is open yet."
    };
    ui.horizontal(|ui| {
        ui.label(RichText::new(after).color(tokens.muted));
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            ui.label(
                RichText::new(error.diagnostic.code)
                    .color(tokens.faint)
                    .font(theme::mono(11.0)),
            );
        });
    });
}
