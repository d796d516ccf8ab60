//! The loop gap in numbers.

use bindpose::ui::for_tests::{distance_told, precision};

#[test]
fn what_files_round_away_is_zero_and_what_counts_is_not() {
    for size in [0.08, 1.8, 73.4] {
        let precision = precision(size);
        let noise = distance_told(7.5e-6 * size, precision);
        assert_eq!(noise, None, "noise in a model of {size}");
        let told: f32 = distance_told(1.1e-5 * size, precision)
            .expect("it counts")
            .parse()
            .expect("a number");
        assert!(told > 0.0, "{size}");
    }
}
