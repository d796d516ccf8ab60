//! Play, pause, loop, scrub.

use bindpose::anim::{LoopMode, Playback};

fn playing(loop_mode: LoopMode, start_secs: f32, end_secs: f32) -> Playback {
    let mut playback = Playback::new(start_secs, end_secs);
    playback.set_loop_mode(loop_mode);
    playback.play();
    playback
}

/// Where each step leads, and whether it still plays then.
fn walk(playback: &mut Playback, steps: &[(f32, f32, bool)]) {
    for &(dt_secs, time_secs, is_playing) in steps {
        playback.advance(dt_secs);
        let at_secs = playback.time_secs();
        assert!(
            (at_secs - time_secs).abs() < 1e-5,
            "{at_secs} s is not {time_secs} s after {dt_secs} s"
        );
        assert_eq!(playback.is_playing(), is_playing, "at {at_secs} s");
    }
}

#[test]
fn a_new_playback_waits_at_the_start() {
    let mut playback = Playback::new(-1.0, 2.0);
    assert_eq!(
        (playback.time_secs(), playback.is_playing(), playback.duration_secs()),
        (-1.0, false, 3.0)
    );
    assert_eq!(
        (playback.speed(), playback.loop_mode(), playback.is_backward()),
        (1.0, LoopMode::Loop, false)
    );
    assert!(!playback.advance(1.0));
    assert_eq!(playback.time_secs(), -1.0);
    assert_eq!(Playback::new(2.0, -1.0), Playback::new(-1.0, 2.0));
}

#[test]
fn once_stops_at_the_end_and_begins_anew() {
    let mut playback = playing(LoopMode::Once, 1.0, 2.0);
    walk(
        &mut playback,
        &[(0.75, 1.75, true), (0.5, 2.0, false), (0.5, 2.0, false)],
    );
    playback.play();
    assert_eq!((playback.time_secs(), playback.is_playing()), (1.0, true));
    walk(&mut playback, &[(0.25, 1.25, true)]);
    // From the middle it goes on.
    playback.pause();
    playback.play();
    assert_eq!(playback.time_secs(), 1.25);
}

#[test]
fn once_backward_stops_at_the_start() {
    let mut playback = Playback::new(1.0, 2.0);
    playback.set_loop_mode(LoopMode::Once);
    playback.set_backward(true);
    playback.play();
    assert_eq!(playback.time_secs(), 2.0);
    walk(&mut playback, &[(0.75, 1.25, true), (0.75, 1.0, false)]);
}

#[test]
fn loop_stands_on_both_ends_and_goes_round_beyond_them() {
    let mut playback = playing(LoopMode::Loop, 1.0, 2.0);
    walk(
        &mut playback,
        &[
            (1.0, 2.0, true),
            (0.25, 1.25, true),
            (3.5, 1.75, true),
            (0.25, 2.0, true),
        ],
    );
    playback.set_backward(true);
    walk(
        &mut playback,
        &[(1.0, 1.0, true), (0.25, 1.75, true), (3.0, 1.75, true)],
    );
    for end_secs in [1.0, 2.0] {
        playback.seek(end_secs);
        assert_eq!(playback.time_secs(), end_secs);
    }
}

#[test]
fn ping_pong_turns_at_both_ends() {
    let mut playback = playing(LoopMode::PingPong, 1.0, 2.0);
    walk(
        &mut playback,
        &[
            (0.75, 1.75, true),
            (0.5, 1.75, true),
            (0.5, 1.25, true),
            (0.5, 1.25, true),
            (0.75, 2.0, true),
            (0.25, 1.75, true),
            (4.0, 1.75, true),
            (0.75, 1.0, true),
            (0.25, 1.25, true),
        ],
    );
    // A scrub goes on forward.
    playback.seek(1.5);
    walk(&mut playback, &[(0.25, 1.75, true)]);
    playback.set_backward(true);
    walk(
        &mut playback,
        &[(0.5, 1.25, true), (0.5, 1.25, true), (0.5, 1.75, true)],
    );
}

