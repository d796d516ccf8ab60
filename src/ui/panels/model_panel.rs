//! The open model: counts, handedness, up axis, size, diagnostics, books' programs, maps, submeshes.

use egui::accesskit::HasPopup;
use egui::{Align2, Color32, FontId, Popup, Rect, Response, Role, Ui, WidgetInfo, pos2, vec2};

use super::crowd;
use super::findings;
use super::skeleton::state::has_joints;
use super::textures;
use crate::actions::Control;
use crate::diagnostic::Severity;
use crate::model::{Handedness, MapSlot, Submesh, UpAxis};
use crate::scene::display_color;
use crate::session::{Command, OpenModel, Session, SubmeshCommand};
use crate::ui::cx::Cx;
use crate::ui::kit::icons::Icon;
use crate::ui::kit::theme::{self, MARGIN, Tokens};
use crate::ui::kit::wording::{counted, grouped, measured};
use crate::ui::kit::{
    MenuLine, Row, RowList, choice_row, hint_beside, is_touch, menu_item, named, paint_chip, paint_swatch, row_icon,
    rule, section_with_action, tell_open, tell_popup, tell_push, value_row,
};
use crate::ui::state::UiState;

/// Width of an icon of a row where a mouse is the pointer.
const ICON_WIDTH: f32 = 22.0;

pub(in crate::ui) fn show(ui: &mut Ui, cx: &mut Cx<'_, UiState>) {
    let Some(open) = cx.session.open_model() else { return };
    // With a skeleton the switch between the panel's pages is the heading.
    if !has_joints(cx.session) {
        heading(ui);
    }
    counts(ui, open);
    space_rows(ui, cx.session, cx.commands);
    bounds_row(ui, open);
    diagnostics_row(ui, cx.session, cx.state);
    let has_maps = cx.session.maps().checklist().named > 0;
    let crowd = |ui: &mut Ui, cx: &mut Cx<'_, UiState>| crowd::show(ui, &mut cx.part(|state| &mut state.cost));
    // The rows of a phone are high: there the subsets come first.
    if is_touch(ui) {
        rule(ui, MARGIN);
        submesh_list(ui, cx, open);
        rule(ui, MARGIN);
        findings::show_books_row(ui, cx.session, cx.state);
        rule(ui, MARGIN);
        crowd(ui, cx);
        if has_maps {
            rule(ui, MARGIN);
            textures::show(ui, cx.session, open, cx.state);
        }
        return;
    }
    findings::show_books_row(ui, cx.session, cx.state);
    if has_maps {
        textures::show(ui, cx.session, open, cx.state);
    }
    rule(ui, MARGIN);
    crowd(ui, cx);
    rule(ui, MARGIN);
    submesh_list(ui, cx, open);
}

fn heading(ui: &mut Ui) {
    let mut heading = Row::new(ui, 22.0);
    heading.left_in(theme::semibold(13.0), "Model", Tokens::of(ui).text);
    heading.told(Role::Heading, "Model");
    rule(ui, MARGIN);
}

fn counts(ui: &mut Ui, open: &OpenModel) {
    let model = &open.model;
    let label = if open.format.dialect().is_some() {
        "Dialect"
    } else {
        "Format"
    };
    value_row(ui, label, open.format.label());
    value_row(ui, "Vertices", &grouped(model.mesh.vertex_count()));
    value_row(ui, "Triangles", &grouped(model.mesh.triangle_count()));
    value_row(ui, "Bones", &grouped(model.skeleton.joint_count()));
    value_row(ui, "Clips", &grouped(model.clips.len()));
}

fn space_rows(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let hand = match session.handedness() {
        Handedness::Left => "Left",
        Handedness::Right => "Right",
    };
    let hands = [
        ("As found", None),
        ("Left-handed", Some(Handedness::Left)),
        ("Right-handed", Some(Handedness::Right)),
    ];
    let chosen = session.handedness_override();
    let asked = found_or_chosen(ui, "Handedness", hand, &hands, chosen);
    commands.extend(asked.map(Command::SetHandedness));
    let axis = match session.up_axis() {
        UpAxis::Y => "Y",
        UpAxis::Z => "Z",
    };
    let axes = [("As found", None), ("Y up", Some(UpAxis::Y)), ("Z up", Some(UpAxis::Z))];
    let asked = found_or_chosen(ui, "Up axis", axis, &axes, session.up_axis_override());
    commands.extend(asked.map(Command::SetUpAxis));
}

