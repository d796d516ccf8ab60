//! Flying through the scene: WASD and QE while the right button is held.

use std::f32::consts::PI;

use egui::{Key, PointerButton, Response, Ui};
use glam::Vec3;

use crate::session::Command;

/// Radians that the head turns for a drag over the height of the view.
const LOOK_PER_HEIGHT: f32 = PI * 0.6;

/// Keys and where they fly: to the right, up, forward.
pub(super) const FLIGHT_KEYS: [(Key, Vec3); 6] = [
    (Key::W, Vec3::Z),
    (Key::S, Vec3::NEG_Z),
    (Key::D, Vec3::X),
    (Key::A, Vec3::NEG_X),
    (Key::E, Vec3::Y),
    (Key::Q, Vec3::NEG_Y),
];

/// A flight from the first key under the held button until the button is let go.
#[derive(Debug, Default)]
pub(super) struct Flight {
    flying: bool,
    asked: (Vec3, bool),
}

impl Flight {
    /// Reads keys and the drag. Whether the drag turns the head instead of carrying the scene.
    pub(super) fn update(&mut self, ui: &Ui, view: &Response, height: f32, commands: &mut Vec<Command>) -> bool {
        let button = ui.input(|input| input.pointer.button_down(PointerButton::Secondary));
        let held = button && view.is_pointer_button_down_on();
        let typing = ui.ctx().text_edit_focused();
        let wanted = if held && !typing { keys_held(ui) } else { Vec3::ZERO };
        self.flying = held && (self.flying || wanted != Vec3::ZERO);
        let asked = (wanted, wanted != Vec3::ZERO && ui.input(|input| input.modifiers.shift));
        if asked != self.asked {
            self.asked = asked;
            let (direction, fast) = asked;
            commands.push(Command::Fly { direction, fast });
        }
        let moved = view.drag_delta() / height * LOOK_PER_HEIGHT;
        if self.flying && moved != egui::Vec2::ZERO {
            commands.push(Command::FlyLook {
                yaw_radians: moved.x,
                pitch_radians: -moved.y,
            });
        }
        self.flying
    }
}

fn keys_held(ui: &Ui) -> Vec3 {
    ui.input(|input| {
        let held = FLIGHT_KEYS.iter().filter(|(key, _)| input.key_down(*key));
        held.map(|&(_, direction)| direction).sum()
    })
}
