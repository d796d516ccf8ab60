//! The selected joint: what it hangs from, where it is now, its matrices and keys; below it the selected vertex.

use egui::{Align2, FontId, Rangef, Rect, Response, Role, Sense, Ui, Vec2, WidgetInfo, pos2, vec2};

use super::tree_row::counted_vertices;
use super::{SkeletonState, key_table, numbers, vertex_panel};
use crate::actions;
use crate::anim::JointReadout;
use crate::model::JointIndex;
use crate::session::{Command, JointCommand, Session};
use crate::ui::icons::Icon;
use crate::ui::theme::{self, CONTROL_RADIUS, MARGIN, ROW_HEIGHT, Tokens};
use crate::ui::widgets::{
    TextButton, control_size, focus_ring, icon_button, paint_elided, rule, section_with_action,
    section_with_labelled_action, segmented, switch_row, value_row,
};

/// Height of the heading, as in the panel on the left.
const HEADING_HEIGHT: f32 = 22.0;
/// Children that are listed: hundreds may hang from one joint.
const CHILDREN: usize = 12;
/// Where values begin.
const LABEL_WIDTH: f32 = 72.0;

/// What a transform is relative to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Space {
    /// The parent.
    #[default]
    Local,
    /// The model.
    Model,
}

/// The panel's contents. Nothing while nothing is selected.
pub(in crate::ui) fn show(ui: &mut Ui, session: &Session, state: &mut SkeletonState, commands: &mut Vec<Command>) {
    // Read in this pass, so it is that of the selected joint.
    let joint = state.reading.joint.take();
    let vertex = state.reading.vertex.take();
    if let Some(readout) = &joint {
        if heading(ui, &session.joint_label(readout.joint)) {
            commands.push(JointCommand::Select(None).into());
        }
        rule(ui, MARGIN);
        show_joint(ui, session, state, readout, commands);
    }
    if let Some(explanation) = &vertex {
        if joint.is_some() {
            rule(ui, MARGIN);
        }
        vertex_panel::show(ui, session, state, explanation, commands);
    }
    (state.reading.joint, state.reading.vertex) = (joint, vertex);
}

fn show_joint(
    ui: &mut Ui,
    session: &Session,
    state: &mut SkeletonState,
    readout: &JointReadout,
    commands: &mut Vec<Command>,
) {
    let joint = readout.joint;
    if section_with_action(ui, "Bone", Some(actions::NAME_BONE.label)) {
        state.rename_selected(ui, session);
    }
    value_row(ui, "Number in the file", &readout.bone.to_string());
    let counts = session.joints().vertex_counts();
    let own = counts.own.get(joint.index()).copied().unwrap_or_default();
    value_row(ui, "Moves", &counted_vertices(own));
    relatives(ui, session, state, joint, commands);

    rule(ui, MARGIN);
    let parts = match state.space {
        Space::Local => &readout.local,
        Space::Model => &readout.model,
    };
    if section_with_labelled_action(ui, "Now", Some(("Copy", "Copy: place now"))) {
        ui.ctx().copy_text(parts.to_text());
    }
    let spaces = [(Space::Local, "Local"), (Space::Model, "Model")];
    if let Some(space) = segmented(ui, "Relative to", &spaces, Some(state.space)) {
        state.space = space;
    }
    ui.add_space(4.0);
    let digits = state.reading.digits;
    numbers::show_parts(ui, parts, digits);
    let matrices = [
        ("Offset", "offset", &readout.offset),
        (
            "Final matrix",
            "finalTransform = offset · toRoot",
            &readout.final_transform,
        ),
    ];
    for (name, in_books, matrix) in matrices {
        rule(ui, MARGIN);
        let label = format!("Copy: {name}");
        if section_with_labelled_action(ui, name, Some(("Copy", &label))) {
            ui.ctx().copy_text(matrix.to_text(in_books));
        }
        numbers::show_matrix(ui, name, matrix, digits);
    }
    ui.add_space(8.0);
    let all = TextButton::new("Copy all numbers", "Copy all numbers of the bone");
    let wide = Rangef::point(ui.available_width());
    if all.width(wide).show(ui).clicked() {
        ui.ctx().copy_text(readout.to_text());
    }
    rule(ui, MARGIN);
    let trail = session.joints().trails().contains(&joint);
    if switch_row(ui, "Trail through the clip", "", trail).clicked() {
        commands.push(JointCommand::ToggleTrail(joint).into());
    }
    key_table::show(ui, session, &mut state.key_part, joint, commands);
}

