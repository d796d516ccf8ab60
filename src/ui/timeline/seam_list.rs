//! The seam of a loop joint by joint: how far each is from where it was. Only the rows in view are laid out.

use egui::{Align2, Color32, FontId, Rect, Role, Sense, Ui, WidgetInfo, pos2, vec2};

use super::super::panel::scrolled;
use super::super::theme::{self, CONTROL_RADIUS, Tokens};
use super::super::widgets::{focus_ring, is_touch, paint_elided, pressed_row_height, section_name};
use super::TimelineState;
use super::seam::{SeamReading, angle, scale};
use crate::model::JointIndex;
use crate::session::{Command, JointCommand, Session};

/// Rows before the list scrolls.
const ROWS: f32 = 6.0;
const TOUCH_ROWS: f32 = 4.0;
/// Room for a distance, and for an angle.
const DISTANCE_WIDTH: f32 = 84.0;
const ANGLE_WIDTH: f32 = 66.0;
/// Room between a row's border and its words.
const INSIDE: f32 = 6.0;

/// A part of a popover: the seam in words, and the list.
pub(super) fn show(ui: &mut Ui, session: &Session, state: &mut TimelineState, commands: &mut Vec<Command>) {
    let reading = std::mem::take(&mut state.seam);
    let of_range = session.playback().range_secs().is_some();
    section_name(
        ui,
        if of_range {
            "Seam of the range"
        } else {
            "Seam of the clip"
        },
    );
    let tokens = Tokens::of(ui);
    match (reading.words(), reading.any_jumps()) {
        (Some(words), _) => paragraph(ui, words, tokens.warning),
        (None, true) => paragraph(ui, "No jump from the last pose to the first is seen.", tokens.muted),
        (None, false) => paragraph(ui, "The last pose is the first one again.", tokens.muted),
    }
    if reading.any_jumps() {
        list(ui, session, &reading, state, commands);
    }
    state.seam = reading;
}

fn paragraph(ui: &mut Ui, words: &str, color: Color32) {
    let font = FontId::proportional(11.5);
    let galley = ui.painter().layout(words.to_owned(), font, color, ui.available_width());
    let (rect, response) = ui.allocate_exact_size(galley.size() + vec2(0.0, 4.0), Sense::hover());
    ui.painter().galley(rect.min, galley, color);
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, words));
}

fn list(ui: &mut Ui, session: &Session, reading: &SeamReading, state: &mut TimelineState, commands: &mut Vec<Command>) {
    captions(ui);
    let height = pressed_row_height(ui);
    let rows = if is_touch(ui) { TOUCH_ROWS } else { ROWS };
    ui.spacing_mut().item_spacing.y = 0.0;
    scrolled("seam", rows * height).auto_shrink([false, true]).show_rows(
        ui,
        height,
        reading.order().len(),
        |ui, seen| {
            for &joint in &reading.order()[seen] {
                row(ui, session, reading, joint, state, commands);
            }
        },
    );
}

/// The right ends of the columns of distances and angles.
fn columns(rect: Rect) -> [f32; 2] {
    let right = rect.max.x - INSIDE;
    [right - ANGLE_WIDTH, right]
}

fn captions(ui: &mut Ui) {
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), 17.0), Sense::hover());
    let (font, color) = (FontId::proportional(11.0), Tokens::of(ui).faint);
    let y = rect.center().y;
    let at = pos2(rect.min.x + INSIDE, y);
    ui.painter().text(at, Align2::LEFT_CENTER, "Bone", font.clone(), color);
    for (x, caption) in columns(rect).into_iter().zip(["Distance", "Angle"]) {
        ui.painter()
            .text(pos2(x, y), Align2::RIGHT_CENTER, caption, font.clone(), color);
    }
    response.on_hover_text("Distance in the model, in its units; angle relative to the parent");
}

fn row(
    ui: &mut Ui,
    session: &Session,
    reading: &SeamReading,
    joint: JointIndex,
    state: &mut TimelineState,
    commands: &mut Vec<Command>,
) {
    let tokens = Tokens::of(ui);
    let size = vec2(ui.available_width(), pressed_row_height(ui));
    let (_, rect) = ui.allocate_space(size);
    let response = ui.interact(rect, ui.scope_id().with(("seam of", joint.0)), Sense::click());
    let joints = session.joints();
    let selected = joints.selected() == Some(joint);
    if response.contains_pointer() && !is_touch(ui) {
        state.hovered = Some(joint);
    }
    if selected {
        ui.painter().rect_filled(rect, CONTROL_RADIUS, tokens.accent_ground);
    } else if joints.hovered() == Some(joint) {
        ui.painter().rect_filled(rect, CONTROL_RADIUS, tokens.field_hovered);
    }
    focus_ring(ui, rect, &response);

    let jump = Jump::new(reading, joint);
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
        let (at, number) = (pos2(x, rect.center().y), number.as_deref().unwrap_or("0"));
        ui.painter()
            .text(at, Align2::RIGHT_CENTER, number, theme::mono(11.5), color);
    }
    let name = session.joint_label(joint);
    let color = match (selected, jump.is_something()) {
        (true, _) => tokens.accent,
        (false, true) => tokens.text,
        (false, false) => tokens.faint,
    };
    let at = pos2(rect.min.x + INSIDE, rect.center().y);
    let room = distance_x - DISTANCE_WIDTH - at.x;
    let words = [Some(name.as_str()), jump.scaled.as_deref()];
    let words = words.into_iter().flatten().collect::<Vec<_>>().join(" ");
    paint_elided(ui.painter(), at, &words, FontId::proportional(12.5), color, room);

    response.widget_info(|| {
        let label = format!("Seam of {name}: {}", jump.words());
        WidgetInfo::selected(Role::ListItem, true, selected, label)
    });
    if response.clicked() {
        let joint = (!selected).then_some(joint);
        commands.push(JointCommand::Select(joint).into());
    }
    response.on_hover_ui(|ui| {
        ui.label(format!("{name}\n{}", jump.long_words()));
    });
}

/// The numbers of one row; `None` where one is nothing.
struct Jump {
    distance: Option<String>,
    own_distance: Option<String>,
    angle: Option<String>,
    /// Few clips scale: there is no column for it.
    scaled: Option<String>,
    travel_is_seen: bool,
    own_is_seen: bool,
}

impl Jump {
    fn new(reading: &SeamReading, joint: JointIndex) -> Self {
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
            "{distance} in the model, {own} by its own keys\n{angle} relative to its parent{}",
            scaled.collect::<String>(),
        )
    }
}