/// What was found in the file, or was chosen instead, with a menu of what can be. Returns a new choice.
fn found_or_chosen<T: Copy + PartialEq>(
    ui: &mut Ui,
    label: &str,
    now: &str,
    choices: &[(&str, Option<T>)],
    chosen: Option<T>,
) -> Option<Option<T>> {
    let how = if chosen.is_some() { "chosen" } else { "found" };
    let row = choice_row(ui, label, now, how);
    let name = tell_popup(ui, &row, HasPopup::Menu);
    let mut asked = None;
    Popup::menu(&row).accessible_name(name).show(|ui| {
        ui.set_width(150.0);
        for &(label, choice) in choices {
            if menu_item(ui, label, MenuLine::Choice(chosen == choice)).clicked() {
                asked = Some(choice);
                ui.close();
            }
        }
    });
    asked
}

fn bounds_row(ui: &mut Ui, open: &OpenModel) {
    let size = open.bind_bounds.size();
    let text = format!("{} × {} × {}", measured(size.x), measured(size.y), measured(size.z));
    let (min, max) = (open.bind_bounds.min, open.bind_bounds.max);
    let corner = |v: glam::Vec3| format!("({}, {}, {})", measured(v.x), measured(v.y), measured(v.z));
    let words = format!(
        "Bind pose, in the file's axes\nfrom {}\nto {}",
        corner(min),
        corner(max)
    );
    hint_beside(value_row(ui, "Size", &text), None, &words);
}

fn diagnostics_row(ui: &mut Ui, session: &Session, state: &mut UiState) {
    let tokens = Tokens::of(ui);
    let mut row = Row::pressable(ui, false);
    row.left("Findings", tokens.text);
    let (count, color) = summary(session, &tokens);
    let right = row.rect.right_center();
    paint_chip(ui.painter(), right, Align2::RIGHT_CENTER, &count, color, tokens.field);
    let response = row.told(Role::Button, format!("Findings: {count}"));
    tell_open(&response, state.diagnostics_open);
    if hint_beside(response, None, "What was found in the file").clicked() {
        state.diagnostics_open = !state.diagnostics_open;
    }
}

/// `2 warnings`, `1 note`, `none`, in the colour of the worst.
pub(in crate::ui) fn summary(session: &Session, tokens: &Tokens) -> (String, Color32) {
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
fn submesh_list(ui: &mut Ui, cx: &mut Cx<'_, UiState>, open: &OpenModel) {
    let all_drawn = !cx.session.submeshes().left_out().contains(&true);
    let action = (!all_drawn).then_some("Show all");
    if section_with_action(ui, "Subsets", action) {
        cx.push(SubmeshCommand::ShowAll);
    }
    RowList::show(ui, "Subsets", |ui, list| {
        for (index, submesh) in open.model.mesh.submeshes.iter().enumerate() {
            let submesh = SubmeshRow::new(cx.session, index, submesh);
            if submesh.show(ui, list, cx.commands) {
                cx.state.hovered_submesh = Some(index);
            }
        }
    });
}

/// The colour of a material, linear. If its diffuse map is missing, the colour that stands in for it.
pub(in crate::ui) fn shown_color(session: &Session, material: usize) -> [f32; 3] {
    let Some(values) = session.materials().get(material) else {
        return [0.0; 3];
    };
    match session.maps().image(material, MapSlot::Diffuse) {
        Some(_) => values.base_color(),
        None => display_color(material, values),
    }
}

struct SubmeshRow<'a> {
    index: usize,
    name: &'a str,
    triangles: String,
    color: [f32; 3],
    visible: bool,
    alone: bool,
    selected: bool,
    /// The map that the colour of the swatch stands in for.
    missing_map: Option<&'a str>,
}

