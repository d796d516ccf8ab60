//! How a clip plays: speed, what happens at the end, the range, and the loop gap.

use egui::{FontId, Rect, RectAlign, RichText, Role, Sense, Tooltip, Ui, WidgetInfo, vec2};

use super::controls;
use super::typed::{self, Unit};
use crate::actions::speed_label;
use crate::anim::{LoopMode, WrapMode};
use crate::model::JointIndex;
use crate::session::{JointCommand, PlayCommand, SPEEDS};
use crate::ui::cx::Cx;
use crate::ui::kit::theme::{self, MARGIN, Tokens};
use crate::ui::kit::wording::trimmed;
use crate::ui::kit::{
    Row, TypedValue, focus_ring, is_touch, paint_list_ground, pressed_row_height, section_name, section_with_action,
    segmented,
};
use crate::ui::timeline::loop_gap::{LoopGapReading, angle, scale};
use crate::ui::timeline::state::TimelineState;
use crate::ui::timeline::time_area::seconds;
use crate::ui::window::panel::{popover_gap, scrolled};

/// Rows before the list scrolls.
const ROWS: f32 = 6.0;
const TOUCH_ROWS: f32 = 4.0;
/// Width of a distance, and of an angle.
const DISTANCE_WIDTH: f32 = 84.0;
const ANGLE_WIDTH: f32 = 76.0;
/// Margin inside a row.
const INSIDE: f32 = 6.0;
pub(in crate::ui::timeline) const WIDTH: f32 = 300.0;
/// Speeds in one row of the switch.
const IN_A_ROW: usize = 5;
const FIELD_WIDTH: f32 = 78.0;

/// The popover's contents. `with_steps`: with the buttons that step, if the strip has no room for them.
pub(in crate::ui::timeline) fn show(ui: &mut Ui, cx: &mut Cx<'_, TimelineState>, with_steps: bool) {
    ui.spacing_mut().item_spacing.y = 4.0;
    if with_steps {
        controls::all_steps(ui, cx);
        popover_gap(ui);
    }
    speed(ui, cx);
    popover_gap(ui);
    at_the_end(ui, cx);
    popover_gap(ui);
    range(ui, cx);
    if cx.state.loop_gap.could_loop() {
        popover_gap(ui);
        let loops = cx.state.loop_gap.loops();
        ui.add_enabled_ui(loops, |ui| loop_gap_list(ui, cx));
    }
}

fn speed<S>(ui: &mut Ui, cx: &mut Cx<'_, S>) {
    let speed = cx.session.playback().speed();
    section_name(ui, "Speed");
    let text = speed_label(speed);
    let typed = trimmed(speed);
    let field = TypedValue::new(ui, "Times as fast", &text, &typed).width(FIELD_WIDTH);
    let typed = ui.horizontal(|ui| field.row(ui, 0.0, ("", "Click to type"), typed::speed));
    if let Some(speed) = typed.inner {
        cx.push(PlayCommand::SetSpeed(speed));
    }
    let labels = SPEEDS.map(speed_label);
    let choices: Vec<(f32, &str)> = SPEEDS.into_iter().zip(labels.iter().map(String::as_str)).collect();
    let in_force = SPEEDS.into_iter().find(|choice| (choice - speed).abs() < 1e-4);
    for row in choices.chunks(IN_A_ROW) {
        if let Some(speed) = segmented(ui, "Speed", row, in_force) {
            cx.push(PlayCommand::SetSpeed(speed));
        }
    }
}

fn at_the_end<S>(ui: &mut Ui, cx: &mut Cx<'_, S>) {
    let playback = cx.session.playback();
    section_name(ui, "At the end");
    let modes = LoopMode::ALL.map(|mode| (mode, mode.label()));
    if let Some(mode) = segmented(ui, "At the end", &modes, Some(playback.loop_mode())) {
        cx.push(PlayCommand::SetLoopMode(mode));
    }
    // What is about loops alone stays, so that nothing moves.
    ui.add_enabled_ui(playback.loop_mode() == LoopMode::Loop, |ui| {
        let modes = WrapMode::ALL.map(|mode| (mode, mode.label()));
        if let Some(mode) = segmented(ui, "Loop", &modes, Some(playback.wrap_mode())) {
            cx.push(PlayCommand::SetWrapMode(mode));
        }
        wrap_explained(ui, playback.wrap_mode());
    });
}

