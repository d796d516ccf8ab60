//! Ranges of a clip, speeds, and the way of the books' demo.

use bindpose::anim::{LoopMode, MAX_SPEED, MIN_SPEED, Playback, WrapMode};

fn ranged(start_secs: f32, end_secs: f32) -> Playback {
    let mut playback = Playback::new(0.0, 4.0);
    playback.set_range_start(start_secs);
    playback.set_range_end(end_secs);
    playback
}

#[test]
fn a_range_lies_in_the_span_and_has_a_length() {
    let mut playback = Playback::new(0.5, 4.0);
    assert_eq!((playback.range_secs(), playback.played_secs()), (None, [0.5, 4.0]));
    playback.set_range_start(1.0);
    assert_eq!(playback.range_secs(), Some([1.0, 4.0]));
    playback.set_range_end(2.0);
    assert_eq!(
        (playback.range_secs(), playback.played_secs()),
        (Some([1.0, 2.0]), [1.0, 2.0])
    );

    // Beyond the other end, that end gives way.
    playback.set_range_start(3.0);
    assert_eq!(playback.range_secs(), Some([3.0, 4.0]));
    playback.set_range_end(1.5);
    assert_eq!(playback.range_secs(), Some([0.5, 1.5]));
    playback.set_range_end(0.75);
    assert_eq!(playback.range_secs(), Some([0.5, 0.75]));

    // No length is left: nothing happens.
    playback.set_range_start(9.0);
    playback.set_range_start(f32::NAN);
    playback.set_range_end(f32::NAN);
    playback.set_range_end(0.5);
    playback.set_range_end(f32::NEG_INFINITY);
    assert_eq!(playback.range_secs(), Some([0.5, 0.75]));

    // All of the span is no range.
    playback.set_range_end(f32::INFINITY);
    assert_eq!(playback.range_secs(), None);
    playback.set_range_start(1.0);
    playback.clear_range();
    assert_eq!(playback.range_secs(), None);
    playback.set_range_start(1.0);
    playback.set_span(0.5, 4.0);
    assert_eq!(playback.range_secs(), None, "a new span is played whole");
}

#[test]
fn a_span_without_length_has_no_range() {
    let mut playback = Playback::new(2.0, 2.0);
    playback.set_range_start(2.0);
    playback.set_range_end(2.0);
    assert_eq!((playback.range_secs(), playback.played_secs()), (None, [2.0, 2.0]));
}

#[test]
fn seeking_leaves_the_range_and_playing_comes_back_to_it() {
    for (backward, begins_secs, then_secs) in [(false, 1.0, 1.25), (true, 3.0, 2.75)] {
        for outside_secs in [0.25, 3.5] {
            let mut playback = ranged(1.0, 3.0);
            playback.set_backward(backward);
            playback.seek(outside_secs);
            assert_eq!(playback.time_secs(), outside_secs);
            playback.play();
            assert_eq!(playback.time_secs(), begins_secs);
            // Sought to while it plays, it stays there until time goes by.
            playback.seek(outside_secs);
            assert_eq!(playback.time_secs(), outside_secs);
            playback.advance(0.25);
            assert_eq!(playback.time_secs(), then_secs);
        }
    }
}

#[test]
fn a_range_that_the_time_is_not_in_waits_for_time_to_go_by() {
    let mut playback = Playback::new(0.0, 4.0);
    playback.set_loop_mode(LoopMode::PingPong);
    playback.play();
    playback.advance(5.0);
    assert_eq!(playback.time_secs(), 3.0);
    playback.set_range_end(2.0);
    assert_eq!(playback.time_secs(), 3.0);
    playback.advance(0.5);
    assert_eq!(playback.time_secs(), 0.5, "from the start, on the way there");
}

#[test]
fn any_speed_between_the_limits_can_be_set() {
    let mut playback = Playback::new(0.0, 4.0);
    for (asked, speed) in [
        (0.05, 0.05),
        (0.333, 0.333),
        (4.0, 4.0),
        (1e-9, MIN_SPEED),
        (4.000_001, MAX_SPEED),
        (f32::MAX, MAX_SPEED),
        (0.0, MAX_SPEED),
        (-1.0, MAX_SPEED),
        (f32::NAN, MAX_SPEED),
        (f32::INFINITY, MAX_SPEED),
    ] {
        playback.set_speed(asked);
        assert_eq!(playback.speed(), speed, "{asked}");
    }
}

/// The demo sets the time to 0 and knows nothing of where a clip starts.
#[test]
fn the_books_demo_begins_at_zero_where_it_can() {
    for ([start_secs, end_secs], first_secs) in [
        ([0.0, 1.0], 0.0),
        ([-0.5, 1.0], 0.0),
        ([0.5, 1.5], 0.5),
        ([-2.0, -1.0], -2.0),
        ([-1.0, 0.0], -1.0),
    ] {
        let mut playback = Playback::new(start_secs, end_secs);
        playback.set_wrap_mode(WrapMode::BookDemo);
        playback.seek(end_secs);
        playback.play();
        playback.advance(0.25);
        assert_eq!(playback.time_secs(), first_secs, "{start_secs} to {end_secs}");
    }
}

#[test]
fn the_demos_loop_stands_on_its_end_and_loses_the_rest_of_a_step() {
    let mut playback = Playback::new(0.0, 1.0);
    playback.set_wrap_mode(WrapMode::BookDemo);
    playback.play();
    for time_secs in [0.75, 0.0, 0.75, 0.0] {
        playback.advance(0.75);
        assert_eq!(playback.time_secs(), time_secs);
    }
    playback.advance(1.0);
    assert_eq!(playback.time_secs(), 1.0);
    playback.set_loop_mode(LoopMode::PingPong);
    playback.advance(0.25);
    assert_eq!(playback.time_secs(), 0.75, "only a loop begins again");
}
