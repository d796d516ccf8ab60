//! Where the samples of a picture at rest lie.

use bindpose::render::for_tests::{lamp_offset, lens_offset, pixel_offset};
use glam::Vec2;

fn mean(points: &[Vec2]) -> Vec2 {
    points.iter().sum::<Vec2>() / points.len() as f32
}

#[test]
fn pixels_are_filtered_by_a_blackman_harris_window() {
    for count in [8, 16, 64, 1024] {
        let points: Vec<_> = (0..count).map(|index| Vec2::from(pixel_offset(index))).collect();
        assert!(points.iter().all(|point| point.abs().max_element() <= 1.5));
        assert!(
            mean(&points).length() < 3.0 / count as f32,
            "{count}: {}",
            mean(&points)
        );
    }
    let points: Vec<_> = (0..4096).map(|index| Vec2::from(pixel_offset(index))).collect();
    // The variance of the window from -1 to 1, by its terms: 1/3 + 2/π² Σ (-1)ⁿ aₙ / (a₀ n²).
    let terms = [-0.488_29, 0.141_28 / 4.0, -0.011_68 / 9.0f32];
    let variance = 1.0 / 3.0 + 2.0 / std::f32::consts::PI.powi(2) * terms.iter().sum::<f32>() / 0.358_75;
    let found = mean(&points.iter().map(|point| *point * *point).collect::<Vec<_>>());
    for axis in [found.x, found.y] {
        assert!(
            (axis / (1.5 * 1.5 * variance) - 1.0).abs() < 0.01,
            "{found} for {}",
            2.25 * variance
        );
    }
}

#[test]
fn the_lamp_is_walked_in_16_parts_of_equal_area() {
    let points: Vec<_> = (0..16).map(|index| Vec2::from(lamp_offset(index))).collect();
    assert!(mean(&points).length() < 1e-6);
    for (index, point) in points.iter().enumerate() {
        assert!(point.length() < 1.0);
        assert!(points[..index].iter().all(|other| other.distance(*point) > 0.2));
    }
    assert_eq!(lamp_offset(16), lamp_offset(0));
    // A disc of even density has a mean square radius of a half. The middles of strata have a little less: a 16th is in each of them.
    let square = points.iter().map(|point| point.length_squared()).sum::<f32>() / 16.0;
    assert!((square - (0.5 - 1.0 / 16.0)).abs() < 0.01, "{square}");
}

#[test]
fn the_lens_is_covered_evenly_by_any_number_of_points() {
    for count in [16, 64] {
        let points: Vec<_> = (0..count).map(|index| Vec2::from(lens_offset(index))).collect();
        assert!(points.iter().all(|point| point.length() <= 1.0 + 1e-6));
        assert!(mean(&points).length() < 0.1, "{count}: {}", mean(&points));
        let inside = points.iter().filter(|point| point.length_squared() < 0.5).count();
        assert!(
            inside.abs_diff(count as usize / 2) <= count as usize / 8,
            "{inside} of {count} in half the area"
        );
    }
}
