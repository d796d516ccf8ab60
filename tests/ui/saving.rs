//! Pictures and contact sheets as files: their size, their ground and their name.

use bindpose::scene::FrameOptions;
use bindpose::session::{CameraCommand, FileCommand, PlayCommand, Session};
use bindpose::ui::{ContactSheetRequest, Request, contact_sheet_name, picture_name};
use egui::accesskit::{Action, ActionData, Role};
use egui::{Event, Key, Modifiers};

use crate::access::ask;
use crate::models::{self, moving, still};
use crate::page::{WIDE, Window, window};

fn open() -> Window {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    window.click("Picture");
    window
}

fn pictures(window: &Window) -> Vec<Request> {
    window.harness.state().requests.clone()
}

#[test]
fn sizes_are_chosen_by_name() {
    let mut window = open();
    for (label, size) in [
        ("Full HD", [1920, 1080]),
        ("4K", [3840, 2160]),
        ("Square", [2048, 2048]),
        ("As the window", [1440, 900]),
    ] {
        window.click(label);
        window.click("Save PNG");
        let transparent = false;
        assert_eq!(
            pictures(&window).last(),
            Some(&Request::SavePicture {
                size,
                transparent,
                aperture: 0.0
            })
        );
    }
}

#[test]
fn sizes_are_typed_and_refused_out_of_reach() {
    let mut window = open();
    for (typed, width) in [("640", 640), ("0", 640), ("99999", 640)] {
        window.click("Width in pixels");
        window.press(Modifiers::COMMAND, Key::A);
        window.harness.event(Event::Text(typed.to_owned()));
        window.press(Modifiers::NONE, Key::Enter);
        assert_eq!(window.shows("A number from 1 to 8192"), typed != "640", "{typed}");
        if typed != "640" {
            window.press(Modifiers::NONE, Key::Escape);
        }
        window.click("Save PNG");
        let (size, transparent) = ([width, 900], false);
        assert_eq!(
            pictures(&window).last(),
            Some(&Request::SavePicture {
                size,
                transparent,
                aperture: 0.0
            })
        );
    }
}

#[test]
fn depth_of_field_is_chosen_where_the_view_is_in_perspective() {
    let mut window = open();
    let value = ActionData::NumericValue(9.0);
    ask(&mut window, "Depth of field", Action::SetValue, Some(value));
    window.click("Save PNG");
    let (size, transparent) = ([1440, 900], false);
    let widest = FrameOptions::WIDEST_APERTURE;
    assert_eq!(
        pictures(&window),
        [Request::SavePicture {
            size,
            transparent,
            aperture: widest
        }]
    );
    window.apply(CameraCommand::ToggleProjection);
    window.pass_on();
    assert!(window.shows("Transparent ground") && !window.shows("Depth of field"));
}

#[test]
fn the_ground_is_left_out_when_asked() {
    let mut window = open();
    window.click("Transparent ground");
    window.click("Save PNG");
    let (size, transparent) = ([1440, 900], true);
    assert_eq!(
        pictures(&window),
        [Request::SavePicture {
            size,
            transparent,
            aperture: 0.0
        }]
    );
}

#[test]
fn the_name_says_model_clip_and_frame() {
    let named = |files| {
        let mut session = Session::new(true);
        session.apply(FileCommand::Add(files));
        session.apply(PlayCommand::Seek { time_secs: 0.5 });
        picture_name(&session)
    };
    assert_eq!(named(vec![moving("in/soldier.m3d")]), "soldier-Bend-15.png");
    assert_eq!(named(vec![still("a.b.m3d")]), "a.b.png");
    let odd = models::file("x.m3d", &models::skinned(&[("Run/../away: now?", 0.0, 31)]));
    assert_eq!(named(vec![odd]), "x-Run-..-away--now--15.png");
    assert_eq!(named(vec![]), "bindpose.png");
}

/// Types a number into the field of this name.
fn type_into(window: &mut Window, field: &str, number: &str) {
    window.click(field);
    window.press(Modifiers::COMMAND, Key::A);
    window.harness.event(Event::Text(number.to_owned()));
    window.press(Modifiers::NONE, Key::Enter);
}

