//! Undo and redo by keys and buttons, and what is one step: a drag, a held arrow key, a typed number.

use bindpose::session::{HistoryCommand, Session};
use bindpose::ui::MirrorInput;
use egui::accesskit::{Action, ActionRequest};
use egui::{Event, Key, Modifiers, Pos2, RawInput, lerp, vec2};

use crate::models::moving;
use crate::page::{PHONE, WIDE, Window, key_event, touch_window, window};
use crate::rigs::rig;

const CTRL: Modifiers = Modifiers::COMMAND;
const CTRL_SHIFT: Modifiers = Modifiers::COMMAND.plus(Modifiers::SHIFT);

/// A window with the values of the only material.
fn open() -> Window {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    window.click("Painted, 12 triangles");
    window
}

fn undo_label(window: &Window) -> Option<String> {
    window.session().history().undo_label().map(str::to_owned)
}

/// How many steps lead back to the beginning.
fn steps(session: &Session) -> usize {
    let mut session = session.clone();
    let mut steps = 0;
    while session.history().undo_label().is_some() {
        session.apply(HistoryCommand::Undo);
        steps += 1;
    }
    steps
}

fn drag(window: &mut Window, from: Pos2, to: Pos2) {
    window.harness.hover_at(from);
    window.harness.drag_at(from);
    for step in 1..=8 {
        window.harness.hover_at(from + (to - from) * (step as f32 / 8.0));
        window.harness.step();
    }
    window.harness.drop_at(to);
    window.pass_on();
}

fn hold(window: &mut Window, key: Key, pressed: bool) {
    window.harness.event(key_event(key, pressed));
    window.harness.step();
}

#[test]
fn a_slider_that_is_dragged_is_one_step() {
    let mut window = open();
    let of_file = window.session().materials().to_vec();
    let rect = window.rect("Roughness");
    let at = |x: f32| Pos2::new(lerp(rect.x_range(), x), rect.center().y);
    drag(&mut window, at(0.2), at(0.8));
    let dragged = window.session().materials().to_vec();
    assert_ne!(dragged, of_file);
    assert_eq!(
        (steps(window.session()), undo_label(&window).as_deref()),
        (1, Some("edit Painted"))
    );

    drag(&mut window, at(0.8), at(0.4));
    assert_eq!(steps(window.session()), 2, "each drag is a step of its own");
    window.press(CTRL, Key::Z);
    assert_eq!(window.session().materials(), dragged);
    window.press(CTRL, Key::Z);
    assert_eq!(window.session().materials(), of_file);
    window.press(CTRL_SHIFT, Key::Z);
    assert_eq!(window.session().materials(), dragged);
    window.press(CTRL, Key::Y);
    assert_eq!(window.session().history().redo_label(), None);
}

#[test]
fn an_arrow_key_on_a_slider_is_a_step_and_one_that_is_held_too() {
    let mut window = open();
    while window.focused().as_deref() != Some("Roughness") {
        window.tab(false);
    }
    for _ in 0..3 {
        window.press(Modifiers::NONE, Key::ArrowLeft);
    }
    assert_eq!(steps(window.session()), 3);
    let before = window.session().materials().to_vec();
    for _ in 0..6 {
        hold(&mut window, Key::ArrowLeft, true);
    }
    hold(&mut window, Key::ArrowLeft, false);
    window.pass_on();
    assert_ne!(window.session().materials(), before);
    assert_eq!(steps(window.session()), 4);
    window.press(CTRL, Key::Z);
    assert_eq!(window.session().materials(), before);
}

#[test]
fn a_number_that_is_typed_is_one_step_and_the_field_keeps_ctrl_z() {
    let mut window = open();
    let of_file = window.session().materials().to_vec();
    window.click("Diffuse: red");
    window.press(CTRL, Key::A);
    for letter in ["0", ".", "7", "5"] {
        window.type_text(letter);
    }
    let before = window.session().history().revision();
    window.press(CTRL, Key::Z);
    assert_eq!(
        window.session().history().revision(),
        before,
        "the field's own letters were undone"
    );
    window.press(CTRL, Key::A);
    for letter in ["0", ".", "2", "5"] {
        window.type_text(letter);
    }
    window.press(Modifiers::NONE, Key::Enter);
    assert_eq!(window.session().materials()[0].diffuse[0], 0.25);
    assert_eq!(steps(window.session()), 1);
    window.press(CTRL, Key::Z);
    assert_eq!(window.session().materials(), of_file);
}

#[test]
fn clicks_are_steps_of_their_own() {
    let mut window = open();
    window.click("Alpha clip");
    window.click("Alpha clip");
    assert_eq!(steps(window.session()), 2);
}

