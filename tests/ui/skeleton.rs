//! The tree of joints, the joint and the vertex that are inspected, what is drawn of them.

use bindpose::anim::{GhostPlan, SkinView};
use bindpose::model::JointIndex;
use bindpose::scene::BoneStyle;
use bindpose::session::{Command, File, JointCommand};
use egui::{Event, Key, Modifiers, OutputCommand, PointerButton, Vec2, vec2};

use crate::chains::mirrored;
use crate::layout::{assert_apart, assert_between_sides};
use crate::models;
use crate::page::{PHONE, WIDE, Window, phone, window};

const SMALL: Vec2 = vec2(900.0, 700.0);

fn chains(bone_count: usize) -> Vec<File> {
    vec![models::file("chains.m3d", &mirrored(bone_count))]
}

/// A window with the tree open.
fn tree(size: Vec2, bone_count: usize) -> Window {
    let mut window = window(size, chains(bone_count));
    window.click("Panel: Skeleton");
    window
}

/// The names of the rows that are laid out.
fn rows(window: &Window) -> Vec<String> {
    let rows = window.named(|name| name.contains(", ") && name.ends_with("vertices"));
    rows.into_iter().map(|(name, _)| name).collect()
}

fn hover(window: &mut Window, start: &str) {
    let at = window.rect(start).center();
    window.harness.hover_at(at);
    window.pass_on();
}

