//! What every panel is on the page, once its roles are settled: ARIA's own rules, and what a listener takes from a role.

use std::collections::HashMap;

use bindpose::model::JointIndex;
use bindpose::session::{File, FileCommand, JointCommand, LookCommand, PlayCommand, SubmeshCommand};
use bindpose::ui::{DrawerPage, Mirror, MirrorId, MirrorNode};
use egui::accesskit::Action;
use egui::{Key, Modifiers, Vec2, vec2};

use crate::models::{broken, moving};
use crate::page::{DRAWER_PAGES, PHONE, WIDE, Window, touch_window, window};
use crate::rigs::rig;

const LOW: Vec2 = vec2(844.0, 390.0);

/// All that is mirrored of a window now.
struct Told {
    nodes: HashMap<MirrorId, MirrorNode>,
    parents: HashMap<MirrorId, MirrorId>,
    outline: String,
}

impl Told {
    fn of(window: &mut Window) -> Self {
        *window.harness.ctx.plugin::<Mirror>().lock() = Mirror::default();
        window.pass_on();
        let plugin = window.harness.ctx.plugin::<Mirror>();
        let mut mirror = plugin.lock();
        let nodes = mirror.take_changes().expect("nothing was told yet").changed;
        let parents = nodes
            .iter()
            .flat_map(|node| node.children.iter().map(|child| (*child, node.id)));
        Self {
            parents: parents.collect(),
            nodes: nodes.iter().map(|node| (node.id, node.clone())).collect(),
            outline: mirror.outline(),
        }
    }

    /// From the element around it outwards.
    fn around(&self, id: MirrorId) -> impl Iterator<Item = &MirrorNode> {
        let parent = |id: &MirrorId| self.parents.get(id).copied();
        std::iter::successors(parent(&id), parent).map(|id| &self.nodes[&id])
    }

    #[track_caller]
    fn find(&self, role: &str, start: &str) -> &MirrorNode {
        let mut nodes = self.nodes.values();
        let found = nodes.find(|node| node.role == role && node.name.starts_with(start));
        found.unwrap_or_else(|| panic!("no {role} {start}:\n{}", self.outline))
    }

    fn children(&self, node: &MirrorNode) -> Vec<&MirrorNode> {
        node.children.iter().map(|id| &self.nodes[id]).collect()
    }
}

/// What may be in a container of items, or None where anything may.
fn items_of(role: &str) -> Option<&'static [&'static str]> {
    Some(match role {
        "tree" => &["treeitem"],
        "listbox" => &["option"],
        "list" => &["listitem"],
        "tablist" => &["tab"],
        "menu" => &["menuitem", "menuitemcheckbox", "menuitemradio", "separator"],
        "grid" => &["row"],
        "row" => &["gridcell", "rowheader"],
        _ => return None,
    })
}

/// Where an item has to stand.
fn container_of(role: &str) -> Option<&'static str> {
    Some(match role {
        "treeitem" => "tree",
        "option" => "listbox",
        "listitem" => "list",
        "tab" => "tablist",
        "menuitem" | "menuitemcheckbox" | "menuitemradio" | "separator" => "menu",
        "row" => "grid",
        "gridcell" | "rowheader" => "row",
        _ => return None,
    })
}

const CONTROLS: &str = "button checkbox switch radio slider spinbutton textbox link tab treeitem option menuitem \
    menuitemcheckbox menuitemradio grid gridcell rowheader listbox application";
const FOLDED: &str = "button link row treeitem gridcell rowheader menuitem tab";
/// The buttons that are switches: they stay as they are pressed. A row of a list is pressed while it is selected.
const SWITCHES: &[&str] = &[
    "Turntable",
    "Backward",
    "Sort by motion",
    "Show Painted alone",
    "Only ",
    "Painted, ",
    "note ",
    "Loop gap of ",
    "warning ",
];

fn is_among(words: &str, role: &str) -> bool {
    words.split(' ').any(|word| word == role)
}

