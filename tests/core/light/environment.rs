//! Environments: which way is which, seams, and what the generated ones look like.

use std::ops::Div as _;

use bindpose::light::{Environment, Prefiltered, Room};
use glam::Vec3;

use crate::light::{all_directions, difference};

#[test]
fn each_axis_meets_its_own_face() {
    // Half floats hold these exactly. A face's texels all have the colour of its axis.
    let axes = [Vec3::X, Vec3::NEG_X, Vec3::Y, Vec3::NEG_Y, Vec3::Z, Vec3::NEG_Z];
    let brightness = |direction: Vec3| {
        let axis = (0..6).max_by(|&a, &b| direction.dot(axes[a]).total_cmp(&direction.dot(axes[b])));
        Vec3::splat(1.0 + axis.expect("there are six") as f32)
    };
    let environment = Environment::from_fn(16, brightness);
    for (face, axis) in axes.into_iter().enumerate() {
        assert_eq!(environment.sample(axis), Vec3::splat(1.0 + face as f32), "{axis}");
    }
    let texels = environment.to_rgba16f();
    let halves = [0x3c00, 0x4000, 0x4200, 0x4400, 0x4500, 0x4600];
    for (face, half) in texels.chunks_exact(16 * 16 * 4).zip(halves) {
        assert!(
            face.as_chunks()
                .0
                .iter()
                .all(|texel| *texel == [half, half, half, 0x3c00])
        );
    }
}

/// The corners of each face as D3D lays them out, the upper left, the upper right and the lower left one.
#[test]
fn faces_lie_as_in_d3d() {
    const CORNERS: [[[f32; 3]; 3]; 6] = [
        [[1.0, 1.0, 1.0], [1.0, 1.0, -1.0], [1.0, -1.0, 1.0]],
        [[-1.0, 1.0, -1.0], [-1.0, 1.0, 1.0], [-1.0, -1.0, -1.0]],
        [[-1.0, 1.0, -1.0], [1.0, 1.0, -1.0], [-1.0, 1.0, 1.0]],
        [[-1.0, -1.0, 1.0], [1.0, -1.0, 1.0], [-1.0, -1.0, -1.0]],
        [[-1.0, 1.0, 1.0], [1.0, 1.0, 1.0], [-1.0, -1.0, 1.0]],
        [[1.0, 1.0, -1.0], [-1.0, 1.0, -1.0], [1.0, -1.0, -1.0]],
    ];
    const SIDE: usize = 16;
    let environment = Environment::from_fn(SIDE, |direction| direction * 0.5 + 0.5);
    let bytes = environment.to_rgba8_srgb();
    let texels: Vec<[u8; 4]> = bytes.as_chunks().0.to_vec();
    for (face, corners) in CORNERS.into_iter().enumerate() {
        let first = face * SIDE * SIDE;
        let places = [first, first + SIDE - 1, first + SIDE * (SIDE - 1)];
        for (corner, place) in corners.into_iter().zip(places) {
            for (sign, value) in corner.into_iter().zip(texels[place]) {
                assert_eq!(
                    sign > 0.0,
                    value > 188,
                    "face {face}, towards {corner:?}: {:?}",
                    texels[place]
                );
            }
        }
    }
}

#[test]
fn there_are_no_seams() {
    // Light that changes slowly, so that a jump at an edge shows against the change along it.
    let environment = Environment::from_fn(16, |d| Vec3::new(d.x * d.y, d.y * d.z, d.z * d.x) * 0.5 + 0.5);
    let mut compared = 0;
    for along in -40i8..=40 {
        let along = f32::from(along) / 40.0;
        for (a, b) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
            for edge in [Vec3::new(a, b, along), Vec3::new(b, along, a), Vec3::new(along, a, b)] {
                for step in [Vec3::X, Vec3::Y, Vec3::Z] {
                    let (before, after) = (edge - step * 1e-4, edge + step * 1e-4);
                    let jump = difference(environment.sample(before), environment.sample(after));
                    assert!(jump < 1e-3, "at {edge}: {jump}");
                    compared += 1;
                }
            }
        }
    }
    assert_eq!(compared, 81 * 4 * 3 * 3);
}

/// A texel is 90° / 16 wide at most, and the light bends little within it.
#[test]
fn smooth_light_comes_back_from_every_direction() {
    let light = |d: Vec3| Vec3::new(d.x * d.y, d.y * d.z, d.z * d.x) * 0.5 + 0.5;
    let environment = Environment::from_fn(16, light);
    for direction in all_directions(2_000) {
        let error = difference(environment.sample(direction * 3.0), light(direction));
        assert!(error < 0.006, "{direction}: {error}");
    }
}

#[test]
fn every_direction_has_some_light_even_none() {
    let environment = Environment::coarse_studio(Room::Dark);
    for odd in [Vec3::ZERO, Vec3::NAN, Vec3::INFINITY] {
        let _ = environment.sample(odd);
    }
    assert_eq!(environment.sample(Vec3::Y * 1e-20), environment.sample(Vec3::Y));
}

