//! The list of subsets and the inspector of the one that is selected.

use bindpose::format::{Dialect, Document, Reflectance as FileReflectance};
use bindpose::model::{AlphaMode, Reflectance};
use bindpose::session::File;
use egui::accesskit::{Action, ActionData};
use egui::{Event, Key, Modifiers, PointerButton, Vec2, pos2};
use serde_json::{Value, json};

use crate::models;
use crate::page::{PHONE, WIDE, Window, button_event, touch_window, window};

/// The box as two subsets: three sides painted, three bare.
fn halves() -> Document {
    let mut document = models::document();
    let mut bare = document.materials[0].clone();
    bare.name = "Bare".to_owned();
    bare.diffuse_map = Some("bare_diff.dds".to_owned());
    document.materials.push(bare);
    let mut second = document.subsets[0];
    document.subsets[0].vertex_count = 12;
    document.subsets[0].face_count = 6;
    second.id = 1;
    second.vertex_start = 12;
    second.vertex_count = 12;
    second.face_start = 6;
    second.face_count = 6;
    document.subsets.push(second);
    document
}

fn files() -> Vec<File> {
    vec![models::file("a.m3d", &halves())]
}

fn open() -> Window {
    window(WIDE, files())
}

fn hover(window: &mut Window, start: &str) {
    let at = window.rect(start).center();
    window.hover_at(at);
}

#[test]
fn a_row_under_the_pointer_stands_out_in_the_view() {
    let mut window = open();
    hover(&mut window, "Bare, 6 triangles");
    assert_eq!(window.session().submeshes().highlighted(), Some(1));
    window.harness.event(Event::PointerGone);
    window.pass_on();
    assert_eq!(window.session().submeshes().highlighted(), None);
}

#[test]
fn a_click_in_the_instant_in_which_the_pointer_comes_meets_what_is_drawn() {
    let mut window = open();
    let at = window.rect("Hide Bare").center();
    let button = |pressed| button_event(at, PointerButton::Primary, pressed, Modifiers::NONE);
    window.frame([Event::PointerMoved(at), button(true), button(false)]);
    window.pass_on();
    assert_eq!(window.session().submeshes().left_out(), [false, true]);
    assert_eq!(window.session().submeshes().selected(), None);
}

#[test]
fn the_list_says_its_states_and_arrows_walk_it() {
    use egui::accesskit::Role;
    use egui_kittest::kittest::NodeT as _;
    let mut window = open();
    window.click("Hide Bare");
    window.click("Bare, 6 triangles, hidden");
    let nodes = window.harness.root().children_recursive();
    let list: Vec<_> = nodes
        .filter(|node| node.accesskit_node().role() == Role::List)
        .flat_map(|list| list.children_recursive().collect::<Vec<_>>())
        .filter(|node| node.accesskit_node().role() == Role::ListItem)
        .map(|node| (node.accesskit_node().label(), node.accesskit_node().is_selected()))
        .collect();
    let expected = [("Painted, 6 triangles", false), ("Bare, 6 triangles, hidden", true)];
    assert_eq!(
        list,
        expected.map(|(name, selected)| (Some(name.to_owned()), Some(selected)))
    );

    for _ in 0..80 {
        if window.focused().as_deref() != Some("Painted, 6 triangles") {
            window.tab(false);
        }
    }
    for (key, name) in [
        (Key::ArrowUp, "Painted, 6 triangles"),
        (Key::ArrowDown, "Bare, 6 triangles, hidden"),
        (Key::ArrowDown, "Bare, 6 triangles, hidden"),
        (Key::Home, "Painted, 6 triangles"),
        (Key::End, "Bare, 6 triangles, hidden"),
    ] {
        window.press(Modifiers::NONE, key);
        assert_eq!(window.focused().as_deref(), Some(name), "{key:?}");
    }
    window.press(Modifiers::NONE, Key::Enter);
    assert_eq!(window.session().submeshes().selected(), None, "a second press lets go");
}

#[test]
fn the_eye_hides_and_shows_and_one_word_shows_all() {
    let mut window = open();
    hover(&mut window, "Bare, 6 triangles");
    window.click("Hide Bare");
    assert_eq!(window.session().submeshes().left_out(), [false, true]);
    window.harness.event(Event::PointerGone);
    window.pass_on();
    window.click("Show Bare");
    assert_eq!(window.session().submeshes().left_out(), [false, false]);
    hover(&mut window, "Painted, 6 triangles");
    window.click("Hide Painted");
    window.click("Show all");
    assert_eq!(window.session().submeshes().left_out(), [false, false]);
    assert!(!window.shows("Show all"));
}

