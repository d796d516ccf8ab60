//! Time along a width.

use bindpose::ui::for_tests::{END_ROOM, SeenTime, TimeAxis};
use egui::Rangef;

const WHOLE: [f32; 2] = [0.5, 10.5];
const FRAME: f32 = 1.0 / 30.0;

#[test]
fn places_and_times_are_inverse() {
    let axis = TimeAxis::new(Rangef::new(100.0, 900.0), END_ROOM, WHOLE);
    assert_eq!([axis.x_of(0.5), axis.x_of(10.5)], [108.0, 892.0]);
    for time_secs in [0.5, 3.25, 10.5, -1.0, 12.0] {
        assert!((axis.time_at(axis.x_of(time_secs)) - time_secs).abs() < 1e-5);
    }
    assert_eq!(axis.seen_time_at(0.0), 0.5);
    assert_eq!(axis.seen_time_at(2000.0), 10.5);
}

#[test]
fn a_stretch_without_length_and_a_width_without_room_are_a_place() {
    let axis = TimeAxis::new(Rangef::new(10.0, 10.0), END_ROOM, [2.0, 2.0]);
    assert_eq!(
        (axis.x_of(7.0), axis.time_at(50.0), axis.points_per_sec()),
        (10.0, 2.0, 0.0)
    );
}

#[test]
fn zooming_keeps_the_time_under_the_pointer_and_ends_at_both_ends() {
    let mut window = SeenTime::default();
    let width = Rangef::new(0.0, 1000.0);
    let axis = |window: &SeenTime| TimeAxis::new(width, END_ROOM, window.span_secs(WHOLE));
    let before = axis(&window).x_of(4.0);
    window.zoom(WHOLE, FRAME, 5.0, 4.0);
    assert!(window.is_part());
    assert!((axis(&window).x_of(4.0) - before).abs() < 0.1);
    for _ in 0..40 {
        window.zoom(WHOLE, FRAME, 2.0, 4.0);
    }
    let [start, end] = window.span_secs(WHOLE);
    assert!((end - start - 4.0 * FRAME).abs() < 1e-4, "{start} {end}");
    window.zoom(WHOLE, FRAME, 1e-6, 4.0);
    assert!(!window.is_part());
}

#[test]
fn panning_stays_inside_and_the_whole_cannot_be_panned() {
    let mut window = SeenTime::default();
    window.pan(WHOLE, FRAME, 1.0);
    assert_eq!(window.span_secs(WHOLE), WHOLE);
    window.show(WHOLE, FRAME, [2.0, 4.0]);
    window.pan(WHOLE, FRAME, 100.0);
    assert_eq!(window.span_secs(WHOLE), [8.5, 10.5]);
    window.pan(WHOLE, FRAME, -100.0);
    assert_eq!(window.span_secs(WHOLE), [0.5, 2.5]);
    window.show(WHOLE, FRAME, [f32::NAN, 1.0]);
    let [start, end] = window.span_secs(WHOLE);
    assert!(
        start == 0.5 && (end - start - 4.0 * FRAME).abs() < 1e-6,
        "no number is the start"
    );
}
