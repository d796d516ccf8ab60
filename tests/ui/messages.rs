//! Short messages: seen for a while, held by pointer and focus, without a pass while nothing happens.

use egui::{Key, Modifiers, pos2};

use crate::models::moving;
use crate::page::{WIDE, Window, phone, window};
use bindpose::model::JointIndex;
use bindpose::session::{NameCommand, SubmeshCommand};
use bindpose::ui::Request;

const WORDS: &str = "Saved a-Bend-15.png, 1920 × 1080";

/// A window in which a picture was just saved.
fn saved(mut window: Window) -> Window {
    window
        .harness
        .state_mut()
        .state
        .messages
        .say_saved("a-Bend-15.png", [1920, 1080]);
    window.pass_on();
    window
}

fn wide() -> Window {
    saved(window(WIDE, vec![moving("a.m3d")]))
}

#[test]
fn a_message_stands_above_the_timeline_goes_by_itself_and_costs_nothing_meanwhile() {
    for mut window in [wide(), saved(phone(vec![moving("a.m3d")]))] {
        let at = window.rect(WORDS);
        assert!(at.max.y < window.rect("Play").min.y, "{at}");
        assert!(at.min.x >= 0.0 && window.rect("Close the message").max.x <= window.harness.ctx.content_rect().max.x);
        window.harness.run();
        let next_pass = window.harness.output().viewport_output[&egui::ViewportId::ROOT].repaint_delay;
        assert!(
            next_pass.as_secs_f32() > 4.0,
            "it asks for a pass at its end alone: {next_pass:?}"
        );
        window.wait(5.0);
        assert!(window.shows(WORDS));
        window.wait(1.5);
        assert!(!window.shows(WORDS));
    }
}

#[test]
fn it_stays_under_the_pointer_and_while_it_has_the_focus() {
    let mut window = wide();
    let at = window.rect(WORDS).center();
    window.harness.hover_at(at);
    window.wait(8.0);
    assert!(window.shows(WORDS));
    window.harness.hover_at(pos2(WIDE.x * 0.5, WIDE.y * 0.4));
    window.wait(5.0);
    assert!(window.shows(WORDS), "its time begins anew");
    let mut window = saved(window);
    for _ in 0..80 {
        if window.focused().as_deref() != Some("Save the picture as…") {
            window.tab(false);
        }
    }
    window.wait(8.0);
    assert!(window.shows(WORDS));
    window.press(Modifiers::NONE, Key::Enter);
    assert!(!window.shows(WORDS));
    assert_eq!(window.harness.state().requests, [Request::SavePictureAs]);
}

#[test]
fn the_cross_ends_it_and_the_next_takes_its_place() {
    let mut window = wide();
    window.harness.state_mut().state.messages.say("Something else");
    window.pass_on();
    assert!(window.shows("Something else") && !window.shows(WORDS) && !window.shows("Save the picture as…"));
    assert!(window.take_told().ends_with("Something else."));
    window.click("Close the message");
    assert!(!window.shows("Something else"));
}

#[test]
fn names_are_told_and_can_be_taken_back_at_once() {
    let mut window = window(WIDE, crate::skeleton::chains(5));
    let name = |joint: u32, name: &str| NameCommand::Rename {
        joint: JointIndex(joint),
        name: name.to_owned(),
    };
    window.take_told();
    window.apply(name(1, "L arm"));
    window.assert_shows("Bone 1 is named L arm");
    assert_eq!(window.take_told(), "Bone 1 is named L arm.");
    window.apply(NameCommand::AcceptMirrored);
    window.assert_shows("Bone 2 is named R arm");
    window.click("Panel: Skeleton");
    window.take_told();
    window.click("Names and branches");
    window.click("Clear names");
    assert!(window.shows("2 names cleared") && window.take_told().contains("2 names cleared."));
    window.click("Undo what the message tells of");
    assert_eq!(window.session().joint_names().all().len(), 2);
    window.assert_shows("Undone: name 2 bones");
    assert!(!window.shows("Undo what the message tells of"));
}

#[test]
fn the_step_that_a_message_offers_to_undo_is_its_own() {
    let mut window = window(WIDE, crate::skeleton::chains(5));
    let (joint, name) = (JointIndex(1), "L arm".to_owned());
    window.apply(NameCommand::Rename { joint, name });
    assert!(window.shows("Undo what the message tells of"));
    window.apply(SubmeshCommand::SetVisible {
        submesh: 0,
        visible: false,
    });
    assert!(window.shows("Bone 1 is named L arm") && !window.shows("Undo what the message tells of"));
}

#[test]
fn what_keys_change_out_of_sight_is_said_and_shown_in_the_same_words() {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    window.take_told();
    for (key, words) in [
        (Key::L, "At the end: There and back"),
        (Key::Num5, "Orthographic"),
        (Key::Num5, "Perspective"),
    ] {
        window.press(Modifiers::NONE, key);
        window.assert_shows(words);
        assert_eq!(window.take_told(), format!("{words}."));
    }
    window.click("Close the message");
    window.click("Speed 1×");
    window.click("Speed: 0.5×");
    assert_eq!(window.take_told(), "Speed 0.5×.");
    assert!(!window.shows("Close the message"), "the chip shows it");
}
