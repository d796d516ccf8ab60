//! The ground under a model.

use bindpose::scene::{Aabb, Ground};
use glam::Vec3;

fn ground(min: Vec3, max: Vec3) -> Ground {
    Ground::under(&Aabb { min, max }, &mut [])
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

/// Of a model 100 high in poses with these lowest points.
#[test]
fn a_model_that_stays_on_the_ground_stands_on_its_soles() {
    let bounds = Aabb {
        min: Vec3::new(-30.0, -3.0, -30.0),
        max: Vec3::new(30.0, 97.0, 30.0),
    };
    for (lowest, height) in [
        // One toe dips.
        (vec![0.5, -3.0, 0.25, 0.5, 0.5], 0.5),
        (vec![-1.0, -1.0, -1.5], -1.0),
        // A leap, and what hangs in the air: as without poses.
        (vec![0.0, 40.0, 1.0], -3.0),
        (vec![20.0, 21.0], -3.0),
        (vec![], -3.0),
    ] {
        assert_eq!(Ground::under(&bounds, &mut lowest.clone()).height, height, "{lowest:?}");
    }
}

#[test]
fn cells_are_round_numbers_near_the_size() {
    // The radius of a cube is half its diagonal.
    for (size, cell) in [
        (0.01, 0.01),
        (1.0, 1.0),
        (2.0, 2.0),
        (75.0, 50.0),
        (150.0, 100.0),
        (10_000.0, 10_000.0),
    ] {
        let found = ground(Vec3::ZERO, Vec3::splat(size));
        assert!((found.cell / cell - 1.0).abs() < 1e-4, "{size}: {}", found.cell);
    }
    assert_eq!(ground(Vec3::ONE, Vec3::ONE).cell, 1.0);
    assert_eq!(Ground::under(&Aabb::EMPTY, &mut []), Ground { height: 0.0, cell: 1.0 });
}
