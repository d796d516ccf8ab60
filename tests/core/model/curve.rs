//! Values that are held from key to key, and splines.

use bindpose::diagnostic::Fault;
use bindpose::model::Channel;
use glam::Vec3;

#[test]
fn a_held_value_changes_at_its_key() {
    let curve = Channel::held([(1.0, Vec3::X), (2.0, Vec3::Y)]).expect("times increase");
    for (time_secs, value) in [
        (0.0, Vec3::X),
        (1.0, Vec3::X),
        (1.999, Vec3::X),
        (2.0, Vec3::Y),
        (9.0, Vec3::Y),
    ] {
        assert_eq!(curve.value_at(time_secs), value, "{time_secs}");
    }
}

#[test]
fn a_spline_is_the_cubic_that_its_keys_and_slopes_were_taken_from() {
    // x = t³ − 2t, with slope 3t² − 2, between keys 2 s apart.
    let key = |t: f32| (t, Vec3::X * (t * t * t - 2.0 * t), [Vec3::X * (3.0 * t * t - 2.0); 2]);
    let curve = Channel::spline([key(-1.0), key(1.0), key(3.0)]).expect("times increase");
    for step in 0..=40 {
        let t = step as f32 * 0.1 - 1.0;
        assert!(
            (curve.value_at(t).x - key(t).1.x).abs() < 1e-5,
            "{t}: {}",
            curve.value_at(t)
        );
    }
    assert_eq!(curve.value_at(99.0), key(3.0).1);
}

#[test]
fn keys_that_make_no_curve_are_refused() {
    let nan = [Vec3::ZERO, Vec3::NAN];
    let refused = |curve: Result<Channel<Vec3>, Fault>| {
        let fault = curve.expect_err("no curve");
        (fault.code, fault.message)
    };
    let not_finite = |key| {
        let message = format!("Key {key} holds a number that is not finite, or a rotation without a direction.");
        ("key-not-finite", message)
    };
    assert_eq!(
        refused(Channel::held([])),
        ("no-keys", "A track needs at least one key.".into())
    );
    let twice = Channel::held([(1.0, Vec3::X), (1.0, Vec3::Y)]);
    let message = "Key 1 is not after the key before it; key times must increase.";
    assert_eq!(refused(twice), ("key-not-after", message.into()));
    assert_eq!(refused(Channel::spline([(0.0, Vec3::X, nan)])), not_finite(0));
    // Its keys can be written, and what is between them not.
    let steep = |time_secs| (time_secs, Vec3::ZERO, [Vec3::X * 3e38; 2]);
    assert_eq!(refused(Channel::spline([steep(0.0), steep(100.0)])), not_finite(1));
    assert!(Channel::spline([steep(0.0), steep(0.5)]).is_ok());
}
