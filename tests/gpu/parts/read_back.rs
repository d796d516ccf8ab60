//! Pixels that were read back.

use bindpose::render::for_tests::make_alpha_straight;
use bindpose::scene::{linear_from_srgb8, srgb8_from_linear};

#[test]
fn alpha_is_divided_out_of_the_colour_in_linear_light() {
    let half_covered = srgb8_from_linear(0.5 * linear_from_srgb8(200));
    for (premultiplied, straight) in [
        ([half_covered, 0, 0, 128], [200, 0, 0, 128]),
        ([200, 100, 50, 255], [200, 100, 50, 255]),
        ([0, 0, 0, 0], [0, 0, 0, 0]),
    ] {
        let mut pixel = premultiplied;
        make_alpha_straight(&mut pixel);
        for (found, expected) in pixel.into_iter().zip(straight) {
            assert!(found.abs_diff(expected) <= 1, "{pixel:?} for {straight:?}");
        }
    }
}
