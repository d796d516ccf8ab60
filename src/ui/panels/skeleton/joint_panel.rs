//! The selected joint: its parent and children, its transform now, its matrices and keys. Above it the selected vertex.

use egui::style::ScrollAnimation;
use egui::{Align, Align2, FontId, Id, Rect, Response, Role, ScrollArea, Sense, Ui, WidgetInfo, pos2, vec2};

use super::numbers::{FINAL_EXPLAINED, OFFSET_EXPLAINED, fitted, show_matrix, show_meaning, show_parts};
use super::state::{KeyList, KeyPart, SkeletonState, Space};
use super::vertex_panel;
use crate::actions;
use crate::anim::{JointReadout, KeyRow, key_rows, key_table};
use crate::check::book::MOST_BONES;
use crate::model::JointIndex;
use crate::session::{JointCommand, LookCommand};
use crate::ui::cx::Cx;
use crate::ui::kit::theme::{self, CONTROL_RADIUS, MARGIN, ROW_HEIGHT, Tokens};
use crate::ui::kit::wording::{counted, counted_vertices, grouped};
use crate::ui::kit::{
    DrawnRows, Row, TextButton, choose, explained, explained_section, explained_segmented, focus_ring, focus_row,
    is_touch, labelled, paint_name, paint_row_ground, pressed_row_height, row_sense, rule, section_with_action,
    section_with_labelled_action, selected_heading, switch_row, tell_row, value_row, walked,
};

/// Keys listed before the list scrolls. By touch the list has this fraction of what is seen of the drawer.
const ROWS: f32 = 8.0;
const DRAWER_FRACTION: f32 = 0.6;
/// Right ends of the columns of frame and time.
const FRAME_END: f32 = 34.0;
const TIME_END: f32 = 86.0;
/// Width of a column of numbers.
const KEY_COLUMN: f32 = 56.0;
/// The most children listed. A joint may have hundreds.
const CHILDREN: usize = 12;
/// Where values begin.
const LABEL_WIDTH: f32 = 72.0;

/// The panel's contents. Nothing while nothing is selected.
pub(in crate::ui) fn show(ui: &mut Ui, cx: &mut Cx<'_, SkeletonState>) {
    // Both were read in this pass, so they are about what is selected now.
    let joint = cx.state.reading.joint.take();
    let vertex = cx.state.reading.vertex.take();
    let shown = vertex.as_ref().map(|explanation| explanation.vertex);
    let newly_shown = shown.is_some() && cx.state.shown_vertex != shown;
    cx.state.shown_vertex = shown;
    if newly_shown {
        // The panel may be scrolled to the numbers of the bone.
        ui.scroll_to_cursor_animation(Some(Align::TOP), ScrollAnimation::none());
    }
    if let Some(explanation) = &vertex {
        vertex_panel::show(ui, cx, explanation);
    }
    if let Some(readout) = &joint {
        if vertex.is_some() {
            rule(ui, MARGIN);
        }
        if selected_heading(ui, &cx.session.joint_label(readout.joint), Tokens::of(ui).accent, None) {
            cx.push(JointCommand::Select(None));
        }
        rule(ui, MARGIN);
        show_joint(ui, cx, readout);
    }
    (cx.state.reading.joint, cx.state.reading.vertex) = (joint, vertex);
}

fn show_joint(ui: &mut Ui, cx: &mut Cx<'_, SkeletonState>, readout: &JointReadout) {
    let joint = readout.joint;
    if section_with_action(ui, "Bone", Some(actions::NAME_BONE.label)) {
        cx.state.rename_selected(ui, cx.session);
    }
    value_row(ui, "Number in the file", &readout.bone.to_string());
    let counts = cx.session.joints().vertex_counts();
    let own = counts.own.get(joint.index()).copied().unwrap_or_default();
    value_row(ui, "Moves", &counted_vertices(own));
    let of = format!(
        "{} of {}; the demo holds {MOST_BONES}",
        readout.bone,
        cx.session.joints().count()
    );
    explained(
        value_row(ui, "Palette", &of),
        "The place of its final transform in gBoneTransforms, the matrix palette that the books' vertex shader reads.",
    );
    relatives(ui, cx, joint);

    rule(ui, MARGIN);
    let parts = match cx.state.space {
        Space::Local => &readout.local,
        Space::Model => &readout.model,
    };
    if section_with_labelled_action(ui, "Now", Some(("Copy", "Copy: place now"))) {
        ui.ctx().copy_text(parts.to_text());
    }
    let spaces = [(Space::Local, "Local (toParent)"), (Space::Model, "Model (toRoot)")];
    let sentences = [
        "toParent brings what is in the bone's space into that of its parent; the clip's keys are of it.",
        "toRoot brings what is in the bone's space into that of the model: toParent times the parent's toRoot.",
    ];
    if let Some(space) = explained_segmented(ui, "Relative to", &spaces, &sentences, Some(cx.state.space)) {
        cx.state.space = space;
    }
    ui.add_space(4.0);
    let digits = cx.state.reading.digits;
    show_parts(ui, parts, digits);
    let matrices = [
        ("Offset", "offset", OFFSET_EXPLAINED, &readout.offset),
        (
            "Final transform",
            "finalTransform = offset · toRoot",
            FINAL_EXPLAINED,
            &readout.final_transform,
        ),
    ];
    for (name, in_books, sentence, matrix) in matrices {
        rule(ui, MARGIN);
        let label = format!("Copy: {name}");
        if explained_section(ui, name, sentence, Some(("Copy", &label))) {
            ui.ctx().copy_text(matrix.to_text(in_books));
        }
        if sentence == FINAL_EXPLAINED {
            show_meaning(ui);
        }
        show_matrix(ui, name, matrix, digits);
    }
    ui.add_space(8.0);
    let all = TextButton::new("Copy all numbers", "Copy all numbers of the bone");
    if all.show_wide(ui).clicked() {
        ui.ctx().copy_text(readout.to_text());
    }
    rule(ui, MARGIN);
    let trail = cx.session.look().trails.contains(&joint);
    if switch_row(ui, "Trail through the clip", "", trail).clicked() {
        cx.push(LookCommand::ToggleTrail(joint));
    }
    key_list(ui, cx, joint);
}

