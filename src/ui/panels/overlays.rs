//! Lines over and beside the model; bones, their names, bind pose, ghosts, trails.

use egui::{Align2, Color32, FontId, Rect, Role, Sense, Ui, Vec2, pos2, vec2};

use super::skeleton::state::{SkeletonState, has_joints};
use crate::actions;
use crate::anim::{GHOST_STEP_FRAMES, GhostPlan};
use crate::scene::{BoneStyle, Overlay, Overlays, joint_colors};
use crate::session::{GHOSTS_SRGB, LookCommand, MAX_LINE_LENGTH, PlayCommand, Session};
use crate::ui::cx::Cx;
use crate::ui::kit::icons::Icon;
use crate::ui::kit::theme::Tokens;
use crate::ui::kit::{
    Row, Slider, action_switch, control_size, noted_switch_row, number_field, push_button, section_name,
    section_with_action, segmented, switch_row,
};
use crate::ui::window::panel::popover_gap;

/// The ghosts when they are switched on.
const FIRST_GHOSTS: GhostPlan = GhostPlan {
    before: 3,
    after: 3,
    step_frames: GHOST_STEP_FRAMES,
};
/// The most ghosts on either side, and the most frames between two.
const MOST_GHOSTS: f32 = 16.0;
const MOST_STEP: f32 = 120.0;

pub(in crate::ui) fn show(ui: &mut Ui, cx: &mut Cx<'_, SkeletonState>) {
    let overlays = &cx.session.look().overlays;
    section_name(ui, "Overlays");
    for overlay in Overlay::ALL {
        let command = LookCommand::ToggleOverlay(overlay).into();
        let key = actions::key_of(cx.session, &command);
        if switch_row(ui, overlay.label(), key, overlays.has(overlay)).clicked() {
            cx.push(command);
        }
        let last_with_lines = overlay == Overlay::Tangents;
        if last_with_lines && (overlays.has(Overlay::Normals) || overlays.has(Overlay::Tangents)) {
            line_length(ui, cx);
        }
    }
    skeleton_rows(ui, cx);
}

/// Whether any overlay but the grid is on.
pub(in crate::ui) fn any_beside_the_grid(session: &Session) -> bool {
    let overlays = &session.look().overlays;
    let mut lines = Overlay::ALL.into_iter().filter(|&overlay| overlay != Overlay::Grid);
    lines.any(|overlay| overlays.has(overlay)) || any_of_skeleton(session)
}

fn line_length<S>(ui: &mut Ui, cx: &mut Cx<'_, S>) {
    let length = cx.session.look().overlays.line_length;
    let text = format!("{:.1} %", length * 100.0);
    let slider = Slider::new("Line length", length, 0.0..=MAX_LINE_LENGTH, &text);
    if let Some(length) = slider.reset_to(Overlays::default().line_length).show(ui) {
        cx.push(LookCommand::SetLineLength(length));
    }
}

/// Whether anything of the skeleton is drawn over the model.
fn any_of_skeleton(session: &Session) -> bool {
    let look = session.look();
    let over = look.bones_visible || !look.trails.is_empty();
    over || look.ghosts.is_some() || look.bind_ghost || session.bind_weight() > 0.0
}

/// Bones, names, bind pose, ghosts, trails.
fn skeleton_rows(ui: &mut Ui, cx: &mut Cx<'_, SkeletonState>) {
    if !has_joints(cx.session) {
        return;
    }
    let look = cx.session.look();
    popover_gap(ui);
    section_name(ui, "Skeleton");
    action_switch(ui, cx, &actions::BONES);
    if look.bones_visible {
        let styles = BoneStyle::ALL.map(|style| (style, style.label()));
        if let Some(style) = segmented(ui, "Bones", &styles, Some(look.bone_style)) {
            cx.push(LookCommand::SetBoneStyle(style));
        }
    }
    action_switch(ui, cx, &actions::BONE_NAMES);
    popover_gap(ui);
    section_name(ui, "Pose");
    bind_pose(ui, cx);
    if cx.session.clip().is_some() {
        ghosts(ui, cx);
        trails(ui, cx);
    }
}

fn bind_pose<S>(ui: &mut Ui, cx: &mut Cx<'_, S>) {
    let weight = cx.session.bind_weight();
    if cx.session.clip().is_some() {
        let toggle = &actions::BIND_POSE;
        if switch_row(ui, toggle.label, toggle.key(), weight >= 0.5).clicked() {
            cx.act(toggle);
        }
        let text = format!("{:.0} %", weight * 100.0);
        if let Some(weight) = Slider::new("To bind pose", weight, 0.0..=1.0, &text).show(ui) {
            cx.push(PlayCommand::SetBindWeight(weight));
        }
    }
    let note = ("grey", FontId::proportional(12.0), ghost_color(ui, 2));
    if noted_switch_row(ui, "Bind pose as a ghost", note, cx.session.look().bind_ghost).clicked() {
        cx.push(LookCommand::SetBindGhost(!cx.session.look().bind_ghost));
    }
}

