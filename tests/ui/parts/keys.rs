//! Which action a key has.

use bindpose::actions;
use bindpose::scene::ViewPreset;
use bindpose::session::{CameraCommand, Command, PlayCommand, Session};
use bindpose::ui::for_tests::{action_of, shortcut};
use bindpose::ui::owns_key;
use egui::{Key, Modifiers};

fn command_for(key: Key, modifiers: Modifiers) -> Option<Command> {
    action_of(key, modifiers)?.command(&Session::new(true))
}

#[test]
fn every_key_of_the_table_is_a_key() {
    for action in actions::ALL {
        for key in action.keys {
            assert!(*key == "?" || shortcut(key).is_some(), "{key}");
        }
    }
}

#[test]
fn keys_of_the_browser_are_left_alone() {
    let keys = [
        Key::L,
        Key::F,
        Key::C,
        Key::W,
        Key::T,
        Key::N,
        Key::P,
        Key::V,
        Key::X,
        Key::Num1,
        Key::Num5,
        Key::Home,
    ];
    for key in keys {
        for modifiers in [Modifiers::COMMAND, Modifiers::ALT] {
            assert_eq!(command_for(key, modifiers), None, "{key:?}");
            assert!(!owns_key(key, modifiers), "{key:?}");
        }
    }
}

#[test]
fn shift_makes_ten_frames_of_one() {
    assert_eq!(
        command_for(Key::ArrowLeft, Modifiers::NONE),
        Some(PlayCommand::StepFrames(-1).into())
    );
    assert_eq!(
        command_for(Key::ArrowRight, Modifiers::SHIFT),
        Some(PlayCommand::StepFrames(10).into())
    );
}

#[test]
fn shift_is_ignored_where_it_means_nothing_of_its_own() {
    // Digits need it on some keyboards.
    let isometric = CameraCommand::Glide(Box::new(CameraCommand::LookFrom(ViewPreset::Isometric))).into();
    assert_eq!(command_for(Key::Num9, Modifiers::SHIFT), Some(isometric));
    assert!(action_of(Key::R, Modifiers::NONE).is_some());
    for key in [Key::R, Key::O] {
        assert!(action_of(key, Modifiers::SHIFT).is_none(), "{key:?}");
    }
}

#[test]
fn alt_and_arrows_move_the_camera_and_alone_they_step() {
    let camera = |modifiers| match command_for(Key::ArrowLeft, modifiers) {
        Some(Command::Camera(CameraCommand::Glide(command))) => Some(*command),
        _ => None,
    };
    assert!(matches!(camera(Modifiers::ALT), Some(CameraCommand::Orbit { yaw_radians, .. }) if yaw_radians > 0.0));
    let pans = camera(Modifiers::ALT | Modifiers::SHIFT);
    assert!(matches!(pans, Some(CameraCommand::Pan { drag }) if drag.x > 0.0));
    assert!(owns_key(Key::ArrowLeft, Modifiers::ALT), "the browser would go back");
    let ctrl_alt = Modifiers::ALT | Modifiers::COMMAND;
    assert!(camera(Modifiers::NONE).is_none() && camera(ctrl_alt).is_none());
    // Plus needs Shift on some keyboards.
    for (key, modifiers) in [
        (Key::Plus, Modifiers::SHIFT),
        (Key::Equals, Modifiers::NONE),
        (Key::Minus, Modifiers::NONE),
    ] {
        assert!(
            matches!(command_for(key, modifiers), Some(Command::Camera(_))),
            "{key:?}"
        );
        assert!(!owns_key(key, Modifiers::COMMAND), "the browser zooms the page");
    }
}

#[test]
fn undo_and_redo_have_their_usual_keys() {
    let shift = Modifiers::COMMAND | Modifiers::SHIFT;
    let label = |key, modifiers| action_of(key, modifiers).map(|action| action.label);
    assert_eq!(label(Key::Z, Modifiers::COMMAND), Some("Undo"));
    assert_eq!(label(Key::Z, shift), Some("Redo"));
    assert_eq!(label(Key::Y, Modifiers::COMMAND), Some("Redo"));
    assert_eq!(
        label(Key::Y, Modifiers::COMMAND | Modifiers::MAC_CMD),
        None,
        "the browser's history"
    );
    assert_eq!(label(Key::Y, shift), None);
    assert_eq!(label(Key::Z, Modifiers::NONE), Some("Wireframe"));
}