/// Says how a loop begins again. As high for all modes, so that nothing moves when another is chosen.
fn wrap_explained(ui: &mut Ui, mode: WrapMode) {
    let words_of = |mode| match mode {
        WrapMode::Wrap => {
            "A step past the end goes on from the start with what is left of it: a round takes its length exactly."
        }
        WrapMode::BookDemo => {
            "A step past the end goes back to time 0, or to the start where 0 is not played, and loses what is left of it."
        }
    };
    let (width, color) = (ui.available_width(), Tokens::of(ui).muted);
    let lay = |mode| {
        let words = words_of(mode).to_owned();
        ui.painter().layout(words, FontId::proportional(11.5), color, width)
    };
    let height = WrapMode::ALL
        .map(|mode| lay(mode).size().y)
        .into_iter()
        .fold(0.0, f32::max);
    let galley = lay(mode);
    let (rect, response) = ui.allocate_exact_size(vec2(width, height), Sense::hover());
    ui.painter().galley(rect.min, galley, color);
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, words_of(mode)));
}

fn range<S>(ui: &mut Ui, cx: &mut Cx<'_, S>) {
    let Some(clip) = cx.session.clip() else { return };
    let playback = cx.session.playback();
    let action = playback.range_secs().map(|_| "Clear");
    if section_with_action(ui, "Range", action) {
        cx.push(PlayCommand::ClearRange);
    }
    let [start_secs, end_secs] = playback.played_secs();
    for (begins, name, secs) in [(true, "In", start_secs), (false, "Out", end_secs)] {
        let typed = format!("{secs:.3}");
        let frame = format!("frame {}", clip.frame_at(secs));
        let read = |typed: &str| {
            let secs = typed::time(typed, clip, Unit::Secs)?;
            match begins {
                true if secs >= clip.end_secs => Err("A range needs some length after its start".to_owned()),
                false if secs <= clip.start_secs => Err("A range needs some length before its end".to_owned()),
                true if secs >= end_secs => Err(format!("Beyond the range's end, {} s", seconds(end_secs))),
                false if secs <= start_secs => Err(format!("Before the range's start, {} s", seconds(start_secs))),
                _ => Ok(secs),
            }
        };
        let text = format!("{typed} s");
        let field = TypedValue::new(ui, name, &text, &typed).width(FIELD_WIDTH);
        let hint = "Click to type seconds, 0.33, or a frame, f20";
        if let Some(secs) = ui.horizontal(|ui| field.row(ui, 0.0, (&frame, hint), read)).inner {
            cx.push(if begins {
                PlayCommand::SetRangeStart(Some(secs))
            } else {
                PlayCommand::SetRangeEnd(Some(secs))
            });
        }
    }
}

/// The loop gap in words, and the jump of each joint.
fn loop_gap_list(ui: &mut Ui, cx: &mut Cx<'_, TimelineState>) {
    let reading = std::mem::take(&mut cx.state.loop_gap);
    let of_range = cx.session.playback().range_secs().is_some();
    section_name(
        ui,
        if of_range {
            "Loop gap of the range"
        } else {
            "Loop gap of the clip"
        },
    );
    let tokens = Tokens::of(ui);
    let (words, color) = match (reading.words(), reading.any_jumps()) {
        (Some(words), _) => (words, tokens.warning),
        (None, true) => ("No jump from the last pose to the first is seen.", tokens.muted),
        (None, false) => ("The last pose is the first one again.", tokens.muted),
    };
    ui.label(RichText::new(words).size(11.5).color(color));
    if reading.any_jumps() {
        ui.add_space(4.0);
        joint_list(ui, cx, &reading);
    }
    cx.state.loop_gap = reading;
}

fn joint_list(ui: &mut Ui, cx: &mut Cx<'_, TimelineState>, reading: &LoopGapReading) {
    captions(ui);
    let height = pressed_row_height(ui);
    let rows = if is_touch(ui) { TOUCH_ROWS } else { ROWS };
    ui.spacing_mut().item_spacing.y = 0.0;
    scrolled("loop gap", rows * height)
        .auto_shrink([false, true])
        .show_rows(ui, height, reading.order().len(), |ui, seen| {
            for &joint in &reading.order()[seen] {
                joint_row(ui, cx, reading, joint);
            }
        });
}

/// The right ends of the columns of distances and angles.
fn columns(rect: Rect) -> [f32; 2] {
    let right = rect.max.x - INSIDE;
    [right - ANGLE_WIDTH, right]
}

fn captions(ui: &mut Ui) {
    let mut row = Row::new(ui, 17.0);
    let (font, color) = (FontId::proportional(11.0), Tokens::of(ui).faint);
    row.left += INSIDE;
    row.left_in(font.clone(), "Bone", color);
    for (x, caption) in columns(row.rect).into_iter().zip(["In the model", "To its parent"]) {
        row.right = x;
        row.right_in(font.clone(), caption, color);
    }
    row.response.on_hover_text(
        "How far the bone moves in the model, in its units; by what angle it turns relative to its parent",
    );
}

