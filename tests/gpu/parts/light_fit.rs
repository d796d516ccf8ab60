//! Lights, and the maps that they see.

use bindpose::render::for_tests::{ContactFit, ShadowFit, StudioLights, light_axes, to_book_lights};
use bindpose::scene::{Aabb, Camera, Projection};
use glam::Vec3;

/// Half the width of the disc of taps, in its radii, where half of the light comes through.
const DISC_EDGE: f32 = 1.374;
/// Radii of the disc in texels: of the book's blur, and the least of any.
const BOOK_RADIUS_TEXELS: f32 = 3.5;
const LEAST_RADIUS_TEXELS: f32 = 1.5;

/// As the demo's `XMMatrixRotationY` does it: z goes towards x.
#[test]
fn the_books_lights_turn_about_y() {
    let (quarter, s) = (std::f32::consts::FRAC_PI_2, std::f32::consts::FRAC_1_SQRT_2);
    let expected = [
        [(-0.57735, 0.57735, -0.57735), (0.57735, 0.57735, -0.57735), (0.0, s, s)],
        [(-0.57735, 0.57735, 0.57735), (-0.57735, 0.57735, -0.57735), (s, s, 0.0)],
        [(0.57735, 0.57735, 0.57735), (-0.57735, 0.57735, 0.57735), (0.0, s, -s)],
    ];
    for (turns, expected) in (0..).zip(expected) {
        let found = to_book_lights(quarter * turns as f32);
        for (found, (x, y, z)) in found.into_iter().zip(expected) {
            assert!(
                found.abs_diff_eq(Vec3::new(x, y, z), 1e-4),
                "{found} after {turns} quarters"
            );
        }
    }
}

#[test]
fn the_key_is_above_to_the_right_and_before_the_model_from_every_side() {
    for yaw_radians in [0.0, 1.0, 2.5, -3.0] {
        let camera = Camera {
            target: Vec3::ZERO,
            distance: 1.0,
            yaw_radians,
            pitch_radians: 0.3,
            projection: Projection::Orthographic,
        };
        let StudioLights { to_key, to_rim } = StudioLights::beside(&camera, 0.0);
        assert!(to_key.y > 0.5 && to_key.dot(camera.right()) > 0.4 && to_key.dot(camera.forward()) < -0.3);
        assert!(to_rim.dot(camera.right()) < -0.4 && to_rim.dot(camera.forward()) > 0.3);
    }
}

#[test]
fn every_corner_of_the_box_lies_inside_the_map() {
    let to_key = Vec3::new(0.6, 0.7, -0.4).normalize();
    for (min, max) in [
        (Vec3::ZERO, Vec3::new(1.0, 70.0, 3.0)),
        (Vec3::splat(-1e4), Vec3::splat(1e4)),
        (Vec3::splat(5.0), Vec3::splat(5.001)),
        (Vec3::ZERO, Vec3::ZERO),
    ] {
        let bounds = Aabb { min, max };
        for fit in [
            ShadowFit::studio(&bounds, to_key, MAP_SIDE),
            ShadowFit::book(&bounds, to_key, MAP_SIDE, bounds.size().y / 3.6),
        ] {
            for corner in 0..8 {
                let pick = |bit: usize| if corner >> bit & 1 == 0 { min[bit] } else { max[bit] };
                let clip = fit
                    .shadow_clip_from_world
                    .project_point3(Vec3::new(pick(0), pick(1), pick(2)));
                assert!(
                    clip.x.abs() < 1.0 && clip.y.abs() < 1.0 && (0.0..1.0).contains(&clip.z),
                    "{clip}"
                );
            }
        }
    }
}

const MAP_SIDE: u32 = 2048;
const FIGURE: Aabb = Aabb {
    min: Vec3::new(-0.7, 0.0, -0.4),
    max: Vec3::new(0.7, 3.6, 0.4),
};

