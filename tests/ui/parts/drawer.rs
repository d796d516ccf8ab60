//! Where the drawer rests.

use bindpose::ui::for_tests::{Heights, Rest, settle_drawer};

#[test]
fn a_slow_finger_leaves_the_sheet_at_the_nearest_height_and_a_quick_one_flings_it() {
    let heights = Heights::new(false, 800.0, 600.0);
    for (height, rate, rest) in [
        (30.0, 0.0, None),
        (200.0, 0.0, Some(Rest::Peek)),
        (330.0, 100.0, Some(Rest::Half)),
        (580.0, -100.0, Some(Rest::Full)),
        (200.0, -900.0, Some(Rest::Half)),
        (380.0, -900.0, Some(Rest::Full)),
        (590.0, 900.0, Some(Rest::Half)),
        (300.0, 900.0, Some(Rest::Peek)),
        (150.0, 900.0, None),
        (600.0, -900.0, Some(Rest::Full)),
    ] {
        assert_eq!(settle_drawer(height, rate, heights), rest, "{height} at {rate}");
    }
}
