//! What is open: counts, handedness, up axis, size, the count of diagnostics, subsets, textures, other models of the drop.

use egui::{Align2, Color32, FontId, Popup, Role, Sense, Ui, WidgetInfo, vec2};

use super::panel::scrolled;
use super::theme::{self, CONTROL_RADIUS, Tokens};
use super::widgets::{choice_row, menu_item, paint_chip, pressed_row_height, rule, section_name, value_row};
use super::wording::{counted, grouped, measured, shortened};
use super::{UiState, skeleton, subset_list, textures, title_bar};
use crate::diagnostic::Severity;
use crate::model::{Handedness, UpAxis};
use crate::session::{Command, OpenModel, Session};

/// Margin inside the panel.
pub(super) const PANEL_MARGIN: f32 = 12.0;

/// The panel's contents.
pub(super) fn show(ui: &mut Ui, session: &Session, state: &mut UiState, commands: &mut Vec<Command>) {
    let Some(open) = session.open_model() else { return };
    // Where there is a skeleton, the panel's pages are its heading.
    if !skeleton::has_joints(session) {
        heading(ui);
    }
    counts(ui, open);
    space_rows(ui, session, commands);
    bounds_row(ui, open);
    diagnostics_row(ui, session, state);
    rule(ui, PANEL_MARGIN);
    subset_list::show(ui, session, open, state, commands);
    if session.maps().checklist().named > 0 {
        rule(ui, PANEL_MARGIN);
        textures::show(ui, session, open, state);
    }
    other_models(ui, session, commands);
}

fn heading(ui: &mut Ui) {
    let (heading, _) = ui.allocate_exact_size(vec2(ui.available_width(), 22.0), Sense::hover());
    let (at, font) = (heading.left_center(), theme::semibold(13.0));
    ui.painter()
        .text(at, Align2::LEFT_CENTER, "Model", font, Tokens::of(ui).text);
    rule(ui, PANEL_MARGIN);
}

fn counts(ui: &mut Ui, open: &OpenModel) {
    let model = &open.model;
    value_row(ui, "Dialect", title_bar::dialect_name(open.dialect));
    value_row(ui, "Vertices", &grouped(model.mesh.vertex_count()));
    value_row(ui, "Triangles", &grouped(model.mesh.triangle_count()));
    value_row(ui, "Bones", &grouped(model.skeleton.joint_count()));
    value_row(ui, "Clips", &grouped(model.clips.len()));
}

fn space_rows(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let how = |chosen: bool| if chosen { "chosen" } else { "found" };
    let hand = |handedness| match handedness {
        Handedness::Left => "Left",
        Handedness::Right => "Right",
    };
    let chosen = session.handedness_override();
    let row = choice_row(ui, "Handedness", hand(session.handedness()), how(chosen.is_some()));
    Popup::menu(&row).show(|ui| {
        ui.set_width(150.0);
        for (label, choice) in [
            ("As found", None),
            ("Left-handed", Some(Handedness::Left)),
            ("Right-handed", Some(Handedness::Right)),
        ] {
            if menu_item(ui, label, chosen == choice).clicked() {
                commands.push(Command::SetHandedness(choice));
                ui.close();
            }
        }
    });

    let axis = |up_axis| match up_axis {
        UpAxis::Y => "Y",
        UpAxis::Z => "Z",
    };
    let chosen = session.up_axis_override();
    let row = choice_row(ui, "Up axis", axis(session.up_axis()), how(chosen.is_some()));
    Popup::menu(&row).show(|ui| {
        ui.set_width(150.0);
        for (label, choice) in [("As found", None), ("Y up", Some(UpAxis::Y)), ("Z up", Some(UpAxis::Z))] {
            if menu_item(ui, label, chosen == choice).clicked() {
                commands.push(Command::SetUpAxis(choice));
                ui.close();
            }
        }
    });
}

fn bounds_row(ui: &mut Ui, open: &OpenModel) {
    let size = open.bind_bounds.size();
    let text = format!("{} × {} × {}", measured(size.x), measured(size.y), measured(size.z));
    let (min, max) = (open.bind_bounds.min, open.bind_bounds.max);
    let corner = |v: glam::Vec3| format!("({}, {}, {})", measured(v.x), measured(v.y), measured(v.z));
    value_row(ui, "Size", &text).on_hover_text(format!(
        "Bind pose, in the file's axes\nfrom {}\nto {}",
        corner(min),
        corner(max)
    ));
}

fn other_models(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let models = session.files().models();
    if models.len() < 2 {
        return;
    }
    rule(ui, PANEL_MARGIN);
    section_name(ui, "In this drop");
    let open_path = session.open_model().map(|open| open.file.path.as_str());
    let list = scrolled("drop", 5.0 * 26.0);
    list.auto_shrink([false, true]).show(ui, |ui| {
        for file in models {
            let response = menu_item(
                ui,
                &shortened(file.base_name(), 28),
                open_path == Some(file.path.as_str()),
            );
            if response.on_hover_text(&file.path).clicked() {
                commands.push(Command::OpenFile(file.path.clone()));
            }
        }
    });
}

fn diagnostics_row(ui: &mut Ui, session: &Session, state: &mut UiState) {
    let tokens = Tokens::of(ui);
    let size = vec2(ui.available_width(), pressed_row_height(ui));
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    if response.hovered() || response.has_focus() {
        ui.painter()
            .rect_filled(rect.expand2(vec2(6.0, 0.0)), CONTROL_RADIUS, tokens.field);
    }
    let font = FontId::proportional(13.0);
    ui.painter().text(
        rect.left_center(),
        Align2::LEFT_CENTER,
        "Diagnostics",
        font,
        tokens.text,
    );
    let (count, color) = summary(session, &tokens);
    let right = rect.right_center();
    paint_chip(ui.painter(), right, Align2::RIGHT_CENTER, &count, color, tokens.field);
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, format!("Diagnostics: {count}")));
    if response.on_hover_text("What was found in the file").clicked() {
        state.diagnostics_open = !state.diagnostics_open;
    }
}

/// `2 warnings`, `1 note`, `none`, with the colour that says how bad it is.
fn summary(session: &Session, tokens: &Tokens) -> (String, Color32) {
    let count = |severity| session.notices().filter(|notice| notice.severity == severity).count();
    match (count(Severity::Warning), count(Severity::Note)) {
        (0, 0) => ("none".to_owned(), tokens.muted),
        (0, notes) => (counted(notes, "note"), tokens.muted),
        (warnings, 0) => (counted(warnings, "warning"), tokens.warning),
        (warnings, notes) => (
            format!("{}, {}", counted(warnings, "warning"), counted(notes, "note")),
            tokens.warning,
        ),
    }
}
