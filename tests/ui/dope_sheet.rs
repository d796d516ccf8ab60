//! The sheet above the strip: rows, keys, boxes, zoom; and how little of it is drawn.

use bindpose::model::JointIndex;
use bindpose::session::{JointCommand, NameCommand, PlayCommand};
use egui::accesskit::{Action, Role, Toggled};
use egui::{Event, Key, Modifiers, MouseWheelUnit, PointerButton, Pos2, TouchPhase, Vec2, pos2, vec2};

use crate::layout::{assert_apart, assert_between_sides, assert_inside};
use crate::models::moving;
use crate::page::{PHONE, WIDE, Window, phone, touch_window, wheel_event, window};
use crate::pointer::{fingers, gesture};
use crate::rigs::{chain, rig};

/// Room between the ends of the time and the ends of the sheet.
const END_ROOM: f32 = 8.0;

fn open(window: &mut Window) {
    window.click("Dope sheet and curves");
}

fn sheet(joints: usize, keys: usize) -> Window {
    let mut window = window(WIDE, vec![rig(joints, keys)]);
    open(&mut window);
    window
}

/// Where a share of what is seen of the time is, in a row.
fn place(window: &Window, row: &str, share: f32) -> Pos2 {
    let keys = window.rect("Keys of all bones");
    let x = keys.min.x + END_ROOM + share * (keys.width() - 2.0 * END_ROOM);
    pos2(x, window.rect(row).center().y)
}

fn drag(window: &mut Window, from: Pos2, to: Pos2) {
    window.harness.hover_at(from);
    window.harness.drag_at(from);
    window.harness.hover_at(from + (to - from) * 0.5);
    window.hover_at(to);
    window.harness.drop_at(to);
    window.pass_on();
}

pub(crate) fn wheel(window: &mut Window, at: Pos2, delta: Vec2, modifiers: Modifiers) {
    window.harness.hover_at(at);
    window
        .harness
        .event_modifiers(wheel_event(MouseWheelUnit::Point, delta, modifiers), modifiers);
    window.wait(0.5);
}

fn rows(window: &Window) -> Vec<String> {
    let rows = window.named(|name| name.starts_with("Bone ") && name.contains(" key"));
    rows.into_iter().map(|(name, _)| name).collect()
}

#[test]
fn while_the_edge_is_dragged_only_the_first_frames_have_a_second_pass() {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    open(&mut window);
    let edge = window.rect("Height of the dope sheet").center();
    window.harness.hover_at(edge);
    window.harness.drag_at(edge);
    window.pass_on();
    // Higher than this the panel on the left would give way, and have a second pass of its own.
    let passes = (1..=8).map(|step| {
        window.harness.hover_at(edge - vec2(0.0, 6.0 * step as f32));
        window.harness.step();
        window.harness.output().platform_output.num_completed_passes
    });
    let passes: Vec<usize> = passes.collect();
    assert!(passes[2..].iter().all(|&passes| passes == 1), "{passes:?}");
    window.pass_on();
    let timeline = window.rect("Height of the dope sheet");
    assert!(
        (timeline.center().y - (edge.y - 48.0)).abs() < 2.0,
        "it follows to the end: {timeline}"
    );
}

#[test]
fn a_button_opens_and_shuts_it_and_the_edge_sizes_it() {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    assert!(!window.shows("Keys of all bones"));
    open(&mut window);
    assert_eq!(rows(&window), ["Bone 0, 31 keys", "Bone 1, 31 keys"]);
    let before = window.rect("Keys of all bones").height();
    let edge = window.rect("Height of the dope sheet").center();
    drag(&mut window, edge, edge - vec2(0.0, 80.0));
    let higher = window.rect("Keys of all bones").height();
    assert!((higher - before - 80.0).abs() < 2.0, "{before} to {higher}");
    let edge = window.rect("Height of the dope sheet").center();
    drag(&mut window, edge, edge - vec2(0.0, 2000.0));
    assert_inside(&window, WIDE);
    let edge = window.rect("Height of the dope sheet").center();
    drag(&mut window, edge, pos2(edge.x, WIDE.y - 20.0));
    assert!(!window.shows("Keys of all bones"), "dragged down it is shut");
    let edge = window.rect("Height of the dope sheet").center();
    drag(&mut window, edge, edge - vec2(0.0, 200.0));
    assert!(window.shows("Keys of all bones"), "dragged up it is open");
    window.click("Shut the dope sheet");
    assert!(!window.shows("Keys of all bones"));
}

