//! What controls have in common: their size, the focus ring, words that end in an ellipsis, arrow keys. And chips: small rounded labels.

use std::ops::RangeInclusive;

use egui::accesskit::{Action, ActionData};
use egui::text::{LayoutJob, TextWrapping};
use egui::{
    Align2, Color32, CornerRadius, Event, EventFilter, FontId, Key, Painter, Pos2, Rect, Response, Role, Sense, Shape,
    Stroke, StrokeKind, Ui, Vec2, WidgetInfo, vec2,
};

use crate::ui::theme::{CONTROL_RADIUS, ROW_HEIGHT, Tokens};

/// Side of a control for a mouse.
pub(super) const MOUSE_CONTROL: f32 = 28.0;
/// Side of a control for fingers.
pub(super) const TOUCH_CONTROL: f32 = 44.0;

/// Sizes controls for fingers or for a mouse, from the next pass on.
pub(crate) fn size_for_touch(ctx: &egui::Context, touch: bool) {
    let side = if touch { TOUCH_CONTROL } else { MOUSE_CONTROL };
    if ctx.global_style().spacing.interact_size.y != side {
        ctx.all_styles_mut(|style| style.spacing.interact_size = Vec2::splat(side));
        ctx.request_repaint();
    }
}

/// Side of a control, in points.
pub(crate) fn control_size(ui: &Ui) -> f32 {
    ui.spacing().interact_size.y
}

/// Whether controls are sized for fingers.
pub(crate) fn is_touch(ui: &Ui) -> bool {
    control_size(ui) > MOUSE_CONTROL
}

/// Whether the pointer is a finger. A touch screen may have a mouse too, and then it acts as one.
pub(crate) fn by_finger(ui: &Ui) -> bool {
    ui.input(|input| {
        if input.has_touch_screen() {
            input.any_touches()
        } else {
            is_touch(ui)
        }
    })
}

/// A key to show beside what it does. By touch none.
pub(crate) fn key_hint<'a>(ui: &Ui, key: &'a str) -> &'a str {
    if is_touch(ui) { "" } else { key }
}

/// Height of a row of a panel that can be pressed.
pub(crate) fn pressed_row_height(ui: &Ui) -> f32 {
    if is_touch(ui) { TOUCH_CONTROL } else { ROW_HEIGHT }
}

/// A ring round the focused control.
pub(crate) fn focus_ring(ui: &Ui, rect: Rect, response: &Response) {
    if response.has_focus() {
        let stroke = Stroke::new(1.5, Tokens::of(ui).accent);
        ui.painter()
            .rect_stroke(rect, CornerRadius::same(CONTROL_RADIUS), stroke, StrokeKind::Inside);
    }
}

/// Draws the ground of a row, a little wider than its contents, and the focus ring.
pub(crate) fn paint_row_ground(ui: &Ui, rect: Rect, response: &Response, selected: bool, over: bool) {
    let tokens = Tokens::of(ui);
    let around = rect.expand2(vec2(6.0, 0.0));
    if selected {
        ui.painter().rect_filled(around, CONTROL_RADIUS, tokens.accent_ground);
    } else if over {
        ui.painter().rect_filled(around, CONTROL_RADIUS, tokens.field);
    }
    focus_ring(ui, around, response);
}

/// Draws words from a point at their left centre. Words wider than `most` end in an ellipsis.
pub(crate) fn paint_elided(painter: &Painter, at: Pos2, text: &str, font: FontId, color: Color32, most: f32) {
    let mut job = LayoutJob::simple_singleline(text.to_owned(), font, color);
    job.wrap = TextWrapping::truncate_at_width(most.max(0.0));
    let galley = painter.layout_job(job);
    painter.galley(at - Vec2::new(0.0, galley.size().y * 0.5), galley, color);
}

/// The mark before something that folds. It points right while folded, otherwise down.
pub(crate) fn paint_fold_mark(painter: &Painter, center: Pos2, folded: bool, color: Color32) {
    let corners = if folded {
        [Vec2::new(-1.7, -3.4), Vec2::new(1.7, 0.0), Vec2::new(-1.7, 3.4)]
    } else {
        [Vec2::new(-3.4, -1.7), Vec2::new(0.0, 1.7), Vec2::new(3.4, -1.7)]
    };
    let corners = corners.map(|corner| center + corner).to_vec();
    painter.add(Shape::line(corners, Stroke::new(1.4, color)));
}

