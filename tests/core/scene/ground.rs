//! The ground under a model.

use bindpose::scene::{Aabb, Ground};
use glam::Vec3;

fn ground(min: Vec3, max: Vec3) -> Ground {
    Ground::under(&Aabb { min, max })
}

#[test]
fn lies_at_zero_and_never_cuts_a_model() {
    for (min_y, max_y, height) in [
        (0.0, 70.0, 0.0),
        (-3.0, 70.0, -3.0),
        (5.0, 70.0, 0.0),
        (-1.0, 1.0, -1.0),
        (90.0, 91.0, 90.0),
    ] {
        let found = ground(Vec3::new(-1.0, min_y, -1.0), Vec3::new(1.0, max_y, 1.0));
        assert_eq!(found.height, height, "{min_y}..{max_y}");
    }
}

#[test]
fn cells_follow_the_size_by_powers_of_ten() {
    for (size, cell) in [(0.01, 0.001), (1.0, 0.1), (75.0, 10.0), (10_000.0, 1000.0)] {
        let found = ground(Vec3::ZERO, Vec3::splat(size));
        assert!((found.cell / cell - 1.0).abs() < 1e-4, "{size}: {}", found.cell);
    }
    assert_eq!(ground(Vec3::ONE, Vec3::ONE).cell, 1.0);
    assert_eq!(Ground::under(&Aabb::EMPTY), Ground { height: 0.0, cell: 1.0 });
}