#[test]
fn the_edge_is_moved_by_keys() {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    window.ask("Height of the dope sheet", Action::Focus, None);
    window.press(Modifiers::NONE, Key::Enter);
    let before = window.rect("Keys of all bones").height();
    window.press(Modifiers::NONE, Key::ArrowUp);
    let higher = window.rect("Keys of all bones").height();
    assert!((higher - before - 24.0).abs() < 1.0, "{before} to {higher}");
    assert_eq!(window.time_secs(), 0.0, "arrows are its own");
    window.press(Modifiers::NONE, Key::Space);
    assert!(!window.shows("Keys of all bones") && !window.session().is_animating());
}

#[test]
fn a_click_on_a_key_goes_there_and_chooses_its_bone() {
    let mut window = sheet(5, 31);
    let at = place(&window, "Bone 3, ", 20.0 / 30.0);
    window.click_at(at + vec2(3.0, 0.0));
    let key_secs = 20.0 / 30.0;
    assert!((window.time_secs() - key_secs).abs() < 1e-6, "{}", window.time_secs());
    assert_eq!(window.session().joints().selected(), Some(JointIndex(3)));
    // A clip that plays would leave it at once.
    window.apply(PlayCommand::Play);
    window.click_at(at);
    assert!(!window.session().playback().is_playing());
    assert!((window.time_secs() - key_secs).abs() < 1e-6, "{}", window.time_secs());
    // Up and down go from key to key of that bone.
    window.press(Modifiers::NONE, Key::ArrowUp);
    assert!((window.time_secs() - 21.0 / 30.0).abs() < 1e-6);
    window.press(Modifiers::NONE, Key::ArrowDown);
    window.press(Modifiers::NONE, Key::ArrowDown);
    assert!((window.time_secs() - 19.0 / 30.0).abs() < 1e-6);
}

#[test]
fn a_drag_draws_a_box_counts_its_keys_and_makes_a_range_of_it() {
    let mut window = sheet(5, 31);
    let from = place(&window, "Bone 1, ", 9.5 / 30.0);
    let to = place(&window, "Bone 4, ", 14.5 / 30.0);
    drag(&mut window, from, to);
    // Bones 1, 4, 2, 3 stand in the order of the tree; 1 and 4 are next to each other.
    let [words] = &window.named(|name| name.contains(" keys · "))[..] else {
        panic!("{:?}", window.widgets());
    };
    assert_eq!(words.0, "10 keys · 0.32–0.48 s");
    assert_eq!(window.time_secs(), 0.0, "a box leaves the time alone");
    window.click("As range");
    let [start, end] = window.session().playback().range_secs().expect("a range");
    assert!((start - 9.5 / 30.0).abs() < 0.002 && (end - 14.5 / 30.0).abs() < 0.002);
    window.press(Modifiers::NONE, Key::Escape);
    assert!(!window.shows("As range"), "Esc lets go of the keys");
    window.click("Bone 2, ");
    window.press(Modifiers::NONE, Key::Escape);
    assert_eq!(window.session().joints().selected(), None, "and then of the bone");
}

#[test]
fn branches_fold_with_counts_and_rows_are_sorted_by_motion() {
    let mut window = sheet(13, 31);
    assert_eq!(rows(&window).len(), 10, "the others are to be scrolled to");
    window.click("Fold Bone 1");
    assert!(!rows(&window).contains(&"Bone 4, 31 keys".to_owned()));
    window.click("Unfold Bone 1");
    assert!(rows(&window).contains(&"Bone 4, 31 keys".to_owned()));
    window.click("Fold all");
    assert_eq!(
        rows(&window),
        ["Bone 0, 31 keys; folded away: 12 bones with keys at 31 times"]
    );
    window.click("Unfold all");
    window.click("Sort by motion");
    assert_eq!(
        rows(&window)[..2],
        [
            "Bone 12, 31 keys, 100 % of the most motion",
            "Bone 11, 31 keys, 92 % of the most motion"
        ]
    );
}

