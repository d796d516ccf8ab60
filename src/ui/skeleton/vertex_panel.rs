//! The selected vertex: which joints move it and how much, and how it comes to its place.

use egui::{Align2, FontId, Rect, Role, Sense, Ui, WidgetInfo, pos2, vec2};

use super::SkeletonState;
use super::joint_panel::heading;
use super::numbers::{fitted, row, show_matrix};
use crate::anim::{ExplainedInfluence, VertexExplanation};
use crate::session::{Command, JointCommand, Session};
use crate::ui::theme::{self, CONTROL_RADIUS, MARGIN, Tokens};
use crate::ui::widgets::{
    focus_ring, is_touch, paint_elided, pressed_row_height, rule, section_name, section_with_labelled_action,
};
use crate::ui::wording::grouped;

/// Where bars begin and end, from the left and from the right.
const BAR_START: f32 = 86.0;
const BAR_END: f32 = 52.0;

/// The panel's contents.
pub(super) fn show(
    ui: &mut Ui,
    session: &Session,
    state: &mut SkeletonState,
    explanation: &VertexExplanation,
    commands: &mut Vec<Command>,
) {
    if heading_of(ui, explanation.vertex) {
        commands.push(JointCommand::SelectVertex(None).into());
    }
    rule(ui, MARGIN);
    section_name(ui, "Weights");
    if explanation.influences.is_empty() {
        let words = "No bone has weight: it stays where bind space has it.";
        ui.label(egui::RichText::new(words).color(Tokens::of(ui).muted));
    }
    for influence in &explanation.influences {
        influence_bar(ui, session, state, influence, commands);
    }
    rule(ui, MARGIN);
    let action = if state.explains {
        ("Hide", "Hide the explanation")
    } else {
        ("Explain this vertex", "Explain this vertex")
    };
    if section_with_labelled_action(ui, "Place now", Some(action)) {
        state.explains = !state.explains;
    }
    let bind = explanation.bind_position.to_array();
    row(ui, "Bind", &bind.map(|number| fitted(number, 4)));
    if state.explains {
        explain(ui, session, explanation);
    }
    let sum = explanation.position.to_array();
    row(ui, "Place", &sum.map(|number| fitted(number, 4)));
}

fn heading_of(ui: &mut Ui, vertex: u32) -> bool {
    heading(ui, &format!("Vertex {}", grouped(vertex as usize)))
}

/// A joint, a bar as long as its weight, and the weight.
fn influence_bar(
    ui: &mut Ui,
    session: &Session,
    state: &mut SkeletonState,
    influence: &ExplainedInfluence,
    commands: &mut Vec<Command>,
) {
    let tokens = Tokens::of(ui);
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), pressed_row_height(ui)), Sense::click());
    let around = rect.expand2(vec2(6.0, 0.0));
    let selected = session.joints().selected() == Some(influence.joint);
    if selected {
        ui.painter().rect_filled(around, CONTROL_RADIUS, tokens.accent_ground);
    } else if response.hovered() && !is_touch(ui) {
        ui.painter().rect_filled(around, CONTROL_RADIUS, tokens.field);
    }
    focus_ring(ui, around, &response);
    if response.contains_pointer() && !is_touch(ui) {
        state.hovered = Some(influence.joint);
    }
    let name = session.joint_label(influence.joint);
    let color = if selected { tokens.accent } else { tokens.text };
    let font = FontId::proportional(13.0);
    paint_elided(ui.painter(), rect.left_center(), &name, font, color, BAR_START - 8.0);
    let y = rect.center().y;
    let bar = |share: f32| {
        let (left, right) = (rect.min.x + BAR_START, rect.max.x - BAR_END);
        Rect::from_min_max(pos2(left, y - 2.5), pos2(left + share * (right - left), y + 2.5))
    };
    ui.painter().rect_filled(bar(1.0), 2.5, tokens.field_hovered);
    ui.painter()
        .rect_filled(bar(influence.weight.clamp(0.0, 1.0)), 2.5, tokens.accent);
    let weight = format!("{:.3}", influence.weight);
    let (right, font) = (rect.right_center(), theme::mono(11.5));
    ui.painter()
        .text(right, Align2::RIGHT_CENTER, &weight, font, tokens.text);
    response.widget_info(|| WidgetInfo::selected(Role::ListItem, true, selected, format!("{name}: weight {weight}")));
    if response.clicked() {
        commands.push(JointCommand::Select(Some(influence.joint)).into());
    }
}

/// The sum of the book's chapter with the numbers of now.
fn explain(ui: &mut Ui, session: &Session, explanation: &VertexExplanation) {
    let tokens = Tokens::of(ui);
    let words = egui::RichText::new("Each bone moves the bind place by offset · toRoot; the weighted places add up.");
    ui.label(words.color(tokens.muted).size(12.0));
    for influence in &explanation.influences {
        let name = session.joint_label(influence.joint);
        ui.add_space(6.0);
        section_name(ui, &name);
        show_matrix(ui, &format!("{name}: offset · toRoot"), &influence.final_transform);
        row(ui, "Moved", &influence.moved.to_array().map(|number| fitted(number, 4)));
        let weighted = influence.weighted.to_array().map(|number| fitted(number, 4));
        row(ui, &format!("× {:.3}", influence.weight), &weighted);
    }
    ui.add_space(6.0);
    let copy = ("Copy as text", "Copy: the sum of the vertex as text");
    if section_with_labelled_action(ui, "Sum", Some(copy)) {
        let skeleton = session.open_model().map(|open| &open.model.skeleton);
        let bone_of = |joint: crate::model::JointIndex| skeleton?.file_bones().get(joint.index()).copied();
        let name_of = |joint| session.joint_names().get(bone_of(joint)?);
        ui.ctx().copy_text(explanation.to_text(name_of));
    }
}
