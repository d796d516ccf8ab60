//! The strip: transport, bar, menus.

use bindpose::anim::{LoopMode, WrapMode};
use bindpose::model::JointIndex;
use bindpose::session::{FileCommand, PlayCommand, SPEEDS};
use bindpose::ui::Request;
use egui::accesskit::{Action, ActionData, Role, Toggled};
use egui::{Event, Key, Modifiers, pos2, vec2};

use crate::dope_sheet::wheel;
use crate::models::{self, moving, still};
use crate::page::{PHONE, WIDE, Window, phone, touch_window, window};
use crate::rigs::{growing, rig};

fn playing() -> Window {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    window.apply(PlayCommand::Play);
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
    window.apply(PlayCommand::Seek { time_secs: 0.5 });
    window.apply(PlayCommand::Pause);
    window.apply(PlayCommand::Seek { time_secs: 0.5 });
    assert!(window.shows("Time 0.500 / 1.000 s") && window.shows("Frame 15 / 30"));
}

#[test]
fn dragging_on_the_bar_seeks_while_it_plays_and_playing_goes_on_from_there() {
    let mut window = playing();
    let bar = window.rect("Time");
    let at = |share: f32| pos2(bar.min.x + share * bar.width(), bar.center().y);
    window.harness.hover_at(at(0.2));
    window.harness.drag_at(at(0.2));
    window.harness.hover_at(at(0.5));
    window.hover_at(at(0.6));
    assert!(window.session().is_scrubbing());
    let held = window.time_secs();
    assert!((held - 0.6).abs() < 0.02, "{held}");
    window.wait(0.5);
    assert_eq!(window.time_secs(), held, "held still");
    window.hover_at(at(2.0));
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
    window.click("Time");
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
        for item in [
            "Bend, 0.00–1.00 s · 62 keys · 30 a second · a.m3d",
            "Turn, 0.50–2.50 s · 122 keys · 30 a second · a.m3d",
            "Still, 0.25–0.25 s · 2 keys · 30 a second · a.m3d",
        ] {
            assert!(window.shows(item), "{item}");
        }
        window.click("Turn, 0.50");
        assert_eq!(window.session().clip_index(), Some(1));
        assert!(
            window.shows("Clip Turn") && window.named(|name| name.starts_with("Turn, ")).is_empty(),
            "the menu is shut"
        );
        window.rect("Time 0.500 ");
        assert!(window.shows("Frame 0 / 60"));
    }
}

#[test]
fn the_speed_menu_lists_all_speeds_and_sets_one() {
    for mut window in [window(WIDE, vec![moving("a.m3d")]), phone(vec![moving("a.m3d")])] {
        window.click("Speed 1×");
        let items = window.named(|name| name.starts_with("Speed: "));
        assert_eq!(items.len(), SPEEDS.len());
        window.click("Speed: 0.25×");
        assert_eq!(window.session().playback().speed(), 0.25);
        assert!(window.shows("Speed 0.25×"));
    }
}

#[test]
fn the_loop_button_goes_through_the_modes() {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    for (label, next) in [
        ("At the end: loops", LoopMode::PingPong),
        ("At the end: plays there and back", LoopMode::Once),
        ("At the end: plays once", LoopMode::Loop),
    ] {
        window.click(label);
        assert_eq!(window.session().playback().loop_mode(), next);
    }
    assert!(window.shows("At the end: loops"));
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
                .named(|name| name.contains("Space") || name.starts_with("Time ") || name.starts_with("Speed"))
                .is_empty()
        );
    }
}