#[test]
fn a_folded_row_has_the_keys_folded_away_in_its_branch() {
    let mut window = window(WIDE, vec![chain(&[&[0, 30], &[0, 10, 30], &[10, 20]])]);
    open(&mut window);
    window.click("Fold Bone 0");
    let row = "Bone 0, 2 keys; folded away: 2 bones with keys at 4 times";
    assert_eq!(rows(&window), [row]);
    let at = |window: &Window, frame: f32| place(window, row, frame / 30.0);
    for frame in [10.0, 20.0, 30.0, 0.0] {
        let there = at(&window, frame) + vec2(2.0, 0.0);
        window.click_at(there);
        assert!((window.time_secs() - frame / 30.0).abs() < 1e-6, "{frame}");
        assert_eq!(window.session().joints().selected(), Some(JointIndex(0)));
        assert_eq!(rows(&window), [row], "it stays folded");
    }
    let between = at(&window, 15.0);
    window.click_at(between);
    assert_eq!(window.time_secs(), 0.0, "there is no key");
    // Bones 1 and 2 both have a key at frame 10, and one has another at 20.
    let [from, to] = [9.0, 21.0].map(|frame| at(&window, frame));
    drag(&mut window, from, to);
    assert_eq!(
        window.named(|name| name.starts_with("3 keys · ")).len(),
        1,
        "{:?}",
        window.widgets()
    );
    window.click("Unfold Bone 0");
    window.click("Fold Bone 1");
    assert_eq!(
        rows(&window),
        [
            "Bone 0, 2 keys",
            "Bone 1, 3 keys; folded away: 1 bone with keys at 2 times"
        ]
    );
}

#[test]
fn folded_branches_of_many_joints_and_keys_are_drawn_as_little_as_a_row() {
    let mut window = sheet(500, 1000);
    window.click("Fold all");
    assert_eq!(
        rows(&window),
        ["Bone 0, 1\u{2009}000 keys; folded away: 499 bones with keys at 1\u{2009}000 times"]
    );
    window.click("Unfold Bone 0");
    assert_eq!(rows(&window).len(), 4);
    // Four rows, each of two lines of marks: its own keys and those folded away.
    let drawn = vertices(&window);
    assert!(drawn <= 2 * 4 * 1200 / 3 * 8, "{drawn}");
    let few = {
        let mut window = sheet(5, 1000);
        window.click("Fold Bone 1");
        vertices(&window)
    };
    assert!(drawn <= 2 * few, "{drawn} of 500 bones, {few} of 5");
}

#[test]
fn ctrl_and_wheel_zoom_at_the_pointer_and_shift_and_wheel_pans() {
    let mut window = sheet(5, 301);
    let at = place(&window, "Bone 1, ", 0.5);
    for _ in 0..4 {
        wheel(&mut window, at, vec2(0.0, 100.0), Modifiers::COMMAND | Modifiers::CTRL);
    }
    assert!(window.shows("All of the time"));
    // The time under the pointer stayed: a click goes to the key in the middle of the clip.
    window.click_at(at);
    assert!((window.time_secs() - 5.0).abs() < 0.02, "{}", window.time_secs());
    let camera = *window.session().camera();
    wheel(&mut window, at, vec2(0.0, -60.0), Modifiers::SHIFT);
    window.click_at(at);
    assert!(window.time_secs() > 5.05, "{}", window.time_secs());
    assert_eq!(*window.session().camera(), camera, "the view behind did not hear of it");
    let before = window.time_secs();
    for (from, to) in [(at, at - vec2(120.0, 0.0))] {
        window.harness.hover_at(from);
        for (pos, pressed) in [(from, true), (to, true), (to, false)] {
            window.harness.event(Event::PointerMoved(pos));
            if pos == from || !pressed {
                window.button(pos, PointerButton::Middle, pressed, Modifiers::NONE);
            }
            window.pass_on();
        }
    }
    window.click_at(at);
    assert!(window.time_secs() > before + 0.05, "{}", window.time_secs());
    window.click("All of the time");
    assert!(!window.shows("All of the time"));
}

