//! The strip: transport, bar, menus.

use bindpose::anim::LoopMode;
use bindpose::session::{Command, SPEEDS};
use egui::pos2;

use crate::models::{moving, still};
use crate::page::{WIDE, Window, phone, window};

fn playing() -> Window {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    window.apply(Command::Play);
    window
}

#[test]
fn the_button_plays_and_pauses_and_says_what_it_will_do() {
    for mut window in [window(WIDE, vec![moving("a.m3d")]), phone(vec![moving("a.m3d")])] {
        assert!(!window.session().is_animating());
        window.click("Play");
        assert!(window.session().is_animating());
        assert!(!window.shows("Play (Space)"));
        window.click("Pause");
        assert!(!window.session().is_animating());
        assert!(window.shows("Play (Space)"));
    }
}

#[test]
fn time_goes_by_while_it_plays_and_the_read_outs_follow() {
    let mut window = playing();
    let before = window.time_secs();
    window.wait(0.5);
    let time_secs = window.time_secs();
    assert!((time_secs - before - 0.5).abs() < 1e-3, "{before} to {time_secs}");
    window.apply(Command::Seek { time_secs: 0.5 });
    window.apply(Command::Pause);
    window.apply(Command::Seek { time_secs: 0.5 });
    assert!(window.shows("Time 0.500 s") && window.shows("Frame 15 of 30"));
}

#[test]
fn dragging_on_the_bar_seeks_while_it_plays_and_playing_goes_on_from_there() {
    let mut window = playing();
    let bar = window.rect("Time in seconds");
    let at = |share: f32| pos2(bar.min.x + share * bar.width(), bar.center().y);
    window.harness.hover_at(at(0.2));
    window.harness.drag_at(at(0.2));
    window.harness.hover_at(at(0.5));
    window.harness.hover_at(at(0.6));
    window.pass_on();
    assert!(window.session().is_scrubbing());
    let held = window.time_secs();
    assert!((held - 0.6).abs() < 0.02, "{held}");
    window.wait(0.5);
    assert_eq!(window.time_secs(), held, "held still");
    window.harness.hover_at(at(2.0));
    window.pass_on();
    assert_eq!(window.time_secs(), 1.0, "beyond the bar is its end");
    window.harness.hover_at(at(0.25));
    window.harness.drop_at(at(0.25));
    window.pass_on();
    assert!(!window.session().is_scrubbing() && window.session().is_animating());
    window.wait(0.25);
    let later = window.time_secs();
    assert!((0.45..0.65).contains(&later), "{later}");
}

#[test]
fn a_click_on_the_bar_goes_there() {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    window.click("Time in seconds");
    assert!((window.time_secs() - 0.5).abs() < 0.01, "{}", window.time_secs());
    assert!(!window.session().is_scrubbing());
}

#[test]
fn the_ends_are_one_click_away() {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    window.click("Last frame");
    assert_eq!(window.time_secs(), 1.0);
    window.click("First frame");
    assert_eq!(window.time_secs(), 0.0);
}

#[test]
fn the_clip_menu_lists_all_clips_and_shows_one() {
    for mut window in [window(WIDE, vec![moving("a.m3d")]), phone(vec![moving("a.m3d")])] {
        window.click("Clip Bend");
        for item in ["Bend   1.00 s", "Turn   2.00 s", "Still   0.00 s"] {
            assert!(window.shows(item), "{item}");
        }
        window.click("Turn   2.00 s");
        assert_eq!(window.session().clip_index(), Some(1));
        assert!(
            window.shows("Clip Turn") && !window.shows("Turn   2.00 s"),
            "the menu is shut"
        );
        assert!(window.shows("Time 0.500 s") && window.shows("Frame 0 of 60"));
    }
}

#[test]
fn the_speed_menu_lists_all_speeds_and_sets_one() {
    for mut window in [window(WIDE, vec![moving("a.m3d")]), phone(vec![moving("a.m3d")])] {
        window.click("Speed 1×");
        let items = window.named(|name| name.ends_with('×') && !name.starts_with("Speed"));
        assert_eq!(items.len(), SPEEDS.len());
        window.click("0.25×");
        assert_eq!(window.session().playback().speed(), 0.25);
        assert!(window.shows("Speed 0.25×"));
    }
}

#[test]
fn the_loop_button_goes_through_the_modes() {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    for (label, next) in [
        ("Loops", LoopMode::PingPong),
        ("Plays there and back", LoopMode::Once),
        ("Plays once", LoopMode::Loop),
    ] {
        window.click(label);
        assert_eq!(window.session().playback().loop_mode(), next);
    }
    assert!(window.shows("Loops (L)"));
}

#[test]
fn without_clips_there_is_no_strip() {
    for window in [
        window(WIDE, vec![still("a.m3d")]),
        window(WIDE, vec![]),
        phone(vec![still("a.m3d")]),
    ] {
        assert!(
            window
                .named(|name| name.contains("Space") || name.starts_with("Time") || name.starts_with("Speed"))
                .is_empty()
        );
    }
}
