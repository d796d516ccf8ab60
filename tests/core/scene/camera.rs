//! The camera, moved.

use std::f32::consts::{FRAC_PI_2, TAU};

use bindpose::scene::Camera;
use glam::{Vec2, Vec3};

use super::unit_box;

#[test]
fn the_view_is_left_handed_with_y_up() {
    let camera = Camera {
        yaw_radians: 0.0,
        pitch_radians: 0.0,
        ..Camera::default()
    };
    assert_eq!(
        (camera.right(), camera.up(), camera.forward()),
        (Vec3::X, Vec3::Y, Vec3::Z)
    );
    let in_view = camera.view_from_world().transform_point3(camera.target);
    assert!((in_view - Vec3::new(0.0, 0.0, camera.distance)).length() < 1e-5);
}

#[test]
fn zoom_holds_the_point_under_the_pointer() {
    let mut camera = Camera::default();
    let pointer = Vec2::new(0.3, -0.2);
    let under_pointer = |camera: &Camera| {
        camera.target + (camera.right() * pointer.x - camera.up() * pointer.y) * camera.height_in_view()
    };
    let before = under_pointer(&camera);
    camera.zoom(0.25, pointer);
    assert!((under_pointer(&camera) - before).length() < 1e-5);
    assert!((camera.distance - 1.0).abs() < 1e-6);
}

#[test]
fn panning_moves_the_scene_with_the_pointer() {
    let mut camera = Camera {
        yaw_radians: 0.0,
        pitch_radians: 0.0,
        ..Camera::default()
    };
    let point = camera.target;
    camera.pan(Vec2::new(0.5, 0.0));
    let clip = (camera.clip_from_view(1.0, &unit_box()) * camera.view_from_world()).project_point3(point);
    assert!(
        (clip.x - 1.0).abs() < 1e-5 && clip.y.abs() < 1e-5,
        "half a height to the right is the edge: {clip}"
    );
}

#[test]
fn a_box_around_the_eye_still_has_a_near_plane_before_its_far_plane() {
    for distance in [1e-3, 1.0, 1e5] {
        let camera = Camera {
            distance,
            ..Camera::default()
        };
        let (near, far) = camera.depth_range(&unit_box());
        assert!(0.0 < near && near < far, "{near} {far}");
    }
}

#[test]
fn orbit_never_tips_over() {
    let mut camera = Camera::default();
    camera.orbit(100.0, 100.0);
    assert!(camera.pitch_radians < FRAC_PI_2 && (0.0..TAU).contains(&camera.yaw_radians));
    assert!(camera.up().y > 0.0);
}
