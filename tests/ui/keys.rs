//! Each key of the table does what the table says.

use bindpose::actions::{self, Group};
use bindpose::anim::LoopMode;
use bindpose::scene::{Light, Overlay, Projection, ViewMode, ViewPreset};
use bindpose::session::{CameraCommand, File, FileCommand, JointCommand, PlayCommand, SPEEDS, SubmeshCommand};
use bindpose::ui::Request;
use egui::{Event, Key, Modifiers, MouseWheelUnit, PointerButton, Pos2, vec2};

use crate::models::moving;
use crate::page::{WIDE, Window, button_event, key_event, wheel_event, window};
use crate::skeleton::tree;

const PLAIN: Modifiers = Modifiers::NONE;
const SHIFT: Modifiers = Modifiers::SHIFT;
const CTRL: Modifiers = Modifiers::COMMAND;

fn open() -> Window {
    window(WIDE, vec![moving("a.m3d")])
}

#[track_caller]
fn assert_frame(window: &Window, frame: f32) {
    let at = window.time_secs() * 30.0;
    assert!((at - frame).abs() < 1e-3, "frame {at} instead of {frame}");
}

/// The README's table of keys: two rows beside each other, the first half on the left.
fn readme_table() -> String {
    let cells: Vec<String> = Group::ALL
        .into_iter()
        .flat_map(actions::rows)
        .map(|row| format!("`{}` | {}", actions::keys_of(row), row[0].does))
        .collect();
    let (left, right) = cells.split_at(cells.len().div_ceil(2));
    let mut table = "| key | does | | key | does |\n|---|---|---|---|---|\n".to_owned();
    for (index, cell) in left.iter().enumerate() {
        let other = right.get(index).map_or(" | ", String::as_str);
        table += &format!("| {cell} | | {other} |\n");
    }
    table
}

#[test]
fn the_readme_has_the_table_of_actions() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/README.md");
    let readme = std::fs::read_to_string(path).expect("the README");
    let start = readme.find("| key | does |").expect("the table of keys");
    let end = start + readme[start..].find("\n\n").expect("its end") + 1;
    let table = readme_table();
    if std::env::var_os("BLESS").is_some() {
        let renewed = format!("{}{table}{}", &readme[..start], &readme[end..]);
        std::fs::write(path, renewed).expect("the README is written");
        return;
    }
    assert_eq!(&readme[start..end], table, "BLESS=1 writes it anew");
}

#[test]
fn space_plays_and_pauses_and_shift_space_plays_backward() {
    let mut window = open();
    window.press(PLAIN, Key::Space);
    assert!(window.session().is_animating() && !window.session().playback().is_backward());
    window.press(PLAIN, Key::Space);
    assert!(!window.session().is_animating());
    window.press(SHIFT, Key::Space);
    assert!(window.session().is_animating() && window.session().playback().is_backward());
}

#[test]
fn a_key_that_is_held_steps_on_and_switches_once() {
    let mut window = open();
    let hold = |window: &mut Window, key: Key| {
        for _ in 0..4 {
            window.harness.event(key_event(key, true));
            window.pass_on();
        }
        window.harness.event(key_event(key, false));
        window.pass_on();
    };
    hold(&mut window, Key::ArrowRight);
    assert_frame(&window, 4.0);
    hold(&mut window, Key::OpenBracket);
    assert_eq!(window.session().playback().speed(), SPEEDS[1], "four down from 1");
    let grid = window.session().look().overlays.has(Overlay::Grid);
    hold(&mut window, Key::G);
    assert_eq!(window.session().look().overlays.has(Overlay::Grid), !grid);
    hold(&mut window, Key::P);
    assert_eq!(window.harness.state().requests.len(), 1, "one picture");
    hold(&mut window, Key::R);
    assert_eq!(window.harness.state().requests.len(), 2, "read once");
}

#[test]
fn arrows_step_one_frame_and_ten_with_shift() {
    let mut window = open();
    for (modifiers, key, frame) in [
        (PLAIN, Key::ArrowRight, 1.0),
        (SHIFT, Key::ArrowRight, 11.0),
        (PLAIN, Key::ArrowLeft, 10.0),
        (PLAIN, Key::Period, 11.0),
        (PLAIN, Key::Comma, 10.0),
        (SHIFT, Key::ArrowLeft, 0.0),
        (PLAIN, Key::ArrowLeft, 0.0),
        (PLAIN, Key::End, 30.0),
        (PLAIN, Key::ArrowRight, 30.0),
        (PLAIN, Key::Home, 0.0),
    ] {
        window.press(modifiers, key);
        assert_frame(&window, frame);
    }
}

