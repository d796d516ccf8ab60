//! Series of pictures.

use std::f32::consts::TAU;

use bindpose::model::Clip;
use bindpose::scene::{Frames, MOST_SHOTS, Shot};

#[test]
fn the_end_is_left_out_and_the_first_is_the_start() {
    assert_eq!(Frames::Count(4).times_secs([1.0, 3.0]), [1.0, 1.5, 2.0, 2.5]);
    assert_eq!(Frames::Count(1).times_secs([1.0, 3.0]), [1.0]);
    assert_eq!(Frames::PerSec(2.0).times_secs([-1.0, 0.5]), [-1.0, -0.5, 0.0]);
    assert_eq!(
        Frames::PerSec(2.0).times_secs([0.0, 1.2]),
        [0.0, 0.5, 1.0],
        "the last lasts shorter"
    );
    // 75 frames at 30 a second, written with seven digits.
    assert_eq!(Frames::PerSec(30.0).count([0.0, 2.500_000_2]), 75);
}

#[test]
fn a_clip_without_length_has_one_frame_a_second_or_as_many_as_asked() {
    assert_eq!(Frames::PerSec(30.0).times_secs([2.0, 2.0]), [2.0]);
    assert_eq!(Frames::Count(2).times_secs([2.0, 2.0]), [2.0, 2.0]);
    assert_eq!(Frames::PerSec(1e12).count([0.0, 1.0]), 4_294_967_295);
    assert_eq!(Frames::PerSec(1e12).times_secs([0.0, 1.0]).len(), MOST_SHOTS as usize);
}

#[test]
fn the_shorter_of_clip_and_turn_begins_again() {
    let turns = |shots: &[Shot]| -> Vec<_> {
        let quarter = |shot: &Shot| (shot.turn_radians.unwrap_or(-1.0) / TAU * 4.0).round();
        shots.iter().map(|shot| (shot.time_secs, quarter(shot))).collect()
    };
    assert_eq!(
        turns(&Shot::series(&[0.0, 0.5], 4)),
        [(Some(0.0), 0.0), (Some(0.5), 1.0), (Some(0.0), 2.0), (Some(0.5), 3.0)]
    );
    assert_eq!(
        turns(&Shot::series(&[0.0, 0.5, 1.0], 2)),
        [(Some(0.0), 0.0), (Some(0.5), 2.0), (Some(1.0), 0.0)]
    );
    assert_eq!(turns(&Shot::series(&[], 2)), [(None, 0.0), (None, 2.0)]);
    let without = Shot::series(&[0.0], 0);
    assert_eq!((without.len(), without[0].turn_radians), (1, None));
}

#[test]
fn a_caption_says_time_frame_and_turn() {
    let mut clip = Clip::new("walk", Vec::new());
    clip.end_secs = 2.0;
    let caption = |time_secs, turn_radians| {
        let shot = Shot {
            time_secs,
            turn_radians,
        };
        shot.caption(Some(&clip)).join(" · ")
    };
    assert_eq!(caption(Some(1.0), None), "1.000 s · frame 30");
    assert_eq!(caption(Some(0.05), Some(TAU / 16.0)), "0.050 s · frame 1.5 · 22.5°");
    assert_eq!(caption(None, Some(TAU / 4.0)), "90°");
}