#[test]
fn buttons_step_by_frames_and_keys_and_play_backward() {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    let frame = |window: &Window| (window.time_secs() * 30.0 * 1000.0).round() / 1000.0;
    for (button, expected) in [
        ("One frame on", 1.0),
        ("Next key", 2.0),
        ("Previous key", 1.0),
        ("One frame back", 0.0),
    ] {
        window.click(button);
        assert_eq!(frame(&window), expected, "{button}");
    }
    window.harness.event(Event::ModifiersChanged(Modifiers::SHIFT));
    window.click("One frame on");
    assert_eq!(frame(&window), 10.0, "with Shift ten");
    window.harness.event(Event::ModifiersChanged(Modifiers::NONE));
    window.click("Backward");
    assert!(window.session().is_animating() && window.session().playback().is_backward());
    window.click("Backward");
    assert!(!window.session().is_animating());
}

/// Types over what a read-out says.
fn type_into(window: &mut Window, read_out: &str, typed: &str, end: Key) {
    window.click(read_out);
    window.type_text(typed);
    window.press(Modifiers::NONE, end);
}

#[test]
fn time_and_frame_are_typed() {
    for mut window in [window(WIDE, vec![moving("a.m3d")]), phone(vec![moving("a.m3d")])] {
        type_into(&mut window, "Time 0.000 ", "0.25", Key::Enter);
        assert_eq!(window.time_secs(), 0.25);
        type_into(&mut window, "Time 0.250 ", "0,5 s", Key::Enter);
        assert_eq!(window.time_secs(), 0.5);
        type_into(&mut window, "Frame 15 / 30", "7.5", Key::Enter);
        assert_eq!(window.time_secs(), 0.25);
        type_into(&mut window, "Time 0.250 ", "f15", Key::Enter);
        assert_eq!(window.time_secs(), 0.5);
        type_into(&mut window, "Frame 15 / 30", "0.25 s", Key::Enter);
        assert_eq!(window.time_secs(), 0.25);
        type_into(&mut window, "Time 0.250 ", "0.9", Key::Escape);
        assert_eq!(window.time_secs(), 0.25, "Esc leaves it");
        window.rect("Time 0.250 ");
    }
}

#[test]
fn a_click_elsewhere_takes_what_was_typed_if_it_makes_sense() {
    for (size, mut window) in [
        (WIDE, window(WIDE, vec![moving("a.m3d")])),
        (PHONE, phone(vec![moving("a.m3d")])),
    ] {
        let click_beside = |window: &mut Window| {
            let at = pos2(0.85 * size.x, 0.3 * size.y);
            window.click_at(at);
            window.wait(0.6);
        };
        let type_and_click = |window: &mut Window, read_out: &str, typed: &str| {
            window.click(read_out);
            window.type_text(typed);
            click_beside(window);
        };
        type_and_click(&mut window, "Time 0.000 ", "0.25");
        assert_eq!(window.time_secs(), 0.25);
        type_and_click(&mut window, "Time 0.250 ", "soon");
        assert_eq!(window.time_secs(), 0.25, "it makes no sense");
        window.rect("Time 0.250 ");
        window.apply(PlayCommand::Play);
        window.click("Time 0.");
        click_beside(&mut window);
        assert!(window.session().playback().is_playing(), "nothing was typed");
        window.apply(PlayCommand::Pause);
        window.apply(PlayCommand::Seek { time_secs: 0.0 });
        // What went away with its popover does not come back.
        window.click("Speed 1×");
        window.click("Times as fast 1×");
        window.type_text("3");
        window.click("Speed 1×");
        window.click("Speed 1×");
        window.rect("Times as fast 1×");
        assert_eq!(window.session().playback().speed(), 1.0);
    }
}

#[test]
fn a_time_that_is_typed_while_it_plays_pauses_there() {
    let mut window = playing();
    type_into(&mut window, "Time 0.", "0.5", Key::Enter);
    assert!(!window.session().playback().is_playing());
    assert_eq!(window.time_secs(), 0.5);
    window.apply(PlayCommand::Play);
    let name = window.named(|name| name.starts_with("Frame 1")).remove(0).0;
    type_into(&mut window, &name, "3", Key::Enter);
    assert!(!window.session().playback().is_playing());
    assert!((window.time_secs() - 0.1).abs() < 1e-6);
}

