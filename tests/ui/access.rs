//! What programs that read the screen are told, and what they can do.

use bindpose::session::{FileCommand, LookCommand, SubmeshCommand};
use bindpose::ui::DrawerPage;
use egui::accesskit::{Action, ActionData, ActionRequest, Role, TreeId};
use egui::{Event, Key, Modifiers, Vec2, vec2};
use egui_kittest::Node;
use egui_kittest::kittest::NodeT as _;

use crate::models::{broken, moving};
use crate::page::{PHONE, WIDE, Window, touch_window, wheel_event, window};

const PLAIN: Modifiers = Modifiers::NONE;

/// Name and role of all nodes that take the focus or are clicked.
fn controls<'a>(window: &'a Window) -> Vec<Node<'a>> {
    let nodes = window.harness.root().children_recursive();
    nodes
        .filter(|node| {
            let data = node.accesskit_node();
            let data = data.data();
            // A scroll bar is egui's own. It is no stop of the keyboard.
            let is_bar = node_role(node) == Role::ScrollBar;
            data.supports_action(Action::Focus) || (data.supports_action(Action::Click) && !is_bar)
        })
        .collect()
}

fn node_role(node: &Node<'_>) -> Role {
    node.accesskit_node().role()
}

/// Whether two controls of one parent may have the same name.
fn may_repeat(role: Role) -> bool {
    matches!(role, Role::GenericContainer | Role::Unknown)
}

#[track_caller]
fn assert_told(window: &Window, what: &str) {
    let mut seen: Vec<(u64, String)> = Vec::new();
    for node in controls(window) {
        let node = node.accesskit_node();
        let (role, rect) = (node.role(), node.bounding_box());
        assert!(
            !matches!(role, Role::Unknown | Role::GenericContainer),
            "{what}: no role at {rect:?}, {:?}",
            node.label()
        );
        let name = node.label().unwrap_or_default();
        assert!(!name.trim().is_empty(), "{what}: a {role:?} at {rect:?} has no name");
        let Some(parent) = node.parent() else { continue };
        let place = (parent.locate().0.0, name);
        assert!(
            may_repeat(role) || !seen.contains(&place),
            "{what}: two controls are called {:?}",
            place.1
        );
        seen.push(place);
    }
    assert!(seen.len() > 4, "{what}: {seen:?}");
}

#[track_caller]
fn assert_has(window: &Window, role: Role, name: &str) {
    let mut nodes = window.harness.root().children_recursive();
    let found = nodes.any(|node| {
        let node = node.accesskit_node();
        node.role() == role && node.label().is_some_and(|label| label.starts_with(name))
    });
    assert!(found, "no {role:?} called {name:?}");
}

#[test]
fn every_control_of_every_panel_has_a_role_and_a_name() {
    let wide = || window(WIDE, vec![moving("a.m3d")]);
    let mut model = wide();
    assert_told(&model, "model");
    assert_has(&model, Role::Region, "Model");
    assert_has(&model, Role::Region, "Timeline");
    assert_has(&model, Role::Image, "Model view");
    model.click("Panel: Skeleton");
    assert_told(&model, "skeleton");
    assert_has(&model, Role::Region, "Skeleton");
    model.click("Bone 1, ");
    assert_told(&model, "bone");
    assert_has(&model, Role::Region, "Inspector");
    let mut inspector = wide();
    inspector.apply(SubmeshCommand::Select(Some(0)));
    assert_told(&inspector, "inspector");
    for (button, role) in [
        ("Lighting", Role::Dialog),
        ("View mode", Role::Menu),
        ("Lines over the model", Role::Dialog),
        ("View from", Role::Menu),
        ("Picture", Role::Dialog),
        ("Speed ", Role::Dialog),
        ("Clip ", Role::Dialog),
    ] {
        let mut window = wide();
        window.click(button);
        assert_told(&window, button);
        assert_has(&window, role, button.trim());
    }
    let mut help = wide();
    help.click("Help (?)");
    assert_told(&help, "help");
    assert_has(&help, Role::Dialog, "Help");
    assert_has(&help, Role::Heading, "Help");
    let mut error = wide();
    error.apply(FileCommand::Add(vec![broken("b.m3d")]));
    assert_told(&error, "error");
    let sentence = error.session().error().expect("the error").diagnostic.message.clone();
    assert_has(&error, Role::AlertDialog, &sentence);
}

