//! What a page mirrors of the interface for screen readers, and what it asks to be done.

use bindpose::session::File;
use bindpose::ui::{Mirror, MirrorAction, MirrorChanges, MirrorId, MirrorInput, MirrorNode};
use egui::{Event, Modifiers, RawInput};

use crate::page::{WIDE, Window, window};
use crate::{models, rigs};

/// A window that is mirrored, all of which was told.
fn mirrored(files: Vec<File>) -> (Window, Vec<MirrorNode>) {
    let window = window(WIDE, files);
    let all = changes(&window).expect("nothing was told yet");
    assert!(all.fresh);
    (window, all.changed)
}

fn changes(window: &Window) -> Option<MirrorChanges> {
    window.harness.ctx.plugin::<Mirror>().lock().take_changes()
}

fn outline(window: &Window) -> String {
    window.harness.ctx.plugin::<Mirror>().lock().outline()
}

#[track_caller]
fn id(nodes: &[MirrorNode], role: &str, name: &str) -> MirrorId {
    let found = nodes
        .iter()
        .find(|node| node.role == role && node.name.starts_with(name));
    found
        .unwrap_or_else(|| panic!("{role} {name} is not there: {nodes:#?}"))
        .id
}

fn act(window: &mut Window, id: MirrorId, action: MirrorAction) {
    let event: Event = action.event(id);
    window.frame([event]);
    window.pass_on();
}

#[test]
fn what_did_not_change_is_told_once() {
    let (mut window, all) = mirrored(vec![rigs::rig(12, 30)]);
    assert!(all.len() > 20, "{}", all.len());
    window.pass_on();
    assert_eq!(changes(&window), None);
    act(&mut window, id(&all, "button", "Next key"), MirrorAction::Click);
    let after = changes(&window).expect("the time is another");
    assert!(!after.fresh);
    let roles: Vec<_> = after.changed.iter().map(|node| node.role).collect();
    assert!(roles.contains(&"slider"), "{roles:?}");
    assert!(
        after.changed.len() < all.len() / 2,
        "{}: {roles:?}",
        after.changed.len()
    );
}

#[test]
fn a_slider_and_a_field_are_set_and_a_button_is_pressed() {
    let (mut window, all) = mirrored(vec![rigs::rig(12, 30)]);
    act(&mut window, id(&all, "button", "Play"), MirrorAction::Click);
    assert!(window.session().playback().is_playing());
    act(&mut window, id(&all, "radio", "Panel: Skeleton"), MirrorAction::Click);
    let opened = changes(&window).expect("another panel").changed;
    let search = id(&opened, "textbox", "Search bones");
    act(&mut window, search, MirrorAction::Focus);
    assert_eq!(window.focused().as_deref(), Some("Search bones"));
    assert_eq!(changes(&window).expect("the focus").focus, Some(search));
    act(&mut window, search, MirrorAction::SetText("11".to_owned()));
    let found = outline(&window);
    assert!(found.contains("textbox \"Search bones\" = 11"), "{found}");
    assert!(found.contains("Bone 11"), "{found}");
    assert!(!found.contains("Bone 5"), "{found}");
}

#[test]
fn rows_of_a_tree_stand_in_a_tree_with_their_buttons_inside() {
    let (mut window, all) = mirrored(vec![rigs::rig(12, 30)]);
    act(&mut window, id(&all, "radio", "Panel: Skeleton"), MirrorAction::Click);
    let nodes = changes(&window).expect("another panel").changed;
    let tree = nodes.iter().find(|node| node.role == "tree").expect("a tree");
    let of = |id: &MirrorId| nodes.iter().find(|node| node.id == *id).expect("told with its parent");
    assert_eq!(tree.children.len(), 12);
    assert!(tree.children.iter().all(|child| of(child).role == "treeitem"));
    let [left, top, width, height] = of(&tree.children[1]).bounds;
    assert!(
        left >= 0.0 && top > 0.0 && width <= tree.bounds[2] && height > 10.0,
        "it lies in the tree"
    );
}

#[test]
fn what_is_gone_is_told() {
    let (mut window, all) = mirrored(vec![models::file("one.m3d", &models::skinned(&[("Walk", 0.0, 2)]))]);
    act(&mut window, id(&all, "button", "Help (?)"), MirrorAction::Click);
    let help = changes(&window).expect("the table of keys").changed;
    window.click("Help (?)");
    let gone = changes(&window).expect("it is shut").removed;
    assert!(
        help.iter()
            .filter(|node| node.role == "text")
            .all(|node| gone.contains(&node.id))
    );
}

#[test]
fn an_id_goes_to_the_page_and_back() {
    let (_, all) = mirrored(Vec::new());
    for node in all {
        let text = serde_json::to_value(node.id).expect("a text");
        assert_eq!(MirrorId::from_text(text.as_str().expect("a text")), Some(node.id));
    }
    assert_eq!(MirrorId::from_text("no number"), None);
}

/// What a frame hears of the page's elements, and what modifiers it leaves.
fn frame_of(window: &mut Window, page: &mut MirrorInput, events: Vec<Event>) -> Modifiers {
    let mut input = RawInput {
        events,
        ..RawInput::default()
    };
    page.begin_frame(&window.harness.ctx, &mut input);
    window.frame(input.events);
    window.harness.ctx.input(|input| input.modifiers)
}

#[test]
fn modifiers_that_come_up_elsewhere_do_not_stay() {
    let (mut window, _) = mirrored(vec![rigs::rig(12, 30)]);
    let mut page = MirrorInput::default();
    page.set_focused(true);
    page.press("Shift", "ShiftLeft", true, Modifiers::SHIFT);
    assert_eq!(frame_of(&mut window, &mut page, Vec::new()), Modifiers::SHIFT);
    page.set_focused(true);
    assert_eq!(
        frame_of(&mut window, &mut page, Vec::new()),
        Modifiers::SHIFT,
        "it is still down, and comes up at the next element"
    );
    page.press("Shift", "ShiftLeft", false, Modifiers::NONE);
    assert_eq!(frame_of(&mut window, &mut page, Vec::new()), Modifiers::NONE);

    page.press("Alt", "AltLeft", true, Modifiers::ALT);
    frame_of(&mut window, &mut page, Vec::new());
    page.set_focused(false);
    assert_eq!(
        frame_of(&mut window, &mut page, Vec::new()),
        Modifiers::NONE,
        "it comes up elsewhere"
    );
}

#[test]
fn modifiers_that_the_canvas_heard_of_end_as_the_focus_goes_to_an_element() {
    let (mut window, _) = mirrored(vec![rigs::rig(12, 30)]);
    let mut page = MirrorInput::default();
    let shift = vec![Event::ModifiersChanged(Modifiers::SHIFT)];
    assert_eq!(frame_of(&mut window, &mut page, shift), Modifiers::SHIFT);
    page.set_focused(true);
    frame_of(&mut window, &mut page, Vec::new());
    let lost = vec![Event::ModifiersChanged(Modifiers::SHIFT), Event::WindowFocused(false)];
    assert_eq!(frame_of(&mut window, &mut page, lost), Modifiers::NONE);
    page.press("a", "KeyA", true, Modifiers::NONE);
    assert_eq!(
        frame_of(&mut window, &mut page, vec![Event::ModifiersChanged(Modifiers::ALT)]),
        Modifiers::NONE,
        "a key says what is held, whatever the pointer told before"
    );
}
