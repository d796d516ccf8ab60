//! The few controls that panels are made of.

mod button;
mod chip;
mod color;
mod hsv;
mod number;
mod row;
mod segmented;
mod slider;
mod switch;
mod typed;

use egui::text::{LayoutJob, TextWrapping};
use egui::{
    Color32, CornerRadius, Event, EventFilter, FontId, Key, Painter, Pos2, Rect, Response, Shape, Stroke, StrokeKind,
    Ui, Vec2,
};

pub(super) use button::{TextButton, action_button, icon_button, keyed_menu_item, menu_item, valued_menu_item};
pub(super) use chip::{chip, chip_size, paint_chip};
pub(super) use color::{color_button, color_picker, color32_from_linear, gradient_shape};
pub(super) use number::number_field;
pub(super) use row::{
    SHEET_HANDLE_HEIGHT, choice_row, closable_heading, keyed_section_name, rule, section_name, section_with_action,
    section_with_labelled_action, sheet_handle, value_row,
};
pub(super) use segmented::segmented;
pub(super) use slider::Slider;
pub(super) use switch::{action_switch, switch_row};
pub(super) use typed::{TypedValue, typed_number};

use super::theme::{CONTROL_RADIUS, ROW_HEIGHT, Tokens};

/// Side of a control where a mouse is the pointer.
const MOUSE_CONTROL: f32 = 28.0;
/// Side of a control where fingers are.
const TOUCH_CONTROL: f32 = 44.0;

/// Sizes controls for fingers or for a mouse, from the next pass on.
pub(super) fn size_for_touch(ctx: &egui::Context, touch: bool) {
    let side = if touch { TOUCH_CONTROL } else { MOUSE_CONTROL };
    if ctx.global_style().spacing.interact_size.y != side {
        ctx.all_styles_mut(|style| style.spacing.interact_size = Vec2::splat(side));
        ctx.request_repaint();
    }
}

/// Side of a control, in points.
pub(super) fn control_size(ui: &Ui) -> f32 {
    ui.spacing().interact_size.y
}

/// Whether controls are sized for fingers.
pub(super) fn is_touch(ui: &Ui) -> bool {
    control_size(ui) > MOUSE_CONTROL
}

/// Whether the pointer is a finger. A screen that was touched may have a mouse too, which keeps what it can do.
pub(super) fn by_finger(ui: &Ui) -> bool {
    ui.input(|input| {
        if input.has_touch_screen() {
            input.any_touches()
        } else {
            is_touch(ui)
        }
    })
}

/// A key to show beside what it does: fingers have none.
pub(super) fn key_hint<'a>(ui: &Ui, key: &'a str) -> &'a str {
    if is_touch(ui) { "" } else { key }
}

/// Height of a row of a panel that can be pressed.
pub(super) fn pressed_row_height(ui: &Ui) -> f32 {
    if is_touch(ui) { TOUCH_CONTROL } else { ROW_HEIGHT }
}

/// Shows which control has the keyboard.
pub(super) fn focus_ring(ui: &Ui, rect: Rect, response: &Response) {
    if response.has_focus() {
        let stroke = Stroke::new(1.5, Tokens::of(ui).accent);
        ui.painter()
            .rect_stroke(rect, CornerRadius::same(CONTROL_RADIUS), stroke, StrokeKind::Inside);
    }
}

/// Draws words that begin at a point, in the middle of their height; what is longer than `most` ends in an ellipsis.
pub(super) fn paint_elided(painter: &Painter, at: Pos2, text: &str, font: FontId, color: Color32, most: f32) {
    let mut job = LayoutJob::simple_singleline(text.to_owned(), font, color);
    job.wrap = TextWrapping::truncate_at_width(most.max(0.0));
    let galley = painter.layout_job(job);
    painter.galley(at - Vec2::new(0.0, galley.size().y * 0.5), galley, color);
}

/// The mark before something that folds: it points to the right while folded, or else down.
pub(super) fn paint_fold_mark(painter: &Painter, center: Pos2, folded: bool, color: Color32) {
    let corners = if folded {
        [Vec2::new(-1.7, -3.4), Vec2::new(1.7, 0.0), Vec2::new(-1.7, 3.4)]
    } else {
        [Vec2::new(-3.4, -1.7), Vec2::new(0.0, 1.7), Vec2::new(3.4, -1.7)]
    };
    let corners = corners.map(|corner| center + corner).to_vec();
    painter.add(Shape::line(corners, Stroke::new(1.4, color)));
}

/// Steps that arrow keys ask of a control that has the keyboard: right and up count up. They are taken, so that nothing else
/// acts on them.
pub(super) fn arrow_steps(ui: &Ui, response: &Response) -> f32 {
    if !response.has_focus() {
        return 0.0;
    }
    let filter = EventFilter {
        horizontal_arrows: true,
        vertical_arrows: true,
        ..EventFilter::default()
    };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, filter));
    let mut steps = 0.0;
    ui.input_mut(|input| {
        input.events.retain(|event| {
            let step = match event {
                Event::Key { key, pressed: true, .. } => match key {
                    Key::ArrowRight | Key::ArrowUp => 1.0,
                    Key::ArrowLeft | Key::ArrowDown => -1.0,
                    _ => return true,
                },
                _ => return true,
            };
            steps += step;
            false
        });
    });
    steps
}
