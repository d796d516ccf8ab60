//! The line between both lights.

use bindpose::session::LookCommand;
use egui::{Key, Modifiers, PointerButton, pos2, vec2};

use crate::models::moving;
use crate::page::{WIDE, Window, phone, window};

fn divided(share: f32) -> Window {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    window.apply(LookCommand::SetSplit(Some(share)));
    window
}

#[track_caller]
fn assert_split(window: &Window, share: f32) {
    let found = window.session().look().split.expect("divided");
    assert!((found - share).abs() < 1e-3, "{found} instead of {share}");
}

#[test]
fn the_line_and_its_handle_follow_the_pointer_and_the_camera_stays() {
    for y in [450.0, 200.0] {
        let mut window = divided(0.5);
        let camera = *window.session().camera();
        window.drag(pos2(720.0, y), pos2(936.0, y + 30.0));
        assert_split(&window, 0.65);
        window.drag(pos2(936.0, y), pos2(5000.0, y));
        assert_split(&window, 0.98);
        assert_eq!(window.session().camera(), &camera);
    }
    let mut phone = phone(vec![moving("a.m3d")]);
    phone.apply(LookCommand::SetSplit(Some(0.5)));
    // A finger is less exact than a pointer.
    let handle = phone.rect("Split").center();
    phone.drag(handle + vec2(18.0, 0.0), pos2(273.0, handle.y));
    assert_split(&phone, 0.7);
    phone.click("Lighting");
    assert!(
        phone.rect("Split").max.y < phone.rect("Close the sheet").min.y,
        "the sheet leaves the handle"
    );
}

#[test]
fn a_double_click_brings_it_to_the_middle() {
    let mut window = divided(0.3);
    let at = pos2(0.3 * WIDE.x, 300.0);
    for _ in 0..2 {
        window.harness.hover_at(at);
        for pressed in [true, false] {
            window.button(at, PointerButton::Primary, pressed, Modifiers::NONE);
        }
    }
    window.pass_on();
    assert_split(&window, 0.5);
}

#[test]
fn the_keyboard_moves_it_too() {
    let mut window = divided(0.5);
    for _ in 0..60 {
        window.tab(false);
        if window.focused().as_deref() == Some("Split") {
            window.press(Modifiers::NONE, Key::ArrowLeft);
            assert_split(&window, 0.49);
            assert_eq!(window.time_secs(), 0.0, "and no frame was stepped");
            return;
        }
    }
    panic!("Tab never reached the handle");
}

#[test]
fn without_a_division_there_is_no_line() {
    let mut window = divided(0.5);
    assert!(window.shows("Split"));
    window.apply(LookCommand::SetSplit(None));
    assert!(!window.shows("Split"));
}
