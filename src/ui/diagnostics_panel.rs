//! Every finding about the open file, with what it is about, its place and code; a click goes there and shows the lines.

use egui::{CursorIcon, FontId, Role, Sense, Ui, WidgetInfo, vec2};

use super::UiState;
use super::excerpt;
use super::finding_goal::Goal;
use super::model_panel::PANEL_MARGIN;
use super::panel::scrolled;
use super::theme::{CONTROL_RADIUS, Tokens};
use super::widgets::{closable_heading, focus_ring, rule};
use crate::diagnostic::{Diagnostic, Severity};
use crate::format::Excerpt;
use crate::session::{Command, OpenModel, Session};

/// The finding whose lines are shown. They are read from the file once, when it is opened.
#[derive(Debug)]
pub(super) struct ShownFinding {
    finding: Diagnostic,
    excerpt: Option<Excerpt>,
}

/// The panel's contents.
pub(super) fn show(ui: &mut Ui, session: &Session, state: &mut UiState, max_height: f32, commands: &mut Vec<Command>) {
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
            for notice in session.notices() {
                finding(ui, session, open, notice, state, commands);
            }
        });
}

fn finding(
    ui: &mut Ui,
    session: &Session,
    open: &OpenModel,
    notice: &Diagnostic,
    state: &mut UiState,
    commands: &mut Vec<Command>,
) {
    let tokens = Tokens::of(ui);
    let color = match notice.severity {
        Severity::Error => tokens.error,
        Severity::Warning => tokens.warning,
        Severity::Note => tokens.accent,
    };
    let goal = notice.subject.and_then(|subject| Goal::of(session, open, subject));
    let shown = state
        .shown_finding
        .as_ref()
        .is_some_and(|shown| shown.finding == *notice);
    let mut job = egui::text::LayoutJob::default();
    job.wrap.max_width = ui.available_width() - 16.0;
    let plain = |size: f32, color| egui::TextFormat {
        font_id: FontId::proportional(size),
        color,
        ..Default::default()
    };
    job.append(&notice.message, 0.0, plain(13.0, tokens.text));
    job.append("\n", 0.0, plain(11.5, tokens.muted));
    if let Some(goal) = &goal {
        job.append(&goal.words, 0.0, plain(11.5, tokens.accent));
        job.append(" · ", 0.0, plain(11.5, tokens.muted));
    }
    let place = notice
        .position
        .map(|p| format!("line {}, column {} · ", p.line, p.column))
        .unwrap_or_default();
    job.append(&format!("{place}{}", notice.code), 0.0, plain(11.5, tokens.muted));
    let galley = ui.painter().layout_job(job);
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), galley.size().y + 12.0), Sense::click());
    let around = rect.expand2(vec2(6.0, 0.0));
    if response.hovered() || response.has_focus() || shown {
        ui.painter().rect_filled(around, CONTROL_RADIUS, tokens.field);
    }
    focus_ring(ui, around, &response);
    ui.painter().circle_filled(rect.min + vec2(4.0, 14.0), 3.0, color);
    ui.painter().galley(rect.min + vec2(16.0, 6.0), galley, tokens.text);
    let about = goal
        .as_ref()
        .map(|goal| format!("\nGo to {}", goal.words))
        .unwrap_or_default();
    let label = format!("{} {}: {}{about}", notice.severity, notice.code, notice.message);
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &label));
    let response = response.on_hover_cursor(CursorIcon::PointingHand);
    if response.clicked() {
        state.shown_finding = (!shown).then(|| ShownFinding {
            finding: notice.clone(),
            excerpt: open.excerpt(notice),
        });
        if let Some(goal) = goal.filter(|_| !shown) {
            goal.go(session, state, commands);
        }
    }
    if shown && let Some(lines) = state.shown_finding.as_ref().and_then(|shown| shown.excerpt.as_ref()) {
        ui.add_space(4.0);
        excerpt::show(ui, lines, None, color);
        ui.add_space(8.0);
    }
}
