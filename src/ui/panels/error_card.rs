//! The card over the view when a file could not be opened. It stays until it is dismissed or another load succeeds.

use egui::text::{LayoutJob, TextFormat};
use egui::{Align, Color32, Id, Layout, Rangef, Rect, RichText, Role, ScrollArea, Sense, Ui, WidgetInfo, vec2};

use crate::diagnostic::{Diagnostic, codes};
use crate::format::Excerpt;
use crate::session::{Command, FileCommand, LoadError, Session};
use crate::ui::kit::icons::Icon;
use crate::ui::kit::theme::{self, CONTROL_RADIUS, MARGIN, Tokens};
use crate::ui::kit::wording::shortened;
use crate::ui::kit::{TextButton, control_size, paint_elided, push_button, rule};
use crate::ui::window::panel::scrolled;

pub(in crate::ui) fn show(ui: &mut Ui, session: &Session, error: &LoadError, commands: &mut Vec<Command>) {
    let tokens = Tokens::of(ui);
    let is_sound = error.diagnostic.code == codes::GPU_REFUSED.name;
    let title = match shortened(&error.file_name, 40) {
        name if name.is_empty() && is_sound => "The view could not be drawn".to_owned(),
        name if name.is_empty() => "Nothing to open".to_owned(),
        name => format!("{name} could not be {}", if is_sound { "drawn" } else { "read" }),
    };
    ui.horizontal(|ui| {
        let (heading, response) = ui.allocate_exact_size(vec2(ui.available_width() - 106.0, 28.0), Sense::hover());
        let (at, font) = (heading.left_center(), theme::semibold(13.5));
        paint_elided(ui.painter(), at, &title, font, tokens.error, heading.width());
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
        if let Some(at) = error.diagnostic.position {
            let mut place = format!("{}:{}:{}", error.file_name, at.line, at.column);
            if let Some(pointer) = &error.diagnostic.pointer {
                place += &format!(" · {pointer}");
            }
            ui.label(RichText::new(place).color(tokens.muted).font(theme::mono(12.0)));
            ui.add_space(4.0);
        }
        show_excerpt(ui, lines, tokens.error);
    }
    if let Some(expected) = expected_and_found(&error.diagnostic) {
        ui.add_space(6.0);
        ui.label(RichText::new(expected).color(tokens.text));
    }
    ui.add_space(9.0);
    let after = if session.open_model().is_some() {
        "The model that was open stays open."
    } else {
        "Nothing is open yet."
    };
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 12.0;
        ui.label(RichText::new(after).color(tokens.muted));
        let code = RichText::new(error.diagnostic.code);
        ui.label(code.color(tokens.faint).font(theme::mono(11.0)));
    });
}

/// What was expected and found, in a sentence.
pub(in crate::ui) fn expected_and_found(diagnostic: &Diagnostic) -> Option<String> {
    match (&diagnostic.expected, &diagnostic.found) {
        (Some(expected), Some(found)) => Some(format!("Expected {expected}, found {found}.")),
        (Some(expected), None) => Some(format!("Expected {expected}.")),
        (None, Some(found)) => Some(format!("Found {found}.")),
        (None, None) => None,
    }
}

/// Lines of a file, with a mark under the wrong part. Their numbers stay in view while the lines are scrolled.
pub(in crate::ui) fn show_excerpt(ui: &mut Ui, excerpt: &Excerpt, mark_color: Color32) {
    let tokens = Tokens::of(ui);
    let mono = |color| TextFormat {
        font_id: theme::mono(12.0),
        color,
        line_height: Some(19.0),
        ..Default::default()
    };
    let (mut numbers, mut text) = (LayoutJob::default(), LayoutJob::default());
    text.wrap.max_width = f32::INFINITY;
    let last = excerpt.lines.len().saturating_sub(1);
    for (index, (number, line)) in excerpt.numbered_lines().enumerate() {
        let end = if index == last { "" } else { "\n" };
        numbers.append(&format!("{number} |{end}"), 0.0, mono(tokens.faint));
        if index < last {
            text.append(&format!("{line}\n"), 0.0, mono(tokens.text));
            continue;
        }
        let (before, marked, after) = excerpt.marked_parts();
        text.append(before, 0.0, mono(tokens.text));
        text.append(marked, 0.0, mono(mark_color));
        text.append(after, 0.0, mono(tokens.text));
        let indent = " ".repeat(excerpt.mark_column as usize - 1);
        let mark = "^".repeat(excerpt.mark_length as usize);
        text.append(&format!("\n{indent}{mark}"), 0.0, mono(mark_color));
    }
    let frame = egui::Frame::new()
        .fill(tokens.field)
        .corner_radius(CONTROL_RADIUS)
        .inner_margin(10.0);
    frame.show(ui, |ui| {
        ui.take_available_width();
        ui.horizontal_top(|ui| {
            ui.spacing_mut().item_spacing.x = ui.fonts_mut(|fonts| fonts.glyph_width(&theme::mono(12.0), ' '));
            let words = spoken(&numbers.text, &text.text);
            let numbers = ui.fonts_mut(|fonts| fonts.layout_job(numbers));
            let (rect, _) = ui.allocate_exact_size(numbers.size(), Sense::hover());
            ui.painter().galley(rect.min, numbers, tokens.faint);
            lines(ui, excerpt, text, &words);
        });
    });
}

/// Numbers and lines in one text, as it is copied and read aloud.
fn spoken(numbers: &str, lines: &str) -> String {
    let numbers: Vec<&str> = numbers.lines().collect();
    let width = numbers.last().map_or(0, |number| number.len());
    let mut words = String::new();
    for (index, line) in lines.lines().enumerate() {
        let number = numbers.get(index).copied().unwrap_or("|");
        words += &format!("{number:>width$} {line}\n");
    }
    words.truncate(words.trim_end().len());
    words
}

/// The lines, scrolled so that the mark is in view. The person scrolls from there.
fn lines(ui: &mut Ui, excerpt: &Excerpt, text: LayoutJob, words: &str) {
    let char_width = ui.spacing().item_spacing.x;
    let shown = Id::unique(("excerpt", &text.text));
    ScrollArea::horizontal().id_salt("excerpt").show(ui, |ui| {
        let label = ui.add(egui::Label::new(text).extend());
        label.widget_info(|| WidgetInfo::labeled(Role::Label, true, words));
        let passes: u8 = ui.data(|data| data.get_temp(shown)).unwrap_or_default();
        if passes < 2 {
            ui.data_mut(|data| data.insert_temp(shown, passes + 1));
            let mark = excerpt.mark_column as usize + excerpt.mark_length as usize;
            let x = label.rect.min.x + char_width * mark as f32;
            let around = Rect::from_x_y_ranges(x - 8.0 * char_width..=x + 4.0 * char_width, label.rect.y_range());
            ui.scroll_to_rect(around, None);
        }
    });
}