#[test]
fn up_and_down_go_from_key_to_key() {
    let mut window = open();
    for (key, frame) in [
        (Key::ArrowUp, 1.0),
        (Key::ArrowUp, 2.0),
        (Key::ArrowDown, 1.0),
        (Key::ArrowDown, 0.0),
        (Key::ArrowDown, 0.0),
    ] {
        window.press(PLAIN, key);
        assert_frame(&window, frame);
    }
}

#[test]
fn i_and_o_set_the_range_and_shift_i_clears_it() {
    let mut window = open();
    let range = |window: &Window| window.session().playback().range_secs();
    window.apply(PlayCommand::Seek { time_secs: 0.25 });
    window.press(PLAIN, Key::I);
    assert_eq!(range(&window), Some([0.25, 1.0]));
    window.apply(PlayCommand::Seek { time_secs: 0.75 });
    window.press(PLAIN, Key::O);
    assert_eq!(range(&window), Some([0.25, 0.75]));
    window.press(PLAIN, Key::Home);
    assert_eq!(window.time_secs(), 0.25, "the first frame is the range's");
    window.press(SHIFT, Key::I);
    assert_eq!(range(&window), None);
}

#[test]
fn brackets_change_the_speed_and_the_backslash_sets_it_back() {
    let mut window = open();
    for (key, speed) in [
        (Key::OpenBracket, 0.75),
        (Key::OpenBracket, 0.5),
        (Key::CloseBracket, 0.75),
        (Key::Backslash, 1.0),
        (Key::CloseBracket, 1.25),
    ] {
        window.press(PLAIN, key);
        assert_eq!(window.session().playback().speed(), speed);
    }
    assert!(window.shows("Speed 1.25×"), "the window shows it without another touch");
}

#[test]
fn l_and_c_go_round() {
    let mut window = open();
    window.press(PLAIN, Key::L);
    assert_eq!(window.session().playback().loop_mode(), LoopMode::PingPong);
    for (modifiers, clip) in [(PLAIN, 1), (PLAIN, 2), (PLAIN, 0), (SHIFT, 2), (SHIFT, 1)] {
        window.press(modifiers, Key::C);
        assert_eq!(window.session().clip_index(), Some(clip));
    }
}

#[test]
fn digits_look_from_named_sides_and_again_from_the_opposite_ones() {
    let mut window = open();
    for (key, preset) in [
        (Key::Num1, ViewPreset::Front),
        (Key::Num1, ViewPreset::Back),
        (Key::Num1, ViewPreset::Front),
        (Key::Num3, ViewPreset::Right),
        (Key::Num3, ViewPreset::Left),
        (Key::Num7, ViewPreset::Top),
        (Key::Num7, ViewPreset::Bottom),
        (Key::Num7, ViewPreset::Top),
        (Key::Num1, ViewPreset::Front),
        (Key::Num9, ViewPreset::Isometric),
        (Key::Num9, ViewPreset::Isometric),
        (Key::Num0, ViewPreset::ThreeQuarter),
    ] {
        window.press(PLAIN, key);
        let camera = window.session().camera();
        assert_eq!(
            (camera.yaw_radians, camera.pitch_radians),
            preset.yaw_pitch_radians(),
            "{preset:?}"
        );
    }
    window.press(PLAIN, Key::Num5);
    assert_eq!(window.session().camera().projection, Projection::Orthographic);
    window.press(PLAIN, Key::Num0);
    assert_ne!(window.session().camera().projection, Projection::Orthographic);
}

