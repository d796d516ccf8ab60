//! Lines of a file with a mark under what is meant.

use egui::text::{LayoutJob, TextFormat};
use egui::{Color32, Ui};

use super::theme::{self, CONTROL_RADIUS, Tokens};
use crate::format::Excerpt;

/// Draws the lines on a quiet ground. `heading` stands above them, `expected` beside the mark.
pub(super) fn show(ui: &mut Ui, excerpt: &Excerpt, heading_and_expected: Option<(&str, &str)>, mark_color: Color32) {
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
            egui::ScrollArea::horizontal()
                .id_salt("excerpt")
                .show(ui, |ui| ui.add(egui::Label::new(job).extend()));
        });
}
