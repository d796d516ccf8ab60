//! The drawer of a phone: its handle, its title, what it covers and what stays in its place.

use bindpose::anim::SkinView;
use bindpose::model::JointIndex;
use bindpose::session::{CameraCommand, FileCommand, JointCommand, LookCommand, SubmeshCommand};
use bindpose::ui::DrawerPage;
use egui::{Key, Modifiers, Rect, TouchPhase, Vec2, pos2, vec2};

use crate::layout::{panel, shown_panel};
use crate::models::{broken, moving, still};
use crate::page::{DRAWER_PAGES, PHONE, Window, phone, touch_window};
use crate::pointer::{fingers, gesture};

fn top(window: &Window) -> f32 {
    panel(window, "drawer").min.y
}

fn open() -> Window {
    let mut window = phone(vec![moving("a.m3d")]);
    window.click("More");
    window.click("Light and background");
    window
}

#[test]
fn the_transport_stays_where_it_is_whatever_the_sheet_does() {
    let mut window = phone(vec![moving("a.m3d")]);
    let play = window.rect("Play");
    for page in DRAWER_PAGES {
        window.harness.state_mut().state.drawer = Some(page);
        window.pass_on();
        assert_eq!(window.rect("Play"), play, "{page:?}");
        assert!(top(&window) < play.min.y - 100.0, "{page:?} is above it");
    }
    window.drag_sheet(-300.0);
    assert_eq!(window.rect("Play"), play);
    window.click("Close");
    assert_eq!(window.rect("Play"), play);
}

#[test]
fn what_is_picked_while_the_sheet_is_shut_is_named_and_its_name_opens_the_inspector() {
    for size in [PHONE, vec2(844.0, 390.0)] {
        let mut window = touch_window(size, vec![moving("a.m3d")]);
        assert!(!window.shows("Show Painted"));
        window.apply(SubmeshCommand::Select(Some(0)));
        let button = window.rect("Show Painted");
        assert!(button.height() >= 44.0);
        assert!(!button.intersects(panel(&window, "drawer")) && !button.intersects(panel(&window, "title")));
        window.click("Show Painted");
        assert!(window.shows("Selected: Painted") && !window.shows("Show Painted"));
        window.click("Close the sheet");
        window.apply(JointCommand::Select(Some(JointIndex(1))));
        window.harness.state_mut().state.diagnostics_open = true;
        window.pass_on();
        window.click("Show Bone 1");
        window.assert_shows("Selected: Bone 1");
        window.click("Close the sheet");
        window.apply(JointCommand::Select(None));
        // What was found in the file stays there.
        let shown = window.named(|name| name.starts_with("Show "));
        assert_eq!(
            shown.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>(),
            ["Show 2 notes"]
        );
    }
}

#[test]
fn a_message_takes_the_place_of_the_selections_name() {
    let mut window = phone(vec![moving("a.m3d")]);
    window.apply(SubmeshCommand::Select(Some(0)));
    window.harness.state_mut().state.messages.say("Done");
    window.pass_on();
    assert!(!window.shows("Show Painted"));
    window.wait(7.0);
    assert!(window.shows("Show Painted"));
}

#[test]
fn the_handle_follows_the_finger_and_rests_at_three_heights() {
    let mut window = open();
    let half = top(&window);
    let from = window.rect("Close the sheet").center();
    window.harness.hover_at(from);
    window.harness.drag_at(from);
    for by in [30.0, 60.0, 90.0] {
        window.hover_at(from + vec2(0.0, by));
        assert!(
            (top(&window) - half - by).abs() < 2.0,
            "{by}: {} from {half}",
            top(&window)
        );
    }
    window.harness.drop_at(from + vec2(0.0, 90.0));
    window.pass_on();
    assert_eq!(top(&window), half, "it goes back to the nearest height");
    window.drag_sheet(180.0);
    let peek = top(&window);
    assert!(peek > half + 100.0, "{peek}");
    window.drag_sheet(-500.0);
    let full = top(&window);
    assert!(full < 0.15 * PHONE.y, "nearly full: {full}");
    window.drag_sheet(600.0);
    assert!(window.shows("Model facts"), "all the way down it shuts");
    assert_eq!(window.harness.state().state.drawer, None);
}