#[test]
fn a_field_that_refuses_says_why_and_keeps_what_was_typed_until_esc() {
    for mut window in [window(WIDE, vec![moving("a.m3d")]), phone(vec![moving("a.m3d")])] {
        for (field, typed, why) in [
            ("Time 0.000 ", "1.3", "Beyond the clip's end, 1 s"),
            ("Time 0.000 ", "soon", "Type seconds, 0.33 s, or a frame, f20"),
            ("Frame 0 / 30", "99", "Beyond the last frame, 30"),
        ] {
            type_into(&mut window, field, typed, Key::Enter);
            window.assert_shows(why);
            assert_eq!(window.time_secs(), 0.0);
            let name = if field.starts_with("Time") {
                "Type the time"
            } else {
                "Type the frame"
            };
            assert_eq!(window.focused().as_deref(), Some(name));
            assert_eq!(window.value_of(name).as_deref(), Some(typed), "it is kept");
            window.press(Modifiers::NONE, Key::Escape);
            assert!(!window.shows(why) && !window.shows(name));
        }
        type_into(&mut window, "Time 0.000 ", "2", Key::Enter);
        window.press(Modifiers::NONE, Key::Backspace);
        assert!(
            !window.shows("Beyond the clip's end, 1 s"),
            "what is typed anew is not refused yet"
        );
        window.type_text("1");
        window.press(Modifiers::NONE, Key::Enter);
        assert_eq!(window.time_secs(), 1.0);
    }
}

#[test]
fn fields_stay_where_they_are_while_somebody_types() {
    for mut window in [window(WIDE, vec![moving("a.m3d")]), phone(vec![moving("a.m3d")])] {
        window.click("Speed 1×");
        let rects = |window: &Window| {
            let kept = [
                "Out 1.000 s",
                "Clear",
                "Speed: 1×",
                "At the end: Loop",
                "Loop gap of the clip",
            ];
            window.named(|name| kept.contains(&name))
        };
        let before = rects(&window);
        assert!(before.len() >= 4, "{before:?}");
        for field in ["Times as fast 1×", "In 0.000 s"] {
            window.click(field);
            assert_eq!(rects(&window), before, "while {field} is typed");
            window.type_text("12345678901234567890");
            assert_eq!(rects(&window), before, "{field} with a long text");
            window.press(Modifiers::NONE, Key::Enter);
            assert_eq!(rects(&window), before, "{field} refused");
            window.press(Modifiers::NONE, Key::Escape);
            assert_eq!(rects(&window), before);
        }
    }
}