#[test]
fn buttons_say_what_they_would_undo_and_redo() {
    let mut window = open();
    assert!(window.shows("Undo (Ctrl Z)") && window.shows("Redo (Ctrl Shift Z)"));
    window.click("Undo (Ctrl Z)");
    assert_eq!(window.session().history().revision(), 0, "there is nothing to undo");

    window.click("Alpha clip");
    window.click("Undo: edit Painted (Ctrl Z)");
    assert!(!window.session().is_edited(0));
    assert!(window.shows("Undo (Ctrl Z)"));
    window.click("Redo: edit Painted (Ctrl Shift Z)");
    assert!(window.session().is_edited(0));
    assert!(window.shows("Redo (Ctrl Shift Z)"));
}

#[test]
fn a_phone_has_them_in_its_menu_while_there_is_something_to_undo() {
    let mut window = touch_window(PHONE, vec![moving("a.m3d")]);
    let in_menu = |window: &mut Window| {
        window.click("More");
        let found = window.named(|name| name.starts_with("Undo:") || name.starts_with("Redo:"));
        window.press(Modifiers::NONE, Key::Escape);
        found.into_iter().map(|(name, _)| name).collect::<Vec<_>>()
    };
    assert!(in_menu(&mut window).is_empty());
    window.click("Model facts");
    window.click("Hide Painted");
    assert_eq!(in_menu(&mut window), ["Undo: hide Painted"]);
    window.click("More");
    window.click("Undo: hide Painted");
    assert!(window.session().submeshes().is_visible(0));
    assert_eq!(in_menu(&mut window), ["Redo: hide Painted"]);
}

#[test]
fn fingers_have_the_buttons_wherever_there_is_a_toolbar() {
    let shows = |width: f32| {
        let window = touch_window(vec2(width, 768.0), vec![moving("a.m3d")]);
        window.shows("Undo (Ctrl Z)") && window.shows("Redo (Ctrl Shift Z)")
    };
    assert!(shows(1024.0) && shows(900.0));
}

#[test]
fn a_bracket_of_the_range_that_is_dragged_is_one_step() {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    let range = window.rect("Range out");
    drag(&mut window, range.center(), range.center() - vec2(200.0, 0.0));
    assert!(window.session().playback().range_secs().is_some());
    assert_eq!(
        (steps(window.session()), undo_label(&window).as_deref()),
        (1, Some("set the range"))
    );
    window.press(CTRL, Key::Z);
    assert_eq!(window.session().playback().range_secs(), None);
}

/// Asks for something as the page does, in one frame with other input.
fn ask_of(window: &Window, name: &str, action: Action) -> Event {
    let (target_node, target_tree) = window.node(name).locate();
    Event::AccessKitActionRequest(ActionRequest {
        action,
        target_tree,
        target_node,
        data: None,
    })
}

/// One frame, with what was done with the page's elements before it.
fn page_frame(window: &mut Window, page: &mut MirrorInput, events: impl IntoIterator<Item = Event>) {
    let mut input = RawInput::default();
    page.begin_frame(&window.harness.ctx, &mut input);
    window.frame(events.into_iter().chain(input.events));
}

#[test]
fn a_key_that_the_page_holds_on_a_slider_is_one_step() {
    let mut window = open();
    let before = window.session().materials().to_vec();
    let mut page = MirrorInput::default();
    let focus = ask_of(&window, "Roughness", Action::Focus);
    page_frame(&mut window, &mut page, [focus]);
    for _ in 0..2 {
        page.holds_key = true;
        for _ in 0..6 {
            let more = ask_of(&window, "Roughness", Action::Increment);
            page_frame(&mut window, &mut page, [more]);
        }
        page.holds_key = false;
        page_frame(&mut window, &mut page, []);
    }
    assert_ne!(window.session().materials(), before);
    assert_eq!(steps(window.session()), 2, "one for each time that it was held");
    window.press(CTRL, Key::Z);
    window.press(CTRL, Key::Z);
    assert_eq!(window.session().materials(), before);
}

#[test]
fn a_page_key_that_is_held_on_a_slider_is_one_step() {
    let mut window = open();
    window.ask("Roughness", Action::Focus, None);
    for _ in 0..4 {
        hold(&mut window, Key::PageUp, true);
    }
    hold(&mut window, Key::PageUp, false);
    window.pass_on();
    assert_eq!(steps(window.session()), 1);
}

#[test]
fn what_a_button_does_at_once_is_one_step_by_key_and_by_screen_reader() {
    for by_key in [false, true] {
        let mut window = window(WIDE, vec![rig(5, 31)]);
        window.click("Dope sheet and curves");
        window.ask("Keys of all bones", Action::Focus, None);
        for (modifiers, key) in [(Modifiers::NONE, Key::ArrowRight), (Modifiers::SHIFT, Key::End)] {
            window.press(modifiers, key);
        }
        if by_key {
            window.ask("As range", Action::Focus, None);
            window.press(Modifiers::NONE, Key::Enter);
        } else {
            window.ask("As range", Action::Click, None);
        }
        assert!(window.session().playback().range_secs().is_some());
        assert_eq!(steps(window.session()), 1, "by key: {by_key}");
    }
}
