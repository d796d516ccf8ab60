//! Mouse and fingers on the view.

use bindpose::scene::Camera;
use egui::{
    Event, Modifiers, MouseWheelUnit, PointerButton, Pos2, TouchDeviceId, TouchId, TouchPhase, Vec2, pos2, vec2,
};
use glam::Vec3;

use crate::models::moving;
use crate::page::{WIDE, Window, button_event, phone, touch_window, wheel_event, window};

pub(crate) const START: Pos2 = pos2(800.0, 420.0);

pub(crate) fn drag(window: &mut Window, button: PointerButton, modifiers: Modifiers, way: Vec2) {
    let press = |pos, pressed| button_event(pos, button, pressed, modifiers);
    window.harness.event(Event::ModifiersChanged(modifiers));
    window.harness.event(Event::PointerMoved(START));
    window.harness.event(press(START, true));
    for step in 1..=4 {
        window
            .harness
            .event(Event::PointerMoved(START + way * (step as f32 / 4.0)));
    }
    window.harness.event(press(START + way, false));
    window.harness.event(Event::ModifiersChanged(Modifiers::NONE));
    window.harness.event(Event::PointerGone);
    window.pass_on();
}

#[test]
fn a_press_and_its_release_in_two_long_frames_are_a_click() {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    let at = window.rect("Export").center();
    let press = |pressed| button_event(at, PointerButton::Primary, pressed, Modifiers::NONE);
    window.frame([Event::PointerMoved(at)]);
    window.frame([press(true)]);
    let now_secs = window.harness.ctx.input(|input| input.time);
    window.harness.input_mut().time = Some(now_secs + 2.5);
    window.frame([press(false)]);
    window.harness.input_mut().time = None;
    window.pass_on();
    assert!(window.shows("Save a.glb"));
}

/// Where a point of the world is in the window.
fn in_window(camera: &Camera, size: Vec2, point: Vec3) -> Pos2 {
    let view = camera.view_from_world().transform_point3(point);
    let height = camera.height_in_view() * view.z / camera.distance;
    pos2(
        size.x * 0.5 + view.x / height * size.y,
        size.y * 0.5 - view.y / height * size.y,
    )
}

#[test]
fn dragging_turns_the_model_with_the_pointer() {
    for (way, name) in [(vec2(120.0, 0.0), "right"), (vec2(0.0, 60.0), "down")] {
        let mut window = window(WIDE, vec![moving("a.m3d")]);
        let before = *window.session().camera();
        drag(&mut window, PointerButton::Primary, Modifiers::NONE, way);
        let after = *window.session().camera();
        assert_eq!((after.target, after.distance), (before.target, before.distance));
        // A point on the near side of the model goes where the pointer goes.
        let near = before.target - before.forward();
        let moved = in_window(&after, WIDE, near) - in_window(&before, WIDE, near);
        assert!(
            moved.dot(way) > 0.9 * moved.length() * way.length(),
            "{name}: {moved:?}"
        );
        assert!(moved.length() > 20.0, "{name}: {moved:?}");
    }
}

#[test]
fn with_alt_the_environment_turns_and_the_camera_stays() {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    let before = *window.session().camera();
    drag(&mut window, PointerButton::Primary, Modifiers::ALT, vec2(90.0, 40.0));
    assert_eq!(window.session().camera(), &before);
    let turn = window.session().look().environment_turn_radians;
    assert!((turn - 0.1 * std::f32::consts::PI).abs() < 0.01, "{turn}");
}

#[test]
fn other_buttons_and_shift_carry_the_model_along() {
    for (button, modifiers) in [
        (PointerButton::Secondary, Modifiers::NONE),
        (PointerButton::Middle, Modifiers::NONE),
        (PointerButton::Primary, Modifiers::SHIFT),
    ] {
        let mut window = window(WIDE, vec![moving("a.m3d")]);
        let before = *window.session().camera();
        let way = vec2(80.0, -40.0);
        drag(&mut window, button, modifiers, way);
        let after = *window.session().camera();
        assert_eq!(
            (after.yaw_radians, after.distance),
            (before.yaw_radians, before.distance)
        );
        let moved = in_window(&after, WIDE, before.target) - in_window(&before, WIDE, before.target);
        assert!((moved - way).length() < 1.0, "{button:?}: {moved:?}");
    }
}

