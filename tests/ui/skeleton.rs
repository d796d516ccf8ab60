//! What is drawn of skeleton and skin: keys, views, legends, clicks in the view, overlays; and helpers for their panels.

use bindpose::anim::{GhostPlan, SkinView};
use bindpose::model::JointIndex;
use bindpose::scene::BoneStyle;
use bindpose::session::{File, JointCommand, LookCommand};
use egui::accesskit::Action;
use egui::{Key, Modifiers, PointerButton, Vec2, vec2};

use crate::chains::mirrored;
use crate::layout::{assert_apart, assert_between_sides};
use crate::models;
use crate::page::{PHONE, WIDE, Window, button_event, phone, window};

const SMALL: Vec2 = vec2(900.0, 700.0);

pub(crate) fn chains(bone_count: usize) -> Vec<File> {
    vec![models::file("chains.m3d", &mirrored(bone_count))]
}

/// A window with the tree open.
pub(crate) fn tree(size: Vec2, bone_count: usize) -> Window {
    let mut window = window(size, chains(bone_count));
    window.click("Panel: Skeleton");
    window
}

/// The names of the rows that are laid out.
pub(crate) fn rows(window: &Window) -> Vec<String> {
    let rows = window.named(|name| name.contains(", ") && name.ends_with("vertices"));
    rows.into_iter().map(|(name, _)| name).collect()
}

pub(crate) fn selected(window: &Window) -> Option<u32> {
    window.session().joints().selected().map(|joint| joint.0)
}

pub(crate) fn window_of_still() -> Window {
    window(WIDE, vec![models::still("a.m3d")])
}

#[test]
fn keys_show_bones_names_weights_and_the_bind_pose() {
    let mut window = window(WIDE, chains(5));
    let press = |window: &mut Window, modifiers, key| window.press(modifiers, key);
    press(&mut window, Modifiers::NONE, Key::B);
    press(&mut window, Modifiers::SHIFT, Key::B);
    press(&mut window, Modifiers::NONE, Key::W);
    press(&mut window, Modifiers::NONE, Key::K);
    let look = window.session().look();
    assert!(look.bones_visible && look.labels_visible());
    assert_eq!(look.skin_view, Some(SkinView::Weight));
    assert_eq!(window.session().bind_weight(), 1.0);
    assert!(window.shows("Legend: Weight of a bone"));
    press(&mut window, Modifiers::SHIFT, Key::B);
    press(&mut window, Modifiers::NONE, Key::B);
    press(&mut window, Modifiers::NONE, Key::W);
    press(&mut window, Modifiers::NONE, Key::K);
    let look = window.session().look();
    assert!(!look.bones_visible && !look.labels_visible() && look.skin_view.is_none());
    assert_eq!(window.session().bind_weight(), 0.0);
    let mut still = window_of_still();
    still.press(Modifiers::NONE, Key::B);
    assert!(!still.session().look().bones_visible, "no bones, no key");
}

#[test]
fn names_go_with_the_bones_whatever_key_hides_or_shows_them() {
    let mut window = window(WIDE, chains(5));
    let mut after = |modifiers| {
        window.press(modifiers, Key::B);
        let look = window.session().look();
        (look.bones_visible, look.labels_visible())
    };
    let (bones, names) = (Modifiers::NONE, Modifiers::SHIFT);
    assert_eq!(
        after(names),
        (true, true),
        "Shift B alone shows the bones that it names"
    );
    assert_eq!(after(bones), (false, false));
    assert_eq!(after(bones), (true, true));
    assert_eq!(after(names), (true, false));
    window.click("Lines over");
    window.click("Names of bones");
    window.click("Bones");
    let look = window.session().look();
    assert!(!look.bones_visible && !look.labels_visible());
}

#[test]
fn the_key_that_flies_forward_leaves_the_skin_alone() {
    let mut window = window(WIDE, chains(5));
    let at = window.harness.ctx.content_rect().center();
    let held = |pressed| button_event(at, PointerButton::Secondary, pressed, Modifiers::NONE);
    window.harness.hover_at(at);
    window.harness.event(held(true));
    window.pass_on();
    window.press(Modifiers::NONE, Key::W);
    window.harness.event(held(false));
    window.pass_on();
    assert_eq!(window.session().look().skin_view, None);
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
    window.apply(JointCommand::Select(Some(JointIndex(3))));
    assert!(window.shows("Legend: Weight of Bone 3"));
    window.click("View mode");
    window.click("Strongest bone");
    assert!(window.shows("Legend: Strongest bone"));
    window.click("View mode");
    window.click("Lit");
    assert_eq!(window.session().look().skin_view, None);
    assert!(window.named(|name| name.starts_with("Legend")).is_empty());
}