#[test]
fn speed_loop_wrap_and_range_are_set_in_one_place() {
    for mut window in [window(WIDE, vec![moving("a.m3d")]), phone(vec![moving("a.m3d")])] {
        window.click("Speed 1×");
        type_into(&mut window, "Times as fast 1×", "0.3", Key::Enter);
        assert_eq!(window.session().playback().speed(), 0.3);
        type_into(&mut window, "Times as fast 0.3×", "100", Key::Enter);
        assert!(window.shows("A number from 0.05 to 4"));
        window.press(Modifiers::NONE, Key::Escape);
        assert_eq!(window.session().playback().speed(), 0.3);
        let explained = |window: &Window| {
            window
                .named(|name| name.starts_with("A step past the end goes"))
                .remove(0)
        };
        let wrap = explained(&window);
        window.click("Loop: As the book's demo");
        assert_eq!(window.session().playback().wrap_mode(), WrapMode::BookDemo);
        let book_demo = explained(&window);
        assert!(book_demo.0.contains("back to time 0") && !wrap.0.contains("back to time 0"));
        assert_eq!(book_demo.1, wrap.1, "nothing moves");
        window.click("At the end: Once");
        assert_eq!(window.session().playback().loop_mode(), LoopMode::Once);
        assert!(window.node("Loop: Wrap").is_disabled(), "only a loop wraps");
        type_into(&mut window, "In 0.000 s", "0.2", Key::Enter);
        type_into(&mut window, "Out 1.000 s", "0.8 s", Key::Enter);
        assert_eq!(window.session().playback().range_secs(), Some([0.2, 0.8]));
        type_into(&mut window, "In 0.200 s", "f9", Key::Enter);
        type_into(&mut window, "Out 0.800 s", "27 f", Key::Enter);
        assert_eq!(window.session().playback().range_secs(), Some([0.3, 0.9]));
        type_into(&mut window, "In 0.300 s", "1", Key::Enter);
        assert!(window.shows("A range needs some length after its start"));
        window.press(Modifiers::NONE, Key::Escape);
        type_into(&mut window, "In 0.300 s", "0.95", Key::Enter);
        assert!(window.shows("Beyond the range's end, 0.9 s"));
        window.press(Modifiers::NONE, Key::Escape);
        type_into(&mut window, "Out 0.900 s", "0.2", Key::Enter);
        assert!(window.shows("Before the range's start, 0.3 s"));
        window.press(Modifiers::NONE, Key::Escape);
        assert_eq!(
            window.session().playback().range_secs(),
            Some([0.3, 0.9]),
            "no end moves the other"
        );
        window.click("Clear");
        assert_eq!(window.session().playback().range_secs(), None);
        assert!(window.shows("Times as fast 0.3×"), "it stays open");
    }
}

#[test]
fn an_end_of_the_range_shows_its_value_while_it_is_dragged() {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    window.click("Speed 1×");
    let bar = window.rect("Time");
    let from = window.rect("Range in").center();
    window.harness.hover_at(from);
    window.harness.drag_at(from);
    for share in [0.2, 0.3] {
        let at = pos2(bar.min.x + 12.0 + share * (bar.width() - 24.0), bar.center().y);
        window.hover_at(at);
        let frame = (share * 30.0).round();
        let told = format!("Range in {share:.3} s, frame {frame}");
        window.assert_shows(&told);
        assert!(window.shows(&format!("In {share:.3} s")), "the field beside it follows");
    }
    let field = window.rect("In 0.300 s");
    window.harness.drop_at(field.center());
    window.pass_on();
    assert!(window.shows("In 0.300 s"), "a drag does not shut the popover");
}

#[test]
fn the_choices_at_the_end_have_room_in_windows_of_all_sizes_and_nothing_shines_through() {
    for mut window in [
        window(WIDE, vec![moving("a.m3d")]),
        window(vec2(900.0, 420.0), vec![moving("a.m3d")]),
        phone(vec![moving("a.m3d")]),
        touch_window(vec2(320.0, 568.0), vec![moving("a.m3d")]),
    ] {
        let fill = window.harness.ctx.global_style().visuals.window_fill;
        assert!(fill.is_opaque(), "of menus and tooltips: {fill:?}");
        window.click("Speed 1×");
        let size = window.harness.ctx.content_rect();
        for (label, least) in [("Once", 40.0), ("Loop", 40.0), ("There and back", 94.0)] {
            let rect = window.rect(&format!("At the end: {label}"));
            assert!(rect.width() >= least, "{label}: {rect} in {size}");
            assert!(
                size.x_range().contains(rect.min.x) && size.x_range().contains(rect.max.x),
                "{rect}"
            );
        }
    }
}

