//! Rays through the picture.

use bindpose::scene::{Aabb, Camera, Projection, Ray};
use glam::{Vec2, Vec3};

#[test]
fn a_ray_goes_through_all_points_that_are_drawn_at_its_place() {
    let bounds = Aabb::from_points([Vec3::splat(-2.0), Vec3::new(3.0, 5.0, 1.0)]);
    for projection in [Camera::default().projection, Projection::Orthographic] {
        for (yaw_radians, pitch_radians) in [(0.0, 0.0), (-0.62, 0.2), (2.5, -1.2), (4.0, 1.5)] {
            let camera = Camera {
                target: Vec3::new(0.3, 1.0, -0.2),
                distance: 7.0,
                yaw_radians,
                pitch_radians,
                projection,
            };
            let aspect = 1.7;
            let clip_from_world = camera.clip_from_view(aspect, &bounds) * camera.view_from_world();
            for point in [Vec2::ZERO, Vec2::new(0.8, -0.4), Vec2::new(-1.0, 1.0)] {
                let ray = camera.ray(point, aspect, &bounds);
                assert!((ray.direction.length() - 1.0).abs() < 1e-6);
                for length in [0.0, 1.0, 8.0] {
                    let drawn = clip_from_world.project_point3(ray.origin + ray.direction * length);
                    assert!((drawn.truncate() - point).length() < 1e-4, "{drawn} instead of {point}");
                    if length == 0.0 {
                        assert!(drawn.z.abs() < 1e-4, "it begins on the near plane: {drawn}");
                    }
                }
            }
        }
    }
}

#[test]
fn a_ray_comes_into_a_box_where_it_meets_its_nearest_side() {
    let bounds = Aabb {
        min: Vec3::new(-1.0, 0.0, -2.0),
        max: Vec3::new(1.0, 4.0, 2.0),
    };
    let enters = |origin: Vec3, direction: Vec3| {
        let direction = direction.normalize();
        Ray { origin, direction }.enters(&bounds)
    };
    assert_eq!(enters(Vec3::new(0.0, 1.0, -5.0), Vec3::Z), Some(3.0));
    assert_eq!(enters(Vec3::new(0.0, 1.0, -5.0), Vec3::NEG_Z), None, "behind it");
    assert_eq!(enters(Vec3::new(0.0, 1.0, 0.0), Vec3::X), Some(0.0), "inside");
    assert_eq!(enters(Vec3::new(1.5, 1.0, -5.0), Vec3::Z), None, "beside it");
    assert_eq!(enters(Vec3::new(1.0, 4.0, -5.0), Vec3::Z), Some(3.0), "along an edge");
    let aslant = enters(Vec3::new(-4.0, 2.0, -5.0), Vec3::new(1.0, 0.0, 1.0)).expect("through a side");
    assert!((aslant - 3.0 * 2.0_f32.sqrt()).abs() < 1e-5, "{aslant}");
    assert_eq!(
        Ray {
            origin: Vec3::ZERO,
            direction: Vec3::Z
        }
        .enters(&Aabb::EMPTY),
        None
    );
}

#[test]
fn in_its_own_space_a_ray_is_the_z_axis() {
    let ray = Ray {
        origin: Vec3::new(3.0, -1.0, 4.0),
        direction: Vec3::new(2.0, -1.0, 0.5).normalize(),
    };
    let ray_from_world = ray.ray_from_world();
    for length in [0.0, 2.0] {
        let point = ray_from_world.transform_point3(ray.origin + ray.direction * length);
        assert!((point - Vec3::Z * length).length() < 1e-5, "{point}");
    }
    assert!((ray_from_world.matrix3.determinant().abs() - 1.0).abs() < 1e-5);
}
