//! What scripts can ask of the transport: steps, ends, range, speed, what happens at the end.

use wasm_bindgen::prelude::*;

use super::api::{apply, of_session};
use crate::anim::{Direction, LoopMode, WrapMode};
use crate::session::Command;

/// Names of what happens at the end, as the state gives them.
const LOOP_NAMES: [(LoopMode, &str); 3] = [
    (LoopMode::Once, "once"),
    (LoopMode::Loop, "loop"),
    (LoopMode::PingPong, "pingpong"),
];

/// Names of how a loop goes on.
const WRAP_NAMES: [(WrapMode, &str); 2] = [(WrapMode::Wrap, "wrap"), (WrapMode::BookDemo, "book-demo")];

pub(super) fn loop_name(mode: LoopMode) -> &'static str {
    name_of(&LOOP_NAMES, mode)
}

pub(super) fn wrap_name(mode: WrapMode) -> &'static str {
    name_of(&WRAP_NAMES, mode)
}

fn name_of<T: Copy + PartialEq>(names: &[(T, &'static str)], value: T) -> &'static str {
    let named = names.iter().find(|(named, _)| *named == value);
    named.map_or("", |(_, name)| name)
}

fn named<T: Copy>(names: &[(T, &str)], wanted: &str) -> Option<T> {
    let named = names.iter().find(|(_, name)| *name == wanted);
    named.map(|(value, _)| *value)
}

/// Pauses and goes some frames on, or back where the number is below 0, to a whole frame.
#[wasm_bindgen(js_name = stepFrames)]
pub fn step_frames(frames: i32) {
    apply(Command::StepFrames(frames));
}

fn step_key(direction: Direction) {
    let joint = of_session(|session| session.joints().selected());
    apply(Command::StepKey { direction, joint });
}

/// Pauses and goes to the next key: of the selected bone, or of any.
#[wasm_bindgen(js_name = nextKey)]
pub fn next_key() {
    step_key(Direction::Forward);
}

/// Pauses and goes to the key before: of the selected bone, or of any.
#[wasm_bindgen(js_name = previousKey)]
pub fn previous_key() {
    step_key(Direction::Backward);
}

/// Goes to the first frame of what plays.
#[wasm_bindgen(js_name = seekStart)]
pub fn seek_start() {
    apply(Command::SeekStart);
}

/// Goes to the last frame of what plays.
#[wasm_bindgen(js_name = seekEnd)]
pub fn seek_end() {
    apply(Command::SeekEnd);
}

/// Lets playing begin at a time in seconds, or at the present one.
#[wasm_bindgen(js_name = setRangeStart)]
pub fn set_range_start(secs: Option<f32>) {
    apply(Command::SetRangeStart(secs));
}

/// Lets playing end at a time in seconds, or at the present one.
#[wasm_bindgen(js_name = setRangeEnd)]
pub fn set_range_end(secs: Option<f32>) {
    apply(Command::SetRangeEnd(secs));
}

/// Lets the whole clip play.
#[wasm_bindgen(js_name = clearRange)]
pub fn clear_range() {
    apply(Command::ClearRange);
}

/// Sets the speed, 1 as the file has it, within the limits of the viewer.
#[wasm_bindgen(js_name = setSpeed)]
pub fn set_speed(speed: f32) {
    apply(Command::SetSpeed(speed));
}

/// Sets what happens at the end: `once`, `loop` or `pingpong`. Returns whether the name is one of these.
#[wasm_bindgen(js_name = setLoop)]
pub fn set_loop(name: &str) -> bool {
    let mode = named(&LOOP_NAMES, name);
    if let Some(mode) = mode {
        apply(Command::SetLoopMode(mode));
    }
    mode.is_some()
}

/// Sets how a loop goes on: `wrap` or `book-demo`. Returns whether the name is one of these.
#[wasm_bindgen(js_name = setWrap)]
pub fn set_wrap(name: &str) -> bool {
    let mode = named(&WRAP_NAMES, name);
    if let Some(mode) = mode {
        apply(Command::SetWrapMode(mode));
    }
    mode.is_some()
}
