//! The panel that saves the model as a file of another format, used by the names of its controls.

use bindpose::session::{ExportFormat, ExportRange, ExportedFile, FileCommand, PlayCommand};
use egui::accesskit::{Role, Toggled};
use egui::{Event, Key, Modifiers};

use crate::findings;
use crate::joint_tree::drawn;
use crate::models::{moving, still};
use crate::page::{PHONE, WIDE, Window, touch_window, window};
use crate::rigs::rig;

const BUTTON: &str = "Export… (E)";

fn open() -> Window {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    window.click(BUTTON);
    window
}

fn saved(window: &Window) -> &[ExportedFile] {
    &window.harness.state().exported
}

#[test]
fn it_saves_in_the_format_that_was_chosen() {
    let mut window = open();
    assert_eq!(window.node("Format: GLB").role(), Role::RadioButton);
    for (format, name) in [
        ("Format: .m3d D3D11", "a-d3d11.zip"),
        ("Format: .m3d D3D12", "a-d3d12.zip"),
        ("Format: GLB", "a.glb"),
    ] {
        window.click(format);
        window.click(&format!("Save {name}"));
        assert_eq!(saved(&window).last().map(|file| file.name.as_str()), Some(name));
    }
    assert!(saved(&window)[2].bytes.starts_with(b"glTF"));
    assert!(saved(&window)[0].bytes != saved(&window)[1].bytes);
}

#[test]
fn what_is_lost_and_changed_is_told_before_it_is_saved() {
    let mut window = open();
    assert!(window.shows("What is lost"));
    window.click("Format: .m3d D3D11");
    window.click("For the book's demo");
    let lost = window.named(|name| name.starts_with("What is lost · "));
    assert_eq!(lost.len(), 1, "a number of losses");
    window.click("Turn");
    assert!(window.shows("What changes · 2"), "the clip, and the hand of the books");
    assert!(window.shows("1 clip is left out."));
    assert!(saved(&window).is_empty());
}

#[test]
fn clips_are_chosen_and_a_range_is_of_one() {
    let mut window = open();
    window.apply(PlayCommand::SetRangeStart(Some(0.25)));
    assert!(window.node("Only a range").is_disabled(), "there are three clips");
    window.click("Export no clip");
    for clip in ["Bend", "Turn", "Still"] {
        assert_eq!(window.node(clip).toggled(), Some(Toggled::False), "{clip}");
    }
    window.click("Bend");
    assert_eq!(
        window.node("Only a range").toggled(),
        Some(Toggled::True),
        "it is the timeline's"
    );
    assert_eq!(window.node("First second").numeric_value(), Some(0.25));
    window.click("Last second");
    window.press(Modifiers::COMMAND, Key::A);
    window.harness.event(Event::Text("0.5".to_owned()));
    window.press(Modifiers::NONE, Key::Enter);
    let options = window.session().export().expect("it is planned").options;
    assert_eq!(options.range, ExportRange::Secs([0.25, 0.5]));
    window.click("Only a range");
    let options = window.session().export().expect("it is planned").options;
    assert_eq!(
        (options.range, options.clips.clone()),
        (ExportRange::Whole, Some(vec!["Bend".to_owned()]))
    );
    window.click("Export all clips");
    assert!(window.node("Only a range").is_disabled());
}

#[test]
fn switches_show_their_numbers_and_what_they_do() {
    let mut window = open();
    let demo = "For the book's demo";
    assert_eq!(
        window.node(demo).toggled(),
        Some(Toggled::False),
        "GLB is no format of the books"
    );
    let numbers = ["Seconds of the easing", "Tolerance in % of the size"];
    assert!(numbers.iter().all(|number| window.node(number).is_disabled()));
    window.click("In place");
    window.click("Close the loop");
    window.click("Reduce keys");
    window.click("Format: .m3d D3D12");
    for name in ["In place", "Close the loop", "Reduce keys", "For the book's demo"] {
        assert_eq!(window.node(name).toggled(), Some(Toggled::True), "{name}");
    }
    assert!(!numbers.iter().any(|number| window.node(number).is_disabled()));
    let options = window.session().export().expect("it is planned").options.clone();
    assert_eq!(
        (
            options.in_place,
            options.close_loop_secs,
            options.reduce,
            options.for_book
        ),
        (true, Some(0.2), Some(0.001), true)
    );
    assert_eq!(options.format, ExportFormat::D3d12);
    assert!(!window.named(|name| name.starts_with("What changes · ")).is_empty());
    window.click("In place");
    assert!(!window.session().export().expect("it is planned").options.in_place);
}

#[test]
fn another_file_begins_with_no_edit_and_the_same_one_keeps_them() {
    let mut window = open();
    window.click("Format: .m3d D3D12");
    window.click("Reduce keys");
    let options = |window: &Window| {
        let options = window.session().export().expect("it is planned").options;
        (options.format, options.reduce)
    };
    let file = window.session().open_model().expect("open").file.clone();
    window.apply(FileCommand::Add(vec![file]));
    assert_eq!(options(&window), (ExportFormat::D3d12, Some(0.001)));
    window.apply(FileCommand::Add(vec![moving("other.m3d")]));
    assert_eq!(options(&window), (ExportFormat::D3d12, None), "the format stays");
}