fn ghosts<S>(ui: &mut Ui, cx: &mut Cx<'_, S>) {
    let plan = cx.session.look().ghosts;
    if switch_row(ui, "Ghosts", "", plan.is_some()).clicked() {
        cx.push(LookCommand::SetGhosts(plan.is_none().then_some(FIRST_GHOSTS)));
    }
    let Some(plan) = plan else { return };
    ui.horizontal(|ui| {
        let gap = ui.spacing().item_spacing.x;
        let size = vec2((ui.available_width() - 2.0 * gap) / 3.0, control_size(ui));
        let muted = Tokens::of(ui).muted;
        let [past, future] = [0, 1].map(|ghost| ghost_color(ui, ghost));
        let mut field = |[short, label]: [&str; 2], color: Color32, value: u32, range| {
            ui.vertical(|ui| {
                ui.set_width(size.x);
                let (name, _) = ui.allocate_exact_size(vec2(size.x, 15.0), Sense::hover());
                let font = FontId::proportional(11.0);
                ui.painter()
                    .text(name.center(), Align2::CENTER_CENTER, short, font, color);
                number_field(ui, label, size, value as f32, range, (0.1, 0))
            })
            .inner
            .map(|number| number.round() as u32)
        };
        let before = field(["before", "Ghosts before"], past, plan.before, 0.0..=MOST_GHOSTS);
        let after = field(["after", "Ghosts after"], future, plan.after, 0.0..=MOST_GHOSTS);
        let step = field(
            ["frames", "Ghosts every frames"],
            muted,
            plan.step_frames,
            1.0..=MOST_STEP,
        );
        let asked = GhostPlan {
            before: before.unwrap_or(plan.before),
            after: after.unwrap_or(plan.after),
            step_frames: step.unwrap_or(plan.step_frames),
        };
        if asked != plan {
            cx.push(LookCommand::SetGhosts(Some(asked)));
        }
    });
    ui.add_space(6.0);
}

/// The colour of past, future and bind pose's ghosts, so far towards that of text that it can be read.
fn ghost_color(ui: &Ui, ghost: usize) -> Color32 {
    let [red, green, blue] = GHOSTS_SRGB[ghost];
    Color32::from_rgb(red, green, blue).lerp_to_gamma(Tokens::of(ui).text, 0.35)
}

/// The joints whose path through the clip is drawn.
fn trails(ui: &mut Ui, cx: &mut Cx<'_, SkeletonState>) {
    let trails = &cx.session.look().trails;
    let selected = cx.session.joints().selected();
    if let Some(joint) = selected.filter(|joint| !trails.contains(joint))
        && switch_row(ui, &format!("Trail of {}", cx.session.joint_label(joint)), "", false).clicked()
    {
        cx.push(LookCommand::ToggleTrail(joint));
    }
    if trails.is_empty() {
        return;
    }
    popover_gap(ui);
    if section_with_action(ui, "Trails", Some("Clear")) {
        cx.push(LookCommand::ClearTrails);
    }
    let colors = cx.session.open_model().map(|open| joint_colors(&open.model.skeleton));
    for &joint in trails.iter() {
        let name = cx.session.joint_label(joint);
        let side = control_size(ui);
        let mut row = Row::new(ui, side);
        if row.response.contains_pointer() {
            cx.state.hovered = Some(joint);
        }
        if let Some(&[red, green, blue, _]) = colors.as_ref().and_then(|colors| colors.get(joint.index())) {
            let at = row.rect.left_center() + vec2(4.0, 0.0);
            ui.painter().circle_filled(at, 4.0, Color32::from_rgb(red, green, blue));
        }
        row.left += 14.0;
        row.right -= side;
        row.name(&name, Tokens::of(ui).text);
        let rect = row.told(Role::Label, format!("Trail: {name}")).rect;
        let place = Rect::from_center_size(pos2(rect.max.x - 0.5 * side + 6.0, rect.center().y), Vec2::splat(side));
        let mut corner = ui.new_child(egui::UiBuilder::new().max_rect(place).id_salt(joint.0));
        if push_button(&mut corner, Icon::Close, &format!("Leave the trail of {name}")).clicked() {
            cx.push(LookCommand::ToggleTrail(joint));
        }
    }
}