impl<'a> SubmeshRow<'a> {
    fn new(session: &'a Session, index: usize, submesh: &Submesh) -> Self {
        let material = submesh.material as usize;
        let submeshes = session.submeshes();
        let has_map = session.maps().image(material, MapSlot::Diffuse).is_some();
        let of_file = session.open_model().and_then(|open| open.model.materials.get(material));
        let map = of_file.and_then(|material| material.map_name(MapSlot::Diffuse));
        Self {
            index,
            name: session.submesh_name(index),
            triangles: grouped(submesh.triangle_count as usize),
            color: shown_color(session, material),
            visible: submeshes.is_visible(index),
            alone: submeshes.solo() == Some(index),
            selected: submeshes.selected() == Some(index),
            missing_map: map.filter(|_| !has_map),
        }
    }

    /// Shows it. Returns whether the pointer is over it.
    fn show(&self, ui: &mut Ui, list: &mut RowList, commands: &mut Vec<Command>) -> bool {
        let tokens = Tokens::of(ui);
        let mut row = Row::pressable(ui, self.selected);
        let (rect, over) = (row.rect, row.response.contains_pointer() && !is_touch(ui));
        row.response
            .widget_info(|| WidgetInfo::labeled(Role::ListItem, true, self.label()));
        list.row(&row.response, self.selected);
        row.response = named(row.response, Control::new("subset").at(self.index));

        let opacity = if self.visible { 1.0 } else { 0.35 };
        paint_swatch(ui, rect.left_center() + vec2(5.0, 0.0), self.color, opacity);
        row.right = self.show_end(ui, rect, &row.response, commands) - 6.0;
        row.left += 18.0;
        let color = match (self.selected, self.visible) {
            (true, _) => tokens.accent,
            (false, true) => tokens.text,
            (false, false) => tokens.muted,
        };
        row.name(self.name, color);
        let response = hint_beside(row.response, Some(rect), &self.hint());

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

    /// `Trim, 2 130 triangles, hidden`.
    fn label(&self) -> String {
        let state = match (self.visible, self.alone) {
            (false, _) => ", hidden",
            (true, true) => ", shown alone",
            (true, false) => "",
        };
        format!("{}, {} triangles{state}", self.name, self.triangles)
    }

    fn hint(&self) -> String {
        let tint = match self.missing_map {
            Some(map) => format!("\nThe map {map} is missing: a colour of its own stands in for it"),
            None => String::new(),
        };
        format!("{}{tint}", self.label())
    }

    /// The right end: the count of triangles, and the icons. They stand there all the time, so that a click meets what is drawn.
    /// Returns its left edge.
    fn show_end(&self, ui: &Ui, rect: Rect, row: &Response, commands: &mut Vec<Command>) -> f32 {
        let width = if is_touch(ui) { rect.height() } else { ICON_WIDTH };
        let right = rect.max.x + if is_touch(ui) { 0.0 } else { 4.0 };
        let place = |from_right: f32| {
            let left = right - from_right * width;
            Rect::from_x_y_ranges(left..=left + width, rect.y_range())
        };
        let label = format!("Show {} alone (Alt click)", self.name);
        let solo = row_icon(ui, place(2.0), row, Icon::Solo, &label, self.alone);
        if named(solo, Control::new("solo-subset").at(self.index)).clicked() {
            commands.push(SubmeshCommand::Solo(self.index).into());
        }
        let (eye, verb) = if self.visible {
            (Icon::Eye, "Hide")
        } else {
            (Icon::EyeOff, "Show")
        };
        let hide = row_icon(ui, place(1.0), row, eye, &format!("{verb} {}", self.name), false);
        tell_push(&hide);
        if named(hide, Control::new("hide-subset").at(self.index)).clicked() {
            let (submesh, visible) = (self.index, !self.visible);
            commands.push(SubmeshCommand::SetVisible { submesh, visible }.into());
        }
        let count_at = pos2(place(2.0).min.x - 4.0, rect.center().y);
        let (font, color) = (FontId::proportional(13.0), Tokens::of(ui).muted);
        let painter = ui.painter();
        painter
            .text(count_at, Align2::RIGHT_CENTER, &self.triangles, font, color)
            .min
            .x
    }
}