#[test]
fn alt_and_arrows_orbit_and_pan_and_plus_and_minus_zoom() {
    let mut window = open();
    let alt_shift = Modifiers::ALT | Modifiers::SHIFT;
    let change = |window: &mut Window, modifiers, key| {
        let before = *window.session().camera();
        window.press(modifiers, key);
        (before, *window.session().camera())
    };
    for (key, right, up) in [
        (Key::ArrowLeft, -1.0, 0.0),
        (Key::ArrowRight, 1.0, 0.0),
        (Key::ArrowUp, 0.0, 1.0),
        (Key::ArrowDown, 0.0, -1.0),
    ] {
        let wanted = vec2(right, up);
        let (before, after) = change(&mut window, Modifiers::ALT, key);
        let way = after.eye() - before.eye();
        let turned = vec2(way.dot(before.right()), way.dot(before.up())).normalized();
        assert!((turned - wanted).length() < 0.2, "{key:?} takes the eye {turned:?}");
        assert_eq!(after.target, before.target);

        let (before, after) = change(&mut window, alt_shift, key);
        let way = after.target - before.target;
        let moved = vec2(way.dot(before.right()), way.dot(before.up())).normalized();
        assert!((moved - wanted).length() < 1e-3, "{key:?} takes the camera {moved:?}");
        assert_eq!(
            (after.yaw_radians, after.distance),
            (before.yaw_radians, before.distance)
        );
    }
    for (modifiers, key, nearer) in [
        (PLAIN, Key::Plus, true),
        (SHIFT, Key::Plus, true),
        (PLAIN, Key::Equals, true),
        (PLAIN, Key::Minus, false),
    ] {
        let (before, after) = change(&mut window, modifiers, key);
        assert_eq!(after.distance < before.distance, nearer, "{key:?}");
        assert_ne!(after.distance, before.distance, "{key:?}");
    }
    assert_eq!(window.time_secs(), 0.0, "no frame was stepped");
}

#[test]
fn t_shows_the_view_mode_again_before_it_goes_on() {
    let mut window = open();
    window.press(PLAIN, Key::W);
    assert!(window.session().look().skin_view.is_some());
    let mode = window.session().look().view_mode;
    window.press(PLAIN, Key::T);
    let look = window.session().look();
    assert_eq!(
        (look.skin_view, look.view_mode),
        (None, mode),
        "the colours of the skin go"
    );
    window.press(PLAIN, Key::T);
    assert_eq!(window.session().look().view_mode, mode.cycled(1));
    window.press(PLAIN, Key::W);
    window.press(SHIFT, Key::T);
    window.press(SHIFT, Key::T);
    let look = window.session().look();
    assert_eq!((look.skin_view, look.view_mode), (None, mode));
}

#[test]
fn f_frames_and_g_hides_the_grid() {
    let mut window = open();
    let framed = *window.session().camera();
    window.apply(CameraCommand::Pan { drag: glam::Vec2::ONE });
    assert_ne!(window.session().camera(), &framed);
    window.press(PLAIN, Key::F);
    assert_eq!(window.session().camera(), &framed);
    window.press(PLAIN, Key::G);
    assert!(!window.session().grid_visible());
    window.press(PLAIN, Key::G);
    assert!(window.session().grid_visible());
}

#[test]
fn letters_change_how_the_model_is_looked_at() {
    let mut window = open();
    for (key, overlay) in [
        (Key::Z, Overlay::Wireframe),
        (Key::N, Overlay::Normals),
        (Key::X, Overlay::Axes),
    ] {
        for on in [true, false] {
            window.press(PLAIN, key);
            assert_eq!(window.session().look().overlays.has(overlay), on, "{overlay:?}");
        }
    }
    window.press(PLAIN, Key::T);
    assert_eq!(window.session().look().view_mode, ViewMode::BaseColor);
    assert!(window.shows("View mode: Base colour"));
    window.press(SHIFT, Key::T);
    window.press(SHIFT, Key::T);
    assert_eq!(window.session().look().view_mode, ViewMode::Shadow);
    for light in [Light::Book, Light::Studio] {
        window.press(PLAIN, Key::V);
        assert_eq!(window.session().look().light, light);
        assert!(window.shows(&format!("Lighting: {}", light.label())));
    }
}

#[test]
fn p_asks_for_a_picture_as_large_as_the_window_and_shift_leaves_the_ground_out() {
    let mut window = open();
    window.press(PLAIN, Key::P);
    window.press(SHIFT, Key::P);
    window.press(CTRL, Key::P);
    let size = [1440, 900];
    let pictures = [false, true].map(|transparent| Request::SavePicture {
        size,
        transparent,
        aperture: 0.0,
    });
    assert_eq!(window.harness.state().requests, pictures);
}