#[track_caller]
fn assert_sound(told: &Told, what: &str) {
    for node in told.nodes.values() {
        let (role, name) = (node.role, node.name.as_str());
        let said = format!("{what}: {role} {name:?} at {:?}\n{}", node.bounds, told.outline);
        if node.focusable || node.clickable {
            assert!(!name.trim().is_empty(), "no name: {said}");
            // The keys scroll the table of keys, so that it takes the focus.
            let is_scrolled = (role, name) == ("group", "Table of keys");
            assert!(is_scrolled || is_among(CONTROLS, role), "no control: {said}");
        }
        let is_stable = |letter: char| letter == '-' || letter.is_ascii_lowercase() || letter.is_ascii_digit();
        assert!(
            node.control.iter().flat_map(|control| control.chars()).all(is_stable),
            "{:?}: {said}",
            node.control
        );
        assert_ne!(node.description.as_deref(), Some(name), "said twice: {said}");
        assert!(node.expanded.is_none() || is_among(FOLDED, role), "folded: {said}");
        assert!(node.popup.is_none() || node.expanded.is_some(), "opens: {said}");
        if role == "button" && node.on.is_some() {
            assert!(
                node.expanded.is_none() && node.popup.is_none(),
                "pressed and opens: {said}"
            );
            assert!(SWITCHES.iter().any(|start| name.starts_with(start)), "pressed: {said}");
        }
        if matches!(
            role,
            "dialog" | "menu" | "grid" | "tree" | "listbox" | "radiogroup" | "region" | "toolbar"
        ) {
            assert!(!name.is_empty() || role == "tree", "no name: {said}");
        }
        if role == "dialog" {
            assert!(!name.contains(['(', '…']), "called by its button: {said}");
        }
        if let Some(items) = items_of(role) {
            let children = told.children(node);
            assert!(!children.is_empty(), "empty: {said}");
            assert!(
                children.iter().all(|child| items.contains(&child.role)),
                "items: {said}"
            );
        }
        let parent = told.around(node.id).next().map(|parent| parent.role);
        let container = container_of(role);
        assert!(
            container.is_none() || container == parent,
            "outside of its container: {said}"
        );
        if role == "radio" {
            let mut around = told.around(node.id);
            assert!(around.any(|node| node.role == "radiogroup"), "alone: {said}");
        }
        if let Some(active) = node.active {
            let cell = told.nodes.get(&active);
            assert!(cell.is_some(), "no cell: {said}");
            let mut around = told.around(active);
            assert!(around.any(|around| around.id == node.id), "elsewhere: {said}");
        }
    }
    for menu in told.nodes.values().filter(|node| node.role == "menu") {
        let radios: Vec<_> = told
            .children(menu)
            .into_iter()
            .filter(|node| node.role == "menuitemradio")
            .collect();
        let chosen = radios.iter().filter(|node| node.on == Some("true")).count();
        assert!(
            radios.is_empty() || chosen == 1,
            "{what}: {chosen} chosen\n{}",
            told.outline
        );
    }
}

fn files() -> Vec<File> {
    vec![moving("a.m3d")]
}

#[test]
fn every_panel_of_a_wide_window_is_what_it_is_said_to_be() {
    let mut window = window(WIDE, files());
    assert_sound(&Told::of(&mut window), "model");
    for button in [
        "View mode",
        "Lighting",
        "Lines over the model",
        "View from",
        "Picture",
        "Export",
        "Speed ",
        "Clip ",
        "Up axis",
    ] {
        window.click(button);
        assert_sound(&Told::of(&mut window), button);
        window.press(Modifiers::NONE, Key::Escape);
    }
    window.click("Help (?)");
    let told = Told::of(&mut window);
    assert_sound(&told, "keys");
    assert_eq!(told.find("button", "Help (?)").expanded, Some(true));
    window.click("Help (?)");
    window.click("Findings: ");
    let told = Told::of(&mut window);
    assert_sound(&told, "findings");
    assert_eq!(told.find("button", "Findings: ").expanded, Some(true));
    window.press(Modifiers::NONE, Key::Escape);
    window.apply(SubmeshCommand::Select(Some(0)));
    assert_sound(&Told::of(&mut window), "a subset");
    window.apply(LookCommand::SetSplit(Some(0.5)));
    assert_sound(&Told::of(&mut window), "split");
    window.apply(FileCommand::Add(vec![broken("b.m3d")]));
    assert_sound(&Told::of(&mut window), "error");
    window.click("Dismiss");
    window.apply(FileCommand::Add(vec![moving("c.m3d"), moving("d.m3d")]));
    window.click("Open model");
    assert_sound(&Told::of(&mut window), "files");
}

#[test]
fn bones_their_numbers_and_keys_are_what_they_are_said_to_be() {
    let mut window = window(WIDE, vec![rig(12, 30)]);
    window.click("Panel: Skeleton");
    assert_sound(&Told::of(&mut window), "tree");
    window.apply(JointCommand::Select(Some(JointIndex(1))));
    let told = Told::of(&mut window);
    assert_sound(&told, "bone");
    for (name, bone) in [("Parent: ", 0), ("Child: ", 4)] {
        told.find("link", &format!("{name}Bone {bone}"));
    }
    window.apply(JointCommand::SelectVertex(Some(0)));
    assert_sound(&Told::of(&mut window), "vertex");
    window.apply(JointCommand::SelectVertex(None));
    window.click("Names and branches");
    assert_sound(&Told::of(&mut window), "names");
}