#[test]
fn a_contact_sheet_is_asked_for_as_chosen() {
    let mut window = open();
    window.click("Save contact sheet");
    let first = ContactSheetRequest {
        size: [1440, 900],
        cells: [4, 3],
        turntable: false,
        transparent: false,
    };
    assert_eq!(pictures(&window), [Request::SaveContactSheet(first)]);

    window.harness.state_mut().state.end_contact_sheet();
    window.pass_on();
    type_into(&mut window, "Columns", "6");
    type_into(&mut window, "Rows", "1");
    window.click("Contact sheet of: Turntable");
    // A switch of its own: the picture's does not count.
    window.click("Transparent ground");
    window.click("Square");
    window.click("Save contact sheet");
    let second = ContactSheetRequest {
        size: [2048, 2048],
        cells: [6, 1],
        turntable: true,
        transparent: false,
    };
    assert_eq!(pictures(&window).last(), Some(&Request::SaveContactSheet(second)));

    window.harness.state_mut().state.end_contact_sheet();
    window.pass_on();
    window.click("Transparent ground");
    window.click("Transparent sheet");
    window.click("Save contact sheet");
    let third = ContactSheetRequest {
        transparent: true,
        ..second
    };
    assert_eq!(pictures(&window).last(), Some(&Request::SaveContactSheet(third)));
    window.click("Save PNG");
    let (size, transparent) = ([2048, 2048], false);
    let last = pictures(&window).last().cloned();
    assert_eq!(
        last,
        Some(Request::SavePicture {
            size,
            transparent,
            aperture: 0.0
        })
    );
}

#[test]
fn a_contact_sheet_tells_how_far_it_is_and_is_cancelled() {
    let mut window = open();
    let tell = |window: &mut Window, done| {
        let goes_on = window.harness.state_mut().state.show_sheet_progress([done, 12]);
        window.pass_on();
        goes_on
    };
    assert!(!tell(&mut window, 0), "nobody wants one");
    window.click("Save contact sheet");
    assert!(!window.shows("Save contact sheet"), "one at a time");
    for done in [0, 5] {
        assert!(tell(&mut window, done));
        let node = window.node("Pictures drawn");
        assert_eq!(node.role(), Role::ProgressIndicator);
        assert_eq!(node.value(), Some(format!("{done} of 12")));
        assert_eq!(
            (node.numeric_value(), node.max_numeric_value()),
            (Some(done as f64), Some(12.0))
        );
    }
    // The popover may be shut and opened meanwhile.
    window.press(Modifiers::NONE, Key::Escape);
    assert!(!window.shows("Cancel the contact sheet"));
    assert!(tell(&mut window, 6));
    window.click("Picture");
    window.click("Cancel the contact sheet");
    assert!(!tell(&mut window, 7), "it ends before the next picture");
    window.harness.state_mut().state.end_contact_sheet();
    window.pass_on();
    assert!(window.shows("Save contact sheet"));
    assert_eq!(pictures(&window).len(), 1);
}

#[test]
fn the_keyboard_stays_on_the_button_while_it_changes() {
    let mut window = open();
    window.ask("Save contact sheet", Action::Focus, None);
    window.press(Modifiers::NONE, Key::Enter);
    assert_eq!(window.focused().as_deref(), Some("Cancel the contact sheet"));
    window.harness.state_mut().state.end_contact_sheet();
    window.pass_on();
    assert_eq!(window.focused().as_deref(), Some("Save contact sheet"));
}

#[test]
fn a_model_without_a_clip_has_a_sheet_of_its_sides_and_no_model_has_none() {
    let window_of = |files| {
        let mut window = window(WIDE, files);
        window.click("Picture");
        window
    };
    let mut of_still = window_of(vec![still("a.m3d")]);
    assert!(!of_still.shows("Contact sheet of: Clip"));
    of_still.click("Save contact sheet");
    assert_eq!(pictures(&of_still).len(), 1);
    let empty = window_of(vec![]);
    assert!(empty.shows("Save PNG (P)") && !empty.shows("Save contact sheet"));
}

#[test]
fn a_sheet_is_named_by_model_and_clip() {
    let named = |files| {
        let mut session = Session::new(true);
        session.apply(FileCommand::Add(files));
        contact_sheet_name(&session)
    };
    assert_eq!(named(vec![moving("in/soldier.m3d")]), "soldier-Bend-sheet.png");
    assert_eq!(named(vec![still("a.m3d")]), "a-sheet.png");
}

#[test]
fn r_asks_for_the_files_again_and_the_browsers_reload_stays_the_browsers() {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    window.press(Modifiers::COMMAND, Key::R);
    assert_eq!(pictures(&window), []);
    window.press(Modifiers::NONE, Key::R);
    assert_eq!(pictures(&window), [Request::ReadAgain]);
}
