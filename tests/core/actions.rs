//! The table of actions and what its keys do.

use bindpose::actions::{ALL, BONES, Group, key_of, keys_of, rows, speed_label};
use bindpose::scene::Overlay;
use bindpose::session::{LookCommand, Session};

#[test]
fn no_key_asks_for_two_things() {
    let mut keys: Vec<&str> = ALL.iter().flat_map(|action| action.keys).copied().collect();
    let count = keys.len();
    keys.sort_unstable();
    keys.dedup();
    assert_eq!(keys.len(), count);
}

#[test]
fn keys_of_a_row_name_a_common_modifier_once() {
    let row_of = |does: &str| {
        let mut all = Group::ALL.into_iter().flat_map(rows);
        keys_of(all.find(|row| row[0].does == does).expect("a row"))
    };
    assert_eq!(row_of("one frame"), "← →");
    assert_eq!(row_of("ten frames"), "Shift ← →");
    assert_eq!(row_of("frame the selection, all"), "F, Shift F");
    assert_eq!(row_of("pan"), "Alt Shift ←↑→↓");
}

#[test]
fn the_key_of_a_command_is_found_by_what_it_does() {
    let session = Session::new(true);
    let wireframe = LookCommand::ToggleOverlay(Overlay::Wireframe).into();
    let bounds = LookCommand::ToggleOverlay(Overlay::Bounds).into();
    assert_eq!(key_of(&session, &wireframe), "Z");
    assert_eq!(key_of(&session, &bounds), "");
    assert_eq!(BONES.ask(&session), None, "there are no bones");
}

#[test]
fn speeds_are_short() {
    assert_eq!(
        [1.0, 0.75, 0.05, 1.234].map(speed_label),
        ["1×", "0.75×", "0.05×", "1.23×"]
    );
}