#[test]
fn the_dope_sheet_is_a_grid_whose_active_cell_moves() {
    let mut window = window(WIDE, vec![rig(12, 30)]);
    window.click("Dope sheet and curves");
    let told = Told::of(&mut window);
    assert_sound(&told, "dope sheet");
    let grid = told.find("grid", "Keys of all bones");
    assert_eq!((grid.of, grid.active), (Some(12), None));
    let rows = told.children(grid);
    assert!(rows.len() > 3, "{}", told.outline);
    for (index, row) in rows.iter().enumerate() {
        let [header] = &told.children(row)[..] else {
            panic!("{}", told.outline)
        };
        assert_eq!((row.place, header.role), (Some(index + 1), "rowheader"));
        assert!(header.name.ends_with(", 30 keys"), "{}", header.name);
    }
    let fold = told.find("button", "Fold Bone 0");
    assert_eq!(told.around(fold.id).next().map(|node| node.role), Some("rowheader"));

    window.ask("Keys of all bones", Action::Focus, None);
    let mut cells = Vec::new();
    for key in [
        Key::ArrowRight,
        Key::ArrowRight,
        Key::ArrowDown,
        Key::Home,
        Key::ArrowLeft,
    ] {
        window.press(Modifiers::NONE, key);
        let told = Told::of(&mut window);
        assert_sound(&told, "with a cell");
        let active = told.find("grid", "Keys of all bones").active.expect("a cell");
        cells.push((active, told.nodes[&active].role, told.nodes[&active].name.clone()));
    }
    let names: Vec<_> = cells.iter().map(|(_, role, name)| format!("{role} {name}")).collect();
    assert!(
        names[1].starts_with("gridcell key 3 of 30, frame 2, ") && names[1].ends_with("Bone 0"),
        "{names:?}"
    );
    assert!(
        names[2].starts_with("gridcell key 3 of 30, ") && names[2].ends_with("Bone 1"),
        "{names:?}"
    );
    assert!(names[4].starts_with("rowheader Bone 1, 30 keys"), "{names:?}");
    let mut ids: Vec<_> = cells.iter().map(|&(id, ..)| id).collect();
    ids.dedup();
    assert_eq!(ids.len(), cells.len(), "each is told as another cell");
}

#[test]
fn the_curves_are_a_grid_whose_active_cell_moves() {
    let mut window = window(WIDE, vec![rig(12, 30)]);
    window.click("Dope sheet and curves");
    window.click("Sheet: Curves");
    assert_sound(&Told::of(&mut window), "curves of no bone");
    window.apply(JointCommand::Select(Some(JointIndex(4))));
    let active = |window: &mut Window| {
        let told = Told::of(window);
        assert_sound(&told, "curves");
        let grid = told.find("grid", "Curves of Bone 4, rotation");
        let cell = grid.active.expect("a cell");
        (grid.id, cell, told.nodes[&cell].name.clone())
    };
    let (grid, ..) = active(&mut window);
    window.ask("Curves of Bone 4, rotation", Action::Focus, None);
    let mut cells = vec![active(&mut window)];
    for key in [Key::ArrowRight, Key::ArrowDown] {
        window.press(Modifiers::NONE, key);
        cells.push(active(&mut window));
    }
    assert!(
        cells.iter().all(|&(id, ..)| id == grid),
        "an element keeps its role with the focus"
    );
    assert!(cells[1].1 != cells[0].1 && cells[2].1 != cells[1].1, "{cells:?}");
    assert!(
        cells[1].2.starts_with("rotation x ") && cells[1].2.contains("key 2 of 30"),
        "{cells:?}"
    );
    assert!(
        cells[2].2.starts_with("rotation y ") && cells[2].2.contains("key 2 of 30"),
        "{cells:?}"
    );
    window.apply(PlayCommand::Seek { time_secs: 0.5 });
    assert_eq!(
        active(&mut window).2,
        cells[2].2,
        "the time changes no cell that one is on"
    );
}

#[test]
fn every_page_of_a_small_window_is_what_it_is_said_to_be() {
    for size in [PHONE, LOW] {
        let open = || touch_window(size, files());
        let mut shut = open();
        let told = Told::of(&mut shut);
        assert_sound(&told, "shut");
        let x_of = |name: &str| told.find("button", name).bounds[0];
        assert!(x_of("Lighting") < x_of("Open files…") && x_of("Open files…") < x_of("More"));
        let at = |words: &str| {
            told.outline
                .find(words)
                .unwrap_or_else(|| panic!("{words}: {}", told.outline))
        };
        assert!(
            at("a.m3d") < at("\"Lighting")
                && at("\"Lighting") < at("\"Open files…")
                && at("\"Open files…") < at("\"More\""),
            "they are read from left to right: {}",
            told.outline
        );
        for page in DRAWER_PAGES {
            let mut window = open();
            let state = window.harness.state_mut();
            state.state.drawer = Some(page);
            window.pass_on();
            assert_sound(&Told::of(&mut window), &format!("{page:?}"));
        }
        let mut window = open();
        let state = window.harness.state_mut();
        state.state.show_skeleton(&state.session);
        window.pass_on();
        assert_sound(&Told::of(&mut window), "Skeleton");
        shut.click("More");
        let told = Told::of(&mut shut);
        assert_sound(&told, "more");
        for page in ["View mode: Lit", "Light and background: Studio", "Picture…", "Export…"] {
            assert_eq!(
                told.find("menuitem", page).on,
                None,
                "{page} opens a page, and is no choice"
            );
        }
    }
}

