//! The lamp of a sky.

use std::f32::consts::PI;

use bindpose::image::{MapKind, decode, half};
use bindpose::light::{Environment, Prefiltered};
use glam::Vec3;

use crate::light::{all_directions, difference, direction};
use crate::radiance::panorama;

const SIDE: u32 = 512;

/// A cube map of floats with this light in each direction.
fn sky(light: impl Fn(Vec3) -> Vec3) -> Environment {
    let mut header = [0u32; 37];
    header[0] = u32::from_le_bytes(*b"DDS ");
    header[1..5].copy_from_slice(&[124, 0x1007, SIDE, SIDE]);
    header[19..22].copy_from_slice(&[32, 4, u32::from_le_bytes(*b"DX10")]);
    header[27..29].copy_from_slice(&[0x1008, 0xfe00]);
    // DXGI_FORMAT_R16G16B16A16_FLOAT, a 2D texture, marked as a cube, one of it.
    header[32..36].copy_from_slice(&[10, 3, 4, 1]);
    let mut bytes: Vec<u8> = header.into_iter().flat_map(u32::to_le_bytes).collect();
    for face in 0..6 {
        for index in 0..SIDE * SIDE {
            let place = |index: u32| (2 * index + 1) as f32 / SIDE as f32 - 1.0;
            let (across, down) = (place(index % SIDE), place(index / SIDE));
            let towards = match face {
                0 => Vec3::new(1.0, -down, -across),
                1 => Vec3::new(-1.0, -down, across),
                2 => Vec3::new(across, 1.0, down),
                3 => Vec3::new(across, -1.0, -down),
                4 => Vec3::new(across, -down, 1.0),
                _ => Vec3::new(-across, -down, -1.0),
            };
            let Vec3 { x, y, z } = light(towards.normalize());
            bytes.extend(
                [x, y, z, 1.0]
                    .into_iter()
                    .flat_map(|value| half::from_f32(value).to_le_bytes()),
            );
        }
    }
    let image = decode(&bytes, "sky.dds").unwrap_or_else(|error| panic!("{error}"));
    Environment::from_image(&image).expect("it is a cube")
}

/// A panorama with this light in each direction.
fn hdr_sky(light: &dyn Fn(Vec3) -> Vec3) -> Environment {
    let image = decode(&panorama(4096, light), "sky.hdr").unwrap_or_else(|error| panic!("{error}"));
    Environment::from_image(&image.with_mips(MapKind::Diffuse)).expect("it is a cube")
}

const BLUE: Vec3 = Vec3::new(0.2, 0.35, 0.7);

#[test]
fn a_painted_sun_becomes_the_lamp_with_all_its_light() {
    for (turn, height, degrees, radiance) in [
        (0.4, 0.9, 0.6, 20_000.0),
        (2.7, 0.2, 1.0, 3_000.0),
        // Over an edge of two faces.
        (PI / 4.0, 0.5, 0.8, 9_000.0),
        // A large one, as a lamp in a room.
        (-2.0, 0.7, 5.0, 60.0),
    ] {
        let towards = direction(turn, height);
        let radius = f32::to_radians(degrees);
        let color = Vec3::new(1.0, 0.9, 0.7) * radiance;
        let light = |d: Vec3| if d.angle_between(towards) < radius { color } else { BLUE };
        let of_panorama = hdr_sky(&light);
        let found = of_panorama.lamp().expect("there is a sun");
        let environment = sky(light);
        let lamp = environment.lamp().expect("there is a sun");
        let words = format!("{turn}, {height}, {degrees}°: {lamp:?}, of a panorama {found:?}");
        assert!(
            found.is_sun && found.direction.angle_between(towards).to_degrees() < 1.0,
            "{words}"
        );
        let expected = color * radius.sin().powi(2);
        assert!(
            (found.color / expected - 1.0).abs().max_element() < 0.05,
            "{words} for {expected}"
        );
        assert!(lamp.is_sun, "{words}");
        assert!(lamp.direction.angle_between(towards).to_degrees() < 1.0, "{words}");
        // What a white surface shows that faces the disc.
        let expected = color * radius.sin().powi(2);
        assert!(
            (lamp.color / expected - 1.0).abs().max_element() < 0.05,
            "{words} for {expected}"
        );
        // Nothing of it is left in the sky.
        for d in all_directions(5_000) {
            assert!(
                difference(environment.sample(d), BLUE) < 0.01,
                "{words}: {d} {}",
                environment.sample(d)
            );
        }
        let sky_alone = 0.2126 * BLUE.x + 0.7152 * BLUE.y + 0.0722 * BLUE.z;
        let own = (0.2126 * expected.x + 0.7152 * expected.y + 0.0722 * expected.z) * height.sin();
        assert!((lamp.ground_share - own / (own + sky_alone)).abs() < 0.03, "{words}");
    }
}

#[test]
fn a_sky_without_a_sun_has_its_brightest_part_as_a_soft_lamp() {
    let towards = direction(1.0, 0.6);
    let cloud = |d: Vec3| BLUE + Vec3::ONE * (-(d.angle_between(towards) / 0.2).powi(2)).exp();
    let environment = sky(cloud);
    let lamp = *environment.lamp().expect("a bright cloud");
    assert!(
        !lamp.is_sun && lamp.direction.angle_between(towards).to_degrees() < 2.0,
        "{lamp:?}"
    );
    // It is still seen in mirrors, and matt surfaces have its light once.
    assert!(difference(environment.sample(towards), cloud(towards)) < 0.02);
    let irradiance = *Prefiltered::of(&environment).irradiance();
    let matt = |normal: Vec3| irradiance.towards(normal) + lamp.color * normal.dot(lamp.direction).max(0.0);
    let points: Vec<Vec3> = all_directions(20_000).collect();
    for normal in all_directions(40) {
        let sum: Vec3 = points.iter().map(|&d| cloud(d) * d.dot(normal).max(0.0)).sum();
        let brute = sum * 4.0 / points.len() as f32;
        assert!(
            difference(matt(normal), brute) < 0.03,
            "{normal}: {} for {brute}",
            matt(normal)
        );
    }
}

#[test]
fn an_even_sky_has_none() {
    let even = sky(|_| BLUE);
    assert!(
        even.lamp().is_none_or(|lamp| lamp.color.max_element() < 1e-4),
        "{:?}",
        even.lamp()
    );
    assert_eq!(sky(|_| Vec3::ZERO).lamp(), None);
}
