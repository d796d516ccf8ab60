//! The selected vertex: which joints move it and how much, and how its position is computed.

use egui::text::LayoutJob;
use egui::{Align2, Color32, FontId, Id, Rect, Role, Sense, Ui, WidgetInfo, pos2, vec2};
use glam::Vec3;

use super::numbers::{
    Digits, FINAL_EXPLAINED, Formula, LINE_HEIGHT, OFFSET_EXPLAINED, TO_ROOT_EXPLAINED, number_column, row,
    rule_over_numbers, show_line, show_matrix, show_meaning, show_spoken,
};
use super::state::SkeletonState;
use crate::anim::{ExplainedInfluence, VertexExplanation};
use crate::session::{JointCommand, Session};
use crate::ui::cx::Cx;
use crate::ui::kit::theme::{self, MARGIN, Tokens};
use crate::ui::kit::wording::grouped;
use crate::ui::kit::{
    Row, elided_name, explained, focus_row, is_touch, labelled, paint_fold_mark, paint_row_ground, pressed_row_height,
    rule, section_name, section_with_labelled_action, selected_heading, tell_row, walked,
};

/// Font size of formulas before numbers, and of the one above all.
const LABEL_SIZE: f32 = 12.0;
// With four terms it fills the slimmest panel.
const FORMULA_SIZE: f32 = 13.0;
/// Width of the mark before a name.
const CHEVRON_WIDTH: f32 = 14.0;
/// The least room for names before bars, and the greatest as a fraction of the row.
const NAMES_LEAST: f32 = 78.0;
const NAMES_FRACTION: f32 = 0.45;
/// Gap between names and bars, and where bars end, from the right.
const BAR_GAP: f32 = 8.0;
const BAR_END: f32 = 52.0;

pub(super) fn show(ui: &mut Ui, cx: &mut Cx<'_, SkeletonState>, explanation: &VertexExplanation) {
    let name = format!("Vertex {}", grouped(explanation.vertex as usize));
    if selected_heading(ui, &name, Tokens::of(ui).accent, None) {
        cx.push(JointCommand::SelectVertex(None));
    }
    rule(ui, MARGIN);
    let triangle = cx.session.joints().selected_triangle();
    let corners = triangle.and_then(|triangle| cx.session.open_model()?.model.mesh.triangle(triangle));
    if let (Some(triangle), Some([a, b, c])) = (triangle, corners) {
        let [triangle, a, b, c] = [triangle, a, b, c].map(|number| grouped(number as usize));
        let words = format!("First corner of triangle {triangle}, which has vertices {a}, {b} and {c}.");
        ui.label(egui::RichText::new(words).size(12.5).color(Tokens::of(ui).muted));
        ui.add_space(6.0);
    }
    section_name(ui, "Weights");
    if explanation.influences.is_empty() {
        let words = "No bone has weight: it stays where bind space has it.";
        ui.label(egui::RichText::new(words).color(Tokens::of(ui).muted));
    }
    let count = explanation.influences.len();
    if count > 0 {
        labelled(ui, Role::ListBox, "Weights of the vertex", count, |ui| {
            let names_width = names_width(ui, cx.session, explanation);
            for slot in 0..count {
                influence_bar(ui, cx, explanation, (slot, names_width));
            }
        });
    }
    rule(ui, MARGIN);
    let action = if cx.state.explains {
        ("Hide", "Hide the explanation")
    } else {
        ("Explain this vertex", "Explain this vertex")
    };
    if section_with_labelled_action(ui, "Place now", Some(action)) {
        cx.state.explains = !cx.state.explains;
    }
    if cx.state.explains {
        show_sum(ui, cx, explanation);
        return;
    }
    let digits = cx.state.reading.digits;
    row(ui, "Bind", &digits.place(explanation.bind_position.to_array()));
    row(ui, "Place", &digits.place(explanation.position.to_array()));
}

/// Room for the names before the bars: as much as the longest needs, within bounds.
fn names_width(ui: &Ui, session: &Session, explanation: &VertexExplanation) -> f32 {
    let most = (NAMES_FRACTION * ui.available_width()).max(NAMES_LEAST);
    let width_of = |influence: &ExplainedInfluence| {
        let (name, font) = (session.joint_label(influence.joint), FontId::proportional(13.0));
        elided_name(ui.painter(), &name, font, Color32::PLACEHOLDER, most)
            .size()
            .x
    };
    let widths = explanation.influences.iter().map(width_of);
    widths.fold(NAMES_LEAST, f32::max).min(most)
}