/// The name, and a button that closes. Whether it was clicked.
pub(super) fn heading(ui: &mut Ui, name: &str) -> bool {
    let size = vec2(ui.available_width(), HEADING_HEIGHT);
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    let side = control_size(ui);
    let (font, most) = (theme::semibold(13.0), rect.width() - side);
    paint_elided(
        ui.painter(),
        rect.left_center(),
        name,
        font,
        Tokens::of(ui).accent,
        most,
    );
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, format!("Selected: {name}")));
    // The cross stands where the edges of the rows below end, and its field around it.
    let place = Rect::from_center_size(rect.right_center() - vec2(8.0, 0.0), Vec2::splat(side));
    // Apart from the rows, which it must not make wider.
    let mut corner = ui.new_child(egui::UiBuilder::new().max_rect(place));
    icon_button(&mut corner, Icon::Close, "Clear the selection (Esc)", false).clicked()
}

/// Parent and children as links.
fn relatives(
    ui: &mut Ui,
    session: &Session,
    state: &mut SkeletonState,
    joint: JointIndex,
    commands: &mut Vec<Command>,
) {
    let Some(open) = session.open_model() else { return };
    let parent = open.model.skeleton.parents().get(joint.index()).copied().flatten();
    let children: Vec<_> = session.joints().tree().children(joint).collect();
    match parent {
        Some(parent) => links(ui, session, state, "Parent", &[parent], commands),
        None => drop(value_row(ui, "Parent", "none, it is a root")),
    }
    match children.len() {
        0 => drop(value_row(ui, "Children", "none")),
        count if count <= CHILDREN => links(ui, session, state, "Children", &children, commands),
        count => {
            links(ui, session, state, "Children", &children[..CHILDREN], commands);
            value_row(ui, "", &format!("and {} more in the tree", count - CHILDREN));
        }
    }
}

/// A label and joints behind it, on as many lines as they need.
fn links(
    ui: &mut Ui,
    session: &Session,
    state: &mut SkeletonState,
    label: &str,
    joints: &[JointIndex],
    commands: &mut Vec<Command>,
) {
    let (left, width) = (ui.cursor().min, ui.available_width());
    let at = left + vec2(0.0, 0.5 * ROW_HEIGHT);
    let (font, color) = (FontId::proportional(13.0), Tokens::of(ui).muted);
    ui.painter().text(at, Align2::LEFT_CENTER, label, font, color);
    let place = Rect::from_min_size(left + vec2(LABEL_WIDTH, 0.0), vec2(width - LABEL_WIDTH, ROW_HEIGHT));
    let builder = egui::UiBuilder::new()
        .max_rect(place)
        .layout(egui::Layout::left_to_right(egui::Align::Min).with_main_wrap(true));
    ui.scope_builder(builder, |ui| {
        ui.spacing_mut().item_spacing = vec2(2.0, 0.0);
        for &joint in joints {
            let link = joint_link(ui, &session.joint_label(joint));
            if link.contains_pointer() {
                state.hovered = Some(joint);
            }
            if link.clicked() {
                commands.push(JointCommand::Select(Some(joint)).into());
            }
        }
    });
}

/// A joint's name that can be clicked.
fn joint_link(ui: &mut Ui, name: &str) -> Response {
    let tokens = Tokens::of(ui);
    let galley = ui
        .painter()
        .layout_no_wrap(name.to_owned(), FontId::proportional(13.0), tokens.accent);
    let width = (galley.size().x + 10.0).min(ui.max_rect().width());
    let (rect, response) = ui.allocate_exact_size(vec2(width, ROW_HEIGHT), Sense::click());
    if response.hovered() || response.has_focus() {
        ui.painter()
            .rect_filled(rect.shrink2(vec2(0.0, 1.0)), CONTROL_RADIUS, tokens.accent_ground);
    }
    focus_ring(ui, rect, &response);
    let at = pos2(rect.min.x + 5.0, rect.center().y);
    let font = FontId::proportional(13.0);
    paint_elided(ui.painter(), at, name, font, tokens.accent, width - 10.0);
    response.widget_info(|| WidgetInfo::labeled(Role::Link, true, name));
    response
}