#[test]
fn the_wheel_comes_nearer_to_what_is_under_the_pointer() {
    for (lines, nearer) in [(3.0, true), (-3.0, false)] {
        let mut window = window(WIDE, vec![moving("a.m3d")]);
        let before = *window.session().camera();
        window.harness.hover_at(START);
        window
            .harness
            .event(wheel_event(MouseWheelUnit::Line, vec2(0.0, lines), Modifiers::NONE));
        window.wait(1.0);
        let after = *window.session().camera();
        let ratio = after.distance / before.distance;
        assert!(if nearer { ratio < 0.9 } else { ratio > 1.1 }, "{ratio}");
        // The point of the target's plane under the pointer stays there.
        let shares = (START - pos2(WIDE.x * 0.5, WIDE.y * 0.5)) / WIDE.y;
        let under = before.target + (before.right() * shares.x - before.up() * shares.y) * before.height_in_view();
        assert!(
            in_window(&after, WIDE, under).distance(START) < 1.0,
            "{:?}",
            in_window(&after, WIDE, under)
        );
    }
}

#[test]
fn a_double_click_frames_the_model() {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    let framed = *window.session().camera();
    drag(&mut window, PointerButton::Secondary, Modifiers::NONE, vec2(90.0, 20.0));
    assert_ne!(window.session().camera(), &framed);
    for _ in 0..2 {
        window.harness.hover_at(START);
        window.harness.drag_at(START);
        window.harness.drop_at(START);
    }
    window.pass_on();
    assert_eq!(window.session().camera(), &framed);
}

#[test]
fn what_happens_on_a_panel_does_not_reach_the_view() {
    let mut window = window(WIDE, vec![moving("a.m3d")]);
    let before = *window.session().camera();
    let on_panel = window.rect("Dialect").center();
    for pos in [
        on_panel,
        window.rect("Frame 0").center(),
        window.rect("Bindpose").center(),
    ] {
        window.harness.hover_at(pos);
        window.harness.drag_at(pos);
        window.harness.hover_at(pos + vec2(200.0, 30.0));
        window.harness.drop_at(pos + vec2(200.0, 30.0));
        window.harness.hover_at(pos);
        window
            .harness
            .event(wheel_event(MouseWheelUnit::Line, vec2(0.0, 3.0), Modifiers::NONE));
        window.wait(0.5);
        assert_eq!(window.session().camera(), &before, "{pos:?}");
    }
}

/// Fingers as a browser tells of them: each as a touch, and the first as a pointer too.
pub(crate) fn fingers(window: &mut Window, phase: TouchPhase, at: &[Pos2]) {
    for (finger, &pos) in at.iter().enumerate() {
        let id = TouchId(finger as u64 + 1);
        window.harness.input_mut().events.push(Event::Touch {
            device_id: TouchDeviceId(0),
            id,
            phase,
            pos,
            force: None,
        });
    }
    if let Some(&pos) = at.first() {
        let button = |pressed| button_event(pos, PointerButton::Primary, pressed, Modifiers::NONE);
        window.harness.input_mut().events.extend(match phase {
            TouchPhase::Start => vec![Event::PointerMoved(pos), button(true)],
            TouchPhase::Move => vec![Event::PointerMoved(pos)],
            TouchPhase::End | TouchPhase::Cancel => vec![button(false), Event::PointerGone],
        });
    }
    window.harness.step();
}