#[test]
fn alone_by_the_icon_or_by_an_alt_click() {
    let mut window = open();
    hover(&mut window, "Bare, 6 triangles");
    window.click("Show Bare alone");
    assert_eq!(window.session().submeshes().left_out(), [true, false]);
    window.click("Show Bare alone");
    assert_eq!(window.session().submeshes().left_out(), [false, false]);

    let at = window.rect("Painted, 6").left_center() + Vec2::new(40.0, 0.0);
    let modifiers = Modifiers::ALT;
    window.harness.event(Event::ModifiersChanged(modifiers));
    window.harness.hover_at(at);
    for pressed in [true, false] {
        window.button(at, PointerButton::Primary, pressed, modifiers);
    }
    window.pass_on();
    assert_eq!(window.session().submeshes().left_out(), [false, true]);
    assert_eq!(window.session().submeshes().selected(), None);
}

#[test]
fn a_click_in_the_list_or_in_the_view_selects() {
    let mut window = open();
    window.click("Bare, 6 triangles");
    assert_eq!(window.session().submeshes().selected(), Some(1));
    for words in ["Selected: Bare", "Subset 2 of 2", "Triangles 6", "Vertices 12"] {
        assert!(window.shows(words), "{words}");
    }
    window.click("Bare, 6 triangles");
    assert_eq!(window.session().submeshes().selected(), None, "a second click lets go");

    let click_at = |window: &mut Window, at| {
        window.click_at(at);
        window.wait(0.6);
    };
    click_at(&mut window, pos2(WIDE.x * 0.5, WIDE.y * 0.5));
    let selected = window.session().submeshes().selected();
    assert!(selected.is_some() && window.session().submeshes().selected_at().is_some());
    click_at(&mut window, pos2(WIDE.x * 0.3, WIDE.y * 0.85));
    assert_eq!(window.session().submeshes().selected(), None, "there is nothing");
}

/// Types a number into a field.
fn type_number(window: &mut Window, field: &str, number: &str) {
    window.click(field);
    window.press(Modifiers::COMMAND, Key::A);
    window.harness.event(Event::Text(number.to_owned()));
    window.press(Modifiers::NONE, Key::Enter);
}

#[test]
fn values_of_the_books_second_edition_are_edited_and_given_back() {
    let mut window = open();
    window.click("Painted, 6 triangles");
    assert!(!window.shows("Reset"));
    type_number(&mut window, "Diffuse: red", "0.25");
    type_number(&mut window, "Fresnel R0: green", "0.5");
    window.click("Alpha clip");
    window.click("Roughness");
    let edited = window.session().materials()[0].clone();
    assert_eq!(edited.diffuse, [0.25, 0.3, 0.2]);
    assert!(edited.is_cut());
    let Reflectance::Fresnel { fresnel0, roughness } = edited.reflectance else {
        panic!("{edited:?}")
    };
    assert_eq!(fresnel0, [0.04, 0.5, 0.04]);
    assert!((roughness - 0.5).abs() < 0.02, "the middle of the track");
    window.click("Reset");
    assert!(!window.session().is_edited(0) && !window.shows("Reset"));
}

#[test]
fn values_of_the_books_first_edition_are_edited() {
    let mut document = halves();
    document.dialect = Dialect::D3d11;
    for material in &mut document.materials {
        material.reflectance = FileReflectance::Phong {
            ambient: [0.1; 3],
            specular: [0.2; 3],
            spec_power: 16.0,
            reflectivity: [0.0; 3],
        };
    }
    let mut window = window(WIDE, vec![models::file("a.m3d", &document)]);
    window.click("Bare, 6 triangles");
    for (field, number) in [
        ("Ambient: red", "0.3"),
        ("Diffuse: green", "0.4"),
        ("Specular: blue", "0.5"),
        ("Power", "64"),
        ("Reflectivity: red", "0.6"),
    ] {
        let field = if field == "Power" { "Power: number" } else { field };
        type_number(&mut window, field, number);
    }
    let edited = &window.session().materials()[1];
    assert_eq!(edited.diffuse[1], 0.4);
    let expected = Reflectance::Phong {
        ambient: [0.3, 0.1, 0.1],
        specular: [0.2, 0.2, 0.5],
        spec_power: 64.0,
        reflectivity: [0.6, 0.0, 0.0],
    };
    assert_eq!(edited.reflectance, expected);
}