#[test]
fn a_file_of_the_books_is_for_their_demo_unless_one_does_not_want_it_and_that_stays() {
    let mut window = open();
    let demo = "For the book's demo";
    let is_on = |window: &Window| window.node(demo).toggled() == Some(Toggled::True);
    assert!(!is_on(&window), "a demo reads no GLB");
    window.click(demo);
    let options = window.session().export().expect("it is planned").options;
    assert_eq!((options.format, is_on(&window)), (ExportFormat::D3d12, true));
    for (format, on) in [(".m3d D3D12", true), (".m3d D3D11", true)] {
        window.click(&format!("Format: {format}"));
        assert_eq!(is_on(&window), on, "{format}");
    }
    window.click(demo);
    window.click("Format: GLB");
    window.click("Format: .m3d D3D12");
    assert!(!is_on(&window));
    window.apply(FileCommand::Add(vec![moving("other.m3d")]));
    assert!(!is_on(&window), "another model");
    window.press(Modifiers::NONE, Key::Escape);
    window.press(Modifiers::NONE, Key::E);
    assert!(!is_on(&window) && !window.node(demo).is_disabled());
}

#[test]
fn nothing_is_put_in_or_taken_away_under_the_pointer() {
    let mut window = open();
    let rows = [
        "Only a range",
        "First second",
        "Last second",
        "Close the loop",
        "Seconds of the easing",
        "Reduce keys",
        "Tolerance in % of the size",
        "For the book's demo",
    ];
    let places = |window: &Window| rows.map(|row| window.rect(row).min);
    let (before, mut foot) = (places(&window), window.rect("Save ").min.y);
    for click in [
        "Format: .m3d D3D12",
        "For the book's demo",
        "Bend",
        "Turn",
        "Only a range",
        "Close the loop",
        "Reduce keys",
        "Export all clips",
        "Format: GLB",
        "Export no clip",
    ] {
        window.click(click);
        assert_eq!(places(&window), before, "{click}");
        let now = window.rect("Save ").min.y;
        assert!(now >= foot, "{click}: the panel is lower than before");
        foot = now;
    }
}

#[test]
fn while_its_panel_is_shut_a_chip_tells_how_far_it_is_and_cancels_it() {
    let mut window = open();
    window.harness.state_mut().holds_export = true;
    window.click("Save a.glb");
    let chips = |window: &Window| window.named(|name| name == "Cancel the export");
    assert_eq!(chips(&window).len(), 1, "the panel's own button");
    window.press(Modifiers::NONE, Key::Escape);
    assert!(!window.shows("Close the loop"), "it is shut");
    let words = drawn(&window, "Writing a.glb ");
    assert_eq!(words.len(), 1, "{words:?}");
    assert!(words[0].ends_with(" %"), "{words:?}");
    window.click("Cancel the export");
    assert!(chips(&window).is_empty() && window.session().export().is_none());
    window.harness.state_mut().holds_export = false;
    window.pass_on();
    assert!(saved(&window).is_empty());
}

#[test]
fn the_clip_of_the_demo_is_told_before_what_was_mended_on_reading() {
    let mut window = window(WIDE, findings::files());
    window.press(Modifiers::NONE, Key::E);
    window.click("Format: .m3d D3D12");
    assert!(window.shows("The demo plays \u{201c}Bend\u{201d}, as Take1. Maps come along as DDS."));
    window.click_anywhere("What changes: show all");
    let top = |words: &str| {
        let named = window.named(|name| name.contains(words));
        named
            .first()
            .unwrap_or_else(|| panic!("{words} {:?}", window.widgets()))
            .1
            .min
            .y
    };
    assert!(top("Clip \"Bend\" is named \"Take1\".") < top("whose sum is off from 1"));
}

#[test]
fn what_cannot_be_written_is_said_and_not_saved() {
    let mut window = open();
    window.click("Close the loop");
    window.click("Seconds of the easing");
    window.press(Modifiers::COMMAND, Key::A);
    window.harness.event(Event::Text("5".to_owned()));
    window.press(Modifiers::NONE, Key::Enter);
    assert!(window.shows("Cannot be written"));
    assert!(window.node("Save").is_disabled());
}

#[test]
fn what_the_demo_cannot_hold_names_the_switch_that_asks_for_it() {
    let mut window = window(WIDE, vec![rig(120, 2)]);
    window.press(Modifiers::NONE, Key::E);
    let words = "What the demo cannot hold is written when \u{201c}For the book's demo\u{201d} is off.";
    assert!(!window.shows(words), "a .glb holds it");
    window.click("Format: .m3d D3D12");
    assert!(window.shows("Cannot be written") && window.shows(words));
    window.click("For the book's demo");
    assert!(!window.shows("Cannot be written") && !window.shows(words));
}

#[test]
fn a_key_opens_and_shuts_it_and_nothing_is_planned_while_it_is_shut() {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    assert!(window.session().export().is_none());
    window.press(Modifiers::NONE, Key::E);
    assert!(window.shows("Save a.glb"));
    window.press(Modifiers::NONE, Key::Escape);
    assert!(!window.shows("Save a.glb"));
    assert!(window.session().export().is_none());
}

#[test]
fn without_a_model_it_says_what_to_do() {
    let mut window = window(WIDE, vec![]);
    window.click(BUTTON);
    assert!(window.shows("Nothing is open. Drop a model, then export it here."));
    assert!(window.named(|name| name.starts_with("Save")).is_empty());
}

#[test]
fn on_a_phone_it_is_a_page_of_the_sheet() {
    let mut window = touch_window(PHONE, vec![still("a.m3d")]);
    window.click("More");
    window.click("Export…");
    assert_eq!(window.named(|name| name == "Export").len(), 1, "one heading");
    let rect = window.rect("Format: GLB");
    assert!(rect.height() >= 44.0, "{rect}");
    window.click_anywhere("Save a.glb");
    assert_eq!(saved(&window).len(), 1);
    window.click("Close the sheet");
    assert!(window.session().export().is_none());
}