#[test]
fn escape_clears_the_selection_last_of_all() {
    let mut window = open();
    window.apply(SubmeshCommand::Select(Some(0)));
    window.click("Lighting");
    window.press(PLAIN, Key::Escape);
    assert!(!window.shows("Exposure") && window.session().submeshes().selected().is_some());
    window.press(PLAIN, Key::Escape);
    assert_eq!(window.session().submeshes().selected(), None);
}

#[test]
fn letters_that_are_typed_are_no_keys() {
    let mut window = open();
    window.click("Lighting");
    window.click("Background: Colour");
    window.click("Background colour: number");
    window.press(PLAIN, Key::Z);
    assert!(!window.session().look().overlays.has(Overlay::Wireframe));
}

#[test]
fn the_question_mark_shows_the_table_and_escape_takes_it_away() {
    let mut window = open();
    window.type_text("?");
    assert!(window.shows("Space: play or pause"));
    window.press(PLAIN, Key::Escape);
    assert!(!window.shows("Space: play or pause"));
    window.click("Help (?)");
    assert!(window.shows("Space: play or pause"));
    window.type_text("?");
    assert!(!window.shows("Space: play or pause"));
}

#[test]
fn the_table_says_what_is_in_force_now() {
    let mut window = open();
    window.type_text("?");
    for (key, off, on) in [
        (Key::Z, "Z: wireframe", "Z: wireframe, now on"),
        (Key::B, "B: bones", "B: bones, now on"),
        (Key::I, "I O: range in, out", "I O: range in, out, now on"),
        (
            Key::L,
            "L: next loop mode, now Loop",
            "L: next loop mode, now There and back",
        ),
        (Key::T, "T: view mode, now Lit", "T: view mode, now Base colour"),
        (Key::V, "V: the other light, now Studio", "V: the other light, now Book"),
    ] {
        let shows = |window: &Window, wanted: &str| !window.named(|name| name == wanted).is_empty();
        assert!(shows(&window, off), "{off}");
        if key == Key::I {
            window.apply(PlayCommand::Seek { time_secs: 0.5 });
        }
        window.press(PLAIN, key);
        assert!(shows(&window, on), "{on}");
    }
}

#[test]
fn escape_takes_away_what_lies_on_top() {
    let mut window = open();
    window.click("Findings");
    window.click("Help (?)");
    window.apply(FileCommand::Add(vec![File::new("b.m3d", *b"")]));
    let lying = |window: &Window| {
        (
            window.shows("b.m3d could not be read"),
            window.shows("Space: play or pause"),
            window.harness.state().state.diagnostics_open,
        )
    };
    assert_eq!(lying(&window), (true, true, true));
    for rest in [(false, true, true), (false, false, true), (false, false, false)] {
        window.press(PLAIN, Key::Escape);
        assert_eq!(lying(&window), rest);
    }
}

#[test]
fn keys_of_the_browser_do_nothing_here() {
    let mut window = open();
    let before = (*window.session().camera(), window.session().picture_revision());
    for key in [
        Key::F,
        Key::L,
        Key::C,
        Key::G,
        Key::W,
        Key::T,
        Key::N,
        Key::P,
        Key::V,
        Key::Num1,
        Key::Num5,
        Key::Home,
    ] {
        window.press(CTRL, key);
        window.press(Modifiers::ALT, key);
    }
    assert_eq!(
        (*window.session().camera(), window.session().picture_revision()),
        before
    );
    assert_eq!(
        (window.session().clip_index(), window.session().playback().loop_mode()),
        (Some(0), LoopMode::Loop)
    );
}

#[test]
fn a_focused_control_keeps_space_for_itself() {
    let mut window = open();
    for _ in 0..40 {
        window.tab(false);
        let focused = window.focused();
        if focused.as_deref() == Some("Turntable") {
            window.press(PLAIN, Key::Space);
            assert!(window.session().turntable(), "the switch was pressed");
            assert!(!window.session().is_animating(), "and nothing plays");
            return;
        }
    }
    panic!("Tab never reached the turntable");
}

fn clicks(at: Pos2, count: usize) -> Vec<Event> {
    let button = |pressed| button_event(at, PointerButton::Primary, pressed, PLAIN);
    let mut events = vec![Event::PointerMoved(at)];
    events.extend((0..count).flat_map(|_| [button(true), button(false)]));
    events
}

