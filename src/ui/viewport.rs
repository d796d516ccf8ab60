//! The 3D view that fills the page: pointer and fingers to camera commands.

use std::f32::consts::PI;

use egui::{Modifiers, PointerButton, Rect, Response, Role, Sense, Ui, WidgetInfo};
use glam::Vec2;

use crate::session::{Command, LookCommand};

/// Radians of orbit for a drag over the height of the view.
const ORBIT_PER_HEIGHT: f32 = PI * 1.1;
/// Radians that the surroundings turn for a drag over the height of the view.
const ENVIRONMENT_TURN_PER_HEIGHT: f32 = PI;
/// Distance factor of one point of wheel movement.
const ZOOM_PER_POINT: f32 = 0.0025;

/// Takes the whole window behind the panels.
pub(super) fn show(ui: &mut Ui, rect: Rect, commands: &mut Vec<Command>) -> Response {
    let response = ui.interact(rect, ui.scope_id().with("viewport"), Sense::click_and_drag());
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, "Model view"));
    let height = rect.height().max(1.0);
    let shares = |v: egui::Vec2| Vec2::new(v.x, v.y) / height;

    if let Some(touch) = ui.input(egui::InputState::multi_touch)
        && rect.contains(touch.center_pos)
        && response.is_pointer_button_down_on()
    {
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
        return response;
    }
    let Modifiers { shift, alt, .. } = ui.input(|input| input.modifiers);
    if alt && response.dragged_by(PointerButton::Primary) {
        let turn = shares(response.drag_delta()).x * ENVIRONMENT_TURN_PER_HEIGHT;
        if turn != 0.0 {
            commands.push(LookCommand::TurnEnvironment(turn).into());
        }
    } else if response.dragged_by(PointerButton::Secondary)
        || response.dragged_by(PointerButton::Middle)
        || (response.dragged_by(PointerButton::Primary) && shift)
    {
        commands.push(Command::Pan {
            drag: shares(response.drag_delta()),
        });
    } else if response.dragged_by(PointerButton::Primary) {
        let turn = shares(response.drag_delta()) * ORBIT_PER_HEIGHT;
        if turn != Vec2::ZERO {
            commands.push(Command::Orbit {
                yaw_radians: turn.x,
                pitch_radians: turn.y,
            });
        }
    }
    if response.double_clicked() {
        commands.push(Command::FrameModel);
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
    response
}
