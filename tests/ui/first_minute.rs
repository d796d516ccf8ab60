//! What somebody is told who sees the page for the first time.

use bindpose::session::SubmeshCommand;
use bindpose::ui::Request;
use egui::{Key, Modifiers, Vec2, vec2};

use crate::layout::{assert_between_sides, assert_off, panel};
use crate::models::moving;
use crate::page::{PHONE, WIDE, Window, touch_window, window};

const WORDS: &str = "A viewer for models with bones: drop a .m3d, .glb or a folder. Files stay on this machine.";

fn greeted(size: Vec2, touch: bool) -> Window {
    let files = vec![moving("a.m3d")];
    let mut window = if touch {
        touch_window(size, files)
    } else {
        window(size, files)
    };
    window.harness.state_mut().state.greeting = Some(WORDS.to_owned());
    window.pass_on();
    window
}

#[test]
fn the_greeting_opens_files_and_goes_for_good() {
    for (size, touch) in [(WIDE, false), (PHONE, true)] {
        let mut window = greeted(size, touch);
        assert!(window.shows(WORDS));
        window.click("Choose files to open");
        window.click("Close the welcome");
        let page = window.harness.state();
        assert_eq!(page.requests, [Request::PickFiles, Request::CloseGreeting]);
        assert_eq!(page.state.greeting, None);
        assert!(!window.shows(WORDS) && !window.shows("Choose files to open"));
    }
}

#[test]
fn the_greeting_covers_no_control() {
    let sizes = [
        (WIDE, false),
        (vec2(900.0, 600.0), false),
        (vec2(900.0, 420.0), false),
        (PHONE, true),
        (vec2(320.0, 568.0), true),
        (vec2(844.0, 390.0), true),
    ];
    for (size, touch) in sizes {
        let mut window = greeted(size, touch);
        window.apply(SubmeshCommand::Select(Some(0)));
        let greeting = panel(&window, "greeting");
        assert_off(
            &window,
            greeting,
            &["title", "toolbar", "model", "inspector", "timeline", "drawer"],
        );
        for (name, rect) in window.named(|name| name.starts_with("Show ") && name != "Show alone") {
            assert!(
                !greeting.intersects(rect) || rect.min.y > greeting.max.y,
                "{name} at {rect} in {size}"
            );
        }
        assert_between_sides(&window, size);
        let room = egui::Rect::from_min_size(egui::Pos2::ZERO, size);
        for part in [WORDS, "Choose files to open", "Close the welcome"] {
            assert!(greeting.contains_rect(window.rect(part)), "{part} in {size}");
        }
        assert!(room.contains_rect(greeting), "{greeting} in {size}");
    }
}

#[test]
fn a_tiny_window_and_an_open_sheet_have_no_greeting() {
    assert!(!greeted(vec2(240.0, 200.0), false).shows(WORDS));
    let mut phone = greeted(PHONE, true);
    phone.click("Model facts");
    assert!(!phone.shows(WORDS));
    phone.click("Close the sheet");
    assert!(phone.shows(WORDS), "it comes back");
}

#[test]
fn the_greeting_is_reached_by_tab() {
    let mut window = greeted(WIDE, false);
    for _ in 0..80 {
        window.tab(false);
        if window.focused().as_deref() == Some("Choose files to open") {
            window.press(Modifiers::NONE, Key::Enter);
            assert_eq!(window.harness.state().requests, [Request::PickFiles]);
            return;
        }
    }
    panic!("Tab never came to it");
}

#[test]
fn help_says_what_the_page_is_for_then_gestures_then_keys() {
    for (size, touch, gesture) in [
        (vec2(900.0, 700.0), false, "Drag: orbit"),
        (PHONE, true, "One finger: orbit"),
    ] {
        let mut window = greeted(size, touch);
        window.harness.state_mut().state.help_open = true;
        window.pass_on();
        let top = |start: &str| window.rect(start).min.y;
        let in_order = [
            "Bindpose shows models with bones, plays",
            "Drop .m3d, .glb",
            "Files stay on",
            gesture,
            "Space: play or pause",
        ];
        let tops = in_order.map(top);
        assert!(tops.is_sorted(), "{in_order:?} at {tops:?} in {size}");
    }
}

#[test]
fn ctrl_o_lets_the_person_pick_files() {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    window.press(Modifiers::COMMAND, Key::O);
    assert_eq!(window.harness.state().requests, [Request::PickFiles]);
    assert!(
        bindpose::ui::owns_key(Key::O, Modifiers::COMMAND),
        "the browser opens nothing"
    );
    window.press(Modifiers::COMMAND | Modifiers::SHIFT, Key::O);
    assert_eq!(window.harness.state().requests, [Request::PickFiles]);
}
