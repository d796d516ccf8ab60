//! Curves as straight pieces.

use bindpose::anim::{LocalJoint, STRAIGHT_ERROR, straight};
use bindpose::model::{Channel, Track};
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
fn a_held_value_is_held_to_the_last_number_before_the_next_key() {
    let held = Channel::held([(0.0, Vec3::X), (1.0, Vec3::Y), (2.0, Vec3::Z)]);
    let track = with_translation(&still(), held);
    let straight = straight(&track);
    for time_secs in [0.0, 0.5, 1.0_f32.next_down(), 1.0, 1.5, 2.0_f32.next_down(), 2.0] {
        assert_eq!(straight.at(time_secs), track.at(time_secs), "{time_secs}");
    }
    assert_eq!(straight.key_count(), 5);
}