#[test]
fn the_ends_of_the_range_are_dragged_on_the_bar_from_frame_to_frame() {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    let bar = window.rect("Time");
    let at = |share: f32| pos2(bar.min.x + 12.0 + share * (bar.width() - 24.0), bar.center().y);
    let drag = |window: &mut Window, name: &str, share: f32| {
        let from = window.rect(name).center();
        window.harness.hover_at(from);
        window.harness.drag_at(from);
        window.hover_at(at(share));
        window.harness.drop_at(at(share));
        window.pass_on();
    };
    drag(&mut window, "Range in", 0.31);
    assert_eq!(window.session().playback().range_secs(), Some([0.3, 1.0]));
    drag(&mut window, "Range out", 0.69);
    let [start, end] = window.session().playback().range_secs().expect("a range");
    assert!(start == 0.3 && (end - 0.7).abs() < 1e-6);
    assert_eq!(window.time_secs(), 0.0, "the time stays");
    drag(&mut window, "Range out", 0.1);
    let [start, end] = window.session().playback().range_secs().expect("a range");
    assert!(start == 0.3 && (end - 1.0 / 3.0).abs() < 1e-6, "a frame is left");
    drag(&mut window, "Range in", -0.2);
    drag(&mut window, "Range out", 1.2);
    assert_eq!(window.session().playback().range_secs(), None, "all of it is no range");
}

#[test]
fn the_bar_and_the_ends_of_the_range_are_sliders() {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    let slider = |window: &Window, name: &str| {
        let node = window.node(name);
        assert_eq!(node.role(), Role::Slider);
        let numbers = [
            node.min_numeric_value(),
            node.numeric_value(),
            node.max_numeric_value(),
            node.numeric_value_step(),
        ];
        let numbers = numbers.map(|number| (number.expect("a number") * 1000.0).round());
        (numbers, node.value().expect("words"))
    };
    window.apply(PlayCommand::Seek { time_secs: 0.5 });
    let words = "0.50 of 1.00 seconds, frame 15 of 30".to_owned();
    assert_eq!(slider(&window, "Time"), ([0.0, 500.0, 1000.0, 33.0], words));
    window.ask("Time", Action::Increment, None);
    assert!((window.time_secs() - 16.0 / 30.0).abs() < 1e-6);
    window.ask("Time", Action::Decrement, None);
    assert_eq!(window.time_secs(), 0.5);
    window.apply(PlayCommand::Play);
    window.ask("Time", Action::SetValue, Some(ActionData::NumericValue(0.25)));
    assert_eq!((window.time_secs(), window.session().is_animating()), (0.25, false));
    window.ask("Range in", Action::SetValue, Some(ActionData::NumericValue(0.2)));
    window.ask("Range out", Action::Decrement, None);
    let range = window.session().playback().range_secs().expect("a range");
    assert!((range[0] - 0.2).abs() < 1e-6 && (range[1] - 29.0 / 30.0).abs() < 1e-6);
    let words = "0.200 s, frame 6".to_owned();
    assert_eq!(slider(&window, "Range in"), ([0.0, 200.0, 933.0, 33.0], words));
    window.ask(
        "Time 0.250 / 1.000 s",
        Action::SetValue,
        Some(ActionData::Value("f3".into())),
    );
    assert!((window.time_secs() - 0.1).abs() < 1e-6, "a read-out takes a text");
}

#[test]
fn the_keys_of_the_bar_and_of_the_ends_of_the_range_are_theirs_alone() {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    window.ask("Time", Action::Focus, None);
    let frame = |window: &Window| (window.time_secs() * 30.0).round() as i32;
    for (modifiers, key, expected) in [
        (Modifiers::NONE, Key::ArrowRight, 1),
        (Modifiers::NONE, Key::ArrowUp, 2),
        (Modifiers::SHIFT, Key::ArrowRight, 12),
        (Modifiers::NONE, Key::ArrowLeft, 11),
        (Modifiers::NONE, Key::PageUp, 12),
        (Modifiers::NONE, Key::PageDown, 11),
        (Modifiers::NONE, Key::End, 30),
        (Modifiers::SHIFT, Key::ArrowDown, 20),
        (Modifiers::NONE, Key::Home, 0),
    ] {
        window.press(modifiers, key);
        assert_eq!(frame(&window), expected, "{key:?}");
        assert_eq!(window.focused().as_deref(), Some("Time"), "{key:?}");
    }
    // A mouse that happens to be over it does not make a click of Enter.
    let bar = window.rect("Time");
    window.harness.hover_at(bar.center());
    window.press(Modifiers::NONE, Key::Enter);
    assert_eq!(frame(&window), 0);
    window.ask("Range in", Action::Focus, None);
    let range = |window: &Window| {
        window
            .session()
            .playback()
            .played_secs()
            .map(|secs| (secs * 30.0).round() as i32)
    };
    for (modifiers, key, expected) in [
        (Modifiers::NONE, Key::ArrowRight, [1, 30]),
        (Modifiers::SHIFT, Key::ArrowRight, [11, 30]),
        (Modifiers::NONE, Key::End, [29, 30]),
        (Modifiers::NONE, Key::PageDown, [19, 30]),
    ] {
        window.press(modifiers, key);
        assert_eq!(range(&window), expected, "{key:?}");
    }
    assert_eq!(frame(&window), 0, "the time stays");
    window.ask("Range out", Action::Focus, None);
    window.press(Modifiers::NONE, Key::Home);
    assert_eq!(range(&window), [19, 20]);
}