#[test]
fn view_modes_are_choices_in_a_menu_and_on_a_page() {
    let mut wide = window(WIDE, files());
    wide.click("View mode");
    let told = Told::of(&mut wide);
    let lines = told.children(told.find("menu", "View mode"));
    let roles: Vec<_> = lines.iter().map(|line| line.role).collect();
    assert!(
        roles.iter().filter(|&&role| role == "menuitemradio").count() > 14,
        "{roles:?}"
    );
    assert_eq!(told.find("separator", "Skin").role, "separator");
    assert_eq!(told.find("menuitemradio", "Lit").on, Some("true"));

    let mut phone = touch_window(PHONE, files());
    phone.harness.state_mut().state.drawer = Some(DrawerPage::ViewMode);
    let told = Told::of(&mut phone);
    let lit = told.find("radio", "Lit");
    assert_eq!(lit.on, Some("true"));
    let mut around = told.around(lit.id);
    assert_eq!(
        around
            .find(|node| node.role == "radiogroup")
            .map(|group| group.name.as_str()),
        Some("View mode")
    );
}

#[test]
fn the_grip_of_the_sheet_says_what_it_opens() {
    let mut phone = touch_window(PHONE, files());
    assert!(phone.shows("Model facts"));
    phone.apply(SubmeshCommand::Select(Some(0)));
    phone.click("Show Painted");
    assert!(phone.shows("Selected: Painted"));
    phone.click("Close the sheet");
    let state = phone.harness.state_mut();
    state.state.show_skeleton(&state.session);
    state.state.drawer = None;
    phone.pass_on();
    assert!(phone.shows("Skeleton") && !phone.shows("Model facts"));
}

#[test]
fn controls_have_names_that_do_not_change_with_what_they_say() {
    let mut window = window(WIDE, files());
    window.click("Clip ");
    let told = Told::of(&mut window);
    for (role, words, control) in [
        // The page opens a dialog of the browser for these two.
        ("button", "Open files…", "open-files"),
        ("button", "Add clips…", "add-clips"),
        ("slider", "Time", "time"),
        ("slider", "Range out", "range-out"),
        ("button", "Undo", "undo"),
        ("button", "View mode: ", "view-mode"),
        ("radio", "Panel: Skeleton", "page-1"),
        ("region", "Model", "model"),
        ("region", "Timeline", "timeline"),
    ] {
        assert_eq!(told.find(role, words).control.as_deref(), Some(control), "{words}");
    }
    // The button that plays says something else while it does.
    for words in ["Play", "Pause"] {
        let told = Told::of(&mut window);
        assert_eq!(told.find("button", words).control.as_deref(), Some("play"));
        window.apply(PlayCommand::Toggle);
    }
}

#[test]
fn the_light_is_described_by_what_it_is() {
    let mut window = window(WIDE, files());
    let told = Told::of(&mut window);
    let description = told.find("button", "Lighting").description.clone().unwrap_or_default();
    assert!(description.starts_with("Light and background"), "{description}");
}

#[test]
fn rows_that_are_scrolled_out_of_view_cover_no_other_control() {
    let mut window = window(vec2(1280.0, 700.0), vec![rig(40, 30)]);
    window.click("Panel: Skeleton");
    window.apply(JointCommand::Select(Some(JointIndex(4))));
    let told = Told::of(&mut window);
    let rect_of = |node: &MirrorNode| {
        let [mut x, mut y, width, height] = node.bounds;
        for around in told.around(node.id) {
            (x, y) = (x + around.bounds[0], y + around.bounds[1]);
        }
        egui::Rect::from_min_size(egui::pos2(x, y), vec2(width, height))
    };
    let timeline = rect_of(told.find("region", "Timeline"));
    let mut below = 0;
    for node in told.nodes.values().filter(|node| !node.name.is_empty()) {
        let inside = told
            .around(node.id)
            .any(|around| around.name == "Inspector" || around.name == "Skeleton");
        let rect = rect_of(node);
        below += usize::from(inside && rect.height() == 1.0);
        assert!(
            !inside || rect.max.y <= timeline.min.y,
            "{} {:?} at {rect} over {timeline}",
            node.role,
            node.name
        );
    }
    assert!(below > 3, "some of the inspector is out of view");
}
