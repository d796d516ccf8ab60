//! Colours that stand in for missing maps, and the sRGB curve.

use bindpose::model::{Material, Reflectance};
use bindpose::scene::{display_color, linear_from_srgb8, srgb8_from_linear, stand_in_color};

/// How many tints there are for materials whose names say nothing.
const TINTS: usize = 7;

fn material(diffuse: [f32; 3], diffuse_map: Option<&str>) -> Material {
    Material {
        name: "m".into(),
        diffuse,
        reflectance: Reflectance::Fresnel {
            fresnel0: [0.05; 3],
            roughness: 0.5,
        },
        diffuse_map: diffuse_map.map(Into::into),
        ..Material::default()
    }
}

#[test]
fn a_white_that_waits_for_its_map_gets_a_tint_and_neighbours_differ() {
    let waiting = material([1.0; 3], Some("a.dds"));
    for index in 0..TINTS {
        let color = display_color(index, &waiting);
        assert_ne!(color, [1.0; 3]);
        assert_ne!(color, display_color(index + 1, &waiting));
    }
    assert_eq!(display_color(3, &waiting), display_color(3 + TINTS, &waiting));
}

#[test]
fn a_name_says_what_a_material_looks_like() {
    let tint = |map| stand_in_color(0, &material([1.0; 3], Some(map)));
    assert_eq!(tint("Head_diff.dds"), Some([0xC9, 0xA9, 0x8F].map(linear_from_srgb8)));
    assert_eq!(
        tint("tree01-leaves_diffuse.dds"),
        Some([0x6A, 0x7A, 0x4C].map(linear_from_srgb8))
    );
    assert_eq!(tint("a.dds"), Some([0x6B, 0x78, 0x86].map(linear_from_srgb8)));
}

#[test]
fn a_colour_of_its_own_is_kept() {
    for (diffuse, map) in [
        ([1.0; 3], None),
        ([0.8, 0.2, 0.4], Some("a.dds")),
        ([0.4; 3], Some("a.dds")),
    ] {
        let linear = diffuse.map(|channel: f32| linear_from_srgb8((channel * 255.0).round() as u8));
        assert_eq!(display_color(0, &material(diffuse, map)), linear);
    }
}

#[test]
fn every_srgb_byte_survives_and_the_middle_of_light_is_188() {
    for byte in 0..=255 {
        assert_eq!(srgb8_from_linear(linear_from_srgb8(byte)), byte);
    }
    for (linear, srgb) in [(0.5, 188), (-1.0, 0), (2.0, 255), (f32::NAN, 0), (0.214_041_14, 128)] {
        assert_eq!(srgb8_from_linear(linear), srgb, "{linear}");
    }
}