/// Steps of the arrow keys in a focused control: right and up count up. The keys are consumed, so that nothing else acts on them.
pub(crate) fn arrow_steps(ui: &Ui, response: &Response) -> f32 {
    let steps = focused_keys(ui, response, &ARROWS)
        .into_iter()
        .map(|(key, _)| match key {
            Key::ArrowRight | Key::ArrowUp => 1.0,
            _ => -1.0,
        });
    steps.sum()
}

const ARROWS: [Key; 4] = [Key::ArrowLeft, Key::ArrowRight, Key::ArrowUp, Key::ArrowDown];

/// Presses of these keys in a focused control, and whether Shift was held. They are consumed, so that nothing else acts on them. Keys
/// with Ctrl, Alt or Command are left alone.
pub(crate) fn focused_keys(ui: &Ui, response: &Response, wanted: &[Key]) -> Vec<(Key, bool)> {
    if !response.has_focus() {
        return Vec::new();
    }
    let filter = EventFilter {
        horizontal_arrows: wanted.contains(&Key::ArrowRight),
        vertical_arrows: wanted.contains(&Key::ArrowUp),
        ..EventFilter::default()
    };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, filter));
    let mut pressed = Vec::new();
    ui.input_mut(|input| {
        input.events.retain(|event| match event {
            Event::Key {
                key,
                pressed: true,
                modifiers,
                ..
            } if wanted.contains(key) && !modifiers.command && !modifiers.ctrl && !modifiers.alt => {
                pressed.push((*key, modifiers.shift));
                false
            }
            _ => true,
        });
    });
    pressed
}

/// A slider as screen readers have it.
#[derive(Clone, Debug)]
pub(crate) struct SliderNode<'a> {
    pub(crate) name: &'a str,
    pub(crate) value: f64,
    pub(crate) range: RangeInclusive<f64>,
    pub(crate) step: f64,
    /// The value in words.
    pub(crate) text: &'a str,
}

impl SliderNode<'_> {
    /// Tells of it. Returns how many steps up they ask for, and which value.
    pub(crate) fn tell(&self, ui: &Ui, response: &Response) -> (i32, Option<f64>) {
        response.widget_info(|| WidgetInfo::slider(true, self.value, self.name));
        ui.ctx().accesskit_node_builder(response.id, |node| {
            node.set_min_numeric_value(*self.range.start());
            node.set_max_numeric_value(*self.range.end());
            node.set_numeric_value_step(self.step);
            node.set_value(self.text);
            for action in [Action::SetValue, Action::Increment, Action::Decrement] {
                node.add_action(action);
            }
        });
        ui.input(|input| {
            let count = |action| input.num_accesskit_action_requests(response.id, action) as i32;
            let set = input.accesskit_action_requests(response.id, Action::SetValue);
            let value = set.filter_map(|request| match request.data {
                Some(ActionData::NumericValue(value)) if value.is_finite() => Some(value),
                _ => None,
            });
            (count(Action::Increment) - count(Action::Decrement), value.last())
        })
    }
}

/// Margins of a chip: left and right together, top and bottom together.
const AROUND: Vec2 = vec2(14.0, 5.0);

/// A chip in a row.
pub(crate) fn chip(ui: &mut Ui, text: &str, color: Color32) -> Response {
    let ground = Tokens::of(ui).field;
    let galley = layout(ui.painter(), text, color);
    let (rect, response) = ui.allocate_exact_size(galley.size() + AROUND, Sense::hover());
    paint_chip(ui.painter(), rect.min, Align2::LEFT_TOP, text, color, ground);
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, text));
    response
}

/// How large a chip is.
pub(crate) fn chip_size(ui: &Ui, text: &str) -> Vec2 {
    layout(ui.painter(), text, Color32::WHITE).size() + AROUND
}

/// Draws a chip whose `anchor` is at a point. Returns its rect.
pub(crate) fn paint_chip(
    painter: &Painter,
    at: Pos2,
    anchor: Align2,
    text: &str,
    color: Color32,
    ground: Color32,
) -> Rect {
    let galley = layout(painter, text, color);
    let rect = anchor.anchor_size(at, galley.size() + AROUND);
    painter.rect_filled(rect, rect.height() * 0.5, ground);
    painter.galley(rect.min + AROUND * 0.5, galley, color);
    rect
}

fn layout(painter: &Painter, text: &str, color: Color32) -> std::sync::Arc<egui::Galley> {
    painter.layout_no_wrap(text.to_owned(), FontId::proportional(11.5), color)
}
