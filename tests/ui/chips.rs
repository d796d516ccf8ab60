//! Chips over the view: which mode is on, and the cross that ends it.

use bindpose::anim::{GhostPlan, SkinView};
use bindpose::model::JointIndex;
use bindpose::session::{CameraCommand, Command, FileCommand, JointCommand, LookCommand, PlayCommand, SubmeshCommand};
use bindpose::slices::Slices;
use egui::{Key, Modifiers, vec2};

use crate::layout::shown_panel;
use crate::models::{broken, moving, still};
use crate::page::{WIDE, Window, key_event, phone, touch_window, window};

/// Each mode: what turns it on, and its chip.
fn modes() -> Vec<(Vec<Command>, &'static str)> {
    vec![
        (vec![PlayCommand::ToggleBindPose.into()], "Leave bind pose"),
        (vec![SubmeshCommand::Solo(0).into()], "Leave only Painted"),
        (
            vec![
                PlayCommand::SetRangeStart(Some(0.2)).into(),
                PlayCommand::SetRangeEnd(Some(0.6)).into(),
            ],
            "Leave the range 6–18",
        ),
        (
            vec![
                JointCommand::Select(Some(JointIndex(1))).into(),
                LookCommand::SetSkinView(Some(SkinView::Weight)).into(),
            ],
            "Leave weights of Bone 1",
        ),
        (vec![CameraCommand::ToggleTurntable.into()], "Leave the turntable"),
        (vec![PlayCommand::SetSpeed(0.5).into()], "Leave speed 0.5×"),
        (vec![LookCommand::SetGhosts(Some(GHOSTS)).into()], "Leave ghosts 3 + 2"),
        (
            vec![LookCommand::SetBindGhost(true).into()],
            "Leave the ghost of the bind pose",
        ),
        (
            vec![LookCommand::ToggleTrail(JointIndex(1)).into()],
            "Leave trail of Bone 1",
        ),
    ]
}

const GHOSTS: GhostPlan = GhostPlan {
    before: 3,
    after: 2,
    step_frames: 5,
};

fn chips(window: &Window) -> Vec<(String, egui::Rect)> {
    let mut chips = window.named(|name| name.starts_with("Leave "));
    chips.dedup();
    chips
}

#[test]
fn each_mode_has_a_chip_that_ends_it() {
    for mut window in [window(WIDE, vec![moving("a.m3d")]), phone(vec![moving("a.m3d")])] {
        assert!(chips(&window).is_empty());
        for (commands, name) in modes() {
            for command in commands {
                window.apply(command);
            }
            assert_eq!(chips(&window).len(), 1, "{name}: {:?}", chips(&window));
            window.click(name);
            assert!(chips(&window).is_empty(), "{name} is over");
        }
        let session = window.session();
        assert_eq!((session.bind_weight(), session.submeshes().solo()), (0.0, None));
        assert_eq!(
            (session.playback().range_secs(), session.playback().speed()),
            (None, 1.0)
        );
        let look = session.look();
        assert!(look.skin_view.is_none() && !session.turntable());
        assert!(look.ghosts.is_none() && !look.bind_ghost && look.trails.is_empty());
        assert_eq!(
            session.joints().selected(),
            Some(JointIndex(1)),
            "the selection is no mode"
        );
    }
}

#[test]
fn chips_stand_in_the_view_beside_each_other_and_off_the_panels() {
    for (size, touch) in [
        (WIDE, false),
        (vec2(900.0, 600.0), false),
        (vec2(390.0, 844.0), true),
        (vec2(844.0, 390.0), true),
    ] {
        let open = if touch { touch_window } else { window };
        let mut window = open(size, vec![moving("a.m3d")]);
        for command in modes().into_iter().flat_map(|(commands, _)| commands) {
            window.apply(command);
        }
        let chips = chips(&window);
        assert_eq!(chips.len(), 9, "{chips:?}");
        for (index, (name, rect)) in chips.iter().enumerate() {
            for panel in ["title", "toolbar", "model", "inspector", "timeline", "drawer", "legend"] {
                if let Some(panel_rect) = shown_panel(&window, panel) {
                    assert!(!rect.intersects(panel_rect), "{name} lies on {panel} in {size}");
                }
            }
            for (other, other_rect) in &chips[..index] {
                assert!(
                    !rect.shrink(0.1).intersects(*other_rect),
                    "{name} lies on {other} in {size}"
                );
            }
            assert!(!touch || rect.height() >= 44.0, "{name} is for fingers");
        }
    }
}

#[test]
fn a_chip_is_pressed_by_the_keyboard_and_by_a_screen_reader() {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    window.apply(PlayCommand::ToggleBindPose);
    for _ in 0..80 {
        if window.focused().as_deref() != Some("Leave bind pose") {
            window.tab(false);
        }
    }
    window.press(Modifiers::NONE, Key::Enter);
    assert_eq!(window.session().bind_weight(), 0.0);
    window.press(Modifiers::NONE, Key::K);
    use egui_kittest::kittest::Queryable as _;
    window.harness.get_by_label("Leave bind pose").click_accesskit();
    window.pass_on();
    assert_eq!(window.session().bind_weight(), 0.0);
}

#[test]
fn without_a_clip_or_a_model_there_is_no_mode_to_leave() {
    let mut window = window(WIDE, vec![still("a.m3d")]);
    window.apply(PlayCommand::SetSpeed(0.5));
    assert!(chips(&window).is_empty());
    window.apply(FileCommand::Add(vec![broken("bad.m3d")]));
    assert!(chips(&window).is_empty());
}

#[test]
fn trails_are_counted_and_all_end_at_once() {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    for joint in [0, 1] {
        window.apply(LookCommand::ToggleTrail(JointIndex(joint)));
    }
    window.click("Leave trails 2");
    assert!(window.session().look().trails.is_empty());
}

#[test]
fn esc_gives_up_what_is_opened_but_not_what_came_after_the_key() {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    window.apply(JointCommand::Select(Some(JointIndex(1))));
    let session = &mut window.harness.state_mut().session;
    session.open_in(&Slices::new(|| true));
    session.apply(FileCommand::Add(vec![moving("b.m3d")]));
    // The key waited for a frame while the file was dropped.
    window.frame([true, false].map(|pressed| key_event(Key::Escape, pressed)));
    assert!(window.session().being_opened().is_some(), "it goes on");
    assert_eq!(
        window.session().joints().selected(),
        None,
        "what was on top when it was pressed"
    );

    window.press(Modifiers::NONE, Key::Escape);
    assert_eq!(window.session().being_opened(), None, "it is given up");
    assert_eq!(window.session().open_model().expect("it stays").file.path, "a.m3d");
}

#[test]
fn an_opening_that_is_read_and_then_made_keeps_its_chip() {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    let session = &mut window.harness.state_mut().session;
    session.open_in(&Slices::new(|| true));
    session.begin_fetching("b.m3d".to_owned(), 2_000_000, true);
    session.note_fetched(500_000, 0);
    window.wait(0.1);
    assert!(!window.shows("Cancel opening b.m3d"), "a short one is not told");
    window.wait(0.2);
    assert!(window.shows("Cancel opening b.m3d"));
    let session = &mut window.harness.state_mut().session;
    session.end_fetching();
    session.apply(FileCommand::Add(vec![moving("b.m3d")]));
    window.frame([]);
    assert!(window.shows("Cancel opening b.m3d"), "it goes on");
    window.click("Cancel opening b.m3d");
    assert_eq!(window.session().being_opened(), None);
}