#[test]
fn a_colour_is_chosen_by_eye() {
    let mut window = open();
    window.click("Painted, 6 triangles");
    window.click("Diffuse: #");
    window.click("Diffuse: number");
    window.press(Modifiers::COMMAND, Key::A);
    window.type_text("#ff0000");
    assert_eq!(window.session().materials()[0].diffuse, [1.0, 0.0, 0.0]);
    for _ in ["the field", "the picker"] {
        window.press(Modifiers::NONE, Key::Escape);
    }
    assert!(window.named(|name| name.starts_with("Diffuse: number")).is_empty());
    assert!(
        window.session().submeshes().selected().is_some(),
        "the picker alone was shut"
    );
}

#[test]
fn maps_that_are_missing_say_so() {
    let mut window = open();
    window.click("Bare, 6 triangles");
    assert!(window.shows("Diffuse map: bare_diff.dds, missing"));
    window.click("Clear the selection");
    assert_eq!(window.session().submeshes().selected(), None);
    window.click("Painted, 6 triangles");
    assert!(!window.shows("Maps"), "it names none");
}

#[test]
fn numbers_of_the_inspector_stand_still() {
    let mut window = open();
    window.click("Painted, 6 triangles");
    window.click("Alpha clip");
    let places = |window: &Window| {
        let fields = window.named(|name| name.contains(": ") || name == "Roughness");
        fields.into_iter().map(|(_, rect)| rect).collect::<Vec<_>>()
    };
    let before = places(&window);
    for number in ["0", "1", "0.123"] {
        type_number(&mut window, "Diffuse: red", number);
        assert_eq!(places(&window), before, "{number}");
    }
}

/// Two triangles: one that alpha cuts, one that is blended.
pub(crate) fn leaf_and_glass() -> File {
    File::new(
        "leaf-and-glass.gltf",
        include_bytes!("../fixtures/gltf/leaf-and-glass.gltf").to_vec(),
    )
}

#[test]
fn a_material_of_gltf_has_the_values_that_do_something() {
    let mut window = window(WIDE, vec![leaf_and_glass()]);
    let material = |window: &Window, index: usize| window.session().materials()[index].clone();
    window.click("Leaf, 1 triangle");
    assert!(window.shows("Metallic") && window.shows("Cutoff") && window.shows("Emissive: green"));
    assert!(window.shows("Both sides") && !window.shows("Normal scale") && !window.shows("Alpha clip"));
    type_number(&mut window, "Emissive: green", "0.5");
    assert_eq!(material(&window, 0).emissive, [0.0, 0.5, 0.0]);
    window.click("Alpha: Opaque");
    assert_eq!(material(&window, 0).alpha, AlphaMode::Opaque);
    assert!(!window.shows("Cutoff") && !window.shows("Opacity"));
    window.click("Alpha: Mask");
    assert_eq!(material(&window, 0).alpha, AlphaMode::Mask { cutoff: 0.5 });
    window.click("Unlit");
    assert!(material(&window, 0).unlit);
    window.click("Reset");
    assert_eq!(material(&window, 0).alpha, AlphaMode::Mask { cutoff: 0.3 });
    assert!(!material(&window, 0).unlit);

    window.click("Clear the selection");
    window.click("Glass, 1 triangle");
    assert!(window.shows("Opacity") && !window.shows("Cutoff"));
    window.click("Both sides");
    assert!(material(&window, 1).double_sided);
}

#[test]
fn what_lies_over_a_surface_is_shown_where_the_file_says_it() {
    let mut document: Value = serde_json::from_slice(&leaf_and_glass().bytes).expect("is JSON");
    document["materials"][1]["extensions"] = json!({
        "KHR_materials_ior": { "ior": 2.0 },
        "KHR_materials_clearcoat": { "clearcoatFactor": 0.5 },
    });
    let mut window = window(WIDE, vec![File::new("layers.gltf", document.to_string().into_bytes())]);
    let layers = |window: &Window| window.session().materials()[1].layers;
    window.click("Glass, 1 triangle");
    assert!(window.shows("Clear coat") && window.shows("Coat roughness"));
    assert!(!window.shows("Sheen") && !window.shows("Transmission") && !window.shows("Specular"));
    type_number(&mut window, "IOR: number", "1.5");
    assert_eq!((layers(&window).ior, layers(&window).clearcoat), (1.5, 0.5));
    assert!(window.shows("IOR"), "what was edited away can be edited back");
    window.click("Reset");
    assert_eq!(layers(&window).ior, 2.0);
}