#[test]
fn rows_light_up_with_their_bones_and_come_into_sight_when_one_is_selected() {
    let mut window = sheet(300, 31);
    let at = place(&window, "Bone 4, ", 0.4);
    window.hover_at(at);
    let row = |window: &Window| window.session().joints().hovered();
    assert_eq!(row(&window), Some(JointIndex(4)));
    window.hover_at(window.rect("Bone 1, ").center());
    assert_eq!(row(&window), Some(JointIndex(1)));
    window.hover_at(pos2(720.0, 300.0));
    assert_eq!(row(&window), None);
    assert!(!rows(&window).contains(&"Bone 299, 31 keys".to_owned()));
    window.apply(JointCommand::Select(Some(JointIndex(299))));
    window.wait(0.5);
    assert!(
        rows(&window).contains(&"Bone 299, 31 keys".to_owned()),
        "{:?}",
        rows(&window)
    );
    let first = rows(&window)[0].clone();
    wheel(&mut window, at, vec2(0.0, 300.0), Modifiers::NONE);
    assert_ne!(rows(&window)[0], first, "it is not held there");
}

#[test]
fn it_opens_at_the_selected_bone_without_showing_others_before() {
    let mut window = window(WIDE, vec![rig(300, 31)]);
    let row = "Bone 299, 31 keys";
    window.apply(JointCommand::Select(Some(JointIndex(299))));
    for _ in 0..2 {
        let button = window.rect("Dope sheet and curves").center();
        window.harness.hover_at(button);
        window.harness.drag_at(button);
        window.harness.drop_at(button);
        let seen = loop {
            window.harness.step();
            let seen = rows(&window);
            if !seen.is_empty() {
                break seen;
            }
        };
        assert!(seen.contains(&row.to_owned()), "{seen:?}");
        window.pass_on();
        assert_eq!(rows(&window), seen, "it stands still");
        // Scrolled away and opened again it is there again.
        let over = place(&window, row, 0.5);
        wheel(&mut window, over, vec2(0.0, 900.0), Modifiers::NONE);
        assert!(!rows(&window).contains(&row.to_owned()));
        window.click("Shut the dope sheet");
    }
}

#[test]
fn arrows_go_from_key_to_key_and_from_row_to_row() {
    let all: Vec<usize> = (0..=30).collect();
    let mut window = window(WIDE, vec![chain(&[&[0, 30], &[0, 10, 30], &[10, 20], &all])]);
    open(&mut window);
    window.ask("Keys of all bones", Action::Focus, None);
    let cell = |window: &Window| window.focused().expect("a cell has the focus");
    assert_eq!(cell(&window), "key 1 of 2, frame 0, 0.00 s, Bone 0");
    for (key, expected) in [
        (Key::ArrowRight, "key 2 of 2, frame 30, 1.00 s, Bone 0"),
        (Key::ArrowRight, "key 2 of 2, frame 30, 1.00 s, Bone 0"),
        (Key::ArrowDown, "key 3 of 3, frame 30, 1.00 s, Bone 1"),
        (Key::ArrowLeft, "key 2 of 3, frame 10, 0.33 s, Bone 1"),
        (Key::ArrowDown, "key 1 of 2, frame 10, 0.33 s, Bone 2"),
        (Key::ArrowDown, "key 11 of 31, frame 10, 0.33 s, Bone 3"),
        (Key::ArrowDown, "key 11 of 31, frame 10, 0.33 s, Bone 3"),
        (Key::ArrowUp, "key 1 of 2, frame 10, 0.33 s, Bone 2"),
        (Key::End, "key 2 of 2, frame 20, 0.67 s, Bone 2"),
        (Key::Home, "key 1 of 2, frame 10, 0.33 s, Bone 2"),
        (Key::PageUp, "key 1 of 2, frame 0, 0.00 s, Bone 0"),
    ] {
        window.press(Modifiers::NONE, key);
        assert_eq!(cell(&window), expected, "{key:?}");
        assert_eq!(window.time_secs(), 0.0, "they are no shortcuts");
    }
    window.press(Modifiers::NONE, Key::ArrowDown);
    assert_eq!(
        cell(&window),
        "key 2 of 3, frame 10, 0.33 s, Bone 1",
        "as in the row before"
    );
    window.apply(PlayCommand::Play);
    window.press(Modifiers::NONE, Key::Enter);
    assert!(!window.session().is_animating());
    assert!((window.time_secs() - 10.0 / 30.0).abs() < 1e-6, "{}", cell(&window));
    assert_eq!(window.session().joints().selected(), Some(JointIndex(1)));
    window.press(Modifiers::NONE, Key::End);
    window.press(Modifiers::NONE, Key::Space);
    assert_eq!((window.time_secs(), window.session().is_animating()), (1.0, false));
    // Left of the first key is the name, which folds its branch.
    window.press(Modifiers::NONE, Key::Home);
    window.press(Modifiers::NONE, Key::ArrowLeft);
    assert_eq!(cell(&window), "Bone 1, 3 keys");
    window.press(Modifiers::NONE, Key::ArrowLeft);
    assert_eq!(rows(&window).len(), 2);
    window.press(Modifiers::NONE, Key::End);
    window.press(Modifiers::NONE, Key::ArrowLeft);
    assert_eq!(cell(&window), "key of 2 bones folded away, frame 29, 0.97 s, Bone 1");
    window.press(Modifiers::NONE, Key::Escape);
    window.press(Modifiers::NONE, Key::Escape);
    assert_eq!(window.focused(), None, "Esc lets go");
}