/// Parent, children and the joint of the other side as links.
fn relatives(ui: &mut Ui, cx: &mut Cx<'_, SkeletonState>, joint: JointIndex) {
    let Some(open) = cx.session.open_model() else { return };
    let parent = open.model.skeleton.parents().get(joint.index()).copied().flatten();
    let children: Vec<_> = cx.session.joints().tree().children(joint).collect();
    match parent {
        Some(parent) => links(ui, cx, ["Parent"; 2], &[parent]),
        None => no_link(ui, "Parent", "none, it is a root"),
    }
    let shown = &children[..children.len().min(CHILDREN)];
    match shown {
        [] => no_link(ui, "Children", "none"),
        _ => links(ui, cx, ["Children", "Child"], shown),
    }
    if let more @ 1.. = children.len() - shown.len() {
        value_row(ui, "", &format!("and {more} more in the tree"));
    }
    match cx.state.mirrored.partner(cx.session, joint) {
        Some(partner) => links(ui, cx, ["Mirror"; 2], &[partner]),
        None => no_link(ui, "Mirror", "none"),
    }
}

/// A row as high as one with a link, so that nothing below moves from bone to bone.
fn no_link(ui: &mut Ui, label: &str, words: &str) {
    let top = ui.cursor().min.y;
    value_row(ui, label, words);
    ui.add_space(top + pressed_row_height(ui) - ui.cursor().min.y);
}

/// A label, then joints on as many lines as they need. By touch each joint has a row. `one`: what screen readers call each of them.
fn links(ui: &mut Ui, cx: &mut Cx<'_, SkeletonState>, [label, one]: [&str; 2], joints: &[JointIndex]) {
    let session = cx.session;
    let mut follow = |link: Response, joint: JointIndex| {
        let name = format!("{one}: {}", session.joint_label(joint));
        link.widget_info(|| WidgetInfo::labeled(Role::Link, true, &name));
        if link.contains_pointer() {
            cx.state.hovered = Some(joint);
        }
        if link.clicked() {
            cx.push(JointCommand::Select(Some(joint)));
        }
    };
    let (font, color) = (FontId::proportional(13.0), Tokens::of(ui).muted);
    if is_touch(ui) {
        for (index, &joint) in joints.iter().enumerate() {
            let label = if index == 0 { label } else { "" };
            follow(link_row(ui, label, &session.joint_label(joint)), joint);
        }
        return;
    }
    let (left, width) = (ui.cursor().min, ui.available_width());
    let at = left + vec2(0.0, 0.5 * ROW_HEIGHT);
    ui.painter().text(at, Align2::LEFT_CENTER, label, font, color);
    let place = Rect::from_min_size(left + vec2(LABEL_WIDTH, 0.0), vec2(width - LABEL_WIDTH, ROW_HEIGHT));
    let builder = egui::UiBuilder::new()
        .max_rect(place)
        .layout(egui::Layout::left_to_right(egui::Align::Min).with_main_wrap(true));
    ui.scope_builder(builder, |ui| {
        ui.spacing_mut().item_spacing = vec2(2.0, 0.0);
        for &joint in joints {
            follow(joint_link(ui, &session.joint_label(joint)), joint);
        }
    });
}

/// A joint's name as a link in a row of its own, after a label.
fn link_row(ui: &mut Ui, label: &str, name: &str) -> Response {
    let tokens = Tokens::of(ui);
    let mut row = Row::pressable(ui, false);
    row.left(label, tokens.muted);
    row.left = row.rect.min.x + LABEL_WIDTH + 5.0;
    row.name(name, tokens.accent);
    row.response
}

/// A joint's name as a link.
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
    paint_name(ui.painter(), at, name, font, tokens.accent, width - 10.0);
    response
}

