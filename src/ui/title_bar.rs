//! Top left: whose page this is, and which file is open.

use egui::text::{LayoutJob, TextWrapping};
use egui::{Response, Role, Sense, Ui, WidgetInfo, vec2};

use super::theme::{self, Tokens};
use super::widgets::{chip, chip_size};
use crate::format::Dialect;
use crate::session::Session;

/// Room between the words.
const SPACING: f32 = 10.0;

/// Name, file, dialect, no wider than `most`. What is too long of the file's name ends in an ellipsis.
pub(super) fn show(ui: &mut Ui, session: &Session, most: f32, with_dialect: bool) {
    let tokens = Tokens::of(ui);
    ui.horizontal_centered(|ui| {
        ui.spacing_mut().item_spacing.x = SPACING;
        let start = ui.cursor().min.x;
        text(ui, "Bindpose", theme::semibold(13.5), tokens.text, f32::INFINITY);
        let Some(open) = session.open_model() else { return };
        let dialect = dialect_name(open.dialect);
        let dialect_width = if with_dialect {
            SPACING + chip_size(ui, dialect).x
        } else {
            0.0
        };
        let room = most - (ui.cursor().min.x - start) - dialect_width;
        let font = egui::FontId::proportional(13.0);
        let name = open.file.base_name();
        text(ui, name, font, tokens.muted, room).on_hover_text(&open.file.path);
        if with_dialect {
            chip(ui, dialect, tokens.muted);
        }
    });
}

/// What people call a dialect.
pub(super) fn dialect_name(dialect: Dialect) -> &'static str {
    match dialect {
        Dialect::D3d12 => "D3D12 book",
        Dialect::D3d11 => "D3D11 book",
        Dialect::Imm => "imm exporter",
    }
}

fn text(ui: &mut Ui, text: &str, font: egui::FontId, color: egui::Color32, most: f32) -> Response {
    let mut job = LayoutJob::simple_singleline(text.to_owned(), font, color);
    job.wrap = TextWrapping::truncate_at_width(most.max(0.0));
    let galley = ui.painter().layout_job(job);
    let (rect, response) = ui.allocate_exact_size(vec2(galley.size().x, 22.0), Sense::hover());
    let at = egui::pos2(rect.min.x, rect.center().y - galley.size().y * 0.5);
    ui.painter().galley(at, galley, color);
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, text));
    response
}
