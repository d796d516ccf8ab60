//! The keyboard focus: in which order Tab takes it through what the page mirrors, what takes it, who gets it back, and that it is seen.

use bindpose::ui::theme::{Contrast, Tokens};
use egui::{Key, Modifiers, Shape};

use crate::models::moving;
use crate::page::{PHONE, WIDE, Window, touch_window, window};

const PLAIN: Modifiers = Modifiers::NONE;

/// The names of all controls, in the order of Tab.
fn order(window: &mut Window) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for _ in 0..200 {
        window.tab(false);
        let name = window.focused().expect("Tab always finds a control");
        if names.first() == Some(&name) {
            return names;
        }
        names.push(name);
    }
    panic!("Tab never came round: {names:?}");
}

/// Whether a ring is drawn in this frame.
fn ring_is_seen(window: &Window) -> bool {
    let dark = window.harness.ctx.global_style().visuals.dark_mode;
    let tokens = Tokens::new(dark, Contrast::Normal);
    window.harness.output().shapes.iter().any(|clipped| {
        let Shape::Rect(rect) = &clipped.shape else {
            return false;
        };
        (rect.stroke.width, rect.stroke.color) == (tokens.ring_width, tokens.accent)
            && clipped.clip_rect.intersects(rect.rect)
    })
}

#[test]
fn tab_goes_in_reading_order_and_every_stop_is_seen() {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    let names = order(&mut window);
    let place = |start: &str| {
        let found = names.iter().position(|name| name.starts_with(start));
        found.unwrap_or_else(|| panic!("no {start:?} in {names:?}"))
    };
    let places = ["View mode", "Help (?)", "Panel: Model", "Findings", "Play"].map(place);
    assert!(places.is_sorted(), "{places:?} of {names:?}");
    for _ in &names {
        window.tab(false);
        assert!(ring_is_seen(&window), "no ring round {:?}", window.focused());
    }
}

#[test]
fn backward_is_the_same_way() {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    let names = order(&mut window);
    for name in names.iter().rev() {
        window.tab(true);
        assert_eq!(window.focused().as_ref(), Some(name));
    }
}

#[test]
fn the_first_tab_after_a_click_goes_on_from_there() {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    let names = order(&mut window);
    let turntable = names.iter().position(|name| name == "Turntable").expect("its button");
    window.click("Turntable");
    assert_eq!(window.focused(), None, "the mouse focuses nothing");
    assert!(!ring_is_seen(&window));
    window.tab(false);
    assert_eq!(window.focused().as_ref(), names.get(turntable + 1));
    assert!(ring_is_seen(&window));
}

#[test]
fn what_opens_takes_the_focus_and_gives_it_back() {
    for (button, first) in [
        ("View mode", "Lit"),
        ("Lighting", "Light: "),
        ("Lines over the model", "Ground grid"),
        ("View from", "Three-quarter"),
        ("Help (?)", "Close"),
        ("Findings", "Close"),
        ("Speed ", ""),
    ] {
        let mut window = window(WIDE, vec![moving("a.m3d")]);
        while !window.focused().is_some_and(|name| name.starts_with(button)) {
            window.tab(false);
        }
        window.press(PLAIN, Key::Enter);
        let inside = window.focused().unwrap_or_default();
        assert!(
            inside.starts_with(first) && !inside.starts_with(button),
            "{button}: {inside:?}"
        );
        window.press(PLAIN, Key::Escape);
        let after = window.focused().unwrap_or_default();
        assert!(after.starts_with(button), "{button}: {after:?}");
    }
}

#[test]
fn tab_goes_into_what_the_mouse_opened() {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    window.click("Lighting");
    assert_eq!(window.focused(), None);
    window.tab(false);
    assert!(window.focused().is_some_and(|name| name.starts_with("Light: ")));
}

#[test]
fn what_is_scrolled_out_comes_into_view_with_the_focus() {
    let mut window = touch_window(PHONE, vec![moving("a.m3d")]);
    window.click("More");
    window.click("Light and background");
    for _ in 0..60 {
        window.tab(false);
        window.wait(0.2);
        let name = window.focused().unwrap_or_default();
        if name == "Model view" {
            continue;
        }
        let rect = window.rect(&name);
        let page = egui::Rect::from_min_size(egui::Pos2::ZERO, PHONE);
        assert!(
            page.contains(rect.center()),
            "{name:?} at {rect} has the focus out of sight"
        );
    }
}
