//! Numbers of the joint and of the vertex that are inspected.

use bindpose::model::JointIndex;
use bindpose::session::{Command, JointCommand};
use egui::{Event, Modifiers, OutputCommand, PointerButton, vec2};

use crate::page::{WIDE, Window, phone, window};
use crate::skeleton::{chains, selected, tree};

/// What a click copies.
fn copied_by(window: &mut Window, start: &str) -> String {
    let at = window.rect(start).center();
    window.harness.hover_at(at);
    window.harness.drag_at(at);
    window.harness.event(Event::PointerButton {
        pos: at,
        button: PointerButton::Primary,
        pressed: false,
        modifiers: Modifiers::NONE,
    });
    window.harness.step();
    let commands = window.harness.output().platform_output.commands.clone();
    window.pass_on();
    let mut texts = commands.into_iter().filter_map(|command| match command {
        OutputCommand::CopyText(text) => Some(text),
        _ => None,
    });
    texts.next().unwrap_or_else(|| panic!("{start} copied nothing"))
}

#[test]
fn the_inspector_reads_the_joint_and_its_relatives_are_links() {
    let mut window = tree(WIDE, 5);
    window.click("Bone 1, ");
    for words in [
        "Number in the file 1",
        "Moves 6 vertices",
        "Quaternion 0.0000 0.0000 0.0000 1.0000",
    ] {
        assert!(window.shows(words), "{words}: {:?}", window.widgets());
    }
    let local = window.rect("Position ");
    assert!(window.shows("Position 0.5000 0.0000 0.0000"));
    window.apply(Command::Seek { time_secs: 0.8 });
    assert_eq!(window.rect("Position "), local, "numbers stand still");
    let tree_row = window.named(|name| name == "Bone 0");
    assert_eq!(tree_row.len(), 1, "the parent");
    window.click("Bone 0");
    assert_eq!(selected(&window), Some(0));
    assert!(window.shows("Parent none, it is a root") && window.shows("Bone 2"));
    window.click("Bone 2");
    assert_eq!(selected(&window), Some(2));
}

#[test]
fn matrices_numbers_and_keys_are_copied_as_text() {
    let mut window = tree(vec2(1440.0, 1300.0), 5);
    window.click("Bone 1, ");
    let offset = copied_by(&mut window, "Copy: Offset");
    assert!(
        offset.starts_with("offset (row vectors") && offset.contains("-0.500000"),
        "{offset}"
    );
    let last = copied_by(&mut window, "Copy: Final matrix");
    assert!(last.starts_with("finalTransform = offset · toRoot"), "{last}");
    let local = copied_by(&mut window, "Copy: place now");
    assert!(local.starts_with("position") && local.contains("0.500000"), "{local}");
    let all = copied_by(&mut window, "Copy all numbers");
    assert!(all.starts_with("bone 1; parent 0; children 3"), "{all}");
    let keys = copied_by(&mut window, "Copy: keys");
    assert_eq!(keys.lines().count(), 4, "{keys}");
}

#[test]
fn a_click_on_a_key_goes_there() {
    let mut window = tree(vec2(1440.0, 1300.0), 5);
    window.click("Bone 1, ");
    window.apply(Command::Play);
    window.click("Key 1, 0.500 s");
    assert_eq!(window.time_secs(), 0.5);
    assert!(!window.session().playback().is_playing());
    window.click("Keys: Euler");
    assert!(window.shows("Key 0, 0.000 s: 0.00 0.00 0.00"));
    window.click("Trail through the clip");
    assert_eq!(window.session().joints().trails(), [JointIndex(1)]);
}

#[test]
fn a_vertex_shows_its_weights_and_explains_its_place() {
    for mut window in [window(vec2(1440.0, 1200.0), chains(5)), phone(chains(5))] {
        if window.shows("Model facts") {
            window.click("Model facts");
        }
        window.apply(JointCommand::SelectVertex(Some(4)).into());
        assert!(window.shows("Selected: Vertex 4"));
        assert!(window.shows("Bone 1: weight 0.750") && window.shows("Bone 0: weight 0.250"));
        window.click("Explain this vertex");
        assert!(window.shows("Copy: the sum of the vertex as text"));
        // On the phone it has to be scrolled to.
        if window.rect("Copy: the sum").max.y < 800.0 {
            let copied = copied_by(&mut window, "Copy: the sum");
            assert!(copied.starts_with("vertex 4: row vectors"), "{copied}");
        }
        window.click("Hide");
        assert!(!window.shows("Copy: the sum of the vertex as text"));
        window.click("Bone 1: weight");
        assert_eq!(selected(&window), Some(1), "its weights can be seen");
        assert!(window.session().joints().selected_vertex().is_some());
    }
}
