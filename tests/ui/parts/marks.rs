//! Keys as marks.

use bindpose::ui::for_tests::{MERGE_POINTS, MOST_RADIUS, Mark, TimeAxis, marks};
use egui::Rangef;

fn found(times_secs: &[f32], span_secs: [f32; 2], width: f32) -> Vec<Mark> {
    let axis = TimeAxis::new(Rangef::new(0.0, width), 0.0, span_secs);
    let mut found = Vec::new();
    marks(times_secs, &axis, |mark| found.push(mark));
    found
}

#[test]
fn keys_with_room_are_marks_of_their_own() {
    let keys = [0.0, 0.5, 1.0];
    assert_eq!(found(&keys, [0.0, 1.0], 100.0), [0.0, 50.0, 100.0].map(Mark::Key));
    assert_eq!(
        found(&keys, [0.0, 0.1], 100.0),
        [Mark::Key(0.0)],
        "the others are not seen"
    );
    assert_eq!(found(&[], [0.0, 1.0], 100.0), []);
    assert_eq!(
        found(&[0.5, 0.5], [0.0, 1.0], 100.0),
        [Mark::Key(50.0)],
        "two at one time"
    );
}

#[test]
fn keys_without_room_are_a_bar() {
    let keys = [0.1, 0.12, 0.14, 0.5, 0.9, 0.92];
    let marks = found(&keys, [0.0, 1.0], 100.0);
    let [Mark::Run(first), Mark::Key(middle), Mark::Run(last)] = marks[..] else {
        panic!("{marks:?}");
    };
    let near = |a: f32, b: f32| (a - b).abs() < 1e-3;
    assert!(near(first.min, 10.0) && near(first.max, 14.0) && near(middle, 50.0) && near(last.max, 92.0));
}

#[test]
fn there_are_never_more_marks_than_the_width_holds() {
    let mut seed = 7_u32;
    for count in [10, 1000, 100_000] {
        let mut keys: Vec<f32> = (0..count)
            .map(|_| {
                seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                (seed >> 8) as f32 / (1 << 24) as f32
            })
            .collect();
        keys.sort_by(f32::total_cmp);
        for span_secs in [[0.0, 1.0], [0.4, 0.6]] {
            let marks = found(&keys, span_secs, 600.0);
            let most = (600.0 + 2.0 * MOST_RADIUS) / MERGE_POINTS + 1.0;
            assert!(marks.len() as f32 <= most, "{} of {count}", marks.len());
        }
    }
}