#[test]
fn tab_goes_through_the_strip_in_reading_order_and_choices_have_values() {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    window.ask("First frame (Home)", Action::Focus, None);
    let mut order = Vec::new();
    for _ in 0..17 {
        order.push(window.focused().expect("something has the focus"));
        window.tab(false);
    }
    let starts = [
        "First frame",
        "Previous key",
        "One frame back",
        "Backward",
        "Play",
        "One frame on",
        "Next key",
        "Last frame",
        "Clip Bend",
        "Time",
        "Range in",
        "Range out",
        "Time 0.000",
        "Frame 0 / 30",
        "Speed 1×",
        "At the end: loops",
        "Dope sheet and curves",
    ];
    let right = order.iter().zip(starts).all(|(name, start)| name.starts_with(start));
    assert!(right, "{order:?}");
    let toggled = |window: &Window, start: &str| {
        let name = window.named(|name| name.starts_with(start)).remove(0).0;
        window.node(&name).toggled().is_some()
    };
    assert!(toggled(&window, "Backward"));
    assert!(!toggled(&window, "One frame on") && !toggled(&window, "Play ("));
    let clip = window.node("Clip Bend");
    assert_eq!(
        clip.label().zip(clip.value()),
        Some(("Clip".to_owned(), "Bend".to_owned()))
    );
    window.ask("Clip Bend", Action::Expand, None);
    assert!(window.shows("Add clips…"));
    window.ask("Clip Bend", Action::Collapse, None);
    assert!(!window.shows("Add clips…"));
}

#[test]
fn a_loop_gap_that_is_seen_is_told() {
    let window = window(WIDE, vec![moving("a.m3d")]);
    let angle = (1.2 * 6.0_f32.sin()).abs().to_degrees();
    let words = format!(
        "The loop has a visible gap from the last pose to the first: Bone 1 turns by {angle:.2}° relative to its parent."
    );
    let told = window.named(|name| name == words);
    assert_eq!(told.len(), 1, "{:?}", window.widgets());
}

#[test]
fn of_a_range_the_loop_gap_between_its_ends_is_told_and_its_mark_stands_there() {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    let whole = window.rect("The loop has a visible gap").center().x;
    window.apply(PlayCommand::SetRangeStart(Some(0.25)));
    window.apply(PlayCommand::SetRangeEnd(Some(0.5)));
    let told = window.named(|name| name.contains("from the range's last pose to its first"));
    assert_eq!(told.len(), 1, "{:?}", window.widgets());
    let bar = window.rect("Time");
    assert!((told[0].1.center().x - bar.center().x).abs() < 1.0 && whole > bar.max.x - 20.0);
    // As far before the turning point of the swing as after it the pose is the same.
    let turning_secs = 0.25 * std::f32::consts::TAU / 0.2 / 30.0;
    window.apply(PlayCommand::ClearRange);
    window.apply(PlayCommand::SetRangeStart(Some(turning_secs - 0.2)));
    window.apply(PlayCommand::SetRangeEnd(Some(turning_secs + 0.2)));
    assert!(
        window
            .named(|name| name.starts_with("The loop has a visible gap"))
            .is_empty()
    );
    window.apply(PlayCommand::ClearRange);
    window.apply(PlayCommand::SetLoopMode(LoopMode::PingPong));
    assert!(
        window
            .named(|name| name.starts_with("The loop has a visible gap"))
            .is_empty()
    );
}

