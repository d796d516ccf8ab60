//! The open model: counts, handedness, up axis, size, diagnostics, submeshes, textures, other models of the drop.

use egui::{Align2, Color32, FontId, Popup, Rect, Response, Role, Sense, Ui, UiBuilder, WidgetInfo, pos2, vec2};

use super::icons::Icon;
use super::panel::scrolled;
use super::skeleton::state::has_joints;
use super::state::UiState;
use super::textures;
use super::theme::{self, MARGIN, Tokens};
use super::widgets::{
    choice_row, is_touch, menu_item, paint_chip, paint_elided, paint_swatch, pressed_row, pressed_row_height, row_icon,
    rule, section_name, section_with_action, value_row,
};
use super::wording::{counted, dialect_name, grouped, measured, shortened};
use crate::diagnostic::Severity;
use crate::model::{Handedness, Submesh, UpAxis};
use crate::scene::display_color;
use crate::session::{Command, FileCommand, MapSlot, OpenModel, Session, SubmeshCommand};

/// Submeshes listed before the list scrolls.
const ROWS: f32 = 8.0;
/// From this width on a row has room for its count beside the icons.
const WIDE_ROW: f32 = 280.0;
/// Width of an icon of a row where a mouse is the pointer.
const ICON_WIDTH: f32 = 22.0;
/// Opacity of the eye of a row that nobody points at.
const FAINT_ICON: f32 = 0.4;

/// The panel's contents.
pub(super) fn show(ui: &mut Ui, session: &Session, state: &mut UiState, commands: &mut Vec<Command>) {
    let Some(open) = session.open_model() else { return };
    // With a skeleton the switch between the panel's pages is the heading.
    if !has_joints(session) {
        heading(ui);
    }
    counts(ui, open);
    space_rows(ui, session, commands);
    bounds_row(ui, open);
    diagnostics_row(ui, session, state);
    rule(ui, MARGIN);
    submesh_list(ui, session, open, state, commands);
    if session.maps().checklist().named > 0 {
        rule(ui, MARGIN);
        textures::show(ui, session, open, state);
    }
    other_models(ui, session, commands);
}

fn heading(ui: &mut Ui) {
    let (heading, _) = ui.allocate_exact_size(vec2(ui.available_width(), 22.0), Sense::hover());
    let (at, font) = (heading.left_center(), theme::semibold(13.0));
    ui.painter()
        .text(at, Align2::LEFT_CENTER, "Model", font, Tokens::of(ui).text);
    rule(ui, MARGIN);
}

fn counts(ui: &mut Ui, open: &OpenModel) {
    let model = &open.model;
    value_row(ui, "Dialect", dialect_name(open.dialect));
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
    rule(ui, MARGIN);
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
                commands.push(FileCommand::Open(file.path.clone()).into());
            }
        }
    });
}

