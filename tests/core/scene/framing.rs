//! The camera, framing.

use std::f32::consts::TAU;

use bindpose::scene::{Aabb, Camera, Insets, Projection, ViewPreset, swept_about_y};
use glam::Vec3;

use super::unit_box;

/// How much of the free part of the picture a framed box fills.
const FRAMED_FRACTION: f32 = 0.9;

/// Corners of a box in clip space, divided by w.
fn corners_in_clip(camera: &Camera, bounds: &Aabb, aspect: f32) -> Vec<Vec3> {
    let clip_from_world = camera.clip_from_view(aspect, bounds) * camera.view_from_world();
    bounds
        .corners()
        .map(|corner| clip_from_world.project_point3(corner))
        .to_vec()
}

#[test]
fn framing_fills_the_picture_and_no_plane_cuts_from_any_side() {
    let bounds = Aabb {
        min: Vec3::new(-3.0, 0.0, -0.1),
        max: Vec3::new(50.0, 7.0, 9.0),
    };
    for preset in ViewPreset::ALL {
        for projection in [Camera::default().projection, Projection::Orthographic] {
            let mut camera = Camera {
                projection,
                ..Camera::default()
            };
            camera.look_from(preset);
            camera.frame(&bounds.corners(), 1.6, Insets::default());
            let corners = corners_in_clip(&camera, &bounds, 1.6);
            let reach = corners.iter().map(|c| c.x.abs().max(c.y.abs())).fold(0.0, f32::max);
            assert!(
                (reach - FRAMED_FRACTION).abs() < 1e-3,
                "{preset:?} {projection:?} reaches {reach}"
            );
            assert!(
                corners.iter().all(|c| (0.0..=1.0).contains(&c.z)),
                "{preset:?} {projection:?}"
            );
        }
    }
}

#[test]
fn a_free_part_beside_the_middle_of_the_picture_is_filled_too() {
    for preset in [ViewPreset::ThreeQuarter, ViewPreset::Front, ViewPreset::Top] {
        let insets = Insets {
            top: 0.1,
            bottom: 0.56,
            ..Insets::default()
        };
        let mut camera = Camera::default();
        camera.look_from(preset);
        camera.frame(&unit_box().corners(), 1.6, insets);
        let corners = corners_in_clip(&camera, &unit_box(), 1.6);
        let heights = || corners.iter().map(|corner| corner.y);
        let [lowest, highest] = [heights().fold(f32::INFINITY, f32::min), heights().fold(-1.0, f32::max)];
        let free = [2.0 * insets.bottom - 1.0, 1.0 - 2.0 * insets.top];
        let filled = (highest - lowest) / (free[1] - free[0]);
        assert!((filled - FRAMED_FRACTION).abs() < 0.02, "{preset:?} fills {filled}");
        assert!(
            lowest > free[0] && highest < free[1],
            "{preset:?}: {lowest} to {highest} in {free:?}"
        );
    }
}

#[test]
fn a_model_stays_in_the_picture_while_the_camera_turns_about_it() {
    let bounds = Aabb {
        min: Vec3::new(2.0, 0.0, -0.5),
        max: Vec3::new(9.0, 4.0, 0.5),
    };
    let (swept, middle) = swept_about_y(&bounds.corners());
    for preset in ViewPreset::ALL {
        for projection in [Camera::default().projection, Projection::Orthographic] {
            let mut camera = Camera {
                projection,
                ..Camera::default()
            };
            camera.look_from(preset);
            camera.frame(&swept, 1.6, Insets::default());
            let before = corners_in_clip(&camera, &bounds, 1.6);
            camera.aim_at_axis(middle);
            let after = corners_in_clip(&camera, &bounds, 1.6);
            for (before, after) in before.iter().zip(after) {
                assert!((before - after).truncate().length() < 1e-3, "{preset:?} {projection:?}");
            }
            assert!(
                (camera.target - middle).with_y(0.0).length() < 0.02,
                "{preset:?}: {}",
                camera.target
            );
            let mut farthest: f32 = 0.0;
            for _ in 0..24 {
                camera.orbit(TAU / 24.0, 0.0);
                let reach = corners_in_clip(&camera, &bounds, 1.6);
                farthest = reach.iter().map(|c| c.x.abs().max(c.y.abs())).fold(farthest, f32::max);
            }
            assert!(
                (0.8..0.92).contains(&farthest),
                "{preset:?} {projection:?} reaches {farthest}"
            );
        }
    }
}

#[test]
fn framing_keeps_clear_of_covered_margins() {
    let mut camera = Camera::default();
    let insets = Insets {
        left: 0.3,
        bottom: 0.2,
        ..Insets::default()
    };
    camera.frame(&unit_box().corners(), 1.5, insets);
    for corner in corners_in_clip(&camera, &unit_box(), 1.5) {
        assert!(corner.x > -1.0 + 2.0 * insets.left - 0.02, "{corner}");
        assert!(corner.y > -1.0 + 2.0 * insets.bottom - 0.02, "{corner}");
        assert!(corner.x < 1.0 && corner.y < 1.0, "{corner}");
    }
}