#[test]
fn the_loop_gap_of_each_bone_is_listed_and_a_row_selects_its_bone() {
    for mut window in [window(WIDE, vec![moving("a.m3d")]), phone(vec![moving("a.m3d")])] {
        window.click("Speed 1×");
        assert!(window.shows("Loop gap of the clip"));
        let rows = |window: &Window| {
            let mut rows = window.named(|name| name.starts_with("Loop gap of Bone "));
            rows.sort_by(|a, b| a.1.min.y.total_cmp(&b.1.min.y));
            rows.into_iter().map(|(name, _)| name).collect::<Vec<_>>()
        };
        // Bone 1 turns on the spot by 1.2 sin 6, which carries nothing that is a joint.
        let angle = (1.2 * 6.0_f32.sin()).abs().to_degrees();
        assert_eq!(
            rows(&window),
            [
                format!("Loop gap of Bone 1: distance 0, angle {angle:.2}°"),
                "Loop gap of Bone 0: distance 0, angle 0".to_owned(),
            ]
        );
        let row = rows(&window).remove(0);
        let over = window.rect("Loop gap of the clip").center();
        wheel(&mut window, over, vec2(0.0, -200.0), Modifiers::NONE);
        window.click(&row);
        assert_eq!(window.session().joints().selected(), Some(JointIndex(1)));
        assert!(window.shows("Loop gap of the clip"), "it stays open");
        window.apply(PlayCommand::SetRangeEnd(Some(0.5)));
        assert!(window.shows("Loop gap of the range"));
        let angle = (1.2 * 3.0_f32.sin()).abs().to_degrees();
        assert_eq!(
            rows(&window)[0],
            format!("Loop gap of Bone 1: distance 0, angle {angle:.2}°")
        );
        window.apply(PlayCommand::SetLoopMode(LoopMode::Once));
        assert!(window.node(&rows(&window)[0]).is_disabled(), "nothing loops");
    }
}

#[test]
fn where_nothing_jumps_that_is_said() {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    window.click("Speed 1×");
    let turning_secs = 0.25 * std::f32::consts::TAU / 0.2 / 30.0;
    window.apply(PlayCommand::SetRangeStart(Some(turning_secs - 0.2)));
    window.apply(PlayCommand::SetRangeEnd(Some(turning_secs + 0.2)));
    assert!(window.shows("No jump from the last pose to the first is seen."));
    window.apply(PlayCommand::SelectClip(2));
    assert!(
        window.named(|name| name.starts_with("Loop gap of")).is_empty(),
        "one pose loops nowhere"
    );
    window.apply(FileCommand::Add(vec![growing()]));
    assert!(window.shows("Loop gap of Bone 0: distance 0, angle 0, scales by 50.0 %"));
    window.apply(FileCommand::Add(vec![rig(1, 31)]));
    assert!(window.shows("The last pose is the first one again."));
    assert!(window.named(|name| name.starts_with("Loop gap of Bone ")).is_empty());
}

