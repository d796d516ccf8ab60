//! The 3D view that fills the page. Turns pointer and fingers into camera commands.

use std::f32::consts::PI;

use egui::{Id, Key, Modifiers, PointerButton, Pos2, Rect, Response, Role, Sense, Ui, WidgetInfo};
use glam::{Vec2, Vec3};

use crate::gestures::{self, Grab, ViewDrag};
use crate::session::{CameraCommand, Command};
use crate::ui::cx::Cx;

#[derive(Debug, Default)]
pub(in crate::ui) struct ViewHold {
    held: bool,
    drag: ViewDrag,
    flight: Flight,
}

impl ViewHold {
    pub(in crate::ui) fn is_held(&self) -> bool {
        self.held
    }
}

/// The id of the view in the window's `Ui`.
pub(in crate::ui) fn id(ui: &Ui) -> Id {
    ui.scope_id().with("viewport")
}

/// The whole window behind the panels. A click selects a bone or a vertex if `picks_bones`, otherwise a submesh. `popover_open`: a click
/// closes what is open and does nothing else. Returns whether it was clicked.
pub(in crate::ui) fn show(
    ui: &Ui,
    rect: Rect,
    cx: &mut Cx<'_, ViewHold>,
    picks_bones: bool,
    popover_open: bool,
) -> bool {
    let response = ui.interact(rect, id(ui), Sense::click_and_drag());
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, "Model view"));
    let height = rect.height().max(1.0);
    let fractions = |v: egui::Vec2| Vec2::new(v.x, v.y) / height;

    let down = response.is_pointer_button_down_on();
    if down != cx.state.held {
        cx.state.held = down;
        let command = if down {
            CameraCommand::BeginDrag
        } else {
            CameraCommand::EndDrag
        };
        cx.push(command);
    }
    if let Some(touch) = ui.input(egui::InputState::multi_touch)
        && rect.contains(touch.center_pos)
        && down
    {
        cx.state.drag.end();
        let middle = fractions(touch.center_pos - rect.center());
        let pinch = gestures::pinch(fractions(touch.translation_delta), touch.zoom_delta, middle);
        cx.commands.extend(pinch);
        return false;
    }
    let flies = cx.state.flight.update(ui, &response, height, cx.commands);
    drag(ui, &response, &fractions, flies, cx);
    if response.double_clicked() {
        cx.push(CameraCommand::Glide(Box::new(CameraCommand::FrameModel)));
    } else if response.clicked()
        && !popover_open
        && let Some(pointer) = response.interact_pointer_pos()
    {
        cx.push(gestures::click(in_picture(rect, pointer), picks_bones));
    }
    // egui lets the view have a pointer that is on a panel but near its edge.
    let on_view = |&pointer: &Pos2| ui.ctx().layer_id_at(pointer) == Some(ui.layer_id());
    if let Some(pointer) = response.hover_pos().filter(on_view) {
        let (wheel, pinch) = ui.input(|input| (input.smooth_scroll_delta().y, input.zoom_delta()));
        let zoom = gestures::zoom(wheel, pinch, fractions(pointer - rect.center()));
        cx.commands.extend(zoom);
    }
    response.clicked()
}

/// A drag with one pointer moves the environment, the model or the eye.
fn drag(ui: &Ui, response: &Response, fractions: &dyn Fn(egui::Vec2) -> Vec2, flies: bool, cx: &mut Cx<'_, ViewHold>) {
    let Modifiers { shift, alt, .. } = ui.input(|input| input.modifiers);
    let now_secs = ui.input(|input| input.time);
    let grab = Grab::of(response.dragged_by(PointerButton::Primary), shift, alt);
    let ViewHold { drag, .. } = &mut *cx.state;
    if response.dragged() && !(flies && grab == Grab::Pan) {
        cx.commands
            .extend(drag.drag(grab, fractions(response.drag_delta()), now_secs));
    } else if response.drag_stopped() && !shift && !alt {
        cx.commands.extend(drag.fling(now_secs));
    } else {
        drag.end();
    }
}

/// A point of the window in the picture: x right, y up, −1…1.
pub(in crate::ui) fn in_picture(rect: Rect, at: Pos2) -> Vec2 {
    let fractions = (at - rect.min) / rect.size();
    gestures::in_picture(Vec2::new(fractions.x, fractions.y))
}

/// Radians that the head turns for a drag over the height of the view.
const LOOK_PER_HEIGHT: f32 = PI * 0.6;

/// Keys and where they fly: to the right, up, forward.
pub(in crate::ui) const FLIGHT_KEYS: [(Key, Vec3); 6] = [
    (Key::W, Vec3::Z),
    (Key::S, Vec3::NEG_Z),
    (Key::D, Vec3::X),
    (Key::A, Vec3::NEG_X),
    (Key::E, Vec3::Y),
    (Key::Q, Vec3::NEG_Y),
];

/// A flight: from the first key while the button is held until the button is released.
#[derive(Debug, Default)]
struct Flight {
    flying: bool,
    asked: (Vec3, bool),
}

impl Flight {
    /// Reads keys and the drag. Returns whether the drag turns the head instead of moving the scene.
    fn update(&mut self, ui: &Ui, view: &Response, height: f32, commands: &mut Vec<Command>) -> bool {
        let button = ui.input(|input| input.pointer.button_down(PointerButton::Secondary));
        let held = button && view.is_pointer_button_down_on();
        let typing = ui.ctx().text_edit_focused();
        let wanted = if held && !typing { keys_held(ui) } else { Vec3::ZERO };
        self.flying = held && (self.flying || wanted != Vec3::ZERO);
        let asked = (wanted, wanted != Vec3::ZERO && ui.input(|input| input.modifiers.shift));
        if asked != self.asked {
            self.asked = asked;
            let (direction, fast) = asked;
            commands.push(CameraCommand::Fly { direction, fast }.into());
        }
        let moved = view.drag_delta() / height * LOOK_PER_HEIGHT;
        if self.flying && moved != egui::Vec2::ZERO {
            commands.push(Command::Camera(CameraCommand::FlyLook {
                yaw_radians: moved.x,
                pitch_radians: -moved.y,
            }));
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
