//! What the toolbar opens: inside the window, off the panels, large enough for fingers.

use bindpose::scene::ViewMode;
use bindpose::session::{JointCommand, LookCommand, SubsetCommand};
use egui::{Order, Rect, vec2};

use crate::layout::{assert_apart, assert_between_sides, assert_inside};
use crate::models::moving;
use crate::page::{PHONE, WIDE, Window, touch_window, window};

/// What hangs from each button of the toolbar, and something in it.
const POPOVERS: [(&str, &str); 5] = [
    ("View mode", "Depth"),
    ("Lighting", "Ambient occlusion: on"),
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
            window.apply(LookCommand::SetViewMode(ViewMode::TexCoords).into());
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
            assert_apart(&window, &["title", "sheet"]);
            let rect = window.rect(inside);
            assert!(rect.height() >= 44.0 && rect.width() >= 44.0, "{inside}: {rect}");
            window.click("Close the sheet");
        }
        window.apply(SubsetCommand::Select(Some(0)).into());
        window.click("Model facts");
        assert!(window.shows("Selected: Painted"));
        let last = window.rect("Fresnel R0: blue");
        assert!(last.max.x <= size.x - 14.0, "{last} leaves the sheet's margin");
        assert_between_sides(&window, size);
        assert_apart(&window, &["title", "sheet"]);
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
        (vec2(900.0, 700.0), false),
        (WIDE, false),
    ] {
        let open = if touch { touch_window } else { window };
        let mut window = open(size, vec![moving("a.m3d")]);
        window.apply(JointCommand::SetBonesVisible(true).into());
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
                for control in ["Play", "Time in seconds"] {
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
