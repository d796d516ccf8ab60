//! The tree of joints: listed, folded, searched, named.

use bindpose::model::JointIndex;
use bindpose::session::{JointCommand, NameCommand};
use egui::{Event, Key, Modifiers, PointerButton};

use crate::page::{WIDE, Window, phone};
use crate::skeleton::{chains, rows, selected, tree, window_of_still};

fn hover(window: &mut Window, start: &str) {
    let at = window.rect(start).center();
    window.harness.hover_at(at);
    window.pass_on();
}

fn double_click(window: &mut Window, start: &str) {
    let at = window.rect(start).center();
    window.harness.hover_at(at);
    window.pass_on();
    for pressed in [true, false, true, false] {
        window.harness.event(Event::PointerButton {
            pos: at,
            button: PointerButton::Primary,
            pressed,
            modifiers: Modifiers::NONE,
        });
        window.harness.step();
    }
    window.pass_on();
}

fn type_text(window: &mut Window, text: &str) {
    window.harness.event(Event::Text(text.to_owned()));
    window.pass_on();
}

#[test]
fn the_tree_lists_every_joint_with_its_vertices() {
    let window = tree(WIDE, 5);
    assert_eq!(
        rows(&window),
        [
            "Bone 0, 9 vertices",
            "Bone 1, 6 vertices",
            "Bone 3, 3 vertices",
            "Bone 2, 6 vertices",
            "Bone 4, 3 vertices",
        ]
    );
    let one = tree(WIDE, 1);
    assert_eq!(rows(&one), ["Bone 0, 3 vertices"]);
    let none = window_of_still();
    assert!(!none.shows("Panel: Skeleton"), "a model without bones has no tree");
}

#[test]
fn a_row_under_the_pointer_lights_its_bone_and_a_click_selects_it() {
    let mut window = tree(WIDE, 5);
    hover(&mut window, "Bone 3, ");
    assert_eq!(window.session().joints().hovered(), Some(JointIndex(3)));
    window.harness.event(Event::PointerGone);
    window.pass_on();
    assert_eq!(window.session().joints().hovered(), None);
    window.click("Bone 3, ");
    assert_eq!(selected(&window), Some(3));
    assert!(window.shows("Selected: Bone 3"));
    window.press(Modifiers::NONE, Key::Escape);
    assert_eq!(selected(&window), None);
}

#[test]
fn branches_fold_by_their_mark_by_arrow_keys_and_all_at_once() {
    let mut window = tree(WIDE, 5);
    window.click("Fold Bone 1");
    assert_eq!(rows(&window).len(), 4);
    assert_eq!(selected(&window), None, "the mark does not select");
    window.click("Unfold Bone 1");
    assert_eq!(rows(&window).len(), 5);
    window.click("Names and branches");
    window.click("Fold all");
    assert_eq!(rows(&window), ["Bone 0, 9 vertices"]);
    window.click("Names and branches");
    window.click("Unfold all");
    assert_eq!(rows(&window).len(), 5);

    // Tab goes on from where the last click was.
    window.click("Bone 0, ");
    window.press(Modifiers::NONE, Key::Tab);
    window.press(Modifiers::SHIFT, Key::Tab);
    assert!(window.focused().is_some_and(|name| name.starts_with("Bone 0, ")));
    window.press(Modifiers::NONE, Key::ArrowDown);
    assert_eq!(selected(&window), Some(1));
    window.press(Modifiers::NONE, Key::ArrowLeft);
    assert_eq!(rows(&window).len(), 4);
    window.press(Modifiers::NONE, Key::ArrowDown);
    assert_eq!(selected(&window), Some(2), "what is folded is stepped over");
    window.press(Modifiers::NONE, Key::ArrowUp);
    window.press(Modifiers::NONE, Key::ArrowRight);
    assert_eq!((selected(&window), rows(&window).len()), (Some(1), 5));
}

