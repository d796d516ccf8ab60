//! The crowd in the model panel, and what a frame of it costs.

use bindpose::scene::FrameCost;
use bindpose::session::{CrowdCommand, LookCommand};
use bindpose::ui::DrawerPage;
use egui::accesskit::{Action, ActionData, Role, Toggled};
use egui::{Key, Modifiers, vec2};

use crate::models::moving;
use crate::page::{WIDE, Window, phone, touch_window, window};

fn open() -> Window {
    window(WIDE, vec![moving("a.m3d")])
}

fn crowd(window: &Window) -> (usize, u32, usize) {
    let crowd = window.session().crowd();
    (crowd.count, crowd.seed, crowd.selected)
}

const COST: FrameCost = FrameCost {
    cpu_secs: Some(0.004_2),
    gpu_secs: Some([0.000_5, 0.000_25, 0.001, 0.0, 0.002]),
    draws: 12,
    vertices: 1_234_567,
    uploaded_bytes: 48_000,
};

fn draw_frame(window: &mut Window, cost: FrameCost) {
    window.harness.state_mut().session.frame_drawn(cost);
}

#[test]
fn a_size_is_chosen_and_the_dice_give_the_next_seed() {
    let mut window = open();
    assert!(window.node("Crowd: 1").toggled() == Some(Toggled::True) && !window.shows("Another seed"));
    for (part, count) in [("Crowd: 10", 10), ("Crowd: 1\u{2009}000", 1000), ("Crowd: 100", 100)] {
        window.click(part);
        assert_eq!(crowd(&window), (count, 1, 0));
        assert_eq!(window.node(part).toggled(), Some(Toggled::True));
        assert_eq!(window.node(part).role(), Role::RadioButton);
    }
    window.click("Another seed");
    window.click("Another seed");
    assert_eq!(crowd(&window), (100, 3, 0));
    assert!(window.shows("Seed 3") && window.shows("Selected 1 of 100"));
}

#[test]
fn seed_and_selection_are_typed_and_what_makes_no_sense_is_refused() {
    let mut window = open();
    window.apply(CrowdCommand::Set { count: 100, seed: 7 });
    let type_into = |window: &mut Window, field: &str, text: &str| {
        window.click(field);
        window.harness.event(egui::Event::Text(text.to_owned()));
        window.press(Modifiers::NONE, Key::Enter);
    };
    type_into(&mut window, "Seed 7", "4294967295");
    type_into(&mut window, "Selected 1 of", "37 of 100");
    assert_eq!(crowd(&window), (100, u32::MAX, 36));
    window.click("Another seed");
    assert_eq!(crowd(&window), (100, 0, 36), "after the last comes the first");
    type_into(&mut window, "Selected 37 of", "101");
    assert!(window.shows("A number from 1 to 100"));
    window.press(Modifiers::NONE, Key::Escape);
    type_into(&mut window, "Seed 0", "-1");
    assert!(window.shows("A whole number up to 4294967295"));
    assert_eq!(crowd(&window), (100, 0, 36));
}

#[test]
fn a_number_that_is_none_of_the_choices_is_still_told() {
    let mut window = open();
    window.apply(CrowdCommand::Set { count: 7, seed: 1 });
    for part in ["Crowd: 1", "Crowd: 10", "Crowd: 100", "Crowd: 1\u{2009}000"] {
        assert_eq!(window.node(part).toggled(), Some(Toggled::False), "{part}");
    }
    assert!(window.shows("Selected 1 of 7") && window.shows("Leave the crowd of 7"));
}

#[test]
fn keys_and_screen_readers_choose_too() {
    let mut window = open();
    window.ask("Crowd: 1", Action::Focus, None);
    window.press(Modifiers::NONE, Key::ArrowRight);
    window.press(Modifiers::NONE, Key::ArrowRight);
    assert_eq!((crowd(&window).0, window.time_secs()), (100, 0.0));
    window.ask("Crowd: 10", Action::Click, None);
    let third = Some(ActionData::Value("3".into()));
    window.ask("Selected 1 of 10", Action::SetValue, third);
    assert_eq!(crowd(&window), (10, 1, 2));
}

#[test]
fn the_cost_of_a_frame_is_read_and_a_window_at_rest_asks_for_no_pass() {
    let mut window = open();
    window.apply(CrowdCommand::Set { count: 100, seed: 1 });
    draw_frame(&mut window, COST);
    window.harness.run();
    for row in [
        "CPU a frame 4.20 ms",
        "GPU a frame 3.75 ms",
        "Vertices a frame 1\u{2009}234\u{2009}567",
        "Uploaded a frame 48.0 kB",
    ] {
        assert!(window.shows(row), "{row}");
    }
    // A new cost is shown a moment later, and then nothing moves.
    let later = FrameCost {
        cpu_secs: None,
        gpu_secs: None,
        vertices: 5,
        ..COST
    };
    draw_frame(&mut window, later);
    window.wait(0.3);
    window.harness.run();
    assert!(window.shows("Vertices a frame 5"));
    assert!(
        window
            .named(|name| name.starts_with("CPU ") || name.starts_with("GPU "))
            .is_empty()
    );
    assert!(
        !window.harness.ctx.has_requested_repaint(),
        "{:?}",
        window.harness.ctx.repaint_causes()
    );
}

#[test]
fn the_cost_of_a_single_frame_at_rest_is_read_too() {
    let mut window = open();
    window.apply(CrowdCommand::Set { count: 100, seed: 1 });
    window.harness.run();
    // A program changes the picture. The window draws it after the panels of that pass.
    let session = &mut window.harness.state_mut().session;
    session.apply(LookCommand::SetExposure(1.0));
    window.harness.step();
    draw_frame(&mut window, COST);
    assert!(window.harness.ctx.has_requested_repaint());
    window.harness.run();
    assert!(window.shows("Vertices a frame 1\u{2009}234\u{2009}567"));
    assert!(!window.harness.ctx.has_requested_repaint());
}

#[test]
fn numbers_change_a_few_times_a_second_while_frames_are_drawn() {
    let mut window = open();
    window.apply(CrowdCommand::Set { count: 10, seed: 1 });
    let mut texts = Vec::new();
    for vertices in 1..=60 {
        draw_frame(&mut window, FrameCost { vertices, ..COST });
        window.harness.step();
        texts.extend(window.named(|name| name.starts_with("Vertices a frame")));
    }
    texts.dedup();
    assert!((3..=6).contains(&texts.len()), "{texts:?}");
}

#[test]
fn a_chip_goes_back_to_one_and_a_phone_has_the_same() {
    for mut window in [
        open(),
        phone(vec![moving("a.m3d")]),
        touch_window(vec2(844.0, 390.0), vec![moving("a.m3d")]),
    ] {
        window.apply(CrowdCommand::Set { count: 100, seed: 5 });
        window.click("Leave the crowd of 100");
        assert_eq!(crowd(&window), (1, 5, 0));
        window.harness.state_mut().state.drawer = Some(DrawerPage::Model);
        window.pass_on();
        window.ask("Crowd: 10", Action::Click, None);
        assert!(window.shows("Another seed") && window.shows("Seed 5"));
        assert_eq!(crowd(&window), (10, 5, 0));
    }
}