#[test]
fn the_dark_studio_has_range_over_dim_walls() {
    let studio = Environment::studio(Room::Dark);
    let average = studio.average();
    assert!((0.34..0.40).contains(&average.element_sum().div(3.0)), "{average}");
    // Neutral on the whole: the cool strips and the warm floor are in balance.
    assert!(average.max_element() / average.min_element() < 1.12, "{average}");
    let mut lights: Vec<f32> = all_directions(100_000).map(|d| studio.sample(d).y).collect();
    lights.sort_by(f32::total_cmp);
    let (median, brightest) = (lights[lights.len() / 2], lights[lights.len() - 1]);
    assert!(
        (40.0..60.0).contains(&(brightest / median)),
        "{brightest} over {median}"
    );
    // Only small things are bright.
    let above_1 = lights.iter().filter(|&&light| light > 1.0).count() as f32 / lights.len() as f32;
    assert!(above_1 < 0.06, "{above_1}");
}

#[test]
fn the_bright_studio_is_bright_but_behind_the_viewer() {
    let [dark, bright] = Room::ALL.map(Environment::studio);
    let lights = |direction: Vec3| [&dark, &bright].map(|room| room.sample(direction).y);
    for direction in [Vec3::NEG_Y, Vec3::Z, Vec3::X] {
        let [of_dark, of_bright] = lights(direction);
        assert!(of_bright > 1.5 * of_dark, "{direction}: {of_bright} beside {of_dark}");
    }
    let [of_dark, of_bright] = lights(Vec3::new(-0.3, 0.9, 0.3).normalize());
    assert!(of_bright > 2.2 * of_dark, "{of_bright} beside {of_dark}");
    // Metal shows where floor and walls meet.
    for (room, least) in [(&dark, 1.8), (&bright, 1.3)] {
        let [wall, floor] = [0.04, -0.13].map(|y: f32| room.sample(Vec3::new(0.0, y, 1.0).normalize()).y);
        assert!(wall > least * floor, "{wall} over {floor}");
    }
    // A ball of metal mirrors in its middle what is behind the viewer: that is dark in the bright room too.
    let [of_dark, of_bright] = lights(Vec3::new(0.0, 0.1, -1.0).normalize());
    assert!(
        of_bright < of_dark && of_bright < 0.25 * bright.sample(Vec3::Z).y,
        "{of_bright} beside {of_dark}"
    );
    // The soft boxes: overhead, and opposite to the lamp.
    for direction in [Vec3::new(0.30, 0.86, -0.42), Vec3::new(-0.74, 0.42, -0.50)] {
        let light = bright.sample(direction.normalize()).y;
        assert!(light > 2.0, "{direction}: {light}");
    }
    let average = bright.average();
    assert!((0.50..0.58).contains(&average.element_sum().div(3.0)), "{average}");
    assert!(average.max_element() / average.min_element() < 1.12, "{average}");
}

#[test]
fn few_texels_hold_as_much_light() {
    for room in Room::ALL {
        let (fine, coarse) = (Environment::studio(room), Environment::coarse_studio(room));
        assert_eq!((fine.side(), coarse.side()), (256, 64));
        assert!(
            (fine.average() / coarse.average() - 1.0).abs().max_element() < 0.01,
            "{room:?}"
        );
        assert!(
            (fine.coarse().average() / fine.average() - 1.0).abs().max_element() < 0.001,
            "{room:?}"
        );
        // Matt surfaces do not see the one replaced by the other.
        let [of_fine, of_coarse] = [&fine, &coarse].map(Prefiltered::of);
        for normal in all_directions(200) {
            let step = difference(
                of_fine.irradiance().towards(normal),
                of_coarse.irradiance().towards(normal),
            );
            assert!(step < 0.01, "{room:?}, {normal}: {step}");
        }
    }
}

#[test]
fn the_studio_is_lit_from_above_in_front_and_its_floor_is_dim_and_warm() {
    let studio = Environment::studio(Room::Dark);
    let above_in_front = studio.sample(Vec3::new(0.34, 0.80, -0.52));
    let floor = studio.sample(Vec3::new(0.1, -1.0, 0.2));
    let ahead = studio.sample(Vec3::Z);
    assert!(above_in_front.min_element() > 4.0, "{above_in_front}");
    assert!(floor.max_element() < ahead.min_element(), "{floor} beside {ahead}");
    assert!(floor.x > floor.z, "{floor}");
    // The fill is opposite to the key, which is on the right.
    let (fill, rim) = (
        studio.sample(Vec3::new(-0.9, 0.1, -0.4)),
        studio.sample(Vec3::new(-0.8, 0.3, 0.52)),
    );
    assert!(
        fill.min_element() > 0.45 && rim.z > 1.5 * fill.z && rim.z > rim.x,
        "{fill} {rim}"
    );
    // A bar crosses the window.
    let window = Vec3::new(0.50, 0.35, -0.79).normalize();
    let right = Vec3::Y.cross(window).normalize();
    let pane = window + right * 0.035 + Vec3::Y * 0.04;
    assert!(studio.sample(pane).x > 3.0 * studio.sample(window).x);
}

#[test]
fn daylight_is_a_blue_sky_over_neutral_ground_and_never_exceeds_white() {
    let daylight = Environment::daylight();
    let [up, horizon, down] = [Vec3::Y, Vec3::new(1.0, 0.03, 0.0), Vec3::NEG_Y].map(|d| daylight.sample(d));
    assert!(up.z > 2.0 * up.y && up.y > 2.0 * up.x, "{up}");
    assert!(horizon.min_element() > 0.6 && horizon.z > horizon.x, "{horizon}");
    assert!(down.max_element() / down.min_element() < 1.2, "{down}");
    for direction in all_directions(5_000) {
        let light = daylight.sample(direction);
        assert!(
            light.min_element() > 0.0 && light.max_element() <= 1.0,
            "{direction}: {light}"
        );
    }
}
