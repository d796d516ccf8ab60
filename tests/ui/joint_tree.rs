//! The tree of joints: listed, folded, searched, named.

use bindpose::model::JointIndex;
use bindpose::session::{JointCommand, NameCommand};
use egui::accesskit::{Action, ActionRequest};
use egui::epaint::TextShape;
use egui::{Event, Key, Modifiers, PointerButton, Rect, Role, Shape};
use egui_kittest::kittest::NodeT as _;

use crate::page::{WIDE, Window, phone};
use crate::skeleton::{chains, rows, selected, tree, window_of_still};

fn hover(window: &mut Window, start: &str) {
    let at = window.rect(start).center();
    window.hover_at(at);
}

fn double_click(window: &mut Window, start: &str) {
    let at = window.rect(start).center();
    window.hover_at(at);
    for pressed in [true, false, true, false] {
        window.button(at, PointerButton::Primary, pressed, Modifiers::NONE);
        window.harness.step();
    }
    window.pass_on();
}

pub(crate) fn type_text(window: &mut Window, text: &str) {
    window.type_text(text);
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
    tab_to(&mut window, "Bone 0, ");
    let press = |window: &mut Window, key| window.press(Modifiers::NONE, key);
    press(&mut window, Key::ArrowDown);
    press(&mut window, Key::ArrowLeft);
    assert_eq!(rows(&window).len(), 4);
    press(&mut window, Key::ArrowDown);
    assert_eq!(focused(&window), "Bone 2, 6 vertices", "what is folded is stepped over");
    press(&mut window, Key::ArrowUp);
    press(&mut window, Key::ArrowRight);
    assert_eq!(
        (focused(&window).as_str(), rows(&window).len()),
        ("Bone 1, 6 vertices", 5)
    );
}

/// Presses Tab until a widget has the focus.
#[track_caller]
fn tab_to(window: &mut Window, start: &str) {
    for _ in 0..60 {
        if window.focused().is_some_and(|name| name.starts_with(start)) {
            return;
        }
        window.tab(false);
    }
    panic!("Tab does not come to {start:?}");
}

fn focused(window: &Window) -> String {
    window.focused().unwrap_or_default()
}

#[test]
fn keys_walk_through_the_tree_and_only_enter_selects() {
    let mut window = tree(WIDE, 5);
    tab_to(&mut window, "Bone 0, ");
    let after = |window: &mut Window, key| {
        window.press(Modifiers::NONE, key);
        focused(window)[..6].to_owned()
    };
    let time_secs = window.time_secs();
    let walk = [
        (Key::ArrowDown, "Bone 1"),
        (Key::ArrowRight, "Bone 3"),
        (Key::ArrowRight, "Bone 3"),
        (Key::ArrowLeft, "Bone 1"),
        (Key::End, "Bone 4"),
        (Key::ArrowDown, "Bone 4"),
        (Key::ArrowLeft, "Bone 2"),
        (Key::Home, "Bone 0"),
        (Key::PageDown, "Bone 2"),
        (Key::PageUp, "Bone 0"),
    ];
    for (key, row) in walk {
        assert_eq!(after(&mut window, key), row, "{key:?}");
    }
    assert_eq!(selected(&window), None, "the focus alone selects nothing");
    assert_eq!(window.time_secs(), time_secs, "no key of the tree moves the time");
    assert_eq!(
        window.session().joints().hovered(),
        Some(JointIndex(0)),
        "the view shows where the focus is"
    );
    after(&mut window, Key::ArrowDown);
    window.press(Modifiers::NONE, Key::Enter);
    assert_eq!(selected(&window), Some(1));
    assert_eq!(focused(&window), "Bone 1, 6 vertices");
}

