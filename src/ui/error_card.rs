//! The card over the view when a file could not be opened. It stays until it is dismissed or another load succeeds.

use egui::text::{LayoutJob, TextFormat};
use egui::{Align, Align2, Color32, Id, Layout, Rangef, Rect, RichText, ScrollArea, Sense, Ui, vec2};

use super::icons::Icon;
use super::panel::scrolled;
use super::theme::{self, CONTROL_RADIUS, MARGIN, Tokens};
use super::widgets::{TextButton, control_size, push_button, rule};
use super::wording::shortened;
use crate::diagnostic::codes;
use crate::format::Excerpt;
use crate::session::{Command, FileCommand, LoadError, Session};

/// The card's contents.
pub(super) fn show(ui: &mut Ui, session: &Session, error: &LoadError, commands: &mut Vec<Command>) {
    let tokens = Tokens::of(ui);
    let is_sound = error.diagnostic.code == codes::GPU_REFUSED.name;
    let title = match shortened(&error.file_name, 40) {
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
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Heading, true, &title));
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            if push_button(ui, Icon::Close, "Dismiss (Esc)").clicked() {
                commands.push(FileCommand::DismissError.into());
            }
            let copy = TextButton::new("Copy", "Copy the error");
            let copy = copy.width(Rangef::new(control_size(ui), f32::INFINITY));
            if copy.show(ui).clicked() {
                ui.ctx().copy_text(error.to_text());
            }
        });
    });
    rule(ui, MARGIN);
    scrolled("error", ui.available_height()).show(ui, |ui| body(ui, session, error));
}

/// What is below the title. It scrolls in a low window.
fn body(ui: &mut Ui, session: &Session, error: &LoadError) {
    let tokens = Tokens::of(ui);
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
        show_excerpt(ui, lines, Some((&words.0, &words.1)), tokens.error);
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

/// Lines of a file, with a mark under the wrong part. The heading stands above the lines, what was expected beside the mark.
pub(super) fn show_excerpt(
    ui: &mut Ui,
    excerpt: &Excerpt,
    heading_and_expected: Option<(&str, &str)>,
    mark_color: Color32,
) {
    let tokens = Tokens::of(ui);
    let mono = |color| TextFormat {
        font_id: theme::mono(12.0),
        color,
        line_height: Some(19.0),
        ..Default::default()
    };
    let mut job = LayoutJob::default();
    job.wrap.max_width = f32::INFINITY;
    let (heading, expected) = heading_and_expected.unwrap_or_default();
    if !heading.is_empty() {
        job.append(&format!("{heading}\n"), 0.0, mono(tokens.muted));
    }
    let last = excerpt.lines.len().saturating_sub(1);
    for (index, (number, line)) in excerpt.numbered_lines().enumerate() {
        job.append(&format!("{number} | "), 0.0, mono(tokens.faint));
        if index == last {
            let (before, marked, after) = excerpt.marked_parts();
            job.append(before, 0.0, mono(tokens.text));
            job.append(marked, 0.0, mono(mark_color));
            job.append(after, 0.0, mono(tokens.text));
            let indent = " ".repeat(excerpt.mark_column as usize - 1);
            let mark = "^".repeat(excerpt.mark_length as usize);
            let number_width = number.len();
            job.append(&format!("\n{:number_width$} | ", ""), 0.0, mono(tokens.faint));
            job.append(&format!("{indent}{mark} {expected}\n"), 0.0, mono(mark_color));
        } else {
            job.append(&format!("{line}\n"), 0.0, mono(tokens.text));
        }
    }
    let text = job.text.trim_end().len();
    job.text.truncate(text);
    if let Some(last) = job.sections.last_mut() {
        last.byte_range.end = egui::text::ByteIndex(text);
    }
    egui::Frame::new()
        .fill(tokens.field)
        .corner_radius(CONTROL_RADIUS)
        .inner_margin(10.0)
        .show(ui, |ui| {
            ui.take_available_width();
            let mark = excerpt.mark_column as usize + excerpt.mark_length as usize;
            let shown = Id::unique(("excerpt", &job.text));
            let char_width = ui.fonts_mut(|fonts| fonts.glyph_width(&theme::mono(12.0), ' '));
            ScrollArea::horizontal().id_salt("excerpt").show(ui, |ui| {
                let label = ui.add(egui::Label::new(job).extend());
                // The mark may be far to the right. It comes into view, and the person scrolls from there.
                let passes: u8 = ui.data(|data| data.get_temp(shown)).unwrap_or_default();
                if passes < 2 {
                    ui.data_mut(|data| data.insert_temp(shown, passes + 1));
                    let number = excerpt
                        .numbered_lines()
                        .last()
                        .map_or(0, |(number, _)| number.len() + 3);
                    let x = label.rect.min.x + char_width * (number + mark) as f32;
                    let around =
                        Rect::from_x_y_ranges(x - 8.0 * char_width..=x + 4.0 * char_width, label.rect.y_range());
                    ui.scroll_to_rect(around, None);
                }
            });
        });
}
