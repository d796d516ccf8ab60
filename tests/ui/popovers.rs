//! What the toolbar opens: inside the window, off the panels, large enough for fingers.

use bindpose::scene::ViewMode;
use bindpose::session::{LookCommand, PlayCommand, SubmeshCommand};
use egui::{Order, Rect, vec2};

use crate::layout::{assert_apart, assert_between_sides, assert_inside, shown_panel};
use crate::models::moving;
use crate::page::{PHONE, WIDE, Window, touch_window, wheel_event, window};

/// What hangs from each button of the toolbar, and something in it.
const POPOVERS: [(&str, &str); 5] = [
    ("View mode", "Depth"),
    ("Lighting", "Contact shadow"),
    ("Lines over the model", "Axes"),
    ("View from", "Isometric"),
    ("Picture", "Save PNG (P)"),
];

#[test]
fn what_hangs_from_the_toolbar_stays_inside_the_window() {
    for size in [WIDE, vec2(900.0, 700.0), vec2(900.0, 600.0)] {
        for touch in [false, true] {
            let open = if touch { touch_window } else { window };
            let mut window = open(
                size,
                vec![moving("a_name_that_needs_all_the_room_that_the_toolbar_leaves.m3d")],
            );
            window.apply(LookCommand::SetViewMode(ViewMode::TexCoords));
            assert_apart(&window, &["title", "toolbar", "model", "timeline"]);
            for (button, item) in POPOVERS {
                window.click(button);
                assert_between_sides(&window, size);
                if !touch {
                    assert_inside(&window, size);
                }
                assert!(window.shows(item), "{button}: {item}");
                window.press(egui::Modifiers::NONE, egui::Key::Escape);
                assert!(!window.shows(item), "{button} is shut");
            }
        }
    }
}

#[test]
fn pages_of_the_sheet_fit_a_phone_and_fingers() {
    for size in [PHONE, vec2(320.0, 568.0)] {
        let mut window = touch_window(size, vec![moving("a.m3d")]);
        for (item, inside) in [
            ("View mode", "Depth"),
            ("Light and background", "Light: Book"),
            ("Lines over", "Wireframe"),
            ("View from", "Front"),
            ("Picture", "4K"),
        ] {
            window.click("More");
            window.click(item);
            assert_between_sides(&window, size);
            assert_apart(&window, &["title", "drawer"]);
            let rect = window.rect(inside);
            assert!(rect.height() >= 44.0 && rect.width() >= 44.0, "{inside}: {rect}");
            window.click("Close the sheet");
        }
        window.apply(SubmeshCommand::Select(Some(0)));
        window.click("Show Painted");
        assert!(window.shows("Selected: Painted"));
        let last = window.rect("Fresnel R0: blue");
        assert!(last.max.x <= size.x - 14.0, "{last} leaves the sheet's margin");
        assert_between_sides(&window, size);
        assert_apart(&window, &["title", "drawer"]);
    }
}

#[test]
fn tooltips_of_a_panel_stand_beside_it_and_menus_let_no_text_through() {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    let panel = shown_panel(&window, "model").expect("it is shown");
    for row in ["Size ", "Painted, 12 triangles", "Hide Painted", "Findings: "] {
        let at = window.rect(row).center();
        window.harness.hover_at(at);
        window.wait(0.6);
        let tooltips: Vec<Rect> = window.harness.ctx.memory(|memory| {
            let layers = memory.areas().visible_layer_ids().into_iter();
            let tooltips = layers.filter(|layer| layer.order == Order::Tooltip);
            tooltips.filter_map(|layer| memory.area_rect(layer.id)).collect()
        });
        assert_eq!(tooltips.len(), 1, "{row}");
        assert!(
            tooltips[0].min.x >= panel.max.x,
            "{row}: {} lies on {panel}",
            tooltips[0]
        );
        window.harness.event(egui::Event::PointerGone);
        window.wait(0.2);
    }
    for theme in [egui::Theme::Dark, egui::Theme::Light] {
        assert!(window.harness.ctx.style_of(theme).visuals.window_fill.is_opaque());
    }
}

/// What hangs from buttons now.
fn popovers(window: &Window) -> Vec<Rect> {
    window.harness.ctx.memory(|memory| {
        let layers = memory.areas().visible_layer_ids().into_iter();
        let hanging = layers.filter(|layer| layer.order == Order::Foreground);
        hanging.filter_map(|layer| memory.area_rect(layer.id)).collect()
    })
}

#[test]
fn what_hangs_over_the_timeline_leaves_the_transport_free() {
    for (size, touch) in [
        (PHONE, true),
        (vec2(320.0, 568.0), true),
        (vec2(844.0, 390.0), true),
        (vec2(900.0, 480.0), true),
        (vec2(900.0, 700.0), false),
        (WIDE, false),
    ] {
        let open = if touch { touch_window } else { window };
        let mut window = open(size, vec![moving("a.m3d")]);
        window.apply(LookCommand::SetBonesVisible(true));
        // A range whose gap is seen has the longest list.
        window.apply(PlayCommand::SetRangeStart(Some(0.2)));
        window.apply(PlayCommand::SetRangeEnd(Some(0.7)));
        let mut buttons = vec!["Clip ", "Speed "];
        if size.x >= 900.0 {
            buttons.extend(["Lighting", "Lines over the model", "Picture"]);
        }
        for button in buttons {
            window.click(button);
            let shown = popovers(&window);
            assert!(!shown.is_empty(), "{button} of {size}");
            for rect in shown {
                assert!(
                    Rect::from_min_size(egui::Pos2::ZERO, size).contains_rect(rect),
                    "{button} of {size}: {rect}"
                );
                for bar in ["title", "toolbar"].into_iter().filter(|_| size.y > 400.0) {
                    if let Some(bar) = shown_panel(&window, bar) {
                        assert!(!rect.intersects(bar), "{button} of {size} lies on the bars at the top");
                    }
                }
                for control in ["Play", "Time"] {
                    assert!(
                        !rect.intersects(window.rect(control)),
                        "{button} of {size} lies on {control}"
                    );
                }
            }
            window.press(egui::Modifiers::NONE, egui::Key::Escape);
        }
    }
}

#[test]
fn a_menu_that_is_higher_than_the_window_scrolls_in_it() {
    for (size, button, last) in [
        (vec2(900.0, 480.0), "View mode", "Stretch"),
        (vec2(900.0, 700.0), "View mode", "Stretch"),
        (vec2(900.0, 480.0), "View from", "Orthographic"),
        (vec2(844.0, 390.0), "More", "Help"),
        (vec2(320.0, 568.0), "More", "Help"),
    ] {
        let mut window = touch_window(size, vec![moving("a.m3d")]);
        window.click(button);
        let shown = popovers(&window);
        let page = Rect::from_min_size(egui::Pos2::ZERO, size);
        assert_eq!(shown.len(), 1, "{button} of {size}");
        assert!(page.contains_rect(shown[0]), "{button} of {size}: {}", shown[0]);
        // Its last line comes into it.
        let below = window.rect(last).max.y - shown[0].max.y;
        window.harness.hover_at(shown[0].center());
        window.harness.event(wheel_event(
            egui::MouseWheelUnit::Point,
            vec2(0.0, -below.max(0.0) - 20.0),
            egui::Modifiers::NONE,
        ));
        window.wait(1.0);
        let line = window.rect(last);
        assert!(shown[0].contains_rect(line), "{last} of {size}: {line} in {}", shown[0]);
        window.click(last);
        assert!(
            popovers(&window).iter().all(|rect| *rect != shown[0]),
            "a choice shuts it"
        );
    }
}
