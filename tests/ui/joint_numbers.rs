//! Numbers of the joint and of the vertex that are inspected.

use bindpose::anim::SkinView;
use bindpose::model::JointIndex;
use bindpose::session::{JointCommand, LookCommand, PlayCommand};
use egui::{Key, Modifiers, MouseWheelUnit, OutputCommand, PointerButton, Role, vec2};
use egui_kittest::Node;
use egui_kittest::kittest::NodeT as _;

use crate::layout::assert_between_sides;
use crate::page::{PHONE, WIDE, Window, phone, touch_window, wheel_event, window};
use crate::skeleton::{chains, selected, tree};

/// What a click copies.
pub(crate) fn copied_by(window: &mut Window, start: &str) -> String {
    let at = window.rect(start).center();
    window.harness.hover_at(at);
    window.harness.drag_at(at);
    window.button(at, PointerButton::Primary, false, Modifiers::NONE);
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
        window.assert_shows(words);
    }
    let local = window.rect("Position ");
    assert!(window.shows("Position 0.5000 0.0000 0.0000"));
    window.apply(PlayCommand::Seek { time_secs: 0.8 });
    assert_eq!(window.rect("Position "), local, "numbers stand still");
    window.click("Parent: Bone 0");
    assert_eq!(selected(&window), Some(0));
    assert!(window.shows("Parent none, it is a root") && window.shows("Child: Bone 2"));
    window.click("Child: Bone 2");
    assert_eq!(selected(&window), Some(2));
    window.click("Mirror: Bone 1");
    assert_eq!(selected(&window), Some(1), "the bone of the other side");
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
    let last = copied_by(&mut window, "Copy: Final transform");
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
    window.apply(PlayCommand::Play);
    window.click("Key 1, 0.500 s");
    assert_eq!(window.time_secs(), 0.5);
    assert!(!window.session().playback().is_playing());
    window.click("Keys: Euler");
    assert!(window.shows("Key 0, 0.000 s: 0.00 0.00 0.00"));
    window.click("Trail through the clip");
    assert_eq!(window.session().look().trails[..], [JointIndex(1)]);
}

#[test]
fn a_vertex_shows_its_weights_and_explains_its_place() {
    for mut window in [window(vec2(1440.0, 1200.0), chains(5)), phone(chains(5))] {
        if window.shows("Model facts") {
            window.click("Model facts");
        }
        window.apply(JointCommand::SelectVertex(Some(4)));
        assert!(window.shows("Selected: Vertex 4"));
        assert!(window.shows("Bone 1: weight 0.750") && window.shows("Bone 0: weight 0.250"));
        window.click("Explain this vertex");
        assert!(window.shows("Copy: the sum of the vertex as text"));
        // On the phone it has to be scrolled to.
        if window.rect("Copy: the sum").max.y < 800.0 {
            let copied = copied_by(&mut window, "Copy: the sum");
            assert!(copied.starts_with("vertex 4: row vectors"), "{copied}");
        }
        window.click("Hide the explanation");
        assert!(!window.shows("Copy: the sum of the vertex as text"));
        window.click("Bone 1: weight");
        assert_eq!(selected(&window), Some(1), "its weights can be seen");
        assert!(window.session().joints().selected_vertex().is_some());
    }
}

/// The last three numbers of a line.
fn numbers_of(line: &str) -> [f32; 3] {
    let words: Vec<&str> = line.split(' ').collect();
    let [.., x, y, z] = words[..] else { panic!("{line}") };
    [x, y, z].map(|word| word.parse().unwrap_or_else(|_| panic!("{line}")))
}

#[track_caller]
fn line(window: &Window, start: &str) -> [f32; 3] {
    let found = window.named(|name| name.starts_with(start));
    let [(name, _)] = &found[..] else {
        panic!("{start}: {found:?}")
    };
    numbers_of(name)
}

/// The numbers of a matrix, row by row, as screen readers know them.
#[track_caller]
fn rows_of(window: &Window, table: &str) -> [[f32; 3]; 4] {
    let mut nodes = window.harness.root().children_recursive();
    let is_table = |node: &Node<'_>| {
        let node = node.accesskit_node();
        node.role() == Role::Table && node.label().as_deref() == Some(table)
    };
    let table = nodes.find(is_table).unwrap_or_else(|| panic!("no table {table:?}"));
    let rows: Vec<_> = table
        .children_recursive()
        .filter_map(|row| row.accesskit_node().label())
        .collect();
    assert_eq!(rows.len(), 4, "{rows:?}");
    [0, 1, 2, 3].map(|row| {
        let numbers = rows[row].strip_prefix(&format!("row {}: ", row + 1));
        let mut numbers = numbers
            .expect("its number")
            .split(' ')
            .map(|word| word.parse().expect("a number"));
        [0; 3].map(|_| numbers.next().expect("three numbers"))
    })
}

