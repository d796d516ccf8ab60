//! Ten hours of playing against whole numbers: every time and step is a multiple of 2⁻⁸⁰ s, so that nothing is rounded.

use bindpose::anim::{LoopMode, Playback, WrapMode};

const TEN_HOURS_SECS: f64 = 36_000.0;

/// What the sum of some million steps may lose of an exact time, beside the rounding of the result to f32: each step loses
/// at most 2⁻⁵² s of a clip of less than four seconds.
const TOLERANCE_SECS: f64 = 1e-9;

/// Steps of 59.94 a second, of a screen at 144 Hz, and one that no screen has.
const STEPS_SECS: [f32; 3] = [0.016_683_351, 0.006_944_444_6, 0.037_9];

const SPAN_SECS: [f32; 2] = [0.3, 1.7];

/// A number in units of 2⁻ᵇⁱᵗˢ. Small f32 have no finer bits than the 40 and 80 that are used here.
fn whole(number: f32, bits: i32) -> i128 {
    let scaled = f64::from(number) * 2.0_f64.powi(bits);
    assert_eq!(scaled.fract(), 0.0, "{number} is no multiple of 2^-{bits}");
    scaled as i128
}

fn secs(units: i128) -> f64 {
    units as f64 / 2.0_f64.powi(80)
}

/// Plays for ten hours and gives the number of steps.
fn play(playback: &mut Playback, dt_secs: f32) -> i128 {
    let steps = (TEN_HOURS_SECS / f64::from(dt_secs)) as u32;
    for _ in 0..steps {
        playback.advance(dt_secs);
    }
    i128::from(steps)
}

fn playing(loop_mode: LoopMode, speed: f32, backward: bool) -> Playback {
    let mut playback = Playback::new(SPAN_SECS[0], SPAN_SECS[1]);
    playback.set_loop_mode(loop_mode);
    playback.set_speed(speed);
    playback.set_backward(backward);
    playback.play();
    playback
}

#[track_caller]
fn assert_exact(playback: &Playback, expected: i128) {
    let (time_secs, expected_secs) = (playback.time_secs(), secs(expected));
    let rounding_secs = f64::from(time_secs.next_up() - time_secs) * 0.5;
    let off_secs = (f64::from(time_secs) - expected_secs).abs();
    assert!(
        off_secs <= rounding_secs + TOLERANCE_SECS,
        "{time_secs} s is {off_secs} s off {expected_secs} s: {playback:?}"
    );
}

#[test]
fn loops_and_ping_pongs_do_not_drift() {
    let [start, end] = SPAN_SECS.map(|secs| whole(secs, 80));
    let length = end - start;
    for dt_secs in STEPS_SECS {
        for (speed, backward) in [(1.0, false), (0.37, true)] {
            let step = whole(dt_secs, 40) * whole(speed, 40) * if backward { -1 } else { 1 };

            let mut playback = playing(LoopMode::Loop, speed, backward);
            let way = step * play(&mut playback, dt_secs);
            assert_exact(&playback, start + way.rem_euclid(length));

            let mut playback = playing(LoopMode::PingPong, speed, backward);
            let way = step * play(&mut playback, dt_secs);
            let flat = way.rem_euclid(2 * length);
            assert_exact(&playback, start + flat.min(2 * length - flat));
        }
    }
}

#[test]
fn the_way_of_the_books_demo_does_not_drift() {
    let [start, end] = SPAN_SECS.map(|secs| whole(secs, 80));
    for dt_secs in STEPS_SECS {
        let mut playback = playing(LoopMode::Loop, 0.37, false);
        playback.set_wrap_mode(WrapMode::BookDemo);
        let steps = play(&mut playback, dt_secs);
        let step = whole(dt_secs, 40) * whole(0.37, 40);
        let mut time = start;
        for _ in 0..steps {
            time += step;
            if time > end {
                time = start;
            }
        }
        assert_exact(&playback, time);
    }
}

#[test]
fn a_clip_of_ten_hours_plays_once_to_its_end_in_time() {
    for backward in [false, true] {
        let mut playback = Playback::new(0.0, 40_000.0);
        playback.set_loop_mode(LoopMode::Once);
        playback.set_backward(backward);
        playback.play();
        let steps = play(&mut playback, STEPS_SECS[0]);
        let way = secs(whole(STEPS_SECS[0], 80) * steps);
        let expected_secs = if backward { 40_000.0 - way } else { way };
        // What f32 tells apart at this time is 2⁻⁸ s; the sum itself is off by less than two million times 2⁻³⁸ s.
        let off_secs = (f64::from(playback.time_secs()) - expected_secs).abs();
        assert!(off_secs <= 2.0_f64.powi(-9) + 1e-5, "{off_secs}");
        assert!(playback.is_playing());
    }
}
