//! The name of the open file: a menu of the models of a drop and of what was open before it.

use bindpose::session::{File, FileCommand};
use egui::{Key, Modifiers, Role};
use egui_kittest::kittest::NodeT as _;

use crate::models::{jointed, moving, still};
use crate::page::{PHONE, WIDE, Window, phone, window};

fn drop() -> Vec<File> {
    vec![still("in/small.m3d"), moving("in/large.m3d"), jointed("in/Middle.m3d")]
}

fn open_path(window: &Window) -> &str {
    &window.session().open_model().expect("a model").file.path
}

/// The lines of the menu, and whether each is marked.
fn lines(window: &Window) -> Vec<(String, bool)> {
    let nodes = window.harness.root().children_recursive();
    let lines = nodes.filter_map(|node| {
        let node = node.accesskit_node();
        let name = node.label()?;
        let is_marked = node.toggled() == Some(egui::accesskit::Toggled::True);
        let is_line = matches!(node.role(), Role::MenuItem | Role::MenuItemRadio);
        (is_line && name.ends_with(".m3d")).then_some((name, is_marked))
    });
    lines.collect()
}

#[test]
fn the_name_of_the_file_opens_a_menu_of_all_models_sorted_with_the_open_one_marked() {
    for mut window in [
        window(WIDE, vec![still("before.m3d")]),
        phone(vec![still("before.m3d")]),
    ] {
        assert!(window.shows("before.m3d"), "one model needs no menu");
        window.apply(FileCommand::Add(drop()));
        let marked = |open: &str| {
            let paths = ["before.m3d", "in/large.m3d", "in/Middle.m3d", "in/small.m3d"];
            paths.map(|path| (path.to_owned(), path == open)).to_vec()
        };
        for (button, open, next) in [
            ("Open model: large.m3d · 2 of 4", "in/large.m3d", "before.m3d"),
            ("Open model: before.m3d · 1 of 4", "before.m3d", "in/small.m3d"),
            ("Open model: small.m3d · 4 of 4", "in/small.m3d", "in/large.m3d"),
        ] {
            window.click(button);
            assert_eq!(lines(&window), marked(open));
            window.click(next);
            assert_eq!(
                (open_path(&window), lines(&window).len()),
                (next, 0),
                "chosen, and shut"
            );
        }
    }
}

#[test]
fn esc_shuts_the_menu_and_gives_the_focus_back_to_the_name() {
    let mut window = window(WIDE, drop());
    let name = Some("Open model: large.m3d · 1 of 3");
    for _ in 0..100 {
        if window.focused().as_deref() != name {
            window.press(Modifiers::NONE, Key::Tab);
        }
    }
    window.press(Modifiers::NONE, Key::Enter);
    assert_eq!(lines(&window).len(), 3);
    window.press(Modifiers::NONE, Key::Tab);
    window.press(Modifiers::NONE, Key::Escape);
    assert!(lines(&window).is_empty());
    assert_eq!(window.focused().as_deref(), name);
    assert_eq!(open_path(&window), "in/large.m3d");
}

#[test]
fn of_a_drop_of_several_a_message_says_which_was_opened() {
    let said = "Opened large.m3d, the largest of 3";
    let mut window = window(WIDE, vec![still("before.m3d")]);
    window.apply(FileCommand::Add(drop()));
    assert!(window.shows(said));
    let told = window.take_told();
    assert_eq!(told.matches(said).count(), 1, "said once: {told}");
    window.wait(6.5);
    assert!(!window.shows(said));
    for path in ["before.m3d", "in/large.m3d"] {
        window.apply(FileCommand::Open(path.to_owned()));
        assert!(!window.shows(said), "the person chose {path}");
    }
}

#[test]
fn a_long_name_leaves_the_tools_their_room() {
    let name = "a_name_that_needs_all_the_room_that_the_toolbar_leaves.m3d";
    let files = || vec![still("b.m3d"), moving(name)];
    let mut phone = phone(files());
    let button = phone.rect("Open model: ");
    assert!(button.max.x <= phone.rect("Lighting").min.x && button.max.x < PHONE.x);
    phone.click("Open model: ");
    let names: Vec<_> = lines(&phone).into_iter().map(|(name, _)| name).collect();
    assert_eq!(
        names,
        ["…_the_room_that_the_toolbar_leaves.m3d", "b.m3d"],
        "the end of a path tells more"
    );
    let wide = window(egui::vec2(900.0, 700.0), files());
    assert!(wide.rect("Open model: ").max.x <= wide.rect("View mode").min.x);
}
