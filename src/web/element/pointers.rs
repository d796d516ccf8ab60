//! Events of pointers and wheel, read as gestures on the view.

use glam::Vec2;
use wasm_bindgen::JsValue;

use crate::actions;
use crate::gestures::{self, Grab, ViewDrag};
use crate::session::{CameraCommand, Command, Session};
use crate::web::{field, now_secs};

/// A pointer that went farther before it let go was no click, in CSS pixels.
const MOST_CLICK_DISTANCE: f32 = 6.0;
/// CSS pixels of a line, for wheels that count lines.
const LINE_HEIGHT: f32 = 40.0;
/// Factor of a touch pad's pinch for each CSS pixel that the browser tells of it, as a logarithm.
const PINCH_PER_PIXEL: f32 = 1.0 / 200.0;

/// A pointer that is down. Places are CSS pixels from the canvas' upper left corner.
#[derive(Debug)]
struct Pointer {
    id: f64,
    is_primary: bool,
    pressed_at: Vec2,
    at: Vec2,
}

/// The pointers that hold the view.
#[derive(Debug, Default)]
pub(super) struct Pointers {
    down: Vec<Pointer>,
    drag: ViewDrag,
    /// Whether what holds the view, or held it last, is no click.
    has_dragged: bool,
}

impl Pointers {
    /// Whether there are any.
    pub(super) fn hold(&self) -> bool {
        !self.down.is_empty()
    }

    /// What an event of the canvas asks for; `size` is the canvas' in CSS pixels. Other events ask for nothing.
    pub(super) fn read(&mut self, event: &JsValue, size: Vec2, session: &Session) -> Vec<Command> {
        let number = |name| field(event, name).as_f64().unwrap_or_default();
        let at = Vec2::new(number("offsetX") as f32, number("offsetY") as f32);
        let id = number("pointerId");
        let height = size.y.max(1.0);
        match field(event, "type").as_string().as_deref() {
            Some("pointerdown") => self.press(Pointer {
                id,
                is_primary: number("button") == 0.0,
                pressed_at: at,
                at,
            }),
            Some("pointermove") => {
                let held = |name| field(event, name).is_truthy();
                self.follow(id, at, [held("shiftKey"), held("altKey")], size)
            }
            Some("pointerup") => self.release(id, true),
            Some("pointercancel") => self.release(id, false),
            Some("click") if !self.has_dragged => {
                let picks_bones = session.look().skin_view.is_some() || session.look().bones_visible;
                let selected = gestures::click(gestures::in_picture(at / size), picks_bones);
                let is_second = number("detail") >= 2.0;
                let framed = is_second.then(|| actions::FRAME_MODEL.command(session)).flatten();
                vec![framed.unwrap_or(selected)]
            }
            Some("wheel") => {
                let unit = [1.0, LINE_HEIGHT, height][(number("deltaMode") as usize).min(2)];
                let points = -number("deltaY") as f32 * unit;
                let pointer = (at - size / 2.0) / height;
                // That is how browsers tell of a touch pad's pinch.
                let zoom = if field(event, "ctrlKey").is_truthy() {
                    gestures::zoom(0.0, (points * PINCH_PER_PIXEL).exp(), pointer)
                } else {
                    gestures::zoom(points, 1.0, pointer)
                };
                zoom.into_iter().collect()
            }
            _ => Vec::new(),
        }
    }

    fn press(&mut self, pointer: Pointer) -> Vec<Command> {
        let is_first = self.down.is_empty();
        self.has_dragged = !is_first;
        self.down.retain(|down| down.id != pointer.id);
        self.down.push(pointer);
        is_first.then(|| CameraCommand::BeginDrag.into()).into_iter().collect()
    }

    fn follow(&mut self, id: f64, at: Vec2, [shift, alt]: [bool; 2], size: Vec2) -> Vec<Command> {
        let Some(index) = self.down.iter().position(|pointer| pointer.id == id) else {
            return Vec::new();
        };
        let pointer = &mut self.down[index];
        let height = size.y.max(1.0);
        let before = std::mem::replace(&mut pointer.at, at);
        self.has_dragged |= at.distance(pointer.pressed_at) > MOST_CLICK_DISTANCE;
        let grab = Grab::of(pointer.is_primary, shift, alt);
        if let [first, second] = &self.down[..] {
            self.drag.end();
            let other = if index == 0 { second.at } else { first.at };
            let spread = at.distance(other).max(1.0) / before.distance(other).max(1.0);
            let middle = (at.midpoint(other) - size / 2.0) / height;
            return gestures::pinch((at - before) / 2.0 / height, spread, middle).collect();
        }
        let moved = self.has_dragged.then_some((at - before) / height);
        let command = moved.and_then(|moved| self.drag.drag(grab, moved, now_secs()));
        command.into_iter().collect()
    }

    fn release(&mut self, id: f64, flings: bool) -> Vec<Command> {
        let were_down = self.down.len();
        self.down.retain(|pointer| pointer.id != id);
        if were_down == self.down.len() || self.hold() {
            return Vec::new();
        }
        let fling = if flings { self.drag.fling(now_secs()) } else { None };
        self.drag.end();
        fling.into_iter().chain([CameraCommand::EndDrag.into()]).collect()
    }
}
