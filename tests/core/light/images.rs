//! Environments from cube maps.

use bindpose::image::{Image, decode};
use bindpose::light::{Environment, Prefiltered};
use glam::Vec3;

use crate::light::{all_directions, difference};
use crate::shared::shared;

/// DXGI_FORMAT_R16G16B16A16_FLOAT and DXGI_FORMAT_R8G8B8A8_UNORM.
const HALF_FLOATS: u32 = 10;
const BYTES: u32 = 28;

/// A DDS file of six square faces; `texel(face, x)` gives the bytes of a texel.
fn cube_file<const N: usize>(side: u32, dxgi_format: u32, texel: impl Fn(usize, u32) -> [u8; N]) -> Vec<u8> {
    let mut header = [0u32; 37];
    header[0] = u32::from_le_bytes(*b"DDS ");
    // Size of the header, which of its members count, and the sides.
    header[1..5].copy_from_slice(&[124, 0x1007, side, side]);
    // The pixel format: its size, a four-character code, the code.
    header[19..22].copy_from_slice(&[32, 4, u32::from_le_bytes(*b"DX10")]);
    // Complex texture; cube map with all faces.
    header[27..29].copy_from_slice(&[0x1008, 0xfe00]);
    // The format, a 2D texture, marked as a cube, one of it.
    header[32..36].copy_from_slice(&[dxgi_format, 3, 4, 1]);
    let mut bytes: Vec<u8> = header.into_iter().flat_map(u32::to_le_bytes).collect();
    for face in 0..6 {
        for _ in 0..side {
            bytes.extend((0..side).flat_map(|x| texel(face, x)));
        }
    }
    bytes
}

/// Each face of one colour.
fn half_float_cube(side: u32, faces: [[u16; 4]; 6]) -> Vec<u8> {
    cube_file(side, HALF_FLOATS, |face, _| {
        let [red, green, blue, alpha] = faces[face].map(u16::to_le_bytes);
        [red[0], red[1], green[0], green[1], blue[0], blue[1], alpha[0], alpha[1]]
    })
}

fn read_cube(bytes: &[u8]) -> Environment {
    let image = decode(bytes, "cube.dds").unwrap_or_else(|error| panic!("{error}"));
    Environment::from_image(&image).expect("it is a cube")
}

const AXES: [Vec3; 6] = [Vec3::X, Vec3::NEG_X, Vec3::Y, Vec3::NEG_Y, Vec3::Z, Vec3::NEG_Z];

#[test]
fn half_floats_are_linear_light_and_may_exceed_white() {
    // 0.5, 1, 2, 4, 8, 16 in red; 1 in green; 0 in blue.
    let reds = [0x3800, 0x3c00, 0x4000, 0x4400, 0x4800, 0x4c00];
    let environment = read_cube(&half_float_cube(16, reds.map(|red| [red, 0x3c00, 0, 0x3c00])));
    for (axis, red) in AXES.into_iter().zip([0.5, 1.0, 2.0, 4.0, 8.0, 16.0]) {
        assert_eq!(environment.sample(axis), Vec3::new(red, 1.0, 0.0), "{axis}");
    }
}

#[test]
fn light_that_cannot_be_is_none_and_a_sun_is_dimmed() {
    // NaN, −1 and infinity.
    let environment = read_cube(&half_float_cube(16, [[0x7e00, 0xbc00, 0x7c00, 0x3c00]; 6]));
    assert_eq!(environment.sample(Vec3::X), Vec3::new(0.0, 0.0, 256.0));
}

/// Half of the light of white is sRGB 188, not 128.
#[test]
fn bytes_are_srgb_and_are_averaged_as_light() {
    let stripes = cube_file(
        512,
        BYTES,
        |_, x| if x % 2 == 0 { [0, 0, 0, 255] } else { [255, 188, 0, 0] },
    );
    let environment = read_cube(&stripes);
    assert_eq!(environment.side(), 256);
    for direction in all_directions(50) {
        let found = environment.sample(direction);
        assert!(
            difference(found, Vec3::new(0.5, 0.2515, 0.0)) < 2e-3,
            "{direction}: {found}"
        );
    }
    let bytes = environment.to_rgba8_srgb();
    assert_eq!(
        (bytes.len(), &bytes[..4]),
        (6 * 256 * 256 * 4, [188, 137, 0, 255].as_slice())
    );
}

#[test]
fn sides_become_powers_of_two() {
    for (side, expected) in [(1, 16), (3, 16), (16, 16), (48, 32), (100, 64), (130, 128)] {
        let environment = read_cube(&half_float_cube(side, [[0x3800, 0x3c00, 0x4000, 0]; 6]));
        assert_eq!(environment.side(), expected, "from {side}");
        for direction in all_directions(20) {
            let found = environment.sample(direction);
            assert!(
                difference(found, Vec3::new(0.5, 1.0, 2.0)) < 1e-5,
                "from {side}: {found}"
            );
        }
    }
}

#[test]
fn flat_pictures_are_no_environments() {
    let image = Image::from_rgba8(16, 16, vec![255; 16 * 16 * 4], "white").expect("the size is right");
    assert_eq!(Environment::from_image(&image), None);
}

#[test]
fn real_cubes_light_a_scene() {
    let Some(folder) = shared("textures/cube") else { return };
    // Mean light, by eye: a bright atrium, a lobby at night, a dusky sky.
    for name in [
        "Atrium_diffuseIBL_BC6H_128_8mips.dds",
        "LobbyCube_DXT1_256_nomips.dds",
        "skybox02_BGRX_256_nomips.dds",
    ] {
        let bytes = std::fs::read(folder.join(name)).expect("the file can be read");
        let environment = read_cube(&bytes);
        assert_eq!(
            environment.side(),
            if name.contains("_256_") { 256 } else { 128 },
            "{name}"
        );
        let average = environment.average();
        assert!(
            average.min_element() > 0.005 && average.max_element() < 4.0,
            "{name}: {average}"
        );
        let prefiltered = Prefiltered::of(&environment);
        let blurred: Vec3 = all_directions(500).map(|d| prefiltered.sample(d, 1.0)).sum::<Vec3>() / 500.0;
        // Blurring moves light but keeps its sum.
        assert!(
            difference(blurred, average) < 0.05 * average.max_element(),
            "{name}: {blurred} for {average}"
        );
    }
}
