//! What the books' programs make of the file: a row of the model panel, and a line for each book above the findings, which unfolds.

use egui::text::{LayoutJob, TextFormat, TextWrapping};
use egui::{Align2, Color32, FontId, Margin, Response, RichText, Role, Sense, Ui, WidgetInfo, pos2, vec2};

use super::filter::color;
use super::row::{INDENT, explanation, mending, tell_fold};
use super::state::BookLines;
use crate::check::book::{Limit, Verdict};
use crate::diagnostic::{Severity, codes};
use crate::session::{OpenModel, Session};
use crate::ui::error_card::show_excerpt;
use crate::ui::state::{Request, UiState};
use crate::ui::theme::Tokens;
use crate::ui::widgets::{hint_beside, paint_fold_mark, paint_row_ground, pressed_row, pressed_row_height, tell_open};

/// What a book's program does with a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Outcome {
    /// It reads it and shows it.
    Shows,
    /// It reads it, and ends before it shows anything.
    Ends,
    /// It goes wrong while it reads.
    Fails,
}

impl Outcome {
    fn of(verdict: &Verdict) -> Self {
        match (verdict.reads(), verdict.ends) {
            (true, false) => Self::Shows,
            (true, true) => Self::Ends,
            (false, _) => Self::Fails,
        }
    }

    /// In one word, after the book.
    fn word(self) -> &'static str {
        match self {
            Self::Shows => "reads",
            Self::Ends => "ends",
            Self::Fails => "fails",
        }
    }
}

/// The row of the model panel. It opens the findings.
pub(in crate::ui) fn show_row(ui: &mut Ui, session: &Session, state: &mut UiState) {
    let tokens = Tokens::of(ui);
    let verdicts = session.verdicts();
    let (rect, response) = pressed_row(ui, false);
    let words: Vec<String> = newest_first(verdicts)
        .map(|verdict| format!("{} {}", short_label(verdict), Outcome::of(verdict).word()))
        .collect();
    let value = if words.is_empty() {
        "read .m3d only".to_owned()
    } else {
        words.join(" · ")
    };
    // A file is of one book's dialect: that the other fails is no news.
    let is_shown = words.is_empty() || verdicts.iter().any(|verdict| Outcome::of(verdict) == Outcome::Shows);
    let color = if is_shown { tokens.muted } else { tokens.warning };
    let font = FontId::proportional(13.0);
    let width = |text: &str| {
        ui.painter()
            .layout_no_wrap(text.to_owned(), font.clone(), color)
            .size()
            .x
    };
    let long = "Books' programs";
    let label = if width(long) + 8.0 + width(&value) <= rect.width() {
        long
    } else {
        "Books"
    };
    let painter = ui.painter();
    painter.text(
        rect.left_center(),
        Align2::LEFT_CENTER,
        label,
        font.clone(),
        tokens.text,
    );
    painter.text(rect.right_center(), Align2::RIGHT_CENTER, &value, font, color);
    let name = format!("{long}: {}", value.replace(" ·", ","));
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &name));
    tell_open(&response, state.diagnostics_open);
    let mut hint: Vec<String> = newest_first(verdicts)
        .map(|verdict| format!("{}: {}", verdict.book.label(), in_words(verdict)))
        .collect();
    if hint.is_empty() {
        hint.push("The books' programs read no glTF.".to_owned());
    }
    if hint_beside(response, None, &hint.join("\n")).clicked() {
        state.diagnostics_open = !state.diagnostics_open;
    }
}

/// A line for each book, and below it what one sees and why while it is unfolded.
pub(super) fn show(ui: &mut Ui, session: &Session, open: &OpenModel, state: &mut UiState) {
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
            frame.show(ui, |ui| details(ui, verdict, lines, &mut state.requests));
        }
    }
}