#[test]
fn the_formula_can_be_followed_through_the_matrices_to_what_is_drawn() {
    let mut window = window(vec2(1440.0, 1200.0), chains(5));
    window.apply(JointCommand::SelectVertex(Some(4)));
    window.click("Explain this vertex");
    assert!(window.shows("v' = w0·v·F0 + w1·v·F1"));
    assert!(!window.shows("Fold the matrices of Bone 0, weight 0.250"));
    window.click("Unfold the matrices of Bone 0, ");
    window.click("Unfold the matrices of Bone 1, ");
    for time_secs in [0.0, 0.3, 0.8] {
        window.apply(PlayCommand::Seek { time_secs });
        let bind = line(&window, "Bind ");
        let mut sum = [0.0; 3];
        for (bone, weight) in [("Bone 0", 0.25), ("Bone 1", 0.75)] {
            for matrix in ["offset", "toRoot"] {
                let [.., place] = rows_of(&window, &format!("{bone}: {matrix}"));
                assert!(place.iter().all(|number| number.is_finite()), "{place:?}");
            }
            let rows = [1, 2, 3, 4].map(|row| line(&window, &format!("{bone}: F, row {row}: ")));
            let moved = line(&window, &format!("{bone}: v·F "));
            let weighted = line(&window, &format!("{bone}: w·v·F "));
            for axis in 0..3 {
                let product: f32 = (0..3).map(|row| bind[row] * rows[row][axis]).sum();
                assert!((product + rows[3][axis] - moved[axis]).abs() < 2e-4, "{bone} {axis}");
                assert!((moved[axis] * weight - weighted[axis]).abs() < 2e-4);
                sum[axis] += weighted[axis];
            }
        }
        // The name of the section begins alike.
        let place = window.named(|name| name.starts_with("Place ") && name != "Place now");
        let place = numbers_of(&place[0].0);
        let drawn = window.harness.state_mut().session.explain_vertex().expect("selected");
        for axis in 0..3 {
            assert!((sum[axis] - place[axis]).abs() < 2e-4, "{sum:?} {place:?}");
            assert!((drawn.position[axis] - place[axis]).abs() < 1e-4);
        }
    }
}

#[test]
fn an_explanation_stands_still_and_inside_of_the_slimmest_panel() {
    for size in [vec2(320.0, 900.0), PHONE, vec2(900.0, 1200.0)] {
        let mut window = if size.x < 900.0 {
            touch_window(size, chains(5))
        } else {
            window(size, chains(5))
        };
        window.apply(JointCommand::SelectVertex(Some(4)));
        if window.shows("Model facts") {
            window.click("Show Vertex 4");
        }
        window.click("Explain this vertex");
        window.click("Unfold the matrices of Bone 0, ");
        assert_between_sides(&window, size);
        let places = |window: &Window| {
            let lines = window.named(|name| name.contains("F, row") || name.contains("v·F") || name.contains("toRoot"));
            lines.into_iter().map(|(_, rect)| rect).collect::<Vec<_>>()
        };
        let before = places(&window);
        assert!(before.len() >= 10, "{}", before.len());
        for time_secs in [0.2, 0.55, 1.0] {
            window.apply(PlayCommand::Seek { time_secs });
            assert_eq!(places(&window), before, "{time_secs}");
        }
        // The next vertex is looked at in the same way.
        window.apply(JointCommand::SelectVertex(Some(5)));
        assert!(!window.named(|name| name.starts_with("Fold the matrices")).is_empty());
    }
}

#[test]
fn the_pointer_over_a_bone_shows_its_weights_and_leaves_those_of_the_selected_one() {
    let mut window = window(vec2(1440.0, 1200.0), chains(5));
    window.apply(LookCommand::SetSkinView(Some(SkinView::Weight)));
    window.apply(JointCommand::Select(Some(JointIndex(2))));
    window.apply(JointCommand::SelectVertex(Some(4)));
    let shown = |window: &Window| (window.session().weighed_joint(), window.session().skin_colors_key());
    let selected = shown(&window);
    assert_eq!(selected.0, Some(JointIndex(2)));
    let at = window.rect("Bone 1: weight").center();
    window.hover_at(at);
    let looked_at = shown(&window);
    assert_eq!(looked_at.0, Some(JointIndex(1)));
    assert_ne!(looked_at.1, selected.1, "the skin is coloured anew");
    assert!(window.shows("Legend: Weight of Bone 1"));
    window.hover_at(egui::pos2(700.0, 20.0));
    assert_eq!(shown(&window), selected);
    assert!(window.shows("Legend: Weight of Bone 2"));
}

#[test]
fn a_vertex_stands_above_the_bone_that_is_selected_with_it() {
    for mut window in [window(vec2(1440.0, 900.0), chains(5)), phone(chains(5))] {
        if window.shows("Model facts") {
            window.click("Model facts");
        }
        window.apply(JointCommand::Select(Some(JointIndex(1))));
        // The panel is scrolled to the bone's numbers.
        let at = window.rect("Selected: Bone 1").center();
        window.harness.hover_at(at);
        window
            .harness
            .event(wheel_event(MouseWheelUnit::Point, vec2(0.0, -300.0), Modifiers::NONE));
        window.wait(0.5);
        window.apply(JointCommand::SelectVertex(Some(4)));
        window.wait(0.5);
        let vertex = window.rect("Selected: Vertex 4");
        assert!(vertex.min.y < window.rect("Selected: Bone 1").min.y);
        assert!(vertex.distance_to_pos(at) < 40.0, "it is seen: {vertex} {at}");
        window.apply(JointCommand::Select(Some(JointIndex(3))));
        assert!(!window.shows("Selected: Vertex 4"), "a bone instead");
    }
}

