//! The findings of the open file: what the books' programs make of it, and all that was mended or is odd, to count, filter, search, follow
//! and take along.

mod books;
mod filter;
pub(in crate::ui) mod goal;
mod row;
pub(in crate::ui) mod state;

pub(in crate::ui) use books::show_row as show_books_row;

use std::cmp::Reverse;
use std::hash::{DefaultHasher, Hash as _, Hasher as _};

use egui::{RichText, Ui};

use crate::diagnostic::Diagnostic;
use crate::session::{OpenModel, Session};
use crate::ui::cx::Cx;
use crate::ui::kit::theme::{MARGIN, Tokens};
use crate::ui::kit::wording::{counted, counted_vertices};
use crate::ui::kit::{RowList, TextButton, closable_heading, control_size, is_touch, rule};
use crate::ui::state::{DrawerPage, Request, UiState};
use crate::ui::window::arrangement::Arrangement;
use crate::ui::window::panel::scrolled;
use row::{FindingRow, row_height};

/// Gap between the parts of the panel.
const GAP: f32 = 8.0;
/// The least height of what scrolls.
const LEAST_SCROLLED: f32 = 60.0;
/// Rows are laid out this far out of view, so that Tab and the arrow keys find the next ones.
const BEYOND_VIEW: f32 = 400.0;

/// Shows or hides them; in a narrow window in the drawer.
pub(in crate::ui) fn toggle(ui: &Ui, state: &mut UiState) {
    let is_wide = Arrangement::here(ui) == Arrangement::Wide;
    let in_drawer = state.drawer.is_some_and(DrawerPage::is_tab);
    state.diagnostics_open = !(state.diagnostics_open && (is_wide || in_drawer));
    if !is_wide {
        state.drawer = state.diagnostics_open.then_some(DrawerPage::Model);
    }
}

pub(in crate::ui) fn show(ui: &mut Ui, cx: &mut Cx<'_, UiState>) {
    let Some(open) = cx.session.open_model() else { return };
    if closable_heading(ui, "Findings") {
        cx.state.diagnostics_open = false;
    }
    rule(ui, MARGIN);
    // The rows of a phone are high: there the buttons come after them and leave them the room.
    let at_end = is_touch(ui);
    let below = if at_end { 0.0 } else { control_size(ui) + 2.0 * GAP };
    let most = (ui.available_height() - below).max(LEAST_SCROLLED);
    scrolled("findings", most).auto_shrink([false, true]).show(ui, |ui| {
        // The books' programs read no glTF.
        if !cx.session.verdicts().is_empty() {
            books::show(ui, cx.session, open, cx.state);
            rule(ui, MARGIN);
        }
        found(ui, cx, open);
        if at_end {
            take_along(ui, cx.session, cx.state);
        }
    });
    if !at_end {
        take_along(ui, cx.session, cx.state);
    }
}

/// Chips, search and rows; or that there is no finding.
fn found(ui: &mut Ui, cx: &mut Cx<'_, UiState>, open: &OpenModel) {
    let mut all: Vec<&Diagnostic> = cx.session.diagnostics().collect();
    // The worst first, and those as bad in the order of the file.
    all.sort_by_key(|diagnostic| Reverse(diagnostic.severity));
    if all.is_empty() {
        nothing_found(ui, cx.session, open);
        return;
    }
    filter::show(ui, &all, &mut cx.state.findings.filter);
    ui.add_space(GAP);
    let listed = cx.state.findings.filter.of(&all);
    if listed.is_empty() {
        ui.label(RichText::new("No finding fits what is chosen above.").color(Tokens::of(ui).muted));
    } else {
        rows(ui, cx, open, &listed);
    }
}

/// That there is no finding, and what was looked at.
fn nothing_found(ui: &mut Ui, session: &Session, open: &OpenModel) {
    let tokens = Tokens::of(ui);
    let words = format!("Nothing found; {}.", books::who_shows(session.verdicts()));
    ui.label(RichText::new(words).color(tokens.text));
    ui.add_space(2.0);
    let model = &open.model;
    let keys = model.clips.iter().map(|clip| clip.key_count).sum();
    let vertices = u32::try_from(model.mesh.vertex_count()).unwrap_or(u32::MAX);
    let looked_at = [
        counted_vertices(vertices),
        counted(model.mesh.triangle_count(), "triangle"),
        counted(model.skeleton.joint_count(), "bone"),
        counted(model.clips.len(), "clip"),
        counted(keys, "key"),
    ];
    let words = format!("Looked at: {}.", looked_at.join(", "));
    ui.label(RichText::new(words).size(12.0).color(tokens.muted));
}

/// The rows, of which only those near the view are laid out.
fn rows(ui: &mut Ui, cx: &mut Cx<'_, UiState>, open: &OpenModel, listed: &[&Diagnostic]) {
    let mut hasher = DefaultHasher::new();
    ui.available_width().to_bits().hash(&mut hasher);
    for diagnostic in listed {
        (diagnostic.code, diagnostic.position, diagnostic.message.as_str()).hash(&mut hasher);
    }
    let height_of = |diagnostic: &&Diagnostic| row_height(ui, cx.session, open, diagnostic);
    // Finding them lays out the words of all.
    let mut kept = std::mem::take(&mut cx.state.findings.heights);
    let heights = kept.of(hasher.finish(), || listed.iter().map(height_of).collect());
    let seen = ui.clip_rect().y_range();
    RowList::show(ui, "Findings", |ui, list| {
        let (mut y, mut skipped) = (ui.cursor().min.y, 0.0);
        for (index, diagnostic) in listed.iter().copied().enumerate() {
            let height = heights[index] + cx.state.findings.unfolded_height_of(diagnostic);
            if y + height < seen.min - BEYOND_VIEW || y > seen.max + BEYOND_VIEW {
                skipped += height;
                y += height;
                continue;
            }
            if skipped > 0.0 {
                ui.add_space(std::mem::take(&mut skipped));
            }
            let row = FindingRow {
                diagnostic,
                place: (index, listed.len()),
                height: heights[index],
            };
            row.show(ui, list, cx, open);
            y += height;
        }
        ui.add_space(skipped);
    });
    cx.state.findings.heights = kept;
}

/// Buttons that copy and save all of it.
fn take_along(ui: &mut Ui, session: &Session, state: &mut UiState) {
    ui.add_space(GAP);
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = GAP;
        if TextButton::new("Copy report", "Copy report").show(ui).clicked() {
            ui.ctx().copy_text(session.report());
            state.messages.say("Copied the report");
        }
        let save = TextButton::new("Save report (SARIF)", "Save report").show(ui);
        if save.on_hover_text("A file for editors and code hosts").clicked() {
            state.requests.push(Request::SaveReport);
        }
    });
}