#[test]
fn shift_and_arrows_choose_keys() {
    let mut window = sheet(5, 31);
    window.ask("Keys of all bones", Action::Focus, None);
    window.press(Modifiers::NONE, Key::ArrowRight);
    for key in [Key::ArrowRight, Key::ArrowRight, Key::ArrowDown] {
        window.press(Modifiers::SHIFT, key);
    }
    window.assert_shows("6 keys · 0.03–0.10 s");
    window.press(Modifiers::SHIFT, Key::ArrowLeft);
    assert!(window.shows("4 keys · 0.03–0.07 s"));
    window.press(Modifiers::SHIFT, Key::End);
    assert!(window.shows("60 keys · 0.03–1.00 s"));
    window.press(Modifiers::NONE, Key::ArrowLeft);
    assert!(!window.shows("As range"), "without Shift they are let go");
}

#[test]
fn it_is_a_grid_whose_rows_select_and_fold() {
    let mut window = sheet(5, 31);
    let grid = window.node("Keys of all bones");
    assert_eq!(grid.role(), Role::Grid);
    let row = window.node("Bone 1, 31 keys");
    assert_eq!(row.role(), Role::RowHeader);
    let above = std::iter::successors(row.parent(), |node| node.parent());
    assert!(
        above.into_iter().any(|node| node.role() == Role::Grid),
        "it is in the grid"
    );
    window.ask("Bone 1, 31 keys", Action::Click, None);
    assert_eq!(window.session().joints().selected(), Some(JointIndex(1)));
    assert_eq!(window.node("Bone 1, 31 keys").is_selected(), Some(true));
    window.ask("Bone 1, 31 keys", Action::Collapse, None);
    assert_eq!(rows(&window).len(), 4);
    let folded = "Bone 1, 31 keys; folded away: 1 bone with keys at 31 times";
    window.ask(folded, Action::Expand, None);
    assert_eq!(rows(&window).len(), 5);
}

#[test]
fn a_row_says_what_its_tint_means_and_covers_no_row_with_that() {
    let mut window = sheet(5, 31);
    let at = place(&window, "Bone 1, ", 0.45);
    window.harness.hover_at(at);
    window.wait(1.0);
    let told = window.named(|name| name.contains("of the most motion"));
    let [(words, rect)] = &told[..] else { panic!("{told:?}") };
    assert!(
        words.starts_with("Bone 1 turns by ") && words.ends_with("the stronger its row is tinted."),
        "{words}"
    );
    assert!(rect.max.y <= window.rect("Bone 0, ").min.y, "{rect}");
}

#[test]
fn bones_go_by_their_names() {
    let mut window = sheet(5, 31);
    let name = "Tail".to_owned();
    let joint = JointIndex(2);
    window.apply(NameCommand::Rename { joint, name });
    window.click("Tail, 31 keys");
    window.click("Sheet: Curves");
    window.rect("Curves of Tail, rotation");
}

