//! A drag and its rate.

use bindpose::ui::for_tests::DragTrail;
use glam::Vec2;

#[test]
fn a_steady_drag_has_its_rate_and_one_that_waits_has_none() {
    let mut trail = DragTrail::default();
    for step in 0..20 {
        trail.add(f64::from(step) * 0.01, Vec2::new(0.02, -0.01));
    }
    let rate = trail.rate_per_sec(0.19);
    assert!((rate - Vec2::new(2.0, -1.0)).abs().max_element() < 0.3, "{rate}");
    assert_eq!(trail.rate_per_sec(0.4), Vec2::ZERO, "it stood still before the end");
    trail.clear();
    assert_eq!(trail.rate_per_sec(0.19), Vec2::ZERO);
}
