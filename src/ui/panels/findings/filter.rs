//! Which findings are listed: chips that count and choose a severity, and a search in words and codes.

use egui::{Role, Ui, WidgetInfo};

use crate::diagnostic::{Diagnostic, Severity};
use crate::ui::kit::theme::Tokens;
use crate::ui::kit::wording::counted;
use crate::ui::kit::{pressed_chip, search_field};

/// The worst first.
const SEVERITIES: [Severity; 3] = [Severity::Error, Severity::Warning, Severity::Note];
/// With less room than this beside the chips the search is below them.
const LEAST_SEARCH: f32 = 150.0;
/// Room between the chips.
const SPACING: f32 = 6.0;

/// What the listed findings have in common.
#[derive(Debug, Default)]
pub(super) struct Filter {
    /// Only those of a severity.
    severity: Option<Severity>,
    query: String,
}

impl Filter {
    pub(super) fn of<'a>(&self, all: &[&'a Diagnostic]) -> Vec<&'a Diagnostic> {
        let words: Vec<String> = self.query.split_whitespace().map(str::to_lowercase).collect();
        let is_listed = |diagnostic: &&&Diagnostic| {
            let message = diagnostic.message.to_lowercase();
            self.severity.is_none_or(|severity| severity == diagnostic.severity)
                && words
                    .iter()
                    .all(|word| message.contains(word) || diagnostic.code.contains(word.as_str()))
        };
        all.iter().filter(is_listed).copied().collect()
    }
}

pub(super) fn show(ui: &mut Ui, all: &[&Diagnostic], filter: &mut Filter) {
    let count = |severity| all.iter().filter(|diagnostic| diagnostic.severity == severity).count();
    let mut room = 0.0;
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = SPACING;
        for severity in SEVERITIES {
            let count = count(severity);
            if count == 0 {
                // What was chosen may be mended by now.
                filter.severity = filter.severity.filter(|&chosen| chosen != severity);
                continue;
            }
            let words = counted(count, severity.as_str());
            let on = filter.severity == Some(severity);
            let chip = pressed_chip(ui, &words, color(ui, severity), on);
            chip.widget_info(|| WidgetInfo::selected(Role::Button, true, on, format!("Only {words}")));
            if chip.clicked() {
                filter.severity = (!on).then_some(severity);
            }
        }
        room = ui.available_width();
        if room >= LEAST_SEARCH {
            search(ui, &mut filter.query);
        }
    });
    if room < LEAST_SEARCH {
        ui.add_space(SPACING);
        search(ui, &mut filter.query);
    }
}

pub(super) fn color(ui: &Ui, severity: Severity) -> egui::Color32 {
    let tokens = Tokens::of(ui);
    match severity {
        Severity::Error => tokens.error,
        Severity::Warning => tokens.warning,
        Severity::Note => tokens.accent,
    }
}

fn search(ui: &mut Ui, query: &mut String) {
    search_field(ui, "Search findings", "Words or code", ui.available_width(), query);
}