/// A key as a browser tells of it.
fn pressed(key: Key, text: Option<&str>) -> Vec<Event> {
    let event = |pressed| key_event(key, pressed);
    let text = text.map(|text| Event::Text(text.to_owned()));
    text.into_iter().chain([event(true), event(false)]).collect()
}

/// Words that are also keys: a picture, the range, normals, playing.
fn typed_name() -> Vec<Event> {
    let letters = [
        (Key::S, "S"),
        (Key::P, "p"),
        (Key::I, "i"),
        (Key::N, "n"),
        (Key::Space, " "),
        (Key::B, "B"),
    ];
    let letters = letters.into_iter().flat_map(|(key, text)| pressed(key, Some(text)));
    letters.chain(pressed(Key::Enter, None)).collect()
}

/// What keys that are taken for shortcuts would change.
fn shortcuts(window: &Window) -> (bool, Option<[f32; 2]>, bool, bool, usize) {
    let session = window.session();
    (
        session.is_animating(),
        session.playback().range_secs(),
        session.look().overlays.has(Overlay::Normals),
        session.look().bones_visible,
        window.harness.state().requests.len(),
    )
}

#[test]
fn a_name_is_the_same_however_its_letters_fall_into_frames() {
    let lay_out = || {
        let mut window = window(WIDE, vec![moving("a.m3d")]);
        window.click("Panel: Skeleton");
        window.apply(PlayCommand::Seek { time_secs: 0.5 });
        window
    };
    let at = lay_out().rect("Bone 1, ").center();
    let events: Vec<Event> = clicks(at, 2).into_iter().chain(typed_name()).collect();
    let mut ways: Vec<Vec<usize>> = (1..=events.len())
        .map(|length| vec![length; events.len() / length + 1])
        .collect();
    ways.extend((1..events.len()).map(|first| vec![first, events.len() - first]));
    for way in ways {
        let mut window = lay_out();
        let before = shortcuts(&window);
        let mut rest = &events[..];
        for &length in &way {
            let (now, later) = rest.split_at(length.min(rest.len()));
            window.frame(now.iter().cloned());
            rest = later;
        }
        window.pass_on();
        assert_eq!(window.session().joint_names().get(1), Some("Spin B"), "{way:?}");
        assert_eq!(shortcuts(&window), before, "{way:?}");
    }
}

#[test]
fn a_name_that_is_typed_at_one_frame_a_second_is_kept_while_the_model_plays() {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    window.click("Panel: Skeleton");
    window.apply(PlayCommand::Play);
    let at = window.rect("Bone 1, ").center();
    let mut time_secs = 100.0;
    for events in [clicks(at, 2), typed_name(), pressed(Key::Escape, None)] {
        time_secs += 1.0;
        window.harness.input_mut().time = Some(time_secs);
        window.frame(events);
    }
    window.pass_on();
    assert_eq!(window.session().joint_names().get(1), Some("Spin B"));
    assert!(window.session().is_animating(), "Space was typed");
}

#[test]
fn a_key_after_enter_is_a_shortcut_again_in_the_same_frame() {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    window.click("Panel: Skeleton");
    let at = window.rect("Bone 1, ").center();
    window.frame(
        clicks(at, 2)
            .into_iter()
            .chain(typed_name())
            .chain(pressed(Key::Z, Some("z"))),
    );
    window.pass_on();
    assert_eq!(window.session().joint_names().get(1), Some("Spin B"));
    assert!(window.session().look().overlays.has(Overlay::Wireframe));
}

#[test]
fn a_number_is_the_same_however_its_digits_fall_into_frames() {
    let at = open().rect("Frame 0 / 30").center();
    let digits = [(Key::Num1, "1"), (Key::Num5, "5")];
    let digits = digits.into_iter().flat_map(|(key, text)| pressed(key, Some(text)));
    let events: Vec<Event> = clicks(at, 1)
        .into_iter()
        .chain(digits)
        .chain(pressed(Key::Enter, None))
        .collect();
    for length in 1..=events.len() {
        let mut window = open();
        let before = *window.session().camera();
        for events in events.chunks(length) {
            window.frame(events.iter().cloned());
        }
        window.pass_on();
        assert_frame(&window, 15.0);
        assert_eq!(window.session().camera(), &before, "frames of {length} events");
    }
}