#[test]
fn letters_find_a_bone_and_only_those_that_no_bone_begins_with_are_shortcuts() {
    let mut window = tree(WIDE, 300);
    window.apply(NameCommand::Rename {
        joint: JointIndex(250),
        name: "left wrist".to_owned(),
    });
    tab_to(&mut window, "Bone 0, ");
    let mut typed = |text: &str| {
        for letter in text.chars() {
            let key = Key::from_name(&letter.to_uppercase().to_string()).expect("a key");
            window.harness.key_press(key);
            window.harness.event(Event::Text(letter.to_string()));
        }
        window.pass_on();
        let found = focused(&window);
        assert!(window.session().look().bones_visible, "B is a letter here");
        assert_eq!(window.session().look().skin_view, None, "and W");
        window.wait(1.5);
        found
    };
    assert_eq!(typed("wr"), "left wrist, 6 vertices");
    assert_eq!(typed("147"), "Bone 147, 6 vertices");
    assert!(typed("b").starts_with("Bone "), "the next one");
    assert_eq!(typed("left"), "left wrist, 6 vertices");
    let row = window.rect("left wrist, ");
    assert!(
        row.max.y < window.rect("Play").min.y && row.min.y > 50.0,
        "it came into view: {row}"
    );
    window.wait(1.5);
    window.press(Modifiers::NONE, Key::E);
    assert!(window.shows("Export"), "no bone begins with E");
    window.press(Modifiers::NONE, Key::Escape);
    assert_eq!(focused(&window), "left wrist, 6 vertices");
}

#[test]
fn f2_names_the_row_with_the_focus_and_the_focus_comes_back() {
    let mut window = tree(WIDE, 5);
    tab_to(&mut window, "Bone 0, ");
    window.press(Modifiers::NONE, Key::ArrowDown);
    let before = window.rect("Bone 1, ");
    window.press(Modifiers::NONE, Key::F2);
    assert!(window.rect("Name of the bone").center().distance(before.center()) < before.width() / 2.0);
    type_text(&mut window, "hip");
    window.press(Modifiers::NONE, Key::Enter);
    assert_eq!(window.session().joint_names().get(1), Some("hip"));
    assert_eq!(focused(&window), "hip, 6 vertices");
    // The old name is selected, so that typing replaces it.
    window.press(Modifiers::NONE, Key::F2);
    type_text(&mut window, "knee");
    window.press(Modifiers::NONE, Key::Enter);
    assert_eq!(window.session().joint_names().get(1), Some("knee"));
    window.press(Modifiers::NONE, Key::F2);
    window.press(Modifiers::NONE, Key::Escape);
    assert_eq!(focused(&window), "knee, 6 vertices");
}

/// Asks for an action as a screen reader does.
#[track_caller]
fn ask(window: &mut Window, start: &str, action: Action) {
    let (target_node, target_tree) = {
        let node = node(window, start);
        node.accesskit_node().locate()
    };
    window.harness.event(Event::AccessKitActionRequest(ActionRequest {
        action,
        target_tree,
        target_node,
        data: None,
    }));
    window.pass_on();
}

#[track_caller]
fn node<'a>(window: &'a Window, start: &'a str) -> egui_kittest::Node<'a> {
    let begins = move |node: &egui_kittest::Node<'_>| {
        let label = node.accesskit_node().label();
        label.is_some_and(|label| label.starts_with(start))
    };
    let mut nodes = window.harness.root().children_recursive();
    nodes.find(begins).unwrap_or_else(|| panic!("no {start:?}"))
}

#[test]
fn screen_readers_know_the_tree_and_its_rows_answer_them() {
    let mut window = tree(WIDE, 300);
    window.apply(JointCommand::Select(Some(JointIndex(3))));
    {
        let bones = node(&window, "Bones").accesskit_node();
        assert_eq!(bones.role(), Role::Tree);
        assert_eq!(
            bones.data().size_of_set(),
            Some(300),
            "all rows, also those out of view"
        );
        let row = node(&window, "Bone 3, ").accesskit_node();
        let parent = row.parent().expect("the tree");
        assert_eq!((row.role(), parent.id()), (Role::TreeItem, bones.id()));
        let row = row.data();
        assert_eq!((row.level(), row.position_in_set()), (Some(2), Some(2)));
        assert_eq!((row.is_selected(), row.is_expanded()), (Some(true), Some(true)));
    }
    ask(&mut window, "Bone 1, ", Action::Collapse);
    assert!(window.session().joints().is_folded(JointIndex(1)));
    assert_eq!(
        node(&window, "Bone 1, ").accesskit_node().data().is_expanded(),
        Some(false)
    );
    ask(&mut window, "Bone 1, ", Action::Expand);
    assert!(!window.session().joints().is_folded(JointIndex(1)));
    ask(&mut window, "Bone 5, ", Action::Focus);
    assert!(focused(&window).starts_with("Bone 5, "));
    ask(&mut window, "Bone 1, ", Action::Click);
    assert_eq!(selected(&window), Some(1));
}