/// Fingers along a path, and away.
pub(crate) fn gesture(window: &mut Window, path: &[Vec<Pos2>]) {
    for (step, at) in path.iter().enumerate() {
        fingers(window, if step == 0 { TouchPhase::Start } else { TouchPhase::Move }, at);
    }
    if let Some(last) = path.last() {
        fingers(window, TouchPhase::End, last);
    }
    window.pass_on();
}

#[test]
fn one_finger_turns() {
    let mut window = phone(vec![moving("a.m3d")]);
    let before = *window.session().camera();
    gesture(
        &mut window,
        &(0..6)
            .map(|i| vec![pos2(150.0 + 15.0 * i as f32, 400.0)])
            .collect::<Vec<_>>(),
    );
    let after = *window.session().camera();
    assert_eq!((after.target, after.distance), (before.target, before.distance));
    assert_ne!(after.yaw_radians, before.yaw_radians);
}

#[test]
fn two_fingers_carry() {
    let mut window = phone(vec![moving("a.m3d")]);
    let before = *window.session().camera();
    let path: Vec<_> = (0..8)
        .map(|i| 8.0 * i as f32)
        .map(|x| vec![pos2(120.0 + x, 350.0), pos2(220.0 + x, 450.0)])
        .collect();
    gesture(&mut window, &path);
    let after = *window.session().camera();
    assert_eq!(
        (after.yaw_radians, after.pitch_radians),
        (before.yaw_radians, before.pitch_radians),
        "nothing turned"
    );
    assert!((after.distance / before.distance - 1.0).abs() < 1e-3);
    let size = crate::page::PHONE;
    let moved = in_window(&after, size, before.target) - in_window(&before, size, before.target);
    assert!(moved.x > 35.0 && moved.y.abs() < 2.0, "{moved:?}");
}

#[test]
fn two_fingers_that_part_come_nearer() {
    for (sign, nearer) in [(1.0, true), (-1.0, false)] {
        let mut window = phone(vec![moving("a.m3d")]);
        let before = *window.session().camera();
        let path: Vec<_> = (0..8)
            .map(|i| 60.0 + sign * 5.0 * i as f32)
            .map(|half| vec![pos2(195.0 - half, 400.0), pos2(195.0 + half, 400.0)])
            .collect();
        gesture(&mut window, &path);
        let after = *window.session().camera();
        let ratio = after.distance / before.distance;
        assert!(if nearer { ratio < 0.8 } else { ratio > 1.25 }, "{ratio}");
        assert_eq!(after.yaw_radians, before.yaw_radians);
    }
}

fn button(pos: Pos2, pressed: bool) -> Event {
    button_event(pos, PointerButton::Primary, pressed, Modifiers::NONE)
}

/// A drag with a mouse from place to place, with all that a browser tells of it.
fn mouse_drag(from: Pos2, to: Pos2) -> Vec<Event> {
    let way = |step: u8| Event::PointerMoved(from.lerp(to, f32::from(step) / 4.0));
    let mut events = vec![way(0), button(from, true)];
    events.extend((1..=4).map(way));
    events.push(button(to, false));
    events
}

/// The same with a finger.
fn finger_drag(from: Pos2, to: Pos2) -> Vec<Event> {
    let touch = |pos, phase| Event::Touch {
        device_id: TouchDeviceId(0),
        id: TouchId(1),
        phase,
        pos,
        force: None,
    };
    let mut events = vec![button(from, true), touch(from, TouchPhase::Start)];
    for step in 1..=4_u8 {
        let pos = from.lerp(to, f32::from(step) / 4.0);
        events.extend([Event::PointerMoved(pos), touch(pos, TouchPhase::Move)]);
    }
    events.extend([button(to, false), Event::PointerGone, touch(to, TouchPhase::End)]);
    events
}

/// Lets events fall into frames of `length` each.
fn in_frames(window: &mut Window, events: &[Event], length: usize) {
    for events in events.chunks(length) {
        window.frame(events.iter().cloned());
    }
    window.pass_on();
}

