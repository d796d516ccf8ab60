//! Labels of times.

use bindpose::ui::for_tests::{label_step, seconds};

#[test]
fn labels_stand_at_round_numbers_of_frames_and_seconds() {
    for (rate, least, step) in [
        (30.0, 0.5, 1),
        (30.0, 4.0, 5),
        (30.0, 12.0, 15),
        (30.0, 16.0, 30),
        (30.0, 100.0, 150),
        (24.0, 7.0, 8),
        (29.5, 7.0, 10),
        (30.0, 1e9, 77),
        (1.0, 0.5, 1),
    ] {
        assert_eq!(label_step(rate, least, 77), step, "{rate} {least}");
    }
}

#[test]
fn seconds_are_short() {
    assert_eq!(
        [0.0, 0.5, 1.25, 1.0 / 3.0, 10.0].map(seconds),
        ["0", "0.5", "1.25", "0.333", "10"]
    );
}