#[test]
fn of_many_bones_only_the_rows_in_view_are_laid_out_and_the_pointer_lights_them_up() {
    let mut window = window(WIDE, vec![rig(2000, 31)]);
    window.click("Speed 1×");
    let rows = window.named(|name| name.starts_with("Loop gap of Bone "));
    assert!((6..=8).contains(&rows.len()), "{}", rows.len());
    let distances: Vec<f32> = rows
        .iter()
        .map(|(name, _)| {
            let distance = name.split_once("distance ").and_then(|(_, rest)| rest.split_once(','));
            distance
                .and_then(|(number, _)| number.parse().ok())
                .unwrap_or_else(|| panic!("{name}"))
        })
        .collect();
    assert!(
        distances.is_sorted_by(|a, b| a >= b) && distances[0] > 0.0,
        "{distances:?}"
    );
    let (name, rect) = &rows[2];
    window.hover_at(rect.center());
    let hovered = window.session().joints().hovered().expect("it stands out");
    assert!(
        name.starts_with(&format!("Loop gap of Bone {}:", hovered.0)),
        "{name} {hovered:?}"
    );
}

#[test]
fn clips_are_blended_faded_and_added() {
    for mut window in [window(WIDE, vec![moving("a.m3d")]), phone(vec![moving("a.m3d")])] {
        window.click("Clip Bend");
        window.click("Add clips…");
        assert_eq!(window.harness.state().requests, [Request::PickClips]);
        window.click("Blend with Turn");
        assert_eq!(
            window.session().blend().map(|blend| (blend.clip, blend.weight)),
            Some((1, 0.5))
        );
        let weight = window.rect("Weight");
        let at = pos2(weight.max.x - 6.0, weight.center().y);
        window.click_at(at);
        assert_eq!(window.session().blend().map(|blend| blend.weight), Some(1.0));
        window.click("End the blend with Turn");
        assert_eq!(window.session().blend(), None);
        let fade = window.rect("Crossfade");
        let at = fade.center();
        window.click_at(at);
        assert!((window.session().crossfade_secs() - 1.0).abs() < 0.05);
        window.apply(FileCommand::AddClips(vec![moving("more.m3d")]));
        let added = window.named(|name| name.contains("more.m3d"));
        assert_eq!(added.len(), 3, "{added:?}");
        window.apply(FileCommand::AddClips(vec![moving("more.m3d")]));
        let again = window.named(|name| name.contains("more.m3d") && !name.contains("replace"));
        assert_eq!(again, added, "the same file once more takes their places");
        window.press(Modifiers::NONE, Key::Escape);
        let told = "more.m3d was added before; its 3 clips replace the 3 clips from then.";
        assert!(window.session().diagnostics().any(|notice| notice.message == told));
    }
}

#[test]
fn a_clip_that_walks_away_has_a_switch_for_staying_in_place() {
    let mut document = models::skinned(&[("Walk", 0.0, 31), ("Bend", 0.0, 31)]);
    for (step, key) in document.clips[0].bones[0].keyframes.iter_mut().enumerate() {
        key.translation[2] = 0.1 * step as f32;
    }
    let file = || vec![models::file("walk.m3d", &document)];
    for mut window in [window(WIDE, file()), phone(file())] {
        window.click("Clip Walk");
        for (on, kept) in [(Toggled::True, &["Walk"][..]), (Toggled::False, &[])] {
            assert_ne!(window.node("In place").toggled(), Some(on));
            window.click("In place");
            assert_eq!(window.node("In place").toggled(), Some(on));
            assert_eq!(window.session().view_state().playback.in_place, kept);
        }
        window.apply(PlayCommand::SelectClip(1));
        assert!(
            window.shows("Add clips…") && !window.shows("In place"),
            "what bends stays"
        );
    }
}

#[test]
fn the_panel_of_the_speed_keeps_its_height_whatever_happens_at_the_end() {
    for mut window in [window(WIDE, vec![moving("a.m3d")]), phone(vec![moving("a.m3d")])] {
        window.click("Speed 1×");
        let heading = window.rect("At the end");
        for mode in ["There and back", "Once", "Loop"] {
            window.click(&format!("At the end: {mode}"));
            assert_eq!(window.rect("At the end"), heading, "{mode}");
            assert!(window.shows("Loop gap of the clip"), "{mode}");
        }
    }
}