/// A chain of two bones with a key every frame.
fn many_keys() -> Vec<bindpose::session::File> {
    let frames: Vec<usize> = (0..76).collect();
    vec![crate::rigs::chain(&[&frames, &frames])]
}

#[test]
fn the_keys_open_at_the_one_in_force_and_keys_walk_through_them() {
    let mut window = window(vec2(1440.0, 1300.0), many_keys());
    window.apply(PlayCommand::Seek { time_secs: 1.5 });
    window.apply(JointCommand::Select(Some(JointIndex(1))));
    let key = window.session().clip().expect("a clip").tracks[1]
        .times_secs()
        .partition_point(|&secs| secs <= 1.5)
        - 1;
    let in_force = format!("Key {key}, ");
    let list = node(&window, "Keys of the bone");
    assert_eq!(list.accesskit_node().role(), Role::ListBox);
    assert_eq!(list.accesskit_node().data().size_of_set(), Some(76));
    let row = node(&window, &in_force);
    assert_eq!(row.accesskit_node().data().is_selected(), Some(true));
    for _ in 0..80 {
        if window.focused().is_some_and(|name| name.starts_with(&in_force)) {
            break;
        }
        window.tab(false);
    }
    window.press(Modifiers::NONE, Key::ArrowDown);
    assert_eq!(window.time_secs(), 1.5, "the focus alone does not move the time");
    assert!(
        window
            .focused()
            .is_some_and(|name| name.starts_with(&format!("Key {}, ", key + 1)))
    );
    window.press(Modifiers::NONE, Key::Enter);
    assert!(window.time_secs() > 1.5);
    for (pressed, start) in [(Key::Home, "Key 0, "), (Key::End, "Key 75, ")] {
        window.press(Modifiers::NONE, pressed);
        let focused = window.focused().unwrap_or_default();
        assert!(focused.starts_with(start), "{pressed:?}: {focused:?}");
    }
}

#[track_caller]
fn node<'a>(window: &'a Window, start: &'a str) -> Node<'a> {
    let begins = move |node: &Node<'_>| {
        node.accesskit_node()
            .label()
            .is_some_and(|label| label.starts_with(start))
    };
    let mut nodes = window.harness.root().children_recursive();
    nodes.find(begins).unwrap_or_else(|| panic!("no {start:?}"))
}

#[test]
fn on_a_phone_the_keys_have_half_of_the_sheet_and_links_are_rows() {
    let mut window = phone(many_keys());
    window.click("Model facts");
    window.apply(JointCommand::Select(Some(JointIndex(1))));
    let link = window.rect("Parent: Bone 0");
    assert!(link.height() >= 44.0, "{link}");
    let keys = window.named(|name| name.starts_with("Key "));
    let height = keys.iter().map(|(_, rect)| rect.height()).sum::<f32>();
    assert!(height >= 0.5 * 0.47 * PHONE.y, "{height}: {keys:?}");
}

#[test]
fn the_words_of_the_books_stand_beside_ours_and_are_explained() {
    let mut window = tree(vec2(1440.0, 1300.0), 5);
    window.click("Bone 1, ");
    assert!(window.shows("Palette 1 of 5; the demo holds 96"));
    assert!(window.shows("F = offset · toRoot, for row vectors"));
    for name in [
        "Palette 1 of 5; the demo holds 96",
        "Relative to: Local (toParent)",
        "Relative to: Model (toRoot)",
        "Offset",
        "Final transform",
    ] {
        let told = window.node(name).description().expect("a sentence");
        assert!(told.ends_with('.') && !told.contains('`'), "{name}: {told}");
        let at = window.named(|shown| shown == name)[0].1.center();
        // Soon after a click there are no tooltips.
        window.wait(0.5);
        window.harness.hover_at(at);
        window.wait(1.0);
        assert!(window.shows(&told), "{name} on hover: {:?}", window.widgets());
    }
    window.apply(JointCommand::SelectVertex(Some(4)));
    window.click("Explain this vertex");
    window.click("Unfold the matrices of Bone 1");
    let toward_model = window.node("bone to model").description().expect("a sentence");
    assert!(toward_model.starts_with("toRoot "), "{toward_model}");
}

#[test]
fn a_bone_without_a_mirror_or_children_moves_nothing_below() {
    // By touch each child has a row.
    for (mut window, joints) in [(tree(vec2(1440.0, 1300.0), 5), [0, 1]), (phone(chains(5)), [1, 3])] {
        let mut places = Vec::new();
        for joint in joints {
            window.harness.state_mut().state.drawer = Some(bindpose::ui::DrawerPage::Selection);
            window.apply(JointCommand::Select(Some(JointIndex(joint))));
            places.push(window.rect("Copy: place now").min.y);
        }
        assert_eq!(places[0], places[1]);
    }
}