#[test]
fn a_quick_finger_flings_it() {
    let mut window = phone(vec![moving("a.m3d")]);
    let from = window.rect("Model facts").center();
    let up: Vec<_> = (0..5).map(|step| vec![from - vec2(0.0, 15.0 * step as f32)]).collect();
    gesture(&mut window, &up);
    assert_eq!(window.harness.state().state.drawer, Some(DrawerPage::Model));
    let from = window.rect("Close the sheet").center();
    let down: Vec<_> = (0..5).map(|step| vec![from + vec2(0.0, 15.0 * step as f32)]).collect();
    for _ in 0..3 {
        if window.shows("Close the sheet") {
            gesture(&mut window, &down);
        }
    }
    assert_eq!(window.harness.state().state.drawer, None);
}

#[test]
fn arrow_keys_move_the_handle_too() {
    let mut window = open();
    let half = top(&window);
    while window.focused().as_deref() != Some("Close the sheet") {
        window.tab(false);
    }
    window.press(Modifiers::NONE, Key::ArrowUp);
    assert!(top(&window) < half);
    for _ in 0..3 {
        window.press(Modifiers::NONE, Key::ArrowDown);
    }
    assert_eq!(window.harness.state().state.drawer, None);
}

#[test]
fn every_page_has_a_title_and_is_closed_by_its_button_or_by_a_tap_on_the_view() {
    for page in DRAWER_PAGES {
        let mut window = phone(vec![moving("a.m3d")]);
        let show = |window: &mut Window| {
            window.harness.state_mut().state.drawer = Some(page);
            window.pass_on();
        };
        show(&mut window);
        let close = window.rect("Close");
        assert!(close.width() >= 44.0 && close.height() >= 44.0, "{page:?}: {close}");
        window.click("Close");
        assert_eq!(window.harness.state().state.drawer, None, "{page:?}");
        show(&mut window);
        // In the middle of what is left stands the model.
        let at = pos2(0.5 * PHONE.x, 0.5 * (top(&window) + panel(&window, "title").max.y));
        let camera = *window.session().camera();
        gesture(&mut window, &[vec![at]]);
        assert_eq!(window.harness.state().state.drawer, None, "{page:?}");
        assert_eq!(window.session().submeshes().selected(), None, "and nothing is selected");
        assert_eq!(window.session().joints().selected_vertex(), None);
        assert_eq!(window.session().camera().yaw_radians, camera.yaw_radians);
    }
}

#[test]
fn the_tree_of_bones_can_be_asked_for() {
    let mut window = phone(vec![moving("a.m3d")]);
    let page = window.harness.state_mut();
    page.state.show_skeleton(&page.session);
    window.pass_on();
    assert!(window.shows("Search bones"));
    window.click("Bone 1, ");
    assert!(window.session().joints().selected().is_some());
    assert_eq!(
        window.harness.state().state.drawer,
        Some(DrawerPage::Selection),
        "then its numbers"
    );
}

#[test]
fn a_camera_that_was_moved_stays_and_framing_is_offered() {
    let mut window = phone(vec![moving("a.m3d")]);
    window.click("Model facts");
    window.click("Close");
    assert!(shown_panel(&window, "offer-frame").is_none(), "nobody moved the camera");
    window.apply(CameraCommand::Pan {
        drag: glam::Vec2::new(0.1, 0.0),
    });
    let camera = *window.session().camera();
    assert!(shown_panel(&window, "offer-frame").is_none(), "nothing opened since");
    window.harness.set_size(Vec2::new(PHONE.y, PHONE.x));
    window.pass_on();
    assert_eq!(window.session().camera(), &camera, "it stays when the phone turns");
    window.click("Frame the model");
    assert_ne!(window.session().camera(), &camera);
    assert!(shown_panel(&window, "offer-frame").is_none(), "done");
}