#[test]
fn a_scrub_that_falls_into_one_frame_moves_the_time_and_not_the_end_that_it_comes_to() {
    for length in 1..=7 {
        let mut window = window(WIDE, vec![moving("a.m3d")]);
        let from = window.rect("Time").center();
        let to = window.rect("Range out").center();
        in_frames(&mut window, &mouse_drag(from, to), length);
        assert_eq!(
            window.session().playback().range_secs(),
            None,
            "frames of {length} events"
        );
        assert_eq!(window.time_secs(), 1.0, "frames of {length} events");
        assert!(!window.session().is_scrubbing(), "frames of {length} events");
    }
    for length in 1..=13 {
        let mut window = phone(vec![moving("a.m3d")]);
        let from = window.rect("Time").center();
        let to = window.rect("Range out").center();
        in_frames(&mut window, &finger_drag(from, to), length);
        assert_eq!(
            window.session().playback().range_secs(),
            None,
            "frames of {length} events"
        );
        assert!((window.time_secs() - 1.0).abs() < 1e-3, "frames of {length} events");
    }
}

#[test]
fn a_drag_that_begins_on_a_panel_never_turns_the_camera() {
    for length in 1..=13 {
        let mut window = phone(vec![moving("a.m3d")]);
        let before = *window.session().camera();
        let from = window.rect("Bindpose").center();
        in_frames(&mut window, &finger_drag(from, from + vec2(0.0, 200.0)), length);
        window.wait(0.5);
        assert_eq!(window.session().camera(), &before, "frames of {length} events");
    }
}

#[test]
fn a_drag_is_the_same_in_one_frame_as_in_many() {
    let turned = |length: usize| {
        let mut window = window(WIDE, vec![moving("a.m3d")]);
        in_frames(&mut window, &mouse_drag(START, START + vec2(120.0, 30.0)), length);
        window.wait(1.0);
        window.session().camera().yaw_radians
    };
    let before = window(WIDE, vec![moving("a.m3d")]).session().camera().yaw_radians;
    for length in 1..=7 {
        assert!((turned(length) - before).abs() > 0.2, "frames of {length} events");
    }
}

/// A wheel over anything that lies over the view, over its margins too, leaves the camera alone.
#[test]
fn a_wheel_over_a_panel_never_zooms_the_scene_beneath() {
    let low = Vec2::new(844.0, 390.0);
    for (mut window, opened) in [
        (window(WIDE, vec![moving("a.m3d")]), ""),
        (window(WIDE, vec![moving("a.m3d")]), "Speed 1×"),
        (window(WIDE, vec![moving("a.m3d")]), "Clip Bend"),
        (window(WIDE, vec![moving("a.m3d")]), "Dope sheet and curves"),
        (window(Vec2::new(900.0, 420.0), vec![moving("a.m3d")]), ""),
        (touch_window(low, vec![moving("a.m3d")]), ""),
        (phone(vec![moving("a.m3d")]), "Dope sheet and curves"),
    ] {
        if !opened.is_empty() {
            window.click(opened);
            window.wait(0.5);
        }
        let camera = *window.session().camera();
        let size = window.harness.ctx.content_rect().size();
        let mut covered = 0;
        for (column, row) in (0..24).flat_map(|column| (0..24).map(move |row| (column, row))) {
            let at = pos2(
                (column as f32 + 0.5) / 24.0 * size.x,
                (row as f32 + 0.5) / 24.0 * size.y,
            );
            let layer = window.harness.ctx.layer_id_at(at);
            if layer.is_none_or(|layer| layer.order == egui::Order::Background) {
                continue;
            }
            covered += 1;
            for delta in [-40.0, 40.0] {
                window.harness.hover_at(at);
                window.frame([wheel_event(MouseWheelUnit::Point, vec2(0.0, delta), Modifiers::NONE)]);
                window.pass_on();
            }
            assert_eq!(*window.session().camera(), camera, "{opened:?} at {at} of {size}");
        }
        assert!(covered > 24, "{covered}");
    }
}
