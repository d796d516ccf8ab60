//! Values that are held from key to key, and splines.

use bindpose::model::{Curve, ModelError};
use glam::Vec3;

#[test]
fn a_held_value_changes_at_its_key() {
    let curve = Curve::step([(1.0, Vec3::X), (2.0, Vec3::Y)]).expect("times increase");
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
    let curve = Curve::cubic([key(-1.0), key(1.0), key(3.0)]).expect("times increase");
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
    assert!(matches!(Curve::<Vec3>::step([]), Err(ModelError::NoKeys)));
    let twice = Curve::step([(1.0, Vec3::X), (1.0, Vec3::Y)]);
    assert!(matches!(twice, Err(ModelError::KeyNotAfter { key: 1 })));
    assert!(matches!(
        Curve::cubic([(0.0, Vec3::X, nan)]),
        Err(ModelError::KeyNotFinite { key: 0 })
    ));
    // Its keys can be written, and what is between them not.
    let steep = |time_secs| (time_secs, Vec3::ZERO, [Vec3::X * 3e38; 2]);
    assert!(matches!(
        Curve::cubic([steep(0.0), steep(100.0)]),
        Err(ModelError::KeyNotFinite { key: 1 })
    ));
    assert!(Curve::cubic([steep(0.0), steep(0.5)]).is_ok());
}