#[test]
fn the_error_card_leaves_the_transport_free_and_shows_the_mark() {
    for size in [PHONE, vec2(844.0, 390.0), vec2(320.0, 568.0)] {
        for sheet in [None, Some(DrawerPage::Light)] {
            let mut window = touch_window(size, vec![moving("a.m3d")]);
            window.harness.state_mut().state.drawer = sheet;
            window.apply(FileCommand::Add(vec![broken("b.m3d")]));
            window.pass_on();
            let card = panel(&window, "error");
            let bar = panel(&window, "title");
            assert!(!card.intersects(bar), "{size}: {card} lies on the bar {bar}");
            for control in ["Play", "Time"] {
                let rect = window.rect(control);
                assert!(!card.intersects(rect), "{size}: {card} lies on {control} {rect}");
            }
            assert!(card.height() >= 120.0, "{size}: {card} is too low to read");
        }
    }
}

#[test]
fn more_than_half_of_the_sheet_of_the_timeline_is_keys() {
    let mut window = phone(vec![moving("a.m3d")]);
    window.click("Dope sheet and");
    let sheet = panel(&window, "drawer");
    let ruler = window.rect("Ruler");
    let keys = Rect::from_min_max(ruler.min, pos2(sheet.max.x, window.rect("Play").min.y));
    assert!(keys.height() >= 0.5 * sheet.height(), "{keys} of {sheet}");
}

#[test]
fn what_is_selected_is_a_tab_beside_model_and_skeleton() {
    for size in [PHONE, vec2(844.0, 390.0)] {
        let mut window = touch_window(size, vec![moving("a.m3d")]);
        let tabs = ["Panel: Model", "Panel: Skeleton", "Panel: Selection"];
        window.click("Model facts");
        let places = tabs.map(|tab| window.rect(tab));
        window.click("Panel: Selection");
        assert!(!window.named(|name| name.starts_with("Nothing is selected.")).is_empty());
        window.apply(SubmeshCommand::Select(Some(0)));
        assert!(window.shows("Selected: Painted"));
        window.apply(LookCommand::SetSkinView(Some(SkinView::Weight)));
        window.click("Close the sheet");
        window.click("Choose a bone in the tree");
        assert!(window.shows("Search bones"), "though a subset is selected");
        window.click("Bone 1, ");
        assert!(window.shows("Selected: Bone 1"));
        assert_eq!(tabs.map(|tab| window.rect(tab)), places, "the way to the rest stays");
        window.click("Panel: Skeleton");
        window.click("Bone 0, ");
        assert!(
            window.shows("Selected: Bone 0"),
            "the next one, without losing the first before"
        );
        window.click("Panel: Model");
        assert!(window.shows("Dialect D3D12 book"));
        assert!(window.session().joints().selected().is_some(), "nothing was let go");
        window.click("Panel: Selection");
        window.click("Clear the selection");
        assert!(window.shows("Dialect D3D12 book"), "the page of before");
    }
    let mut window = phone(vec![still("a.m3d")]);
    window.click("Model facts");
    assert!(window.shows("Panel: Model") && window.shows("Panel: Selection") && !window.shows("Panel: Skeleton"));
}

#[test]
fn a_long_press_says_what_a_control_is_and_does_nothing_else() {
    let mut window = phone(vec![moving("a.m3d")]);
    let at = window.rect("Dope sheet and").center();
    fingers(&mut window, TouchPhase::Start, &[at]);
    window.wait(1.2);
    assert!(
        window.named(|name| name == "Dope sheet and curves").len() > 1,
        "{:?}",
        window.widgets()
    );
    fingers(&mut window, TouchPhase::End, &[at]);
    window.pass_on();
    assert_eq!(window.harness.state().state.drawer, None);
}