/// `the D3D12 book's program reads it`, for all verdicts. One that reads it and then ends shows nothing.
pub(super) fn who_reads(verdicts: &[Verdict]) -> String {
    if verdicts.is_empty() {
        return "the books' programs read .m3d only".to_owned();
    }
    let all: Vec<_> = newest_first(verdicts)
        .filter(|verdict| verdict.reads() && !verdict.ends)
        .collect();
    match all[..] {
        [] => "but neither book's program shows it".to_owned(),
        [only] => format!("the {}'s program reads it", only.book.label()),
        _ => "both books' programs read it".to_owned(),
    }
}

fn newest_first(verdicts: &[Verdict]) -> impl Iterator<Item = &Verdict> {
    verdicts.iter().rev()
}

/// `D3D12`.
fn short_label(verdict: &Verdict) -> &'static str {
    let label = verdict.book.label();
    label.strip_suffix(" book").unwrap_or(label)
}

/// What one sees, after the book and a colon.
fn in_words(verdict: &Verdict) -> String {
    if verdict.trouble.is_some() || verdict.ends {
        let shows = verdict.shows.strip_suffix('.').unwrap_or(&verdict.shows);
        return match shows.strip_prefix("It ") {
            Some(ends) => ends.to_owned(),
            None => format!("shows {}", without_capital(shows)),
        };
    }
    match verdict.limits.len() {
        0 => "reads it".to_owned(),
        1 => "reads it, with 1 limit".to_owned(),
        limits => format!("reads it, with {limits} limits"),
    }
}

fn without_capital(words: &str) -> String {
    let mut letters = words.chars();
    let first = letters.next().map(|first| first.to_ascii_lowercase());
    first.into_iter().chain(letters).collect()
}

/// The colour of the worst that there is to tell.
fn color_of(ui: &Ui, verdict: &Verdict) -> Color32 {
    match Outcome::of(verdict) {
        Outcome::Fails | Outcome::Ends => color(ui, Severity::Warning),
        Outcome::Shows if verdict.limits.is_empty() => Tokens::of(ui).muted,
        Outcome::Shows => {
            let of_limit = |limit: &Limit| codes::named(limit.code).map(|code| code.severity);
            let worst = verdict.limits.iter().filter_map(of_limit).max();
            color(ui, worst.unwrap_or(Severity::Note))
        }
    }
}

fn line(ui: &mut Ui, verdict: &Verdict, is_open: bool) -> Response {
    let tokens = Tokens::of(ui);
    let (book, words) = (verdict.book.label(), in_words(verdict));
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
    let galley = ui.painter().layout_job(job);
    let one_line = pressed_row_height(ui);
    let first_middle = galley.rows.first().map_or(0.0, |row| 0.5 * row.height());
    let height = one_line + galley.size().y - 2.0 * first_middle;
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), height), Sense::click());
    paint_row_ground(ui, rect, &response, false, response.contains_pointer());
    let at = rect.left_top() + vec2(0.0, 0.5 * one_line);
    ui.painter()
        .circle_filled(at + vec2(4.0, 0.0), 3.0, color_of(ui, verdict));
    let place = at + vec2(INDENT, -first_middle);
    ui.painter().galley(place, galley, tokens.text);
    paint_fold_mark(ui.painter(), pos2(rect.max.x - 6.0, at.y), !is_open, tokens.muted);
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, format!("{book}: {words}")));
    response
}

/// What happens, what one sees, the lines of the file, and the limits.
fn details(ui: &mut Ui, verdict: &Verdict, lines: &BookLines, requests: &mut Vec<Request>) {
    let tokens = Tokens::of(ui);
    let words = |words: &str, color| RichText::new(words).size(12.5).color(color);
    if let Some(trouble) = &verdict.trouble {
        ui.label(words(&trouble.why, tokens.text));
        if let Some(excerpt) = &lines.excerpt {
            ui.add_space(4.0);
            show_excerpt(ui, excerpt, tokens.warning);
            ui.add_space(4.0);
        }
    }
    let color = if verdict.ends { tokens.warning } else { tokens.text };
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
