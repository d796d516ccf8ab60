//! What the books' programs make of the file: a row of the model panel, and a line for each book above the findings, which unfolds.

use std::sync::Arc;

use egui::text::{LayoutJob, TextFormat, TextWrapping};
use egui::{Align, Color32, FontId, Galley, Margin, Rect, Response, RichText, Role, Sense, Ui, WidgetInfo, pos2, vec2};

use super::filter::color;
use super::row::{INDENT, explanation, mending, tell_fold};
use super::state::BookLines;
use crate::check::book::{Book, Limit, Verdict, converted_in_words};
use crate::diagnostic::{Severity, codes};
use crate::session::{ExportFormat, OpenModel, Session};
use crate::ui::kit::theme::Tokens;
use crate::ui::kit::wording::counted;
use crate::ui::kit::{TextButton, hint_beside, paint_fold_mark, paint_row_ground, pressed_row_height, tell_open};
use crate::ui::panels::error_card::show_excerpt;
use crate::ui::panels::export;
use crate::ui::state::{Request, UiState};

/// The row of the model panel: what the demo of the file's own book does. That the other book's reads no such file is no news. It opens the
/// findings.
pub(in crate::ui) fn show_row(ui: &mut Ui, session: &Session, state: &mut UiState) {
    let tokens = Tokens::of(ui);
    let verdicts = session.verdicts();
    let own = newest_first(verdicts).find(|verdict| !verdict.is_foreign);
    let converted = session.limits_once_converted().filter(|limits| !limits.is_empty());
    let (label, value) = match (own, converted) {
        (Some(own), _) => (own.book.label(), own.outcome.to_string()),
        (None, Some(_)) => ("Book demos", "read .m3d only; too large even converted".to_owned()),
        (None, None) => ("Book demos", "read .m3d only".to_owned()),
    };
    let color = if own.is_some_and(Verdict::is_bad) {
        tokens.warning
    } else {
        tokens.muted
    };
    let font = FontId::proportional(13.0);
    let label_galley = ui.painter().layout_no_wrap(label.to_owned(), font.clone(), tokens.text);
    let mut job = LayoutJob::simple(value.clone(), font, color, 0.0);
    job.wrap = TextWrapping::wrap_at_width(ui.available_width() - label_galley.size().x - 8.0);
    job.halign = Align::RIGHT;
    let (rect, response, galley, top) = wrapped_row(ui, job);
    ui.painter().galley(pos2(rect.min.x, top), label_galley, tokens.text);
    ui.painter().galley(pos2(rect.max.x, top), galley, color);
    let name = format!("Books: {label}: {value}");
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &name));
    tell_open(&response, state.diagnostics_open);
    let mut hint: Vec<String> = newest_first(verdicts)
        .map(|verdict| format!("{}: {}", verdict.book.label(), verdict.outcome))
        .collect();
    if hint.is_empty() {
        hint.push("The books' demos read no glTF.".to_owned());
        hint.extend(session.limits_once_converted().map(converted_in_words));
    }
    if hint_beside(response, None, &hint.join("\n")).clicked() {
        state.diagnostics_open = !state.diagnostics_open;
    }
}

/// A row to press, as high as its words, and the y at which they begin.
fn wrapped_row(ui: &mut Ui, job: LayoutJob) -> (Rect, Response, Arc<Galley>, f32) {
    let galley = ui.painter().layout_job(job);
    let one_line = pressed_row_height(ui);
    let first_middle = galley.rows.first().map_or(0.0, |row| 0.5 * row.height());
    let height = one_line + galley.size().y - 2.0 * first_middle;
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), height), Sense::click());
    paint_row_ground(ui, rect, &response, false, response.contains_pointer());
    let top = rect.min.y + 0.5 * one_line - first_middle;
    (rect, response, galley, top)
}