#[test]
fn a_search_finds_numbers_and_names_and_escape_takes_it_away() {
    let mut window = tree(WIDE, 300);
    window.click("Search bones");
    type_text(&mut window, "12");
    let found = rows(&window);
    assert_eq!(found.last().map(String::as_str), Some("Bone 12, 6 vertices"));
    assert_eq!(found.len(), 7, "it and what it hangs from: {found:?}");
    type_text(&mut window, "x");
    assert!(rows(&window).is_empty() && window.shows("No bone has this number or name."));
    window.apply(JointCommand::Select(Some(JointIndex(5))));
    window.press(Modifiers::NONE, Key::Escape);
    assert!(rows(&window).len() > 20);
    assert_eq!(selected(&window), Some(5), "Esc left the search alone");
}

#[test]
fn a_joint_is_named_by_double_click_by_f2_and_in_the_inspector() {
    let mut window = tree(WIDE, 5);
    double_click(&mut window, "Bone 1, ");
    type_text(&mut window, "L hip");
    window.press(Modifiers::NONE, Key::Enter);
    assert!(window.shows("L hip, 6 vertices"));
    assert_eq!(window.session().joint_names().get(1), Some("L hip"));

    window.click("Bone 3, ");
    window.press(Modifiers::NONE, Key::F2);
    type_text(&mut window, "nobody");
    window.press(Modifiers::NONE, Key::Escape);
    assert_eq!(window.session().joint_names().get(3), None, "Esc leaves the name");
    assert_eq!(selected(&window), Some(3), "and the selection");
    window.click("Panel: Model");
    window.click("Rename");
    type_text(&mut window, "L knee");
    window.click("Bone 4, ");
    assert_eq!(
        window.session().joint_names().get(3),
        Some("L knee"),
        "a click elsewhere takes it"
    );
    // Letters that are keys do nothing while a name is typed.
    assert!(!window.session().look().bones_visible);
}

#[test]
fn names_of_one_side_propose_those_of_the_other() {
    let mut window = tree(WIDE, 5);
    window.click("Names and branches");
    window.click("Propose mirrored");
    assert!(!window.shows("Take the proposed names"), "nothing has a name");
    window.click("Back to the tree");
    let named = |joint, name: &str| NameCommand::Rename {
        joint: JointIndex(joint),
        name: name.to_owned(),
    };
    window.apply(named(1, "L hip"));
    window.apply(named(3, "L knee"));
    window.click("Names and branches");
    window.click("Propose mirrored");
    assert!(window.shows("Bone 2 would be R hip") && window.shows("Bone 4 would be R knee"));
    window.click("Take the proposed names");
    assert_eq!(window.session().joint_names().get(4), Some("R knee"));
    window.click("Names and branches");
    window.click("Clear names");
    assert!(window.session().joint_names().is_empty());
}

#[test]
fn of_thousands_of_joints_only_those_in_view_are_laid_out() {
    let mut window = tree(WIDE, 2_000);
    let laid_out = rows(&window).len();
    assert!((20..60).contains(&laid_out), "{laid_out}");
    // One that is selected elsewhere is scrolled to.
    window.apply(JointCommand::Select(Some(JointIndex(1_998))));
    window.wait(1.0);
    let row = window.rect("Bone 1998, ");
    assert!(row.max.y < window.rect("Play").min.y && row.min.y > 50.0, "{row}");
    assert!(rows(&window).len() < 60);
}

#[test]
fn fingers_name_a_joint_from_its_inspector() {
    let mut window = phone(chains(5));
    window.click("Model facts");
    window.apply(JointCommand::Select(Some(JointIndex(3))));
    window.click("Rename");
    assert!(window.shows("Name of the bone"), "the tree stands in its place");
    type_text(&mut window, "knee");
    window.press(Modifiers::NONE, Key::Enter);
    assert_eq!(window.session().joint_names().get(3), Some("knee"));
    assert!(window.shows("Selected: knee"), "and goes again");
}
