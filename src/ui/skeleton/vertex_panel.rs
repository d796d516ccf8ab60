//! The selected vertex: which joints move it and how much, and how it comes to its place.

use egui::{Align2, FontId, Rect, Role, Sense, Ui, WidgetInfo, pos2, vec2};

use super::joint_panel::heading;
use super::numbers::row;
use super::{SkeletonState, vertex_sum};
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
    if state.explains {
        vertex_sum::show(ui, session, state, explanation);
        return;
    }
    let digits = state.reading.digits;
    row(ui, "Bind", &digits.place(explanation.bind_position.to_array()));
    row(ui, "Place", &digits.place(explanation.position.to_array()));
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