#[test]
fn the_ruler_carries_the_time() {
    let mut window = sheet(5, 31);
    let ruler = window.rect("Ruler");
    drag(&mut window, ruler.left_center() + vec2(8.0, 0.0), ruler.center());
    assert!((window.time_secs() - 0.5).abs() < 0.01, "{}", window.time_secs());
    assert!(!window.session().is_scrubbing());
}

/// Corners of all that is drawn in the window.
fn vertices(window: &Window) -> usize {
    let shapes = &window.harness.output().shapes;
    let meshes = shapes.iter().filter_map(|clipped| match &clipped.shape {
        egui::Shape::Mesh(mesh) => Some(mesh.vertices.len()),
        _ => None,
    });
    meshes.sum::<usize>() + shapes.len()
}

#[test]
fn what_is_drawn_is_bounded_by_what_is_seen_and_not_by_the_model() {
    let few = sheet(30, 1000);
    let many = sheet(2000, 1000);
    let [few_vertices, many_vertices] = [&few, &many].map(vertices);
    // A mark has eight corners, a bar four; ten rows of a mark every three points of 1200.
    assert!(many_vertices <= 10 * 1200 / 3 * 8, "{many_vertices}");
    assert!(
        many_vertices <= few_vertices + few_vertices / 4,
        "{few_vertices} {many_vertices}"
    );
    assert_eq!(
        rows(&many).len(),
        rows(&few).len(),
        "rows that are not seen are not laid out"
    );
}

#[test]
fn rigs_of_any_size_have_their_rows() {
    for (joints, shown) in [(1, 1), (300, 10)] {
        let mut window = sheet(joints, 31);
        assert_eq!(rows(&window).len(), shown);
        assert_inside(&window, WIDE);
        assert_apart(&window, &["title", "toolbar", "model", "timeline"]);
        window.apply(PlayCommand::SelectClip(1));
        assert_eq!(rows(&window).len(), shown, "a clip of one key has rows too");
    }
}

#[test]
fn it_fits_windows_of_any_size() {
    for size in [WIDE, vec2(900.0, 700.0), vec2(900.0, 600.0), vec2(1200.0, 480.0)] {
        let mut window = window(size, vec![rig(30, 31)]);
        open(&mut window);
        for tab in ["Sheet: Curves", "Sheet: Dope sheet"] {
            window.click(tab);
            assert_inside(&window, size);
            assert_apart(&window, &["title", "toolbar", "model", "timeline"]);
        }
    }
    let sheet: &[&str] = &["title", "drawer"];
    for (size, panels) in [
        (PHONE, sheet),
        (vec2(320.0, 568.0), sheet),
        (vec2(899.0, 700.0), sheet),
        (vec2(844.0, 390.0), &["title", "drawer", "page"]),
    ] {
        let mut window = touch_window(size, vec![rig(30, 31)]);
        open(&mut window);
        window.click("Bone 1, ");
        for tab in ["Sheet: Curves", "Sheet: Dope sheet"] {
            window.click(tab);
            assert_between_sides(&window, size);
            assert_apart(&window, panels);
        }
    }
}

#[test]
fn rows_scroll_with_the_wheel() {
    let mut window = sheet(300, 31);
    let first = rows(&window)[0].clone();
    let at = place(&window, "Bone 1, ", 0.5);
    wheel(&mut window, at, vec2(0.0, -400.0), Modifiers::NONE);
    assert_ne!(rows(&window)[0], first);
    assert!(!window.shows("All of the time"), "the time stays");
}

#[test]
fn on_a_phone_it_is_a_page_of_the_sheet_with_buttons_for_time() {
    let mut window = phone(vec![rig(30, 31)]);
    open(&mut window);
    assert!(!rows(&window).is_empty());
    assert_between_sides(&window, PHONE);
    for start in [
        "Previous key",
        "One frame on",
        "Backward",
        "Last frame",
        "Sort by motion",
        "Fold all",
        "Shut the dope sheet",
        "Bone 1, ",
        "Time 0",
        "Frame 0",
    ] {
        let rect = window.rect(start);
        assert!(rect.height() >= 44.0 && rect.width() >= 44.0, "{start}: {rect}");
    }
    window.click("One frame on");
    assert!((window.time_secs() - 1.0 / 30.0).abs() < 1e-6);
    // A finger on the play head means the time; away from it the ends of the range are as large as everything.
    window.click("Last frame");
    let [near, far] = ["Range out", "Range in"].map(|end| window.rect(end).width());
    assert!(near < far && far >= 44.0, "{near} and {far}");
    window.click("Sheet: Curves");
    assert_inside(&window, PHONE);
    window.click("Shut the dope sheet");
    assert!(rows(&window).is_empty());
}