/// A joint, a bar as long as its weight, and the weight.
fn influence_bar(
    ui: &mut Ui,
    cx: &mut Cx<'_, SkeletonState>,
    explanation: &VertexExplanation,
    (slot, names_width): (usize, f32),
) {
    let tokens = Tokens::of(ui);
    let influence = &explanation.influences[slot];
    let selected = cx.session.joints().selected() == Some(influence.joint);
    let size = vec2(ui.available_width(), pressed_row_height(ui));
    let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
    let id_of = |slot: usize| Id::unique("weight").with((ui.layer_id(), slot));
    let response = ui.interact(rect, id_of(slot), Sense::click());
    paint_row_ground(ui, rect, &response, selected, response.contains_pointer());
    if response.contains_pointer() && !is_touch(ui) {
        cx.state.hovered = Some(influence.joint);
    }
    let name = cx.session.joint_label(influence.joint);
    let color = if selected { tokens.accent } else { tokens.text };
    let mut row = Row::of(ui, rect, response);
    let weight = format!("{:.3}", influence.weight);
    row.right_in(theme::mono(11.5), &weight, tokens.text);
    row.right = row.left + names_width;
    row.name(&name, color);
    let (response, y) = (row.response, row.y);
    let bar = |fraction: f32| {
        let (left, right) = (row.right + BAR_GAP, rect.max.x - BAR_END);
        Rect::from_min_max(pos2(left, y - 2.5), pos2(left + fraction * (right - left), y + 2.5))
    };
    ui.painter().rect_filled(bar(1.0), 2.5, tokens.field_hovered);
    ui.painter()
        .rect_filled(bar(influence.weight.clamp(0.0, 1.0)), 2.5, tokens.accent);
    let label = format!("{name}: weight {weight}");
    if tell_row(ui, &response, Role::ListBoxOption, &label, slot, selected) {
        focus_row(ui, response.id, rect);
    }
    let count = explanation.influences.len();
    if let Some(to) = walked(ui, response.id, slot, count, count) {
        let below = vec2(0.0, (to as f32 - slot as f32) * rect.height());
        focus_row(ui, id_of(to), rect.translate(below));
    }
    if response.clicked() {
        // The vertex stays selected beside its bone.
        cx.push(JointCommand::Select(Some(influence.joint)));
        cx.push(JointCommand::SelectVertex(Some(explanation.vertex)));
    }
}

/// The book's formula for one vertex with its present numbers, step by step: `v' = w0·v·F0 + w1·v·F1 + …` with `F = offset · toRoot`,
/// row vectors. One line for the bind position, two for each influence (or all its matrices), one for the sum.
fn show_sum(ui: &mut Ui, cx: &mut Cx<'_, SkeletonState>, explanation: &VertexExplanation) {
    let tokens = Tokens::of(ui);
    let digits = cx.state.reading.digits;
    show_formula(ui, explanation.influences.len());
    ui.add_space(4.0);
    let label = Formula::new(LABEL_SIZE, tokens.muted).plain("Bind place ").bold("v");
    let bind = explanation.bind_position.to_array();
    show_line(ui, "Bind", label.into_job(), &digits.place(bind));
    for slot in 0..explanation.influences.len() {
        ui.add_space(5.0);
        show_influence(ui, cx, explanation, slot);
    }
    rule_over_numbers(ui);
    let label = Formula::new(LABEL_SIZE, tokens.text)
        .plain("Place ")
        .bold("v")
        .plain("'");
    let sum = explanation.position.to_array();
    show_line(ui, "Place", label.into_job(), &digits.place(sum));
    ui.add_space(8.0);
    let copy = ("Copy as text", "Copy: the sum of the vertex as text");
    if section_with_labelled_action(ui, "All numbers", Some(copy)) {
        ui.ctx()
            .copy_text(explanation.to_text(|joint| cx.session.joint_name(joint)));
    }
}

/// `v' = w0·v·F0 + w1·v·F1` and what F is.
fn show_formula(ui: &mut Ui, influences: usize) {
    let tokens = Tokens::of(ui);
    let formula = || Formula::new(FORMULA_SIZE, tokens.text);
    let mut sum = formula().bold("v").plain("'").plain(" = ");
    let mut spoken = "v' = ".to_owned();
    for slot in 0..influences {
        let sign = if slot == 0 { "" } else { " + " };
        sum = sum.plain(sign).weighted(slot);
        spoken += &format!("{sign}w{slot}·v·F{slot}");
    }
    if influences == 0 {
        sum = sum.bold("v");
        spoken += "v";
    }
    show_spoken(ui, sum, &spoken);
    show_meaning(ui);
}

/// One influence: its row, its matrices when unfolded, and its term of the sum.
fn show_influence(ui: &mut Ui, cx: &mut Cx<'_, SkeletonState>, explanation: &VertexExplanation, slot: usize) {
    let tokens = Tokens::of(ui);
    let Cx { session, state, .. } = cx;
    let digits = state.reading.digits;
    let influence = &explanation.influences[slot];
    let name = session.joint_label(influence.joint);
    let unfolded = state.unfolded.get(slot).copied().unwrap_or_default();
    let pressed = influence_row(ui, state, &name, unfolded, (slot, influence));
    if pressed && let Some(place) = state.unfolded.get_mut(slot) {
        *place = !unfolded;
    }
    if unfolded {
        show_matrices(ui, digits, &name, explanation.bind_position, (slot, influence));
    }
    let label = Formula::new(LABEL_SIZE, tokens.muted).weighted(slot).into_job();
    let weighted = digits.place(influence.weighted.to_array());
    show_line(ui, &format!("{name}: w·v·F"), label, &weighted);
}

