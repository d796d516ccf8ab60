//! What is in sight.

use bindpose::scene::{Aabb, Camera, Projection, Sight};
use glam::Vec3;

fn cameras() -> impl Iterator<Item = Camera> {
    [Camera::default().projection, Projection::Orthographic]
        .into_iter()
        .flat_map(|projection| {
            [(0.0, 0.0), (2.5, -1.2), (-0.6, 0.4)].map(|(yaw_radians, pitch_radians)| Camera {
                target: Vec3::new(0.3, 1.0, -0.2),
                distance: 7.0,
                yaw_radians,
                pitch_radians,
                projection,
            })
        })
}

/// A net of points around the camera's target.
fn points() -> impl Iterator<Item = Vec3> {
    let steps = || (-6..=6).map(|step| step as f32 * 2.1 + 0.13);
    steps().flat_map(move |x| steps().flat_map(move |y| steps().map(move |z| Vec3::new(x, y, z))))
}

#[test]
fn what_projects_into_the_picture_is_shown_and_so_is_a_sphere_that_holds_it() {
    let bounds = Aabb::from_points([Vec3::splat(-20.0), Vec3::splat(20.0)]);
    for camera in cameras() {
        let sight = Sight::of(&camera, 1.6);
        let clip_from_world = camera.clip_from_view(1.6, &bounds) * camera.view_from_world();
        let (mut shown, mut hidden) = (0, 0);
        for point in points() {
            let clip = clip_from_world * point.extend(1.0);
            let is_shown = clip.x.abs() <= clip.w && clip.y.abs() <= clip.w && clip.w > 0.0;
            assert_eq!(sight.shows(point, 0.0), is_shown, "{point} {camera:?}");
            shown += usize::from(is_shown);
            hidden += usize::from(!is_shown);
            for aside in Vec3::AXES {
                assert!(!is_shown || sight.shows(point + aside, 1.0));
            }
        }
        assert!(shown > 20 && hidden > 20, "{shown} {hidden}");
    }
}

#[test]
fn a_sphere_as_high_as_the_picture_has_height_1() {
    for camera in cameras() {
        let sight = Sight::of(&camera, 1.0);
        let height = sight.height_of(camera.target, camera.height_in_view() * 0.5);
        assert!((height - 1.0).abs() < 1e-5, "{height}");
    }
    let [near, .., far] = cameras().collect::<Vec<_>>()[..] else {
        panic!("there are several")
    };
    let behind_target = |camera: Camera| camera.target + camera.forward() * camera.distance;
    let half_as_high = Sight::of(&near, 1.0).height_of(behind_target(near), near.height_in_view() * 0.5);
    assert!((half_as_high - 0.5).abs() < 1e-5, "{half_as_high}");
    let as_high = Sight::of(&far, 1.0).height_of(behind_target(far), far.height_in_view() * 0.5);
    assert!((as_high - 1.0).abs() < 1e-5, "{as_high}");
}
