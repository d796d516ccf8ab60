//! Values along a height.

use bindpose::ui::for_tests::{ValueAxis, round_up};
use egui::Rangef;

fn axis(values: &[f32]) -> ValueAxis {
    ValueAxis::fitted(Rangef::new(0.0, 200.0), values.iter().copied())
}

#[test]
fn all_values_are_inside_and_greater_ones_above() {
    let axis = axis(&[-3.0, 7.0, 2.0, f32::NAN]);
    let [low, high] = [-3.0, 7.0].map(|value| axis.y_of(value));
    assert!(high > 5.0 && low < 195.0 && high < low);
}

#[test]
fn what_stands_still_is_in_the_middle() {
    for value in [0.0, 5.0, -12_000.0] {
        assert!((axis(&[value, value]).y_of(value) - 100.0).abs() < 1e-2);
    }
    assert!(axis(&[]).y_of(0.0).is_finite());
}

#[test]
fn lines_are_round_and_have_room() {
    let (lines, decimals) = axis(&[-3.0, 7.0]).lines();
    assert_eq!((lines, decimals), (vec![-2.0, 0.0, 2.0, 4.0, 6.0], 0));
    let (lines, decimals) = axis(&[0.1, 0.2]).lines();
    assert_eq!(decimals, 2);
    assert!(
        lines.windows(2).all(|pair| (pair[1] - pair[0] - 0.02).abs() < 1e-5),
        "{lines:?}"
    );
    for step in [1e-4, 0.3, 1.0, 4.9, 700.0] {
        assert!(round_up(step) >= step * 0.999 && round_up(step) <= step * 2.5);
    }
}
