//! The camera, flown.

use bindpose::scene::{Camera, Projection};
use glam::Vec3;

#[test]
fn flying_goes_where_one_looks_and_up_is_the_worlds() {
    let mut camera = Camera {
        pitch_radians: 0.6,
        ..Camera::default()
    };
    let (eye, forward, right) = (camera.eye(), camera.forward(), camera.right());
    camera.fly(Vec3::new(1.0, 2.0, 3.0));
    let expected = eye + right + Vec3::Y * 2.0 + forward * 3.0;
    assert!(camera.eye().abs_diff_eq(expected, 1e-5), "{}", camera.eye());
    assert_eq!(camera.forward(), forward);
    camera.fly(Vec3::new(f32::NAN, 0.0, 0.0));
    assert!(camera.eye().abs_diff_eq(expected, 1e-5));
}

#[test]
fn what_is_ahead_grows_also_where_depth_is_no_size() {
    let mut camera = Camera {
        projection: Projection::Orthographic,
        ..Camera::default()
    };
    let (target, height) = (camera.target, camera.height_in_view());
    camera.fly(Vec3::Z);
    assert!(camera.height_in_view() < height && camera.target == target);
}

#[test]
fn looking_around_leaves_the_eye_where_it_is() {
    let mut camera = Camera::default();
    let (eye, forward) = (camera.eye(), camera.forward());
    camera.look_around(0.3, 0.2);
    assert!(camera.eye().abs_diff_eq(eye, 1e-5));
    assert!(camera.forward().y > forward.y, "up");
    let right = forward.cross(Vec3::Y).normalize() * -1.0;
    assert!(camera.forward().dot(right) > 0.0, "to the right");
    let before = camera;
    camera.look_around(f32::INFINITY, 0.0);
    assert!(camera.eye().abs_diff_eq(before.eye(), 1e-5));
}