/// A thousandth of a radian moves a point of a turning map by no more than that, in maps, times the corner's distance from
/// the middle, which is below 2. A frame that turns over moves it by the whole map.
#[test]
fn the_map_turns_evenly_with_the_light() {
    const STEP_RADIANS: f32 = 1e-3;
    let lights = [Vec3::new(0.64, 0.74, -0.34), Vec3::new(-0.57735, 0.57735, -0.57735)];
    for to_key in lights.map(Vec3::normalize) {
        let fit_at = |step: u32| {
            let turned = glam::Quat::from_rotation_y(step as f32 * STEP_RADIANS) * to_key;
            [
                ShadowFit::studio(&FIGURE, turned, MAP_SIDE),
                ShadowFit::book(&FIGURE, turned, MAP_SIDE, 1.0),
            ]
        };
        let mut sign_changes = 0;
        let mut before = fit_at(0);
        for step in 1..=6284 {
            let here = fit_at(step);
            for (before, here) in before.iter().zip(here) {
                for corner in [FIGURE.min, FIGURE.max] {
                    let at = |fit: &ShadowFit| fit.shadow_clip_from_world.project_point3(corner);
                    let moved = at(before).distance(at(&here));
                    assert!(moved < 3.0 * STEP_RADIANS, "{moved} at step {step}");
                }
            }
            let z = |fits: &[ShadowFit; 2]| fits[0].shadow_clip_from_world.row(2).z;
            sign_changes += u32::from((z(&before) > 0.0) != (z(&here) > 0.0));
            before = here;
        }
        assert_eq!(sign_changes, 2, "a whole turn passes z = 0 twice");
    }
}

#[test]
fn a_light_straight_above_has_axes() {
    for to_key in [Vec3::Y, Vec3::NEG_Y] {
        let [right, up, forward] = light_axes(to_key);
        assert!(right.cross(up).dot(forward).abs() > 0.999, "{right} {up} {forward}");
    }
}

/// 2.4 of the demo's texels, whichever box the animation reaches.
#[test]
fn the_books_blur_is_as_wide_in_every_box() {
    let to_key = Vec3::new(-0.57735, 0.57735, -0.57735).normalize();
    for width in [0.1, 1.4, 4.0, 11.0] {
        let half = Vec3::new(width * 0.5, 1.8, width * 0.5);
        let bounds = Aabb { min: -half, max: half };
        let fit = ShadowFit::book(&bounds, to_key, MAP_SIDE, 1.0);
        let edge = fit.radius_texels * fit.texel * DISC_EDGE;
        assert!((edge / 3.6 - 0.011_74).abs() < 1e-4, "{edge} in a box {width} wide");
        assert!(fit.radius_texels >= 0.999 * BOOK_RADIUS_TEXELS, "the texels would show");
    }
    let [small, large] = [1.0, 20.0].map(|unit| {
        let bounds = Aabb {
            min: FIGURE.min * unit,
            max: FIGURE.max * unit,
        };
        ShadowFit::book(&bounds, to_key, MAP_SIDE, unit)
    });
    assert!(
        (large.texel / small.texel - 20.0).abs() < 1e-3 && (large.radius_texels - small.radius_texels).abs() < 1e-3
    );
}

/// The contact map's texels are as large for one figure as for some in a row, as long as the largest map has enough of them, and lie at the
/// same places of the world.
#[test]
fn contacts_keep_their_texels_wherever_the_box_lies() {
    let fit = |wider: f32| {
        let row = Aabb {
            max: FIGURE.max + Vec3::X * wider,
            ..FIGURE
        };
        let fit = ContactFit::new(&row, 1.0);
        let texel = 2.0 * fit.half_width / fit.map_size as f32;
        let room = fit.half_width - 0.5 * (1.4 + wider);
        assert!(room > 20.0 * texel, "{wider} wider: the blur has room");
        (fit, texel)
    };
    let (alone, texel) = fit(0.0);
    assert_eq!(alone.map_size, 256);
    for (wider, map_size) in [(0.013, 256), (1.7, 256), (7.0, 512), (15.0, 768), (21.0, 1024)] {
        let (row, of_row) = fit(wider);
        assert_eq!(row.map_size, map_size, "{wider} wider");
        assert!((of_row / texel - 1.0).abs() < 1e-5, "{wider} wider");
        let steps = (row.center - alone.center) / texel;
        assert!(
            (steps - steps.round()).abs().max_element() < 1e-3,
            "{wider} wider: {steps}"
        );
    }
    let (crowd, of_crowd) = fit(500.0);
    assert!(crowd.map_size == 1024 && of_crowd > 10.0 * texel);
    let to_key = Vec3::new(0.64, 0.74, -0.34).normalize();
    let row = Aabb {
        max: FIGURE.max + Vec3::X * 500.0,
        ..FIGURE
    };
    assert!(ShadowFit::book(&row, to_key, MAP_SIDE, 1.0).radius_texels >= LEAST_RADIUS_TEXELS);
}