fn diagnostics_row(ui: &mut Ui, session: &Session, state: &mut UiState) {
    let tokens = Tokens::of(ui);
    let (rect, response) = pressed_row(ui, false);
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

/// `2 warnings`, `1 note`, `none`, in the colour of the worst.
fn summary(session: &Session, tokens: &Tokens) -> (String, Color32) {
    let count = |severity| {
        session
            .diagnostics()
            .filter(|diagnostic| diagnostic.severity == severity)
            .count()
    };
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

/// The submeshes: which are drawn, which one is selected.
fn submesh_list(ui: &mut Ui, session: &Session, open: &OpenModel, state: &mut UiState, commands: &mut Vec<Command>) {
    let all_drawn = !session.submeshes().left_out().contains(&true);
    let action = (!all_drawn).then_some("Show all");
    if section_with_action(ui, "Subsets", action) {
        commands.push(SubmeshCommand::ShowAll.into());
    }
    let list = scrolled("subsets", ROWS * pressed_row_height(ui));
    list.auto_shrink([false, true]).show(ui, |ui| {
        for (index, submesh) in open.model.mesh.submeshes.iter().enumerate() {
            let submesh = SubmeshRow::new(session, index, submesh);
            if submesh.show(ui, commands) {
                state.hovered_submesh = Some(index);
            }
        }
    });
}

/// The colour of a material, linear. If its diffuse map is missing, the colour that stands in for it.
pub(super) fn shown_color(session: &Session, material: usize) -> [f32; 3] {
    let Some(values) = session.materials().get(material) else {
        return [0.0; 3];
    };
    match session.maps().image(material, MapSlot::Diffuse) {
        Some(_) => values.diffuse,
        None => display_color(material, values),
    }
}

/// One row.
struct SubmeshRow<'a> {
    index: usize,
    name: &'a str,
    triangles: String,
    color: [f32; 3],
    visible: bool,
    alone: bool,
    selected: bool,
}

impl<'a> SubmeshRow<'a> {
    fn new(session: &'a Session, index: usize, submesh: &Submesh) -> Self {
        let material = submesh.material as usize;
        let submeshes = session.submeshes();
        Self {
            index,
            name: session.materials().get(material).map_or("", |values| &values.name),
            triangles: grouped(submesh.triangle_count as usize),
            color: shown_color(session, material),
            visible: submeshes.is_visible(index),
            alone: submeshes.solo() == Some(index),
            selected: submeshes.selected() == Some(index),
        }
    }

    /// Shows it. Returns whether the pointer is over it.
    fn show(&self, ui: &mut Ui, commands: &mut Vec<Command>) -> bool {
        let tokens = Tokens::of(ui);
        let (rect, response) = pressed_row(ui, self.selected);
        let touch = is_touch(ui);
        let over = response.contains_pointer() && !touch;
        response.widget_info(|| {
            let label = format!("{}, {} triangles", self.name, self.triangles);
            WidgetInfo::selected(Role::ListItem, true, self.selected, label)
        });

        let opacity = if self.visible { 1.0 } else { 0.35 };
        paint_swatch(ui, rect.left_center() + vec2(5.0, 0.0), self.color, opacity);
        let icons_shown = over || touch || response.has_focus();
        let end = self.show_end(ui, rect, &response, icons_shown, commands);
        let color = if self.selected { tokens.accent } else { tokens.text };
        let left = rect.min.x + 18.0;
        let middle = pos2(left, rect.center().y);
        let font = FontId::proportional(13.0);
        paint_elided(
            ui.painter(),
            middle,
            self.name,
            font,
            color.gamma_multiply(opacity.max(0.55)),
            end - 6.0 - left,
        );

        if response.clicked() {
            let alone = ui.input(|input| input.modifiers.alt);
            let selected = (!self.selected).then_some(self.index);
            let asked = if alone {
                SubmeshCommand::Solo(self.index)
            } else {
                SubmeshCommand::Select(selected)
            };
            commands.push(asked.into());
        }
        over
    }

    /// The right end: the eye, faint unless the pointer is over the row or the subset is hidden; beside it the other icon under the
    /// pointer or while it is on, otherwise the count of triangles. Returns its left edge.
    fn show_end(&self, ui: &mut Ui, rect: Rect, row: &Response, all: bool, commands: &mut Vec<Command>) -> f32 {
        let width = if is_touch(ui) { rect.height() } else { ICON_WIDTH };
        let eye = if self.visible { Icon::Eye } else { Icon::EyeOff };
        let verb = if self.visible { "Hide" } else { "Show" };
        let visible = SubmeshCommand::SetVisible {
            submesh: self.index,
            visible: !self.visible,
        };
        let alone = SubmeshCommand::Solo(self.index);
        let icons = [
            (
                all || !self.visible,
                eye,
                format!("{verb} {}", self.name),
                false,
                visible,
            ),
            (
                all || self.alone,
                Icon::Solo,
                format!("Show {} alone (Alt click)", self.name),
                self.alone,
                alone,
            ),
        ];
        // Each icon has its place, whether or not the other is shown.
        let mut right = rect.max.x + if is_touch(ui) { 0.0 } else { 4.0 };
        let mut begins = right;
        for (index, (shown, icon, label, on, command)) in icons.into_iter().enumerate() {
            let place = Rect::from_min_max(pos2(right - width, rect.min.y), pos2(right, rect.max.y));
            right = place.min.x;
            // The eye is always there, so that a quick click on it is not one on the row.
            if shown || index == 0 {
                begins = right;
                let mut of_icon = ui.new_child(UiBuilder::new().id_salt(("icon", self.index, index)));
                if !shown {
                    of_icon.set_opacity(FAINT_ICON);
                }
                if row_icon(&of_icon, place, row, icon, &label, on) {
                    commands.push(command.into());
                }
            }
        }
        let is_covered = begins == right;
        if is_covered && rect.width() < WIDE_ROW {
            return begins;
        }
        let count_at = pos2(begins - if is_covered { 6.0 } else { 2.0 }, rect.center().y);
        let (font, color) = (FontId::proportional(13.0), Tokens::of(ui).muted);
        let painter = ui.painter();
        painter
            .text(count_at, Align2::RIGHT_CENTER, &self.triangles, font, color)
            .min
            .x
    }
}