#[test]
fn on_a_phone_too() {
    for size in [PHONE, vec2(844.0, 390.0)] {
        let open = || touch_window(size, vec![moving("a.m3d")]);
        assert_told(&open(), "shut");
        for (page, name) in [
            (DrawerPage::Model, "Model"),
            (DrawerPage::Model, "Skeleton"),
            (DrawerPage::Selection, "Inspector"),
            (DrawerPage::ViewMode, "View mode"),
            (DrawerPage::Light, "Light and background"),
            (DrawerPage::Overlays, "Lines over the model"),
            (DrawerPage::ViewFrom, "View from"),
            (DrawerPage::Picture, "Picture"),
            (DrawerPage::Timeline, "Timeline"),
        ] {
            let mut window = open();
            let state = window.harness.state_mut();
            if name == "Skeleton" {
                state.state.show_skeleton(&state.session);
            }
            state.state.drawer = Some(page);
            window.pass_on();
            assert_told(&window, name);
            assert_has(&window, Role::Region, name);
        }
        let mut window = open();
        window.click("More");
        assert_told(&window, "more");
        window.press(PLAIN, Key::Escape);
        window.apply(FileCommand::Add(vec![broken("b.m3d")]));
        assert_told(&window, "error");
        window.click("Dismiss");
        window.harness.state_mut().state.help_open = true;
        window.pass_on();
        assert_told(&window, "help");
    }
}

/// Asks what a program asks that reads the screen.
pub(crate) fn ask(window: &mut Window, start: &str, action: Action, data: Option<ActionData>) {
    let node = controls(window)
        .into_iter()
        .find(|node| {
            let label = node.accesskit_node().label();
            label.is_some_and(|label| label.starts_with(start))
        })
        .unwrap_or_else(|| panic!("no {start:?}"));
    let target_node = node.accesskit_node().locate().0;
    window.harness.event(Event::AccessKitActionRequest(ActionRequest {
        action,
        target_tree: TreeId::ROOT,
        target_node,
        data,
    }));
    window.pass_on();
}

#[test]
fn a_slider_tells_its_range_and_does_as_it_is_asked() {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    ask(&mut window, "Lighting", Action::Click, None);
    let stops = |window: &Window| window.session().look().exposure_stops;
    ask(
        &mut window,
        "Exposure",
        Action::SetValue,
        Some(ActionData::NumericValue(1.5)),
    );
    assert_eq!(stops(&window), 1.5);
    ask(&mut window, "Exposure", Action::Increment, None);
    assert!(stops(&window) > 1.5);
    ask(&mut window, "Exposure", Action::Decrement, None);
    assert!((stops(&window) - 1.5).abs() < 1e-5);
    let exposure = controls(&window)
        .into_iter()
        .find(|node| node.accesskit_node().label().as_deref() == Some("Exposure"))
        .expect("the slider");
    let node = exposure.accesskit_node();
    let data = node.data();
    assert_eq!(data.role(), Role::Slider);
    assert_eq!(data.value(), Some("+1.5 EV"));
    assert!(data.min_numeric_value() < Some(0.0) && data.max_numeric_value() > Some(1.5));
    assert!(data.numeric_value_step() > Some(0.0));

    ask(&mut window, "Exposure", Action::Focus, None);
    for (key, check) in [
        (Key::Home, f32::lt as fn(&f32, &f32) -> bool),
        (Key::PageUp, f32::gt),
        (Key::ArrowLeft, f32::lt),
        (Key::End, f32::gt),
        (Key::PageDown, f32::lt),
    ] {
        let before = stops(&window);
        window.press(PLAIN, key);
        assert!(
            check(&stops(&window), &before),
            "{key:?}: {before} to {}",
            stops(&window)
        );
    }
    assert_eq!(window.time_secs(), 0.0, "and no key was one of the time");
}

