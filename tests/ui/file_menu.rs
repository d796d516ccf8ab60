//! The name of the open file: a menu of all models that are open. And what a message says of a drop.

use bindpose::session::{File, FileCommand};
use egui::{Key, Modifiers, Role};
use egui_kittest::kittest::NodeT as _;

use crate::models::{cube, jointed, moving, still};
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
        let is_line = node.role() == Role::MenuItemRadio;
        (is_line && name.ends_with(".m3d")).then_some((name, is_marked))
    });
    lines.collect()
}

#[test]
fn the_name_of_the_file_opens_a_menu_of_all_models_with_the_open_one_marked() {
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
    window.apply(FileCommand::Open("in/Middle.m3d".to_owned()));
    let name = Some("Open model: Middle.m3d · 2 of 3");
    for _ in 0..100 {
        if window.focused().as_deref() != name {
            window.tab(false);
        }
    }
    window.press(Modifiers::NONE, Key::Enter);
    assert_eq!(lines(&window).len(), 3);
    assert_eq!(
        window.focused().as_deref(),
        Some("in/Middle.m3d"),
        "it begins with the one that is open"
    );
    window.press(Modifiers::NONE, Key::ArrowDown);
    assert_eq!(
        window.focused().as_deref(),
        Some("in/small.m3d"),
        "the first arrow moves"
    );
    window.press(Modifiers::NONE, Key::Escape);
    assert!(lines(&window).is_empty());
    assert_eq!(window.focused().as_deref(), name);
    assert_eq!(open_path(&window), "in/Middle.m3d");
}

#[test]
fn in_a_menu_that_the_pointer_opened_the_first_arrow_goes_on_from_the_open_model() {
    for (arrow, next) in [(Key::ArrowDown, "in/small.m3d"), (Key::ArrowUp, "in/large.m3d")] {
        let mut window = window(WIDE, drop());
        window.apply(FileCommand::Open("in/Middle.m3d".to_owned()));
        window.click("Open model: Middle.m3d · 2 of 3");
        assert_eq!(window.focused(), None);
        window.press(Modifiers::NONE, arrow);
        assert_eq!(window.focused().as_deref(), Some(next));
    }
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
        ["…that_the_toolbar_leaves.m3d", "b.m3d"],
        "the end of a path tells more"
    );
    let wide = window(egui::vec2(900.0, 700.0), files());
    assert!(wide.rect("Open model: ").max.x <= wide.rect("View mode").min.x);
}

#[test]
fn a_cross_or_delete_closes_a_model_of_the_menu() {
    for mut window in [window(WIDE, drop()), phone(drop())] {
        window.click("Open model: ");
        let (line, cross) = (window.rect("in/small.m3d"), window.rect("Close small.m3d"));
        assert!(cross.min.x >= line.max.x && window.shows("Close large.m3d"));
        let ends = ["large", "Middle", "small"].map(|name| window.rect(&format!("Close {name}.m3d")).max.x);
        assert!(ends.iter().all(|&end| end == ends[0]), "one column: {ends:?}");
        window.click("Close small.m3d");
        assert_eq!(open_path(&window), "in/large.m3d");
        assert!(window.shows("Open model: large.m3d · 1 of 2"));

        window.apply(FileCommand::Add(vec![still("new.m3d")]));
        window.click("Open model: new.m3d · 3 of 3");
        let names: Vec<_> = lines(&window).into_iter().map(|(name, _)| name).collect();
        assert_eq!(
            names,
            ["in/large.m3d", "in/Middle.m3d", "new.m3d"],
            "what is new stands at the end"
        );
        for _ in 0..20 {
            if window.focused().as_deref() != Some("new.m3d") {
                window.press(Modifiers::NONE, Key::ArrowDown);
            }
        }
        window.press(Modifiers::NONE, Key::Delete);
        assert_eq!(open_path(&window), "in/Middle.m3d", "the one before comes in its place");
        assert_eq!(window.session().models().len(), 2);
    }
}

#[test]
fn each_line_has_the_size_of_its_file() {
    let mut window = window(WIDE, drop());
    let size = window.session().models()[0].bytes.len();
    window.click("Open model: ");
    assert!((1000..999_500).contains(&size), "{size} bytes are some kB");
    let told = window.node("in/large.m3d").description().expect("a size");
    let kilobytes = told
        .strip_suffix(" kB, Delete closes it")
        .and_then(|number| number.parse::<f64>().ok());
    assert!(
        kilobytes.is_some_and(|told| (told * 1e3 - size as f64).abs() < 500.0),
        "{told}: {size}"
    );
}

#[test]
fn a_cube_map_among_textures_is_offered_as_sky_and_a_sky_can_be_taken_back() {
    let mut window = window(WIDE, vec![still("a.m3d"), cube("in/dusk.dds", 2, [9; 4])]);
    let sky = |window: &Window| window.session().sky_file().map(|file| file.path.clone());
    assert!(window.shows("dusk.dds is a cube map") && sky(&window).is_none());
    assert!(window.shows("Lighting: Studio"));
    window.click("Use the cube map as sky");
    assert_eq!(sky(&window).as_deref(), Some("in/dusk.dds"));
    assert!(window.shows("dusk.dds is the sky") && window.shows("Lighting: Sky, dusk.dds"));

    window.apply(FileCommand::Add(vec![cube("noon.dds", 2, [200; 4])]));
    assert!(window.shows("noon.dds is the sky") && window.shows("Lighting: Sky, noon.dds"));
    window.click("Undo what the message tells of");
    assert_eq!(sky(&window).as_deref(), Some("in/dusk.dds"));
    assert!(!window.shows("dusk.dds is the sky"), "nobody asked for it again");

    window.click("Lighting: ");
    assert!(window.shows("Sky dusk.dds") && !window.shows("Use dusk.dds as sky"));
    window.click("Use noon.dds as sky");
    assert_eq!(sky(&window).as_deref(), Some("noon.dds"));
    window.click("Remove the sky");
    assert_eq!(sky(&window), None);
    for words in ["Use dusk.dds as sky", "Use noon.dds as sky"] {
        assert!(window.shows(words), "both can still be chosen");
    }
}

#[test]
fn models_that_are_closed_to_make_room_are_told() {
    let bytes = bytes::Bytes::from(vec![0; 300 << 20]);
    let mut window = window(WIDE, vec![still("a.m3d"), File::sharing("a.bin", bytes.clone())]);
    window.apply(FileCommand::Add(vec![
        still("b.m3d"),
        moving("c.m3d"),
        File::sharing("b.bin", bytes),
    ]));
    assert!(window.shows("Opened c.m3d, the largest of 2 · 1 model closed, the oldest, to make room"));
}