fn double_click(window: &mut Window, start: &str) {
    let at = window.rect(start).center();
    window.harness.hover_at(at);
    // A click just before would make it a triple click.
    window.wait(1.0);
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

fn selected(window: &Window) -> Option<u32> {
    window.session().joints().selected().map(|joint| joint.0)
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

fn window_of_still() -> Window {
    window(WIDE, vec![models::still("a.m3d")])
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

    window.click("Bone 0, ");
    for _ in 0..40 {
        if window.focused().is_some_and(|name| name.starts_with("Bone 0, ")) {
            break;
        }
        window.press(Modifiers::NONE, Key::Tab);
    }
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
    window.apply(JointCommand::Select(Some(JointIndex(5))).into());
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
    assert!(!window.session().joints().bones_visible());
}

#[test]
fn names_of_one_side_propose_those_of_the_other() {
    let mut window = tree(WIDE, 5);
    window.click("Names and branches");
    window.click("Propose mirrored");
    assert!(!window.shows("Take the proposed names"), "nothing has a name");
    window.click("Back to the tree");
    let named = |joint, name: &str| JointCommand::Rename {
        joint: JointIndex(joint),
        name: name.to_owned(),
    };
    window.apply(named(1, "L hip").into());
    window.apply(named(3, "L knee").into());
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
    window.apply(JointCommand::Select(Some(JointIndex(1_998))).into());
    window.wait(1.0);
    let row = window.rect("Bone 1998, ");
    assert!(row.max.y < window.rect("Play").min.y && row.min.y > 50.0, "{row}");
    assert!(rows(&window).len() < 60);
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
fn keys_show_bones_names_weights_and_the_bind_pose() {
    let mut window = window(WIDE, chains(5));
    let press = |window: &mut Window, modifiers, key| window.press(modifiers, key);
    press(&mut window, Modifiers::NONE, Key::B);
    press(&mut window, Modifiers::SHIFT, Key::B);
    press(&mut window, Modifiers::NONE, Key::W);
    press(&mut window, Modifiers::NONE, Key::K);
    let joints = window.session().joints();
    assert!(joints.bones_visible() && joints.labels_visible());
    assert_eq!(joints.skin_view(), Some(SkinView::Weight));
    assert_eq!(window.session().bind_share(), 1.0);
    assert!(window.shows("Legend: Weight of a bone"));
    press(&mut window, Modifiers::NONE, Key::B);
    press(&mut window, Modifiers::SHIFT, Key::B);
    press(&mut window, Modifiers::NONE, Key::W);
    press(&mut window, Modifiers::NONE, Key::K);
    let joints = window.session().joints();
    assert!(!joints.bones_visible() && !joints.labels_visible() && joints.skin_view().is_none());
    assert_eq!(window.session().bind_share(), 0.0);
    let mut still = window_of_still();
    still.press(Modifiers::NONE, Key::B);
    assert!(!still.session().joints().bones_visible(), "no bones, no key");
}

#[test]
fn the_key_that_flies_forward_leaves_the_skin_alone() {
    let mut window = window(WIDE, chains(5));
    let at = window.harness.ctx.content_rect().center();
    let held = |pressed| Event::PointerButton {
        pos: at,
        button: PointerButton::Secondary,
        pressed,
        modifiers: Modifiers::NONE,
    };
    window.harness.hover_at(at);
    window.harness.event(held(true));
    window.pass_on();
    window.press(Modifiers::NONE, Key::W);
    window.harness.event(held(false));
    window.pass_on();
    assert_eq!(window.session().joints().skin_view(), None);
}

#[test]
fn each_view_of_the_skin_has_a_legend() {
    let mut window = window(WIDE, chains(5));
    for (view, legend) in [
        ("Number of bones", "Colours of 0 to 4 bones"),
        ("Stretch", "Colours from 0.5 to 2"),
        ("Weight of a bone", "Colours from 0 to 1"),
    ] {
        window.click("View mode");
        window.click(view);
        assert!(
            window.shows(&format!("Legend: {view}")) && window.shows(legend),
            "{view}"
        );
        assert!(window.shows(&format!("View mode: {view}")));
    }
    window.apply(JointCommand::Select(Some(JointIndex(3))).into());
    assert!(window.shows("Legend: Weight of Bone 3"));
    window.click("View mode");
    window.click("Strongest bone");
    assert!(window.shows("Legend: Strongest bone"));
    window.click("View mode");
    window.click("Lit");
    assert_eq!(window.session().joints().skin_view(), None);
    assert!(window.named(|name| name.starts_with("Legend")).is_empty());
}

/// The middle of the window where the first triangle of a bone is.
fn place_of_vertex(window: &mut Window, vertex: u32) -> egui::Pos2 {
    window.apply(JointCommand::SelectVertex(Some(vertex)).into());
    let at = window
        .harness
        .state_mut()
        .session
        .selected_vertex_at()
        .expect("in view");
    window.apply(JointCommand::SelectVertex(None).into());
    let share = vec2(0.5 * (at.x + 1.0), 0.5 * (1.0 - at.y));
    egui::Pos2::ZERO + share * WIDE
}

fn click_at(window: &mut Window, at: egui::Pos2) {
    window.harness.hover_at(at);
    window.harness.drag_at(at);
    window.harness.drop_at(at);
    window.pass_on();
}

#[test]
fn a_click_in_the_view_means_what_is_shown_there() {
    let mut window = window(WIDE, vec![models::moving("a.m3d")]);
    // A corner of the front, a little inside of the box.
    let corner = place_of_vertex(&mut window, 2);
    let center = window.harness.ctx.content_rect().center();
    let at = corner + 0.12 * (center - corner);
    click_at(&mut window, at);
    assert_eq!(window.session().subsets().selected(), Some(0), "plainly a subset");
    window.press(Modifiers::NONE, Key::W);
    // Else it would be a double click.
    window.wait(1.0);
    click_at(&mut window, at);
    let vertex = window.session().joints().selected_vertex();
    assert!(vertex.is_some(), "a vertex of a coloured skin");
    assert_eq!(
        window.session().subsets().selected(),
        None,
        "one thing is selected at a time"
    );
    window.press(Modifiers::NONE, Key::B);
    let bone = bone_place(&mut window, 1);
    window.harness.hover_at(bone);
    window.pass_on();
    assert_eq!(window.session().joints().hovered(), Some(JointIndex(1)));
    click_at(&mut window, bone);
    assert_eq!(selected(&window), Some(1), "a bone before the skin");
    window.press(Modifiers::NONE, Key::Escape);
    assert_eq!(
        (selected(&window), window.session().joints().selected_vertex()),
        (Some(1), None)
    );
    window.press(Modifiers::NONE, Key::Escape);
    assert_eq!(selected(&window), None);
}

/// Where a joint is in the window: its label says it.
fn bone_place(window: &mut Window, joint: u32) -> egui::Pos2 {
    let session = &mut window.harness.state_mut().session;
    session.apply(JointCommand::SetLabelsVisible(true).into());
    let mut places = Vec::new();
    session.joint_labels(0.0, &mut places);
    session.apply(JointCommand::SetLabelsVisible(false).into());
    let place = places
        .into_iter()
        .find(|place| place.joint.0 == joint)
        .expect("in view");
    let share = vec2(0.5 * (place.position.x + 1.0), 0.5 * (1.0 - place.position.y));
    egui::Pos2::ZERO + share * WIDE
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

#[test]
fn bones_pose_ghosts_and_trails_are_among_the_overlays() {
    let mut window = window(WIDE, chains(5));
    window.apply(JointCommand::Select(Some(JointIndex(3))).into());
    window.click("Lines over");
    window.click("Bones");
    window.click("Bones: Axes");
    window.click("Names of bones");
    let joints = window.session().joints();
    assert_eq!((joints.bone_style(), joints.labels_visible()), (BoneStyle::Axes, true));
    window.click("Bind pose as a veil");
    assert!(window.session().bind_ghost());
    window.click("To bind pose");
    let share = window.session().bind_share();
    assert!((0.4..0.6).contains(&share), "{share}");
    window.click("Ghosts");
    let plan = GhostPlan {
        before: 3,
        after: 3,
        step_frames: 5,
    };
    assert_eq!(window.session().ghost_plan(), Some(plan));
    assert!(window.shows("Ghosts every frames"));
    window.click("Trail of Bone 3");
    assert_eq!(window.session().joints().trails(), [JointIndex(3)]);
    window.click("Leave the trail of Bone 3");
    assert!(window.session().joints().trails().is_empty());
}

#[test]
fn tree_and_inspector_fit_every_window() {
    for (size, bone_count) in [(WIDE, 300), (SMALL, 300), (SMALL, 1), (vec2(900.0, 600.0), 2_000)] {
        let mut window = tree(size, bone_count);
        window.apply(JointCommand::Select(Some(JointIndex(0))).into());
        window.apply(JointCommand::SelectVertex(Some(0)).into());
        window.apply(JointCommand::SetSkinView(Some(SkinView::Weight)).into());
        assert_between_sides(&window, size);
        assert_apart(
            &window,
            &["title", "toolbar", "model", "inspector", "timeline", "legend"],
        );
        assert!(!rows(&window).is_empty());
    }
    let mut window = phone(chains(300));
    window.click("Model facts");
    window.click("Panel: Skeleton");
    window.apply(JointCommand::SetSkinView(Some(SkinView::Weight)).into());
    assert_between_sides(&window, PHONE);
    assert_apart(&window, &["title", "sheet", "legend"]);
    let row = window.rect("Bone 1, ");
    assert!(row.height() >= 44.0, "{row}");
    window.click("Bone 1, ");
    assert!(window.shows("Selected: Bone 1"), "the sheet is about it");
    assert_between_sides(&window, PHONE);
}
