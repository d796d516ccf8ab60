//! Pictures as files: their size, their ground and their name.

use bindpose::session::{FileCommand, PlayCommand, Session};
use bindpose::ui::{Request, picture_name};
use egui::{Event, Key, Modifiers};

use crate::models::{self, moving, still};
use crate::page::{WIDE, Window, window};

fn open() -> Window {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    window.click("Picture");
    window
}

fn pictures(window: &Window) -> Vec<Request> {
    window.harness.state().requests.clone()
}

#[test]
fn sizes_are_chosen_by_name() {
    let mut window = open();
    for (label, size) in [
        ("Full HD", [1920, 1080]),
        ("4K", [3840, 2160]),
        ("Square", [2048, 2048]),
        ("As the window", [1440, 900]),
    ] {
        window.click(label);
        window.click("Save PNG");
        let transparent = false;
        assert_eq!(
            pictures(&window).last(),
            Some(&Request::SavePicture { size, transparent })
        );
    }
}

#[test]
fn sizes_are_typed_and_kept_in_reach() {
    let mut window = open();
    for (typed, width) in [("640", 640), ("0", 1), ("99999", bindpose::ui::MAX_PICTURE_SIDE)] {
        window.click("Width in pixels");
        window.press(Modifiers::COMMAND, Key::A);
        window.harness.event(Event::Text(typed.to_owned()));
        window.press(Modifiers::NONE, Key::Enter);
        window.click("Save PNG");
        let (size, transparent) = ([width, 900], false);
        assert_eq!(
            pictures(&window).last(),
            Some(&Request::SavePicture { size, transparent })
        );
    }
}

#[test]
fn the_ground_is_left_out_when_asked() {
    let mut window = open();
    window.click("Transparent ground");
    window.click("Save PNG");
    let (size, transparent) = ([1440, 900], true);
    assert_eq!(pictures(&window), [Request::SavePicture { size, transparent }]);
}

#[test]
fn the_name_says_model_clip_and_frame() {
    let named = |files| {
        let mut session = Session::new(true);
        session.apply(FileCommand::Add(files));
        session.apply(PlayCommand::Seek { time_secs: 0.5 });
        picture_name(&session)
    };
    assert_eq!(named(vec![moving("in/soldier.m3d")]), "soldier-Bend-15.png");
    assert_eq!(named(vec![still("a.b.m3d")]), "a.b.png");
    let odd = models::file("x.m3d", &models::skinned(&[("Run/../away: now?", 0.0, 31)]));
    assert_eq!(named(vec![odd]), "x-Run-..-away--now--15.png");
    assert_eq!(named(vec![]), "bindpose.png");
}

#[test]
fn r_asks_for_the_files_again_and_the_browsers_reload_stays_the_browsers() {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    window.press(Modifiers::COMMAND, Key::R);
    assert_eq!(pictures(&window), []);
    window.press(Modifiers::NONE, Key::R);
    assert_eq!(pictures(&window), [Request::ReadAgain]);
}