/// The keys of a joint's track in the open clip. Only rows in view are laid out. A click goes to the key. The list opens at the key
/// in force.
fn key_list(ui: &mut Ui, cx: &mut Cx<'_, SkeletonState>, joint: JointIndex) {
    rule(ui, MARGIN);
    let clip = cx.session.clip();
    let track = clip.and_then(|clip| clip.tracks.get(joint.index()));
    let (Some(clip), Some(track)) = (clip, track.filter(|track| track.has_keys())) else {
        section_with_labelled_action(ui, "Keys", None);
        ui.label(egui::RichText::new("No keys: it stays at rest.").color(Tokens::of(ui).muted));
        return;
    };
    let copy = ("Copy", "Copy: keys as a table");
    if section_with_labelled_action(ui, &counted(track.key_count(), "key"), Some(copy)) {
        ui.ctx().copy_text(key_table(clip, track));
    }
    let parts = [
        (KeyPart::Position, "Position"),
        (KeyPart::Rotation, "Euler"),
        (KeyPart::Scale, "Scale"),
    ];
    choose(ui, "Keys", &parts, &mut cx.state.key_part);
    ui.add_space(4.0);
    let height = pressed_row_height(ui);
    let most = if is_touch(ui) {
        DRAWER_FRACTION * ui.clip_rect().height()
    } else {
        ROWS * height
    };
    let rows = key_rows(clip, track);
    // The last key at or before the present time.
    let now_secs = cx.session.playback().time_secs();
    let in_force = track
        .times_secs()
        .partition_point(|&secs| secs <= now_secs)
        .checked_sub(1);
    let mut list = ScrollArea::vertical()
        .id_salt(("keys", joint.0))
        .max_height(most)
        .min_scrolled_height(most)
        .auto_shrink([false, true]);
    let opened = Some((joint, cx.session.clip_index(), cx.session.clips_revision()));
    if cx.state.keys.opened != opened {
        cx.state.keys = KeyList { opened, stop: None };
        let middle = in_force.unwrap_or_default() as f32 * height - 0.5 * (most - height);
        list = list.vertical_scroll_offset(middle.max(0.0));
    }
    let count = rows.len();
    let part = cx.state.key_part;
    list.show_rows(ui, height, count, |ui, range| {
        labelled(ui, Role::ListBox, "Keys of the bone", count, |ui| {
            let layer = ui.layer_id();
            let id_of = |key: usize| Id::unique("key row").with((layer, joint.0, key));
            let stop = cx.state.keys.stop.or(in_force).unwrap_or_default().min(count - 1);
            let drawn = DrawnRows::new(ui, range, height, (stop, id_of(stop)));
            let mut walks_to = None;
            let in_view = rows.skip(drawn.in_view.start).take(drawn.in_view.len());
            let out_of_view = drawn.out_of_view.and_then(|key| key_rows(clip, track).nth(key));
            for row in in_view.chain(out_of_view) {
                let key = row.key;
                let response = ui.interact(drawn.rect_of(key), id_of(key), row_sense(key == drawn.tab_stop));
                if key_row(ui, &response, &row, part, in_force == Some(key)) {
                    cx.state.keys.stop = Some(key);
                    focus_row(ui, response.id, response.rect);
                }
                if response.clicked() {
                    cx.pause_at(row.time_secs);
                    cx.state.keys.stop = Some(key);
                }
                walks_to = walks_to.or(walked(ui, response.id, key, count, drawn.page));
            }
            // Only now: a row that is no stop yet would lose the focus when it is drawn.
            if let Some(to) = walks_to {
                cx.state.keys.stop = Some(to);
                focus_row(ui, id_of(to), drawn.rect_of(to));
            }
        });
    });
}

/// Shows a row of a key. Returns whether a screen reader asks for the focus.
fn key_row(ui: &Ui, response: &Response, row: &KeyRow, part: KeyPart, in_force: bool) -> bool {
    let tokens = Tokens::of(ui);
    let rect = response.rect;
    paint_row_ground(ui, rect, response, in_force, response.contains_pointer());
    let numbers = match part {
        KeyPart::Position => row.parts.position.to_array().map(|number| fitted(number, 3)),
        KeyPart::Rotation => row.parts.euler_xyz_degrees.to_array().map(|number| fitted(number, 2)),
        KeyPart::Scale => row.parts.scale.to_array().map(|number| fitted(number, 4)),
    };
    let (frame, time) = (grouped(row.frame as usize), format!("{:.3}", row.time_secs));
    // The scroll bar lies over the last points of the row.
    let right = rect.max.x - 8.0;
    let (of_frame, of_time) = if in_force {
        (tokens.accent, tokens.accent)
    } else {
        (tokens.faint, tokens.muted)
    };
    let cells = [
        (rect.min.x + FRAME_END, &frame, of_frame),
        (rect.min.x + TIME_END, &time, of_time),
        (right - 2.0 * KEY_COLUMN, &numbers[0], tokens.text),
        (right - KEY_COLUMN, &numbers[1], tokens.text),
        (right, &numbers[2], tokens.text),
    ];
    for (end, text, color) in cells {
        let at = pos2(end, rect.center().y);
        ui.painter()
            .text(at, Align2::RIGHT_CENTER, text, theme::mono(10.5), color);
    }
    let label = format!("Key {}, {time} s: {}", row.key, numbers.join(" "));
    tell_row(ui, response, Role::ListBoxOption, &label, row.key, in_force)
}