/// offset, toRoot, and their product applied to the bind position: each row of the product times a coordinate of `v`, added up.
fn show_matrices(
    ui: &mut Ui,
    digits: Digits,
    name: &str,
    bind_position: Vec3,
    (slot, influence): (usize, &ExplainedInfluence),
) {
    let tokens = Tokens::of(ui);
    let symbol = |symbol: &str| Formula::new(LABEL_SIZE, tokens.text).plain(symbol);
    caption(ui, symbol("offset"), "bind space to bone", OFFSET_EXPLAINED);
    show_matrix(ui, &format!("{name}: offset"), &influence.offset, digits);
    caption(ui, symbol("· toRoot"), "bone to model", TO_ROOT_EXPLAINED);
    show_matrix(ui, &format!("{name}: toRoot"), &influence.to_root, digits);
    let product = symbol("= ").bold("F").below(slot);
    caption(ui, product, "each row times a number of v", FINAL_EXPLAINED);
    let [x, y, z] = digits.place(bind_position.to_array());
    let factors = [x, y, z, "1".to_owned()];
    for (row, (factor, [x, y, z, _])) in factors.iter().zip(influence.final_transform.0).enumerate() {
        let spoken = format!("{name}: F, row {}: {factor} times", row + 1);
        product_line(ui, &spoken, factor, &digits.matrix(row, [x, y, z]));
    }
    rule_over_numbers(ui);
    let label = Formula::new(LABEL_SIZE, tokens.muted).moved(slot).into_job();
    let moved = digits.place(influence.moved.to_array());
    show_line(ui, &format!("{name}: v·F"), label, &moved);
}

/// Name and weight, and the mark that unfolds. Returns whether the row was clicked.
fn influence_row(
    ui: &mut Ui,
    state: &mut SkeletonState,
    name: &str,
    unfolded: bool,
    (slot, influence): (usize, &ExplainedInfluence),
) -> bool {
    let tokens = Tokens::of(ui);
    let mut row = Row::pressable(ui, false);
    let over = row.response.contains_pointer() && !is_touch(ui);
    if over {
        state.hovered = Some(influence.joint);
    }
    let center = row.rect.left_center() + vec2(4.0, 0.0);
    let color = tokens.muted_to_text(over || row.response.has_focus());
    paint_fold_mark(ui.painter(), center, !unfolded, color);

    let weight = format!("{:.3}", influence.weight);
    row.right_in(theme::mono(11.0), &weight, tokens.text);
    let symbol = Formula::new(LABEL_SIZE, tokens.muted)
        .plain("w")
        .below(slot)
        .plain(" =");
    let galley = ui.painter().layout_job(symbol.into_job());
    row.right = row.right - 6.0 - galley.size().x;
    let at = pos2(row.right, row.y - 0.5 * galley.size().y);
    ui.painter().galley(at, galley, tokens.muted);
    row.left += CHEVRON_WIDTH;
    row.right -= 8.0;
    row.name(name, tokens.text);
    let verb = if unfolded { "Fold" } else { "Unfold" };
    let label = format!("{verb} the matrices of {name}, weight {weight}");
    row.response
        .widget_info(|| WidgetInfo::selected(Role::Button, true, unfolded, &label));
    row.response.clicked()
}

/// The caption of a matrix: its symbol, and in words what it does.
fn caption(ui: &mut Ui, symbol: Formula, words: &str, sentence: &str) {
    let tokens = Tokens::of(ui);
    let mut row = Row::new(ui, LINE_HEIGHT + 3.0);
    let galley = ui.painter().layout_job(symbol.into_job());
    row.y += 1.5;
    let at = pos2(row.left, row.y - 0.5 * galley.size().y);
    ui.painter().galley(at, galley, tokens.text);
    row.right_in(FontId::proportional(11.0), words, tokens.faint);
    explained(row.told(Role::Label, words), sentence);
}

/// `0.6676 ×` and a row of the final matrix: four such lines add up to the product.
fn product_line(ui: &mut Ui, spoken: &str, factor: &str, numbers: &[String; 3]) {
    let tokens = Tokens::of(ui);
    let line = Rect::from_min_size(ui.cursor().min, vec2(ui.available_width(), LINE_HEIGHT));
    let end = pos2(line.max.x - 3.0 * number_column(line.width()), line.center().y);
    let (painter, anchor, font) = (ui.painter(), Align2::RIGHT_CENTER, theme::mono(11.0));
    let times = painter.text(end, anchor, "×", font.clone(), tokens.faint);
    painter.text(pos2(times.min.x - 4.0, end.y), anchor, factor, font, tokens.muted);
    show_line(ui, spoken, LayoutJob::default(), numbers);
}
