//! The line that divides the picture between both lights, and its handle.

use egui::{Align2, Color32, CursorIcon, Rect, Response, Sense, Shape, Stroke, Ui, pos2, vec2};

use crate::actions::Control;
use crate::scene::Light;
use crate::session::{Command, LookCommand, Session};
use crate::ui::kit::theme::Tokens;
use crate::ui::kit::{SliderNode, is_touch, named, paint_chip, slider_keys};

/// Where the line can be, as fractions of the window's width.
const REACH: std::ops::RangeInclusive<f32> = 0.02..=0.98;
/// One step of an arrow key, as a fraction of the width.
const KEY_STEP: f32 = 0.01;
const HANDLE_RADIUS: f32 = 13.0;

/// Shows the line while the picture is divided.
pub(in crate::ui) fn show(ui: &Ui, session: &Session, window: Rect, free: Rect, commands: &mut Vec<Command>) {
    let Some(fraction) = session.look().split else { return };
    let x = window.min.x + fraction * window.width();
    // The handle is in the middle of the window, or higher if panels at the bottom leave less room.
    let handle = pos2(x, window.center().y.min(free.center().y));
    let reach = if is_touch(ui) { 22.0 } else { HANDLE_RADIUS };
    let id = ui.scope_id().with("split");
    // The line's target is thin, so that the model beside it can still be touched. Fingers use the handle.
    let line = Rect::from_x_y_ranges(x - 4.0..=x + 4.0, window.y_range());
    let line = ui.interact(line, id.with("line"), Sense::CLICK | Sense::DRAG);
    let grip = Rect::from_center_size(handle, egui::Vec2::splat(2.0 * reach));
    let grip = ui.interact(grip, id.with("handle"), Sense::click_and_drag());
    let active = [&line, &grip].into_iter().any(|part| part.hovered() || part.dragged());
    if active {
        ui.ctx().set_cursor_icon(CursorIcon::ResizeHorizontal);
    }
    paint(
        ui,
        window,
        free.min.y,
        handle,
        session.look().light,
        active || grip.has_focus(),
    );

    let text = format!("{:.0} %", 100.0 * fraction);
    let slider = SliderNode {
        name: "Split",
        value: f64::from(fraction),
        range: f64::from(*REACH.start())..=f64::from(*REACH.end()),
        step: f64::from(KEY_STEP),
        text: &text,
    };
    let keyed = slider_keys(ui, &grip, &slider);
    let grip = named(grip, Control::new("split-handle"));
    let asked = if line.double_clicked() || grip.double_clicked() {
        Some(0.5)
    } else if let Some(keyed) = keyed {
        Some(keyed as f32)
    } else {
        let pointer = dragged_to(&line).or_else(|| dragged_to(&grip));
        pointer.map(|pointer| (pointer - window.min.x) / window.width().max(1.0))
    };
    if let Some(asked) = asked {
        let fraction = asked.clamp(*REACH.start(), *REACH.end());
        commands.push(LookCommand::SetSplit(Some(fraction)).into());
    }
}

fn dragged_to(part: &Response) -> Option<f32> {
    let pointer = part.interact_pointer_pos().filter(|_| part.dragged())?;
    Some(pointer.x)
}

fn paint(ui: &Ui, window: Rect, top: f32, handle: egui::Pos2, light: Light, active: bool) {
    let tokens = Tokens::of(ui);
    let painter = ui.painter();
    // A light line with a dark edge is visible on any picture.
    painter.vline(
        handle.x,
        window.y_range(),
        Stroke::new(3.0, Color32::from_black_alpha(50)),
    );
    let color = if active {
        tokens.accent
    } else {
        Color32::from_white_alpha(230)
    };
    painter.vline(handle.x, window.y_range(), Stroke::new(1.0, color));

    let ground = tokens.panel.to_opaque();
    painter.circle_filled(
        handle + vec2(0.0, 2.0),
        HANDLE_RADIUS + 2.0,
        Color32::from_black_alpha(40),
    );
    painter.circle(handle, HANDLE_RADIUS, ground, Stroke::new(1.5, color));
    let arrow = if active { tokens.accent } else { tokens.muted };
    for side in [-1.0, 1.0] {
        let at = |x: f32, y: f32| handle + vec2(side * x, y);
        let points = vec![at(3.5, -4.0), at(7.5, 0.0), at(3.5, 4.0)];
        painter.add(Shape::line(points, Stroke::new(1.4, arrow)));
    }

    let sides = [(light.other(), Align2::RIGHT_TOP, -8.0), (light, Align2::LEFT_TOP, 8.0)];
    for (light, anchor, away) in sides {
        let at = pos2(handle.x + away, top);
        paint_chip(painter, at, anchor, light.label(), tokens.text, tokens.panel);
    }
}