#[test]
fn buttons_open_and_close_what_hangs_from_them_when_asked() {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    ask(&mut window, "Lighting", Action::Expand, None);
    assert!(window.shows("Exposure"));
    ask(&mut window, "Lighting", Action::Collapse, None);
    assert!(!window.shows("Exposure"));
    ask(&mut window, "Turntable", Action::Click, None);
    assert!(window.session().turntable());
}

#[test]
fn arrows_go_through_the_parts_of_a_switch() {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    ask(&mut window, "Panel: Model", Action::Focus, None);
    window.press(PLAIN, Key::ArrowRight);
    assert!(window.shows("Search bones"));
    assert_eq!(window.focused().as_deref(), Some("Panel: Skeleton"));
    window.press(PLAIN, Key::ArrowLeft);
    assert!(!window.shows("Search bones"));
    assert_eq!(window.time_secs(), 0.0);
}

#[test]
fn lines_to_choose_from_are_radios_and_lines_that_do_something_are_not() {
    let roles = |window: &Window, wanted: Role| {
        let nodes = controls(window);
        let lines = nodes.iter().filter(|node| node_role(node) == wanted);
        lines
            .filter_map(|node| node.accesskit_node().label())
            .collect::<Vec<_>>()
    };
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    window.click("View mode");
    let radios = roles(&window, Role::MenuItemRadio);
    assert!(radios.len() > 11 && radios.contains(&"Lit".to_owned()) && radios.contains(&"Depth".to_owned()));
    assert!(roles(&window, Role::MenuItem).is_empty());
    window.press(PLAIN, Key::Escape);
    window.click("View from");
    assert_eq!(roles(&window, Role::MenuItemCheckBox), ["Orthographic"]);
    assert!(roles(&window, Role::MenuItem).contains(&"Front".to_owned()));
    window.press(PLAIN, Key::Escape);
    let row = window.named(|name| name.starts_with("Up axis")).remove(0).0;
    ask(&mut window, &row, Action::Expand, None);
    assert_eq!(roles(&window, Role::MenuItemRadio), ["As found", "Y up", "Z up"]);
    assert_has(&window, Role::Menu, "Up axis");
}

#[test]
fn keys_go_through_a_menu() {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    ask(&mut window, "View from", Action::Focus, None);
    window.press(PLAIN, Key::Enter);
    let mut names = vec![window.focused().expect("the first line")];
    for key in [Key::ArrowDown, Key::ArrowUp, Key::End, Key::Home] {
        window.press(PLAIN, key);
        names.push(window.focused().expect("a line"));
    }
    let [first, second, first_again, last, home] = &names[..] else {
        panic!("{names:?}")
    };
    assert_eq!((first, first), (first_again, home));
    assert!(first != second && last == "Orthographic", "{names:?}");
    assert_eq!(window.time_secs(), 0.0, "and no key was one of the time");
    window.press(PLAIN, Key::Escape);
    assert_eq!(window.focused().as_deref(), Some("View from…"));
}

#[test]
fn a_colour_is_chosen_by_keys() {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    window.apply(LookCommand::SetBackground(bindpose::scene::Background::Color([
        128, 64, 64,
    ])));
    window.click("Lighting");
    let color = |window: &Window| window.session().look().background;
    for (slider, keys) in [
        (
            "Background colour: saturation",
            [Key::ArrowUp, Key::ArrowRight, Key::Home],
        ),
        ("Background colour: hue", [Key::ArrowRight, Key::PageUp, Key::Home]),
    ] {
        ask(&mut window, slider, Action::Focus, None);
        for key in keys {
            let before = color(&window);
            window.press(PLAIN, key);
            assert_ne!(color(&window), before, "{slider} {key:?}");
        }
        window.apply(LookCommand::SetBackground(bindpose::scene::Background::Color([
            128, 64, 64,
        ])));
    }
}