fn joint_row(ui: &mut Ui, cx: &mut Cx<'_, TimelineState>, reading: &LoopGapReading, joint: JointIndex) {
    let tokens = Tokens::of(ui);
    let size = vec2(ui.available_width(), pressed_row_height(ui));
    let (_, rect) = ui.allocate_space(size);
    let response = ui.interact(rect, ui.scope_id().with(("loop gap of", joint.0)), Sense::click());
    let joints = cx.session.joints();
    let selected = joints.selected() == Some(joint);
    if response.contains_pointer() && !is_touch(ui) {
        cx.state.hovered = Some(joint);
    }
    paint_list_ground(ui, rect, selected, joints.hovered() == Some(joint));
    focus_ring(ui, rect, &response);

    let jump = Jump::new(reading, joint);
    let mut row = Row::of(ui, rect, response);
    let [distance_x, angle_x] = columns(rect);
    let numbers = [
        (distance_x, &jump.distance, jump.travel_is_seen),
        (angle_x, &jump.angle, jump.own_is_seen),
    ];
    for (x, number, seen) in numbers {
        let color = match (number, seen) {
            (None, _) => tokens.faint,
            (Some(_), true) => tokens.warning,
            (Some(_), false) => tokens.muted,
        };
        row.right = x;
        row.right_in(theme::mono(11.5), number.as_deref().unwrap_or("0"), color);
    }
    let name = cx.session.joint_label(joint);
    let color = match (selected, jump.is_something()) {
        (true, _) => tokens.accent,
        (false, true) => tokens.text,
        (false, false) => tokens.faint,
    };
    (row.left, row.right) = (rect.min.x + INSIDE, distance_x - DISTANCE_WIDTH);
    let words = [Some(name.as_str()), jump.scaled.as_deref()];
    let words = words.into_iter().flatten().collect::<Vec<_>>().join(" ");
    row.name_in(FontId::proportional(12.5), &words, color);

    let response = row.response;
    response.widget_info(|| {
        let label = format!("Loop gap of {name}: {}", jump.words());
        WidgetInfo::selected(Role::ListItem, ui.is_enabled(), selected, label)
    });
    if response.clicked() {
        let joint = (!selected).then_some(joint);
        cx.push(JointCommand::Select(joint));
    }
    // Beside the list, so that it covers no row.
    let mut tooltip = Tooltip::for_enabled(&response);
    let list = rect.expand2(vec2(2.0 * MARGIN, 0.0));
    let beside = [RectAlign::RIGHT, RectAlign::TOP_START];
    tooltip.popup = tooltip
        .popup
        .anchor(list)
        .align(RectAlign::LEFT)
        .align_alternatives(&beside);
    tooltip.show(|ui| ui.label(format!("{name}\n{}", jump.long_words())));
}

/// The numbers of one row. None stands for zero.
struct Jump {
    distance: Option<String>,
    own_distance: Option<String>,
    angle: Option<String>,
    /// In words, not in a column, since few clips scale.
    scaled: Option<String>,
    travel_is_seen: bool,
    own_is_seen: bool,
}

impl Jump {
    fn new(reading: &LoopGapReading, joint: JointIndex) -> Self {
        let jump = reading.of_joint(joint);
        Self {
            distance: reading.distance(jump.travel),
            own_distance: reading.distance(jump.translation),
            angle: angle(jump.rotation_degrees),
            scaled: scale(jump.scale).map(|scale| format!("scales by {scale}")),
            travel_is_seen: reading.travel_is_seen(&jump),
            own_is_seen: jump.visibility >= 1.0,
        }
    }

    fn is_something(&self) -> bool {
        self.distance.is_some() || self.angle.is_some() || self.scaled.is_some()
    }

    fn words(&self) -> String {
        let [distance, angle] = [&self.distance, &self.angle].map(|number| number.as_deref().unwrap_or("0"));
        let scaled = self.scaled.iter().map(|scaled| format!(", {scaled}"));
        format!("distance {distance}, angle {angle}{}", scaled.collect::<String>())
    }

    fn long_words(&self) -> String {
        let numbers = [&self.distance, &self.own_distance, &self.angle];
        let [distance, own, angle] = numbers.map(|number| number.as_deref().unwrap_or("0"));
        let scaled = self.scaled.iter().map(|scaled| format!(", {scaled}"));
        format!(
            "From the last pose to the first:\n{distance} in the model, {own} by its own keys\n{angle} relative to its parent{}",
            scaled.collect::<String>(),
        )
    }
}
