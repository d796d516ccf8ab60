//! Every finding about the open file, with its place and code; a click shows the lines.

use egui::{FontId, Role, Sense, Ui, WidgetInfo, vec2};

use super::UiState;
use super::excerpt;
use super::model_panel::PANEL_MARGIN;
use super::panel::scrolled;
use super::theme::{CONTROL_RADIUS, Tokens};
use super::widgets::{closable_heading, rule};
use crate::diagnostic::{Diagnostic, Severity};
use crate::session::{OpenModel, Session};

/// The panel's contents.
pub(super) fn show(ui: &mut Ui, session: &Session, state: &mut UiState, max_height: f32) {
    let Some(open) = session.open_model() else { return };
    let tokens = Tokens::of(ui);
    if closable_heading(ui, "Diagnostics") {
        state.diagnostics_open = false;
    }
    rule(ui, PANEL_MARGIN);
    if session.notices().next().is_none() {
        ui.label(egui::RichText::new("Nothing was mended and nothing is odd.").color(tokens.muted));
        return;
    }
    scrolled("findings", max_height)
        .auto_shrink([false, true])
        .show(ui, |ui| {
            for (index, notice) in session.notices().enumerate() {
                finding(ui, open, notice, index, state);
            }
        });
}

fn finding(ui: &mut Ui, open: &OpenModel, notice: &Diagnostic, index: usize, state: &mut UiState) {
    let tokens = Tokens::of(ui);
    let color = match notice.severity {
        Severity::Error => tokens.error,
        Severity::Warning => tokens.warning,
        Severity::Note => tokens.accent,
    };
    let shown = state.shown_finding == Some(index);
    let mut job = egui::text::LayoutJob::default();
    job.wrap.max_width = ui.available_width() - 16.0;
    let plain = |size: f32, color| egui::TextFormat {
        font_id: FontId::proportional(size),
        color,
        ..Default::default()
    };
    job.append(&notice.message, 0.0, plain(13.0, tokens.text));
    let place = notice
        .position
        .map(|p| format!("line {}, column {} · ", p.line, p.column))
        .unwrap_or_default();
    job.append(&format!("\n{place}{}", notice.code), 0.0, plain(11.5, tokens.muted));
    let galley = ui.painter().layout_job(job);
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), galley.size().y + 12.0), Sense::click());
    if response.hovered() || response.has_focus() || shown {
        ui.painter()
            .rect_filled(rect.expand2(vec2(6.0, 0.0)), CONTROL_RADIUS, tokens.field);
    }
    ui.painter().circle_filled(rect.min + vec2(4.0, 14.0), 3.0, color);
    ui.painter().galley(rect.min + vec2(16.0, 6.0), galley, tokens.text);
    let label = format!("{} {}: {}", notice.severity, notice.code, notice.message);
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &label));
    if response.clicked() {
        state.shown_finding = if shown { None } else { Some(index) };
    }
    if shown && let Some(lines) = open.excerpt(notice) {
        ui.add_space(4.0);
        excerpt::show(ui, &lines, None, color);
        ui.add_space(8.0);
    }
}
