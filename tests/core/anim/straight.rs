//! Curves as straight pieces.

use bindpose::anim::{CompiledClip, LocalJoint, LocalPose, STRAIGHT_ERROR, sample, straight};
use bindpose::model::{Channel, Clip, Track};
use glam::{Quat, Vec3};

use crate::documents::{with_rotation, with_translation};

fn still() -> Track {
    let still = |time_secs| (time_secs, LocalJoint::IDENTITY);
    Track::new([still(0.0), still(1.0), still(2.0)]).expect("times increase")
}

fn greatest_error(track: &Track) -> f32 {
    let straight = straight(track);
    let apart = |time_secs| {
        let [a, b] = [track.at(time_secs), straight.at(time_secs)];
        a.translation
            .distance(b.translation)
            .max(2.0 * (a.rotation - b.rotation).length())
    };
    (0..=4000).map(|step| apart(step as f32 * 0.0005)).fold(0.0, f32::max)
}

#[test]
fn pieces_stay_beside_a_spline_that_eases_in_and_out() {
    let key = |time_secs, x| (time_secs, Vec3::X * x, [Vec3::ZERO; 2]);
    let turn = |time_secs, radians| {
        let still = Quat::from_xyzw(0.0, 0.0, 0.0, 0.0);
        (time_secs, Quat::from_rotation_y(radians), [still; 2])
    };
    let turned = Channel::spline([turn(0.0, 0.0), turn(1.0, 1.5), turn(2.0, 3.0)]);
    let moved = Channel::spline([key(0.0, 0.0), key(1.0, 10.0), key(2.0, -5.0)]);
    let track = with_rotation(&with_translation(&still(), moved), turned);
    let error = greatest_error(&track);
    assert!(error < 4.0 * 15.0 * STRAIGHT_ERROR, "{error}");
    let keys = straight(&track).key_count();
    assert!((100..1200).contains(&keys), "{keys}");
}

#[test]
fn a_spline_swings_out_between_keys_that_are_the_same() {
    let key = |time_secs, slope: f32| (time_secs, Vec3::ZERO, [Vec3::X * slope; 2]);
    let swings = Channel::spline([key(0.0, 40.0), key(1.0, -40.0), key(2.0, 40.0)]);
    let track = with_translation(&still(), swings);
    assert!(track.at(0.5).translation.x > 9.0);
    let error = greatest_error(&track);
    assert!(error < 40.0 * STRAIGHT_ERROR, "{error}");
}

#[test]
fn a_held_value_is_held_to_the_last_number_before_the_next_key() {
    let held = Channel::held([(0.0, Vec3::X), (1.0, Vec3::Y), (2.0, Vec3::Z)]);
    let track = with_translation(&still(), held);
    let straight = straight(&track);
    for time_secs in [0.0, 0.5, 1.0_f32.next_down(), 1.0, 1.5, 2.0_f32.next_down(), 2.0] {
        assert_eq!(straight.at(time_secs), track.at(time_secs), "{time_secs}");
    }
    assert_eq!(straight.key_count(), 5);
}

/// Twenty joints with a key at each of 240 frames; each channel moves or stays.
fn compiled(moves: [bool; 3], held: bool) -> CompiledClip {
    let times = || (0_u16..240).map(|frame| f32::from(frame) / 60.0);
    let vectors = |moves: bool, first: Vec3| {
        let step = if moves { Vec3::splat(0.25) } else { Vec3::ZERO };
        let keys = times().map(|secs| (secs, first + step * secs));
        if held {
            Channel::held(keys)
        } else {
            Channel::straight(keys)
        }
    };
    let angle = if moves[0] { 0.5 } else { 0.0 };
    let turns = times().map(|secs| (secs, Quat::from_rotation_y(angle * secs)));
    let rotation = if held {
        Channel::held(turns)
    } else {
        Channel::straight(turns)
    };
    let channels = with_translation(&still(), vectors(moves[1], Vec3::ZERO));
    let track = Track::of_channels(
        channels.translation().clone(),
        rotation.expect("times increase"),
        vectors(moves[2], Vec3::ONE).expect("times increase"),
    );
    CompiledClip::new(&Clip::new("way", vec![track; 20]))
}

#[test]
fn compiled_keys_take_the_bytes_of_what_moves_and_steps_take_no_more() {
    for (moves, most) in [
        ([true, false, false], 24.5),
        ([true, true, false], 36.5),
        ([false, true, false], 12.5),
        ([true; 3], 48.5),
        ([false; 3], 0.5),
    ] {
        for held in [false, true] {
            let bytes = compiled(moves, held).byte_count() as f32 / (20.0 * 240.0);
            assert!((most - 0.6..most).contains(&bytes), "{moves:?}, held: {held}: {bytes}");
        }
    }
}

#[test]
fn a_compiled_clip_holds_steps_beside_joints_that_go_on() {
    let held = with_translation(
        &still(),
        Channel::held([(0.0, Vec3::X), (1.0, Vec3::Y), (2.0, Vec3::Z)]),
    );
    let turned = |radians: f32| Quat::from_rotation_z(radians);
    let jumps = with_rotation(&still(), Channel::held([(0.25, turned(0.0)), (1.25, turned(3.0))]));
    let goes = with_rotation(&still(), Channel::straight([(0.5, turned(0.5)), (1.75, turned(1.75))]));
    let tracks = vec![held, jumps, goes];
    let clip = CompiledClip::new(&Clip::new("steps", tracks.clone()));
    let mut local = LocalPose::default();
    for secs in [
        0.0,
        0.3,
        0.9,
        1.0_f32.next_down(),
        1.0,
        1.25_f32.next_down(),
        1.25,
        1.5,
        2.0,
    ] {
        sample(&clip, secs, &mut local);
        for (joint, track) in local.joints().zip(&tracks) {
            let expected = track.at(secs);
            assert!(
                joint.translation.abs_diff_eq(expected.translation, 1e-6),
                "{secs}: {joint:?}"
            );
            assert!(
                joint.rotation.dot(expected.rotation).abs() > 1.0 - 1e-6,
                "{secs}: {joint:?}"
            );
        }
        assert_eq!(
            local.joints().next().expect("a joint").translation,
            tracks[0].at(secs).translation
        );
    }
}