#[test]
fn a_finger_that_rests_on_a_step_makes_ten_of_it() {
    let mut window = phone(vec![rig(5, 31)]);
    open(&mut window);
    let at = [window.rect("One frame on").center()];
    fingers(&mut window, TouchPhase::Start, &at);
    window.wait(1.5);
    fingers(&mut window, TouchPhase::End, &at);
    window.pass_on();
    assert!(
        (window.time_secs() - 10.0 / 30.0).abs() < 1e-6,
        "{}",
        window.time_secs()
    );
}

#[test]
fn two_fingers_zoom_in_time_and_one_pans_and_scrolls() {
    let mut window = phone(vec![rig(300, 301)]);
    open(&mut window);
    let middle = window.rect("Keys of all bones").center();
    let pinch = |apart: f32| vec![middle - vec2(apart, 0.0), middle + vec2(apart, 0.0)];
    gesture(&mut window, &[20.0, 30.0, 40.0, 60.0, 80.0].map(pinch));
    assert!(window.shows("All of the time"));
    let first = rows(&window)[0].clone();
    let path = [0.0, 20.0, 60.0, 120.0].map(|up| vec![middle - vec2(0.5 * up, up)]);
    gesture(&mut window, &path);
    assert_ne!(rows(&window)[0], first, "rows follow the finger");
    assert!(!window.shows("As range"), "a finger draws no box");
    assert_eq!(window.time_secs(), 0.0);
}

#[test]
fn a_finger_on_ruler_and_curves_carries_the_time_and_what_is_seen_stays() {
    let mut window = phone(vec![rig(5, 301)]);
    open(&mut window);
    window.click("Bone 1, ");
    let middle = window.rect("Keys of all bones").center();
    let pinch = |apart: f32| vec![middle - vec2(apart, 0.0), middle + vec2(apart, 0.0)];
    gesture(&mut window, &[20.0, 30.0, 40.0, 60.0, 80.0].map(pinch));
    assert!(window.shows("All of the time"));
    for (tab, place) in [("Sheet: Dope sheet", "Ruler"), ("Sheet: Curves", "Curves of Bone 1")] {
        window.click(tab);
        let rect = window.rect(place);
        let at = |share: f32| vec![pos2(rect.min.x + share * rect.width(), rect.center().y)];
        let mut times = Vec::new();
        for way in [[0.2, 0.3, 0.45, 0.6], [0.6, 0.45, 0.3, 0.2], [0.2, 0.3, 0.45, 0.6]] {
            gesture(&mut window, &way.map(at));
            times.push(window.time_secs());
        }
        assert!(times[0] > times[1] + 0.5, "{place}: {times:?}");
        assert!(
            (times[0] - times[2]).abs() < 1e-3,
            "{place}: what is seen moved, {times:?}"
        );
    }
}

#[test]
fn curves_are_read_by_keyboard_and_their_lines_are_hidden() {
    let mut window = sheet(5, 31);
    window.apply(JointCommand::Select(Some(JointIndex(4))));
    window.click("Sheet: Curves");
    window.ask("rotation y", Action::Click, None);
    let line = window.node("rotation y");
    assert_eq!((line.role(), line.toggled()), (Role::CheckBox, Some(Toggled::False)));
    window.ask("Curves of Bone 4, rotation", Action::Focus, None);
    let key = |window: &Window| window.focused().expect("a key has the focus");
    assert_eq!(key(&window), "rotation x 0.0000, key 1 of 31, frame 0, 0.00 s");
    for (key, frame) in [(Key::ArrowRight, 1), (Key::End, 30), (Key::ArrowLeft, 29)] {
        window.press(Modifiers::NONE, key);
        let words = format!(", key {} of 31, frame {frame}, {:.2} s", frame + 1, frame as f32 / 30.0);
        assert!(window.focused().is_some_and(|name| name.ends_with(&words)), "{words}");
        assert_eq!(window.time_secs(), 0.0, "they are no shortcuts");
    }
    for _ in 0..3 {
        window.press(Modifiers::NONE, Key::ArrowDown);
    }
    assert!(key(&window).starts_with("rotation w "), "{}", key(&window));
    window.press(Modifiers::NONE, Key::Enter);
    assert!((window.time_secs() - 29.0 / 30.0).abs() < 1e-6);
    window.press(Modifiers::SHIFT, Key::Home);
    window.assert_shows("30 keys · 0.00–0.97 s");
    window.click("As range");
    assert_eq!(window.session().playback().range_secs(), Some([0.0, 29.0 / 30.0]));
}

