//! Top left: whose page this is, and which file is open.

use egui::{Role, Sense, Ui, WidgetInfo, vec2};

use super::theme::{self, Tokens};
use super::timeline::shortened;
use super::widgets::chip;
use crate::format::Dialect;
use crate::session::Session;

/// Name, file, dialect.
pub(super) fn show(ui: &mut Ui, session: &Session, narrow: bool) {
    let tokens = Tokens::of(ui);
    ui.horizontal_centered(|ui| {
        ui.spacing_mut().item_spacing.x = 10.0;
        text(ui, "Bindpose", theme::semibold(13.5), tokens.text);
        let Some(open) = session.open_model() else { return };
        let most = if narrow { 18 } else { 36 };
        text(
            ui,
            &shortened(open.file.base_name(), most),
            egui::FontId::proportional(13.0),
            tokens.muted,
        );
        if !narrow {
            chip(ui, dialect_name(open.dialect), tokens.muted);
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

fn text(ui: &mut Ui, text: &str, font: egui::FontId, color: egui::Color32) {
    let galley = ui.painter().layout_no_wrap(text.to_owned(), font, color);
    let (rect, response) = ui.allocate_exact_size(vec2(galley.size().x, 22.0), Sense::hover());
    let at = egui::pos2(rect.min.x, rect.center().y - galley.size().y * 0.5);
    ui.painter().galley(at, galley, color);
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, text));
}