/// The middle of the window where the first triangle of a bone is.
fn place_of_vertex(window: &mut Window, vertex: u32) -> egui::Pos2 {
    window.apply(JointCommand::SelectVertex(Some(vertex)));
    let session = &mut window.harness.state_mut().session;
    let place = session.explain_vertex().expect("it was selected").position;
    let at = session.place_in_picture(place).expect("in view");
    window.apply(JointCommand::SelectVertex(None));
    let share = vec2(0.5 * (at.x + 1.0), 0.5 * (1.0 - at.y));
    egui::Pos2::ZERO + share * window.harness.ctx.content_rect().size()
}

fn click_at(window: &mut Window, at: egui::Pos2) {
    window.click_at(at);
}

#[test]
fn a_click_in_the_view_means_what_the_panel_is_about() {
    let mut window = window(WIDE, vec![models::moving("a.m3d")]);
    // A corner of the front, a little inside of the box.
    let corner = place_of_vertex(&mut window, 2);
    let center = window.harness.ctx.content_rect().center();
    let at = corner + 0.12 * (center - corner);
    let click = |window: &mut Window, at| {
        // Else it would be a double click.
        window.wait(1.0);
        click_at(window, at);
        let joints = window.session().joints();
        let submesh = window.session().submeshes().selected();
        (submesh, joints.selected_vertex().is_some(), selected(window))
    };
    window.press(Modifiers::NONE, Key::B);
    assert_eq!(
        click(&mut window, at),
        (Some(0), false, None),
        "the model's page is about subsets"
    );
    let bone = bone_place(&mut window, 1);
    window.press(Modifiers::NONE, Key::W);
    assert!(click(&mut window, at).1, "on a coloured skin about vertices");
    window.press(Modifiers::NONE, Key::W);
    for tab in ["Panel: Model", "Panel: Skeleton"] {
        window.click(tab);
        window.apply(JointCommand::Select(None));
        window.hover_at(bone);
        assert_eq!(window.session().joints().hovered(), Some(JointIndex(1)), "{tab}");
        assert_eq!(
            click(&mut window, bone),
            (None, false, Some(1)),
            "a bone that is drawn is selected: {tab}"
        );
    }
    window.press(Modifiers::NONE, Key::W);
    assert_eq!(
        click(&mut window, at),
        (None, true, Some(1)),
        "a vertex of a coloured skin"
    );
    assert_eq!(
        click(&mut window, bone),
        (None, false, Some(1)),
        "its ring goes with a bone"
    );
    window.press(Modifiers::NONE, Key::W);
    window.press(Modifiers::NONE, Key::B);
    let (submesh, vertex, joint) = click(&mut window, at);
    assert_eq!((submesh, vertex), (None, false));
    assert!(
        joint.is_some(),
        "the bone that moves the skin there, though none is drawn"
    );
    window.press(Modifiers::NONE, Key::Escape);
    assert_eq!(selected(&window), None);
}

/// Where a joint is in the window: its label says it.
fn bone_place(window: &mut Window, joint: u32) -> egui::Pos2 {
    let session = &mut window.harness.state_mut().session;
    session.apply(LookCommand::SetLabelsVisible(true));
    let mut places = Vec::new();
    session.joint_labels(0.0, &mut places);
    session.apply(LookCommand::SetLabelsVisible(false));
    let place = places
        .into_iter()
        .find(|place| place.joint.0 == joint)
        .expect("in view");
    let share = vec2(0.5 * (place.position.x + 1.0), 0.5 * (1.0 - place.position.y));
    egui::Pos2::ZERO + share * WIDE
}

#[test]
fn bones_pose_ghosts_and_trails_are_among_the_overlays() {
    let mut window = window(WIDE, chains(5));
    window.apply(JointCommand::Select(Some(JointIndex(3))));
    window.click("Lines over");
    window.click("Bones");
    window.click("Bones: Axes");
    window.click("Names of bones");
    let look = window.session().look();
    assert_eq!((look.bone_style, look.labels_visible()), (BoneStyle::Axes, true));
    window.click("Bind pose as a ghost");
    assert!(window.session().look().bind_ghost);
    window.click("To bind pose");
    let share = window.session().bind_weight();
    assert!((0.4..0.6).contains(&share), "{share}");
    window.click("Ghosts");
    let plan = GhostPlan {
        before: 3,
        after: 3,
        step_frames: 5,
    };
    assert_eq!(window.session().look().ghosts, Some(plan));
    assert!(window.shows("Ghosts every frames"));
    window.click("Trail of Bone 3");
    assert_eq!(window.session().look().trails[..], [JointIndex(3)]);
    window.click("Leave the trail of Bone 3");
    assert!(window.session().look().trails.is_empty());
}

#[test]
fn weights_without_a_bone_offer_to_choose_one() {
    for mut window in [window(WIDE, chains(5)), phone(chains(5))] {
        window.apply(LookCommand::SetSkinView(Some(SkinView::Weight)));
        window.click("Choose a bone in the tree");
        assert!(window.shows("Search bones"), "the tree is open");
        window.click("Bone 3, ");
        assert!(window.shows("Legend: Weight of Bone 3"));
        assert!(!window.shows("Choose a bone in the tree"));
    }
}

