//! The 3D view that fills the page: pointer and fingers to camera commands.

use std::f32::consts::PI;

use egui::{Modifiers, PointerButton, Pos2, Rect, Response, Role, Sense, Ui, WidgetInfo};
use glam::Vec2;

use super::drag_trail::DragTrail;
use super::flight::Flight;
use crate::session::{Command, LookCommand};

/// Radians of orbit for a drag over the height of the view.
const ORBIT_PER_HEIGHT: f32 = PI * 1.1;
/// Radians that the surroundings turn for a drag over the height of the view.
const ENVIRONMENT_TURN_PER_HEIGHT: f32 = PI;
/// Distance factor of one point of wheel movement.
const ZOOM_PER_POINT: f32 = 0.0025;

/// How the pointer holds the view.
#[derive(Debug, Default)]
pub(super) struct ViewHold {
    held: bool,
    orbit: DragTrail,
    flight: Flight,
}

/// Takes the whole window behind the panels. `popover_open`: a click shuts something, and means nothing else.
pub(super) fn show(ui: &Ui, rect: Rect, hold: &mut ViewHold, popover_open: bool, commands: &mut Vec<Command>) {
    let response = ui.interact(rect, ui.scope_id().with("viewport"), Sense::click_and_drag());
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, "Model view"));
    let height = rect.height().max(1.0);
    let shares = |v: egui::Vec2| Vec2::new(v.x, v.y) / height;

    let down = response.is_pointer_button_down_on();
    if down != hold.held {
        hold.held = down;
        commands.push(if down { Command::BeginDrag } else { Command::EndDrag });
    }
    if let Some(touch) = ui.input(egui::InputState::multi_touch)
        && rect.contains(touch.center_pos)
        && down
    {
        hold.orbit.clear();
        commands.push(Command::Pan {
            drag: shares(touch.translation_delta),
        });
        if touch.zoom_delta != 1.0 {
            let pointer = shares(touch.center_pos - rect.center());
            commands.push(Command::Zoom {
                factor: 1.0 / touch.zoom_delta,
                pointer,
            });
        }
        return;
    }
    let flies = hold.flight.update(ui, &response, height, commands);
    drag(ui, &response, &shares, flies, hold, commands);
    if response.double_clicked() {
        commands.push(Command::Glide(Box::new(Command::FrameModel)));
    } else if response.clicked()
        && !popover_open
        && let Some(pointer) = response.interact_pointer_pos()
    {
        commands.push(Command::SelectAt(in_picture(rect, pointer)));
    }
    if let Some(pointer) = response.hover_pos() {
        let (wheel, pinch) = ui.input(|input| (input.smooth_scroll_delta().y, input.zoom_delta()));
        let factor = (-wheel * ZOOM_PER_POINT).exp() / pinch;
        if factor != 1.0 {
            commands.push(Command::Zoom {
                factor,
                pointer: shares(pointer - rect.center()),
            });
        }
    }
}

/// What a drag with one pointer does: the surroundings, the model or the eye move.
fn drag(
    ui: &Ui,
    response: &Response,
    shares: &dyn Fn(egui::Vec2) -> Vec2,
    flies: bool,
    hold: &mut ViewHold,
    commands: &mut Vec<Command>,
) {
    let Modifiers { shift, alt, .. } = ui.input(|input| input.modifiers);
    let moved = shares(response.drag_delta());
    let now_secs = ui.input(|input| input.time);
    let orbits = response.dragged_by(PointerButton::Primary) && !shift && !alt;
    if orbits {
        let turn = moved * ORBIT_PER_HEIGHT;
        hold.orbit.add(now_secs, turn);
        if turn != Vec2::ZERO {
            commands.push(Command::Orbit {
                yaw_radians: turn.x,
                pitch_radians: turn.y,
            });
        }
    } else if alt && response.dragged_by(PointerButton::Primary) {
        let turn = moved.x * ENVIRONMENT_TURN_PER_HEIGHT;
        if turn != 0.0 {
            commands.push(LookCommand::TurnEnvironment(turn).into());
        }
    } else if response.dragged() && !flies {
        commands.push(Command::Pan { drag: moved });
    }
    if response.drag_stopped() {
        let rate = hold.orbit.rate_per_sec(now_secs);
        if rate != Vec2::ZERO && !shift && !alt {
            commands.push(Command::Fling {
                yaw_radians_per_sec: rate.x,
                pitch_radians_per_sec: rate.y,
            });
        }
    }
    if !orbits {
        hold.orbit.clear();
    }
}

/// A point of the window in the picture: x right, y up, −1…1.
pub(super) fn in_picture(rect: Rect, at: Pos2) -> Vec2 {
    let share = (at - rect.min) / rect.size();
    Vec2::new(2.0 * share.x - 1.0, 1.0 - 2.0 * share.y)
}
