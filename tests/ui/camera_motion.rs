//! What the camera does by itself after the pointer: it runs on, and it flies.

use bindpose::session::{FileCommand, PlayCommand, Session};
use egui::{Event, Modifiers, PointerButton, vec2};

use crate::models::moving;
use crate::page::{WIDE, Window, button_event, key_event, window};
use crate::pointer::{START, drag};

/// A window whose camera may move by itself.
fn lively() -> Window {
    let mut window = window(WIDE, vec![]);
    let session = &mut window.harness.state_mut().session;
    *session = Session::new(false);
    session.apply(FileCommand::Add(vec![moving("a.m3d")]));
    session.apply(PlayCommand::Pause);
    window.pass_on();
    window
}

#[test]
fn a_drag_that_is_let_go_runs_on_and_one_that_was_held_stays() {
    let mut window = lively();
    let before = window.session().camera().yaw_radians;
    drag(&mut window, PointerButton::Primary, Modifiers::NONE, vec2(120.0, 0.0));
    let released = window.session().camera().yaw_radians;
    window.wait(1.0);
    let later = window.session().camera().yaw_radians;
    assert!(
        (later - released) * (released - before) > 0.0,
        "{before} {released} {later}"
    );
    assert!(!window.session().is_moving(), "it comes to rest");

    window.harness.hover_at(START);
    window.harness.drag_at(START);
    window.harness.hover_at(START + vec2(60.0, 0.0));
    window.harness.hover_at(START + vec2(120.0, 0.0));
    window.wait(0.2);
    let held = *window.session().camera();
    window.harness.drop_at(START + vec2(120.0, 0.0));
    window.wait(0.5);
    assert_eq!(window.session().camera(), &held);
}

#[test]
fn the_right_button_and_w_fly_forward_and_the_drag_turns_the_head() {
    let mut window = lively();
    let before = *window.session().camera();
    let press = |pressed, pos| button_event(pos, PointerButton::Secondary, pressed, Modifiers::NONE);
    let key = |pressed| key_event(egui::Key::W, pressed);
    window.harness.event(Event::PointerMoved(START));
    window.harness.event(press(true, START));
    window.harness.event(key(true));
    window.wait(0.5);
    let flown = *window.session().camera();
    assert!((flown.eye() - before.eye()).dot(before.forward()) > 0.1);
    window.harness.event(key(false));
    window.wait(0.2);
    let stopped = *window.session().camera();
    window.harness.event(Event::PointerMoved(START + vec2(100.0, 0.0)));
    window.pass_on();
    let looked = *window.session().camera();
    assert!(looked.eye().abs_diff_eq(stopped.eye(), 1e-3), "the eye stays");
    assert!(looked.forward().dot(stopped.right()) > 0.05, "and looks to the right");
    window.harness.event(press(false, START + vec2(100.0, 0.0)));
    window.wait(0.5);
    assert_eq!(window.session().camera(), &looked, "all is quiet");
}