/// A line for each book, and below it what one sees and why while it is unfolded.
pub(super) fn show(ui: &mut Ui, session: &Session, open: &OpenModel, state: &mut UiState) {
    let mut exported_for = None;
    for (verdict, lines) in session.verdicts().iter().zip(&mut state.findings.books).rev() {
        let response = line(ui, verdict, lines.is_some());
        if tell_fold(ui, &response, lines.is_some()) {
            *lines = lines.is_none().then(|| BookLines::of(open, verdict));
        }
        if let Some(lines) = lines {
            let frame = egui::Frame::new().inner_margin(Margin {
                left: INDENT as i8,
                bottom: 8,
                ..Margin::ZERO
            });
            frame.show(ui, |ui| {
                details(ui, verdict, lines, &mut state.requests);
                if !verdict.is_shown() || !verdict.limits.is_empty() {
                    ui.add_space(8.0);
                    let name = format!("Export for this book: {}", verdict.book.label());
                    if TextButton::new("Export for this book", &name).show(ui).clicked() {
                        exported_for = Some(verdict.book);
                    }
                }
            });
        }
    }
    if let Some(book) = exported_for {
        state.export.options.format = match book {
            Book::D3d11 => ExportFormat::D3d11,
            Book::D3d12 => ExportFormat::D3d12,
        };
        state.export.options.for_book = true;
        export::open(ui, state);
    }
}

/// `the D3D12 demo shows it`, for all verdicts.
pub(super) fn who_shows(verdicts: &[Verdict]) -> String {
    if verdicts.is_empty() {
        return "the books' demos read .m3d only".to_owned();
    }
    let all: Vec<_> = newest_first(verdicts).filter(|verdict| verdict.is_shown()).collect();
    match all[..] {
        [] => "but neither book's demo shows it".to_owned(),
        [only] => format!("the {} {}", only.book.label(), only.outcome),
        [first, ..] => format!("each book's demo {}", first.outcome),
    }
}

fn newest_first(verdicts: &[Verdict]) -> impl Iterator<Item = &Verdict> {
    verdicts.iter().rev()
}

/// The colour of the worst that there is to tell. One about the other book is neutral.
fn color_of(ui: &Ui, verdict: &Verdict) -> Color32 {
    let of_limit = |limit: &Limit| codes::named(limit.code).map(|code| code.severity);
    let worst = match verdict.is_bad() {
        true => Some(Severity::Warning),
        false => verdict.limits.iter().filter_map(of_limit).max(),
    };
    let worst = worst.filter(|_| !verdict.is_foreign);
    worst.map_or(Tokens::of(ui).muted, |worst| color(ui, worst))
}

fn line(ui: &mut Ui, verdict: &Verdict, is_open: bool) -> Response {
    let tokens = Tokens::of(ui);
    let (book, mut words) = (verdict.book.label(), verdict.outcome.to_string());
    if verdict.is_shown() && !verdict.limits.is_empty() {
        words += &format!(" · {}", counted(verdict.limits.len(), "limit"));
    }
    let plain = |color| TextFormat {
        font_id: FontId::proportional(13.0),
        color,
        ..Default::default()
    };
    let mut job = LayoutJob::default();
    job.append(&format!("{book}: "), 0.0, plain(tokens.text));
    job.append(&words, 0.0, plain(tokens.muted));
    // It is the answer that people came for, so all of it is seen.
    job.wrap = TextWrapping::wrap_at_width(ui.available_width() - 2.0 * INDENT);
    let (rect, response, galley, top) = wrapped_row(ui, job);
    let y = rect.min.y + 0.5 * pressed_row_height(ui);
    ui.painter()
        .circle_filled(pos2(rect.min.x + 4.0, y), 3.0, color_of(ui, verdict));
    ui.painter().galley(pos2(rect.min.x + INDENT, top), galley, tokens.text);
    paint_fold_mark(ui.painter(), pos2(rect.max.x - 6.0, y), !is_open, tokens.muted);
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, format!("{book}: {words}")));
    response
}

/// What happens, what one sees, the lines of the file, and the limits.
fn details(ui: &mut Ui, verdict: &Verdict, lines: &BookLines, requests: &mut Vec<Request>) {
    let tokens = Tokens::of(ui);
    let words = |words: &str, color| RichText::new(words).size(12.5).color(color);
    let color = if verdict.is_bad() { tokens.warning } else { tokens.text };
    if let Some(trouble) = &verdict.trouble {
        ui.label(words(&trouble.why, tokens.text));
        if let Some(excerpt) = &lines.excerpt {
            ui.add_space(4.0);
            show_excerpt(ui, excerpt, color);
            ui.add_space(4.0);
        }
    }
    ui.add_space(2.0);
    ui.label(words(&format!("One sees: {}", verdict.shows), color));
    if verdict.trouble.is_some() {
        ui.add_space(2.0);
        explanation(ui, codes::BOOK_STOPS.name, requests);
    }
    for limit in &verdict.limits {
        ui.add_space(8.0);
        ui.label(words(&limit.message, tokens.text));
        mending(ui, limit.code, requests);
    }
}
