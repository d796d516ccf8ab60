//! What movements on the view ask for.

use std::f32::consts::PI;

use bindpose::gestures::{DragTrail, Grab, ViewDrag, click, in_picture, pinch, zoom};
use bindpose::session::{CameraCommand, Command, JointCommand, LookCommand, SubmeshCommand};
use glam::Vec2;

#[test]
fn button_and_modifiers_say_what_a_drag_moves() {
    for (is_primary, shift, alt, grab) in [
        (true, false, false, Grab::Orbit),
        (true, true, false, Grab::Pan),
        (true, false, true, Grab::Environment),
        (true, true, true, Grab::Environment),
        (false, false, false, Grab::Pan),
        (false, false, true, Grab::Pan),
    ] {
        assert_eq!(Grab::of(is_primary, shift, alt), grab);
    }
    let mut drag = ViewDrag::default();
    let moved = Vec2::new(0.5, -0.25);
    let orbit = CameraCommand::Orbit {
        yaw_radians: 0.55 * PI,
        pitch_radians: -0.275 * PI,
    };
    assert_eq!(drag.drag(Grab::Orbit, moved, 0.0), Some(orbit.into()));
    assert_eq!(drag.drag(Grab::Orbit, Vec2::ZERO, 0.0), None);
    let turn = LookCommand::TurnEnvironment(0.5 * PI);
    assert_eq!(drag.drag(Grab::Environment, moved, 0.0), Some(turn.into()));
    let pan = CameraCommand::Pan { drag: moved };
    assert_eq!(drag.drag(Grab::Pan, moved, 0.0), Some(pan.into()));
}

#[test]
fn only_an_orbit_that_was_quick_until_it_ended_goes_on() {
    let quick = || {
        let mut drag = ViewDrag::default();
        for step in 0..20 {
            drag.drag(Grab::Orbit, Vec2::new(0.02, 0.0), f64::from(step) * 0.01);
        }
        drag
    };
    let Some(Command::Camera(CameraCommand::Fling {
        yaw_radians_per_sec,
        pitch_radians_per_sec,
    })) = quick().fling(0.19)
    else {
        panic!("it goes on")
    };
    assert!((yaw_radians_per_sec - 2.2 * PI).abs() < 1.0, "{yaw_radians_per_sec}");
    assert_eq!(pitch_radians_per_sec, 0.0);
    assert_eq!(quick().fling(0.4), None, "it stood still before the end");
    let mut panned = quick();
    panned.drag(Grab::Pan, Vec2::ONE, 0.19);
    assert_eq!(panned.fling(0.19), None, "it ended with another drag");
}

#[test]
fn fingers_and_wheel_come_nearer_to_what_is_under_them() {
    let (moved, middle) = (Vec2::new(0.1, 0.0), Vec2::new(-0.2, 0.3));
    let pan: Command = CameraCommand::Pan { drag: moved }.into();
    let nearer: Command = CameraCommand::Zoom {
        factor: 0.5,
        pointer: middle,
    }
    .into();
    assert_eq!(pinch(moved, 2.0, middle).collect::<Vec<_>>(), [pan.clone(), nearer]);
    assert_eq!(pinch(moved, 1.0, middle).collect::<Vec<_>>(), [pan]);
    assert_eq!(zoom(0.0, 1.0, middle), None);
    let Some(Command::Camera(CameraCommand::Zoom { factor, pointer })) = zoom(100.0, 1.0, middle) else {
        panic!("a wheel zooms")
    };
    assert!(factor < 1.0 && pointer == middle);
}

#[test]
fn a_click_selects_where_it_is() {
    let at = in_picture(Vec2::new(0.75, 0.0));
    assert_eq!(at, Vec2::new(0.5, 1.0));
    assert_eq!(click(at, true), JointCommand::SelectAt(at).into());
    assert_eq!(click(at, false), SubmeshCommand::SelectAt(at).into());
}

#[test]
fn a_steady_drag_has_its_rate_and_one_that_waits_has_none() {
    let mut trail = DragTrail::default();
    for step in 0..20 {
        trail.add(f64::from(step) * 0.01, Vec2::new(0.02, -0.01));
    }
    let rate = trail.rate_per_sec(0.19);
    assert!((rate - Vec2::new(2.0, -1.0)).abs().max_element() < 0.3, "{rate}");
    assert_eq!(trail.rate_per_sec(0.4), Vec2::ZERO, "it stood still before the end");
    trail.clear();
    assert_eq!(trail.rate_per_sec(0.19), Vec2::ZERO);
}
