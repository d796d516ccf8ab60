//! The tone map.

use glam::Vec3;

use crate::twins::tone_map::{exposed, tone_mapped};

/// Where colours begin to bend: the shoulder and the veil that is taken off.
const SHOULDER: f32 = 0.8;

fn colors() -> impl Iterator<Item = Vec3> {
    let steps = || [0.0f32, 0.01, 0.05, 0.1, 0.3, 0.6, 0.79, 0.9, 1.5, 4.0, 30.0, 1_000.0].into_iter();
    steps().flat_map(move |r| steps().flat_map(move |g| steps().map(move |b| Vec3::new(r, g, b))))
}

#[test]
fn nothing_leaves_the_screen() {
    for color in colors() {
        let shown = tone_mapped(color);
        assert!(
            shown.min_element() >= -1e-6 && shown.max_element() <= 1.0,
            "{color}: {shown}"
        );
    }
}

#[test]
fn more_light_never_shows_darker() {
    for color in colors().filter(|color| *color != Vec3::ZERO) {
        let mut before = f32::NEG_INFINITY;
        for step in 0..60 {
            let shown = tone_mapped(exposed(color, step as f32 * 0.25 - 8.0));
            let brightness = shown.max_element();
            // Once white, the last digit of f32 may go either way.
            assert!(
                brightness >= before - 1e-6,
                "{color} at step {step}: {brightness} after {before}"
            );
            before = brightness;
        }
    }
}

#[test]
fn below_the_shoulder_only_what_a_dielectric_mirrors_is_taken_off() {
    for color in colors().filter(|color| color.max_element() < SHOULDER && color.min_element() >= 0.032) {
        let difference = color - tone_mapped(color);
        assert!(
            (difference - Vec3::splat(0.016)).abs().max_element() < 1e-6,
            "{color}: {difference}"
        );
    }
    assert_eq!(tone_mapped(Vec3::ZERO), Vec3::ZERO);
}

/// The share of the way from the least to the greatest channel at which the middle one lies: what remains of a hue when
/// white is mixed in.
#[test]
fn hues_stay() {
    let hue = |color: Vec3| {
        let mut channels = color.to_array();
        channels.sort_by(f32::total_cmp);
        (channels[1] - channels[0]) / (channels[2] - channels[0])
    };
    let mut compared = 0;
    for color in colors().filter(|color| color.max_element() > color.min_element()) {
        let shown = tone_mapped(color);
        if shown.max_element() - shown.min_element() < 0.02 {
            continue;
        }
        assert!((hue(shown) - hue(color)).abs() < 1e-3, "{color} became {shown}");
        compared += 1;
    }
    assert!(compared > 800, "{compared}");
}

#[test]
fn a_stop_doubles() {
    assert_eq!(exposed(Vec3::new(0.1, 0.2, 0.4), 1.0), Vec3::new(0.2, 0.4, 0.8));
    assert_eq!(exposed(Vec3::ONE, -2.0), Vec3::splat(0.25));
}