#[test]
fn keys_scroll_the_table_of_keys() {
    let mut window = touch_window(PHONE, vec![moving("a.m3d")]);
    window.harness.state_mut().state.help_open = true;
    window.pass_on();
    ask(&mut window, "Table of keys", Action::Focus, None);
    let first = |window: &Window| window.rect("One finger").min.y;
    let top = first(&window);
    window.press(PLAIN, Key::ArrowDown);
    let after = first(&window);
    assert!(after < top, "{after} {top}");
    window.press(PLAIN, Key::PageDown);
    assert!(first(&window) < after - 100.0);
    window.press(PLAIN, Key::Home);
    assert_eq!(first(&window), top);
}

/// What 1440×900 offers, and where it is in a window of half that size: by its name there, or by what opens it.
#[test]
fn at_twice_the_size_nothing_is_lost() {
    let size = Vec2::new(720.0, 450.0);
    let mut window = window(size, vec![moving("a.m3d")]);
    for control in [
        "Lighting",
        "Open files",
        "More",
        "Play",
        "Time",
        "Clip ",
        "Speed ",
        "Dope sheet",
    ] {
        assert!(!window.named(|name| name.starts_with(control)).is_empty(), "{control}");
    }
    for (item, inside) in [
        ("View mode", "Depth"),
        ("Light and background", "Exposure"),
        ("Lines over", "Wireframe"),
        ("View from", "Orthographic"),
        ("Picture", "4K"),
    ] {
        window.click("More");
        window.click(item);
        assert!(
            !window.named(|name| name.starts_with(inside)).is_empty(),
            "{item}: {inside}"
        );
    }
    window.click("More");
    for item in ["Frame the model", "Turntable", "Light theme", "Dark theme", "Help"] {
        let found = !window.named(|name| name.starts_with(item)).is_empty();
        assert!(found || item.ends_with("theme"), "{item}");
    }
    window.press(PLAIN, Key::Escape);
    window.harness.state_mut().state.drawer = Some(DrawerPage::Model);
    window.pass_on();
    assert!(window.shows("Findings, nothing found") || window.shows("Panel: Skeleton"));
    window.click("Panel: Skeleton");
    assert!(window.shows("Search bones"));
    window.click("Speed ");
    for step in ["One frame on", "One frame back", "First frame", "Last frame"] {
        assert!(
            !window.named(|name| name.starts_with(step)).is_empty(),
            "{step} among {:?}",
            window.widgets().into_iter().map(|(name, _)| name).collect::<Vec<_>>()
        );
    }
}

#[test]
fn the_wheel_over_any_panel_leaves_the_camera_alone() {
    for (size, open) in [
        (WIDE, "Help (?)"),
        (WIDE, "Lighting"),
        (PHONE, "Model facts"),
        (WIDE, "Dope sheet and"),
    ] {
        let touch = size == PHONE;
        let mut window = if touch {
            touch_window(size, vec![moving("a.m3d")])
        } else {
            window(size, vec![moving("a.m3d")])
        };
        window.click(open);
        window.wait(0.5);
        let before = *window.session().camera();
        let layers = window.harness.ctx.memory(|memory| {
            let layers = memory.areas().visible_layer_ids().into_iter();
            let panels = layers.filter(|layer| layer.order != egui::Order::Background);
            let rects = panels.filter_map(|layer| memory.area_rect(layer.id));
            rects.collect::<Vec<_>>()
        });
        assert!(layers.len() >= 2);
        for rect in layers {
            for at in [
                rect.center(),
                rect.min + vec2(2.0, 2.0),
                rect.max - vec2(2.0, 2.0),
                rect.center_top() + vec2(0.0, 3.0),
            ] {
                window.harness.hover_at(at);
                window
                    .harness
                    .event(wheel_event(egui::MouseWheelUnit::Line, vec2(0.0, 3.0), PLAIN));
                window.wait(0.3);
                assert_eq!(window.session().camera(), &before, "{open}: {at} in {rect}");
            }
        }
    }
}