#[test]
fn the_panel_with_the_tree_is_dragged_wider_and_stays_so() {
    let mut window = tree(WIDE, 5);
    let width = |window: &Window| window.rect("Bone 1, ").width();
    let before = width(&window);
    let handle = window.rect("Width of the panel").center();
    window.harness.hover_at(handle);
    window.harness.drag_at(handle);
    window.pass_on();
    window.hover_at(handle + vec2(100.0, 0.0));
    window.harness.drop_at(handle + vec2(100.0, 0.0));
    window.pass_on();
    let wider = width(&window);
    assert!((95.0..110.0).contains(&(wider - before)), "{before} {wider}");
    window.click("Panel: Model");
    window.click("Panel: Skeleton");
    assert_eq!(width(&window), wider);
    let handle = window.rect("Width of the panel").center();
    window.harness.hover_at(handle);
    window.harness.drag_at(handle);
    window.pass_on();
    for x in [2_000.0, 0.0] {
        window.hover_at(egui::pos2(x, handle.y));
        assert!(
            (before..WIDE.x / 2.0).contains(&width(&window)),
            "{x}: {}",
            width(&window)
        );
    }
}

#[test]
fn a_program_that_reads_the_screen_widens_the_panel_by_single_steps() {
    let mut window = tree(WIDE, 5);
    let width = |window: &Window| window.rect("Bone 1, ").width();
    let before = width(&window);
    window.ask("Width of the panel", Action::Increment, None);
    let wider = width(&window);
    assert_eq!(wider - before, 16.0);
    window.ask("Width of the panel", Action::Decrement, None);
    assert_eq!(width(&window), before);
}

#[test]
fn tree_and_inspector_fit_every_window() {
    for (size, bone_count) in [(WIDE, 300), (SMALL, 300), (SMALL, 1), (vec2(900.0, 600.0), 2_000)] {
        let mut window = tree(size, bone_count);
        window.apply(JointCommand::Select(Some(JointIndex(0))));
        window.apply(JointCommand::SelectVertex(Some(0)));
        window.apply(LookCommand::SetSkinView(Some(SkinView::Weight)));
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
    window.apply(LookCommand::SetSkinView(Some(SkinView::Weight)));
    assert_between_sides(&window, PHONE);
    assert_apart(&window, &["title", "drawer", "legend"]);
    let row = window.rect("Bone 1, ");
    assert!(row.height() >= 44.0, "{row}");
    window.click("Bone 1, ");
    assert!(window.shows("Selected: Bone 1"), "the sheet is about it");
    assert_between_sides(&window, PHONE);
}

#[test]
fn a_tap_means_what_is_drawn_whatever_tab_is_behind_a_closed_sheet() {
    for tab in ["Panel: Model", "Panel: Skeleton"] {
        let mut window = phone(vec![models::moving("a.m3d")]);
        window.click("Model facts");
        window.click(tab);
        window.click("Close the sheet");
        window.apply(LookCommand::SetBonesVisible(false));
        window.wait(1.0);
        let corner = place_of_vertex(&mut window, 2);
        let opposite = place_of_vertex(&mut window, 0);
        let at = corner + 0.12 * (opposite - corner);
        let mut tap = |look: LookCommand| {
            window.apply(look);
            window.wait(1.0);
            click_at(&mut window, at);
            let joints = window.session().joints();
            let submesh = window.session().submeshes().selected();
            (submesh, joints.selected_vertex().is_some(), joints.selected().is_some())
        };
        let shown = LookCommand::SetBonesVisible;
        assert_eq!(tap(shown(false)), (Some(0), false, false), "{tab}: the model as it is");
        assert_eq!(tap(shown(true)), (None, false, true), "{tab}: with bones");
        assert_eq!(
            tap(LookCommand::SetSkinView(Some(SkinView::Weight))),
            (None, true, true),
            "{tab}: with weights"
        );
    }
}

#[test]
fn bones_are_drawn_while_the_tree_is_the_page_unless_somebody_hid_them() {
    let mut window = tree(WIDE, 5);
    let drawn = |window: &Window| window.session().look().bones_visible;
    assert!(drawn(&window));
    window.click("Panel: Model");
    assert!(!drawn(&window), "they were drawn for the tree");
    window.click("Panel: Skeleton");
    window.press(Modifiers::NONE, Key::B);
    assert!(!drawn(&window));
    window.click("Panel: Model");
    window.click("Panel: Skeleton");
    assert!(!drawn(&window), "somebody hid them");
    window.press(Modifiers::NONE, Key::B);
    window.click("Panel: Model");
    assert!(drawn(&window), "somebody showed them");
}