#[test]
fn every_level_of_a_deep_tree_is_indented_and_names_keep_half_of_the_row() {
    let frames: Vec<&[usize]> = vec![&[0, 10]; 40];
    let mut window = crate::page::window(WIDE, vec![crate::rigs::chain(&frames)]);
    window.click("Panel: Skeleton");
    let mut lefts: Vec<f32> = (0..25)
        .map(|bone| window.rect(&format!("Fold Bone {bone}")).min.x)
        .collect();
    let deepest = lefts[24];
    lefts.dedup();
    assert_eq!(lefts.len(), 25, "{lefts:?}");
    assert!(lefts.is_sorted());
    let row = window.rect("Bone 24, ");
    assert!(deepest < row.center().x, "{deepest} {row}");
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
    assert!(window.session().look().bones_visible);
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

/// The texts that begin so as they are drawn.
fn texts<'a>(window: &'a Window, start: &'a str) -> impl Iterator<Item = &'a TextShape> {
    let shapes = window.harness.output().shapes.iter();
    let texts = shapes.filter_map(|clipped| match &clipped.shape {
        Shape::Text(text) => Some(text),
        _ => None,
    });
    texts.filter(move |text| text.galley.text().starts_with(start))
}

/// The words that begin so and are drawn, whatever readers of the screen are told.
pub(crate) fn drawn(window: &Window, start: &str) -> Vec<String> {
    texts(window, start).map(|text| text.galley.text().to_owned()).collect()
}

/// Those that are drawn within one of these rows, not wider than it.
fn drawn_in(window: &Window, rows: &[Rect], start: &str) -> Vec<String> {
    let fits = |text: &&TextShape| {
        let drawn = Rect::from_min_size(text.pos, text.galley.size());
        rows.iter().any(|row| row.contains_rect(drawn))
    };
    let fitting = texts(window, start).filter(fits);
    fitting.map(|text| text.galley.text().to_owned()).collect()
}

#[test]
fn names_too_long_for_their_rows_keep_their_beginning_and_end() {
    let mut window = tree(WIDE, 5);
    let long = |end: &str| format!("mixamorig:LeftHandThumbThatIsFarLongerThanAnyRowOfAPanel_{end}");
    for (joint, end) in [(1, "1"), (2, "e\u{301}"), (3, "3")] {
        let (joint, name) = (JointIndex(joint), long(end));
        window.apply(NameCommand::Rename { joint, name });
    }
    let rows = |window: &Window| window.named(|name| name.starts_with("mixamorig:"));
    let in_tree = rows(&window);
    assert_eq!(in_tree.len(), 3, "the whole name for readers: {in_tree:?}");
    let rects: Vec<Rect> = in_tree.into_iter().map(|(_, rect)| rect).collect();
    let drawn = drawn_in(&window, &rects, "mixa");
    for end in ["…", "_1", "_e\u{301}", "_3"] {
        let ends = drawn.iter().filter(|name| name.ends_with(end)).count();
        assert_eq!(ends, usize::from(end != "…"), "{end}: {drawn:?}");
    }
    // The weights of a vertex leave less room.
    window.apply(JointCommand::SelectVertex(Some(3)));
    let weights = window.named(|name| name.starts_with("mixamorig:") && name.contains(": weight"));
    assert!(!weights.is_empty(), "{:?}", window.widgets());
    for (name, rect) in weights {
        let drawn = drawn_in(&window, &[rect], "mi");
        let (name, _) = name.split_once(": weight").expect("a weight");
        let end = name.rsplit_once('_').expect("its end").1;
        assert!(
            drawn.len() == 1 && drawn[0].contains('…') && drawn[0].ends_with(end),
            "{name}: {drawn:?}"
        );
    }
}
