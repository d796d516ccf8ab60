//! Boxes.

use bindpose::model::Aabb;
use glam::{Affine3A, Vec3};

#[test]
fn an_empty_box_stays_empty_and_has_no_size() {
    assert!(Aabb::EMPTY.is_empty());
    assert_eq!(
        Aabb::EMPTY.transformed(Affine3A::from_scale(Vec3::NEG_ONE)),
        Aabb::EMPTY
    );
    assert_eq!(
        (Aabb::EMPTY.size(), Aabb::EMPTY.center(), Aabb::EMPTY.radius()),
        (Vec3::ZERO, Vec3::ZERO, 0.0)
    );
}

#[test]
fn mirroring_swaps_the_ends_of_an_axis() {
    let bounds = Aabb::from_points([Vec3::new(1.0, 2.0, 3.0), Vec3::new(-1.0, 0.0, 5.0)]);
    let mirrored = bounds.transformed(Affine3A::from_scale(Vec3::new(1.0, 1.0, -1.0)));
    assert_eq!(
        mirrored,
        Aabb {
            min: Vec3::new(-1.0, 0.0, -5.0),
            max: Vec3::new(1.0, 2.0, -3.0)
        }
    );
}