#[test]
fn a_letter_under_a_pressed_read_out_is_no_shortcut() {
    let mut window = open();
    let at = window.rect("Frame 0 / 30").center();
    window.frame(clicks(at, 1).into_iter().take(2));
    window.frame(pressed(Key::Z, Some("z")));
    assert!(!window.session().look().overlays.has(Overlay::Wireframe));
}

#[test]
fn f2_takes_the_letters_after_it_though_its_row_has_to_be_scrolled_to() {
    let mut window = tree(WIDE, 300);
    window.apply(JointCommand::Select(Some(bindpose::model::JointIndex(250))));
    window.wait(1.0);
    window
        .harness
        .hover_at(window.rect("Search bones").center() + vec2(0.0, 100.0));
    window.frame([wheel_event(MouseWheelUnit::Point, vec2(0.0, 1e5), PLAIN)]);
    window.wait(1.0);
    assert!(
        window.shows("Bone 0, 9 vertices"),
        "scrolled away from what is selected"
    );
    let before = shortcuts(&window);
    window.frame(pressed(Key::F2, None).into_iter().chain(typed_name()));
    window.wait(1.0);
    assert_eq!(shortcuts(&window), before);
    assert!(window.shows("Name of the bone"), "its field is there");
}

#[test]
fn a_name_whose_row_is_scrolled_out_of_sight_is_taken() {
    let mut window = tree(WIDE, 300);
    let at = window.rect("Bone 1, ").center();
    window.frame(clicks(at, 2));
    window.pass_on();
    window.frame([Event::Text("Spine".to_owned())]);
    window.frame([wheel_event(MouseWheelUnit::Point, vec2(0.0, -1e5), PLAIN)]);
    window.wait(1.0);
    assert!(!window.shows("Name of the bone"), "the row is out of sight");
    assert_eq!(window.session().joint_names().get(1), Some("Spine"));
    window.press(PLAIN, Key::Z);
    assert!(
        window.session().look().overlays.has(Overlay::Wireframe),
        "and keys are shortcuts again"
    );
}

/// Presses Tab until a control has the keyboard.
#[track_caller]
fn tab_to(window: &mut Window, start: &str) {
    for _ in 0..80 {
        window.tab(false);
        if window.focused().is_some_and(|name| name.starts_with(start)) {
            return;
        }
    }
    panic!("Tab never reached {start:?}");
}

#[test]
fn what_hung_from_a_button_gives_it_the_keyboard_back() {
    for (button, inside) in [("View mode", "Depth"), ("Lighting", "Exposure"), ("View from", "Top")] {
        let mut window = open();
        tab_to(&mut window, button);
        window.press(PLAIN, Key::Enter);
        assert!(
            window.shows(inside) || !window.named(|name| name.starts_with(inside)).is_empty(),
            "{button}"
        );
        for steps in [0, 1, 3] {
            for _ in 0..steps {
                window.tab(false);
            }
            window.press(PLAIN, Key::Escape);
            let focused = window.focused();
            assert!(
                focused.as_deref().is_some_and(|name| name.starts_with(button)),
                "{button}: {focused:?}"
            );
            window.press(PLAIN, Key::Enter);
        }
    }
    let mut window = open();
    tab_to(&mut window, "View mode");
    window.press(PLAIN, Key::Enter);
    tab_to(&mut window, "Depth");
    window.press(PLAIN, Key::Enter);
    assert_eq!(window.session().look().view_mode, ViewMode::Depth);
    assert_eq!(
        window.focused().as_deref(),
        Some("View mode: Depth"),
        "a choice gives it back too"
    );
}

#[test]
fn esc_that_shuts_something_leaves_the_keyboard_where_it_is() {
    let mut window = open();
    window.apply(SubmeshCommand::Select(Some(0)));
    tab_to(&mut window, "Turntable");
    window.press(PLAIN, Key::Escape);
    assert_eq!(window.session().submeshes().selected(), None);
    assert_eq!(window.focused().as_deref(), Some("Turntable"));
    window.press(PLAIN, Key::Escape);
    assert_eq!(window.focused(), None, "there was nothing to shut");
}

#[test]
fn with_a_mouse_nothing_takes_the_keyboard() {
    let mut window = open();
    window.click("Lighting");
    window.press(PLAIN, Key::Escape);
    assert_eq!(window.focused(), None);
    window.press(PLAIN, Key::Space);
    assert!(window.session().is_animating(), "Space plays");
}