#[test]
fn fingers_find_icons_and_inspector_in_the_sheet() {
    let mut window = touch_window(PHONE, files());
    window.click("Model facts");
    let rect = window.rect("Hide Painted");
    assert!(rect.height() >= 44.0 && rect.width() >= 44.0, "{rect}");
    window.drag_sheet(-300.0);
    window.click("Painted, 6 triangles");
    assert!(window.shows("Selected: Painted") && !window.shows("Handedness: Left found"));
    window.click("Clear the selection");
    assert!(window.shows("Painted, 6 triangles"), "the list is back");
}

#[test]
fn subsets_of_one_material_are_told_apart_by_a_number() {
    let mut document = halves();
    // Subsets that the file has no material for share one.
    document.materials.truncate(1);
    let mut third = document.subsets[1];
    document.subsets[1].face_count = 3;
    (third.id, third.face_start, third.face_count) = (2, 9, 3);
    document.subsets.push(third);
    let mut window = window(WIDE, vec![models::file("a.m3d", &document)]);
    let name = |index| window.session().submesh_name(index).to_owned();
    let (shared, numbered) = (name(1), name(2));
    assert_eq!(numbered, format!("{shared} (2)"));
    assert!(![&shared, &numbered].contains(&&name(0)));
    window.click(&format!("{numbered}, 3 triangles"));
    assert_eq!(window.session().submeshes().selected(), Some(2));
    window.assert_shows(&format!("Selected: {numbered}"));
}

#[test]
fn a_wrong_value_is_refused_in_words() {
    let mut window = open();
    window.click("Painted, 6 triangles");
    let of_file = window.session().materials().to_vec();
    for typed in ["abc", "7", "-1", "0.5 apples"] {
        type_number(&mut window, "Diffuse: red", typed);
        window.assert_shows("A number from 0 to 1");
        assert_eq!(
            window.value_of("Type the diffuse: red").as_deref(),
            Some(typed),
            "it is kept"
        );
        assert_eq!(window.session().materials(), of_file);
        window.press(Modifiers::NONE, Key::Escape);
        assert!(!window.shows("A number from 0 to 1"));
    }
    let set = ActionData::Value("2".into());
    window.ask("Diffuse: red", Action::SetValue, Some(set));
    assert!(window.shows("A number from 0 to 1"), "asked for by a screen reader too");
    window.press(Modifiers::NONE, Key::Escape);
    type_number(&mut window, "Diffuse: red", "0,25");
    assert_eq!(window.session().materials()[0].diffuse[0], 0.25);
    window.click("Diffuse: #");
    type_number(&mut window, "Diffuse: number", "redish");
    assert!(window.shows("Six digits 0–9, a–f: #5aa9ff"));
}

#[test]
fn a_number_is_dragged_and_stepped_within_its_range() {
    let mut window = open();
    window.click("Painted, 6 triangles");
    let red = |window: &Window| window.session().materials()[0].diffuse[0];
    let (from, before) = (window.rect("Diffuse: red").center(), red(&window));
    window.harness.hover_at(from);
    window.harness.drag_at(from);
    for step in 1..=20_u8 {
        window.hover_at(from - Vec2::new(f32::from(step), 0.0));
    }
    window.harness.drop_at(from - Vec2::new(20.0, 0.0));
    window.pass_on();
    let dragged = red(&window);
    // The first points only tell that it is a drag.
    assert!((0.05..=0.1).contains(&(before - dragged)), "{before} {dragged}");
    window.ask("Diffuse: red", Action::Increment, None);
    assert!(
        (red(&window) - dragged - 0.005).abs() < 1e-4,
        "{} {dragged}",
        red(&window)
    );
    let number = window.node("Diffuse: red");
    assert_eq!(number.min_numeric_value(), Some(0.0));
    assert_eq!(number.max_numeric_value(), Some(1.0));
}
