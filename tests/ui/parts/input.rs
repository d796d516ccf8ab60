//! How the events of a frame fall into passes.

use std::collections::VecDeque;

use bindpose::ui::for_tests::first_pass;
use egui::{Event, Key, Modifiers, PointerButton, Pos2};

use crate::page::{button_event, key_event};

fn moved() -> Event {
    Event::PointerMoved(Pos2::ZERO)
}

fn button(pressed: bool) -> Event {
    button_event(Pos2::ZERO, PointerButton::Primary, pressed, Modifiers::NONE)
}

fn key(key: Key, pressed: bool) -> Event {
    key_event(key, pressed)
}

fn text() -> Event {
    Event::Text("a".to_owned())
}

/// How many events each pass handles.
fn passes(events: Vec<Event>) -> Vec<usize> {
    let mut waiting = VecDeque::from(events);
    let mut counts = Vec::new();
    while !waiting.is_empty() {
        counts.push(first_pass(&waiting));
        waiting.drain(..counts[counts.len() - 1]);
    }
    counts
}

#[test]
fn what_follows_a_press_waits_for_what_it_took_hold_of() {
    assert_eq!(passes(vec![moved(), button(true), moved(), moved()]), [2, 2]);
    assert_eq!(passes(vec![moved(), button(true), moved(), button(false)]), [2, 1, 1]);
    assert_eq!(passes(vec![button(true), button(false), text()]), [1, 1, 1]);
    let gone = Event::PointerGone;
    assert_eq!(
        passes(vec![button(true), button(false), gone]),
        [1, 2],
        "a finger is gone with its release"
    );
    assert_eq!(
        passes(vec![button(true), Event::PointerGone]),
        [1, 1],
        "a mouse that left still holds"
    );
}

#[test]
fn words_are_typed_in_one_pass_and_what_ends_them_has_its_own() {
    let (enter, enter_up) = (key(Key::Enter, true), key(Key::Enter, false));
    let typed = vec![
        text(),
        key(Key::A, true),
        key(Key::A, false),
        text(),
        enter,
        enter_up,
        text(),
    ];
    assert_eq!(passes(typed), [4, 2, 1]);
    assert_eq!(passes(vec![key(Key::Tab, true), key(Key::Tab, true)]), [1, 1]);
    assert_eq!(
        passes(vec![text(), button(true)]),
        [1, 1],
        "what was typed went to the field before"
    );
}

#[test]
fn most_frames_have_one_pass() {
    assert_eq!(passes(vec![moved(), moved(), moved()]), [3]);
    let arrows = (0..9).map(|_| key(Key::ArrowRight, true)).collect();
    assert_eq!(passes(arrows), [9]);
}