#[test]
fn speed_scales_time() {
    let mut playback = playing(LoopMode::Loop, 0.0, 10.0);
    playback.set_speed(2.5);
    walk(&mut playback, &[(1.0, 2.5, true)]);
    for refused in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        playback.set_speed(refused);
        assert_eq!(playback.speed(), 2.5);
    }
}

#[test]
fn only_time_that_goes_by_moves_it() {
    let mut playback = playing(LoopMode::Loop, 0.0, 1.0);
    for dt_secs in [0.0, -1.0, f32::NAN, f32::NEG_INFINITY] {
        assert!(!playback.advance(dt_secs));
        assert_eq!(playback.time_secs(), 0.0);
    }
    assert!(playback.advance(0.5));
}

#[test]
fn the_longest_steps_stay_inside() {
    for loop_mode in [LoopMode::Once, LoopMode::Loop, LoopMode::PingPong] {
        for backward in [false, true] {
            for dt_secs in [1e6, f32::MAX, f32::INFINITY] {
                let mut playback = playing(loop_mode, -0.5, 0.75);
                playback.set_backward(backward);
                playback.set_speed(f32::MAX);
                playback.advance(dt_secs);
                let time_secs = playback.time_secs();
                assert!(
                    (-0.5..=0.75).contains(&time_secs),
                    "{loop_mode:?} {dt_secs} s: {time_secs} s"
                );
            }
        }
    }
}

#[test]
fn a_span_without_length_never_changes() {
    for loop_mode in [LoopMode::Loop, LoopMode::PingPong] {
        let mut playback = playing(loop_mode, 3.0, 3.0);
        assert!(!playback.advance(0.1));
        assert_eq!((playback.time_secs(), playback.is_playing()), (3.0, true));
    }
    let mut playback = playing(LoopMode::Once, 3.0, 3.0);
    assert!(playback.advance(0.1));
    assert!(!playback.is_playing());
}

#[test]
fn seeking_stays_inside_and_keeps_playing() {
    let mut playback = playing(LoopMode::Loop, -1.0, 2.0);
    for (wanted_secs, time_secs) in [
        (0.517, 0.517),
        (5.0, 2.0),
        (-5.0, -1.0),
        (f32::INFINITY, 2.0),
        (f32::NEG_INFINITY, -1.0),
        (f32::NAN, -1.0),
    ] {
        playback.seek(wanted_secs);
        assert_eq!(playback.time_secs(), time_secs);
        assert!(playback.is_playing());
    }
}

#[test]
fn a_new_span_takes_the_time_with_it() {
    let mut playback = playing(LoopMode::Loop, 0.0, 10.0);
    playback.seek(8.0);
    playback.set_span(2.0, 5.0);
    assert_eq!(
        (playback.time_secs(), playback.start_secs(), playback.end_secs()),
        (5.0, 2.0, 5.0)
    );
    playback.set_span(7.0, 6.0);
    assert_eq!(
        (playback.time_secs(), playback.start_secs(), playback.end_secs()),
        (6.0, 6.0, 7.0)
    );
    playback.set_span(f32::NAN, 1.0);
    playback.set_span(0.0, f32::INFINITY);
    assert_eq!((playback.start_secs(), playback.end_secs()), (6.0, 7.0));
}

/// An hour at 60 frames a second: the sum of the steps, not of their rounding.
#[test]
fn small_steps_add_up() {
    let mut playback = playing(LoopMode::Loop, 0.0, 1.25);
    let dt_secs = 1.0_f32 / 60.0;
    let frames = 60 * 60 * 60;
    for _ in 0..frames {
        playback.advance(dt_secs);
    }
    let expected_secs = (f64::from(dt_secs) * f64::from(frames)).rem_euclid(1.25);
    assert!(
        (f64::from(playback.time_secs()) - expected_secs).abs() < 1e-4,
        "{}",
        playback.time_secs()
    );
}