#[test]
fn curves_show_the_chosen_bone_and_follow_the_choices() {
    let mut window = sheet(5, 31);
    window.click("Sheet: Curves");
    assert!(window.shows("Curves are those of one bone. Choose it in the dope sheet or in the skeleton."));
    window.click("Choose the bone that moves most");
    let most = window.session().joints().selected().expect("a bone");
    let session = window.session();
    let activity = session
        .open_model()
        .expect("open")
        .activity(session.clip_index().expect("a clip"));
    assert_eq!(activity.expect("of each bone")[most.index()].fraction, 1.0);
    assert!(!window.shows("Choose the bone that moves most"));
    window.press(Modifiers::NONE, Key::Escape);
    window.click("Sheet: Dope sheet");
    window.click("Bone 4, ");
    window.click("Sheet: Curves");
    window.rect("Curves of Bone 4, rotation");
    let legend = |window: &Window| {
        let mut words = window.named(|name| name.starts_with("t 0")).remove(0).0;
        for part in ["translation", "rotation", "scale"] {
            for channel in ["x", "y", "z", "w"] {
                let name = format!("{part} {channel}");
                if window.shows(&name) {
                    words += &format!(", {channel} {}", window.value_of(&name).expect("a value"));
                }
            }
        }
        words
    };
    assert_eq!(legend(&window), "t 0.000 s, x 0.0000, y 0.0000, z 0.0000, w 1.0000");
    window.apply(PlayCommand::Seek { time_secs: 10.0 / 30.0 });
    // Bone 4 of 5 turns by 0.8 sin 1.5 about x, as far as six digits of a file say it.
    let angle = 0.8 * 1.5_f32.sin();
    let x = |window: &Window| {
        let legend = legend(window);
        let value = legend.split(", ").nth(1).and_then(|x| x.strip_prefix("x "));
        let number = value.and_then(|value| value.trim_end_matches('°').parse::<f32>().ok());
        number.unwrap_or_else(|| panic!("{legend}"))
    };
    assert!((x(&window) - (angle * 0.5).sin()).abs() < 2e-4);
    window.click("Rotation as: Euler");
    assert!((x(&window) - angle.to_degrees()).abs() < 2e-2);
    window.click("Part: Translation");
    assert_eq!(legend(&window), "t 0.333 s, x 0.0000, y 0.1000, z 0.0000");
    window.click("Space: Model");
    assert_ne!(legend(&window), "t 0.333 s, x 0.0000, y 0.1000, z 0.0000");
    window.click("Part: Scale");
    assert!(legend(&window).contains("y 1.0000"));
    window.click("Part: Rotation");
    window.apply(PlayCommand::Seek { time_secs: 0.4 });
    let (whole, over) = (legend(&window), window.rect("Curves of Bone 4"));
    let modifiers = Modifiers::COMMAND | Modifiers::CTRL;
    wheel(
        &mut window,
        over.left_center() + vec2(0.4 * over.width(), 0.0),
        vec2(0.0, 150.0),
        modifiers,
    );
    window.hover_at(pos2(5.0, 5.0));
    assert!(window.shows("All of the time"));
    assert_eq!(legend(&window), whole, "what is seen of the time changes no value");
    wheel(&mut window, over.center(), vec2(0.0, -40.0), Modifiers::SHIFT);
    window.hover_at(pos2(5.0, 5.0));
    assert_eq!(legend(&window), whole, "nor does panning");
    window.click("All of the time");
    let curves = window.rect("Curves of Bone 4");
    window.click_at(curves.center());
    assert!((window.time_secs() - 0.5).abs() < 0.01, "a press goes there");
}
