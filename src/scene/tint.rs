//! The colour that stands for a material while its maps are not there.

use crate::model::Material;

/// Quiet colours that can be told apart, sRGB: skin, olive, sand, grey-green, slate, clay, steel, moss.
const TINTS_SRGB: [[u8; 3]; 8] = [
    [0xC9, 0xA9, 0x8F],
    [0x6F, 0x7A, 0x60],
    [0x8A, 0x84, 0x68],
    [0x55, 0x5A, 0x52],
    [0x3A, 0x3D, 0x42],
    [0x93, 0x76, 0x68],
    [0x6B, 0x78, 0x86],
    [0x7C, 0x86, 0x58],
];

/// A channel above this counts as part of a white, which books use to say "the map has the colour".
const WHITE_FROM: f32 = 0.7;
/// How far the channels of a white may differ.
const WHITE_SPREAD: f32 = 0.1;

/// The colour in which a material is shown, linear: its diffuse colour, or a quiet tint of its own when that is a plain white
/// meant to be multiplied with a map. A material without a map keeps even white.
pub fn display_color(material_index: usize, material: &Material) -> [f32; 3] {
    stand_in_color(material_index, material).unwrap_or(material.diffuse.map(|channel| channel.clamp(0.0, 1.0)))
}

/// The quiet tint, linear, of a material whose diffuse colour only waits for a map.
pub fn stand_in_color(material_index: usize, material: &Material) -> Option<[f32; 3]> {
    let [red, green, blue] = material.diffuse;
    let least = red.min(green).min(blue);
    let greatest = red.max(green).max(blue);
    let is_placeholder = material.diffuse_map.is_some() && least >= WHITE_FROM && greatest - least <= WHITE_SPREAD;
    is_placeholder.then(|| TINTS_SRGB[material_index % TINTS_SRGB.len()].map(linear_from_srgb8))
}

/// Decodes an sRGB channel: 0…255 -> linear 0…1.
pub fn linear_from_srgb8(encoded: u8) -> f32 {
    let encoded = f32::from(encoded) / 255.0;
    if encoded <= 0.04045 {
        encoded / 12.92
    } else {
        ((encoded + 0.055) / 1.055).powf(2.4)
    }
}

/// Encodes a linear channel, clamped to 0…1, as sRGB.
pub fn srgb8_from_linear(linear: f32) -> u8 {
    let linear = linear.clamp(0.0, 1.0);
    let encoded = if linear <= 0.003_130_8 {
        linear * 12.92
    } else {
        1.055 * linear.powf(1.0 / 2.4) - 0.055
    };
    (encoded * 255.0).round() as u8
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Reflectance;

    fn material(diffuse: [f32; 3], diffuse_map: Option<&str>) -> Material {
        Material {
            name: "m".into(),
            diffuse,
            reflectance: Reflectance::Fresnel {
                fresnel0: [0.05; 3],
                roughness: 0.5,
            },
            alpha_clip: false,
            diffuse_map: diffuse_map.map(Into::into),
            normal_map: None,
        }
    }

    #[test]
    fn a_white_that_waits_for_its_map_gets_a_tint_and_neighbours_differ() {
        let waiting = material([1.0; 3], Some("head.dds"));
        for index in 0..TINTS_SRGB.len() {
            let color = display_color(index, &waiting);
            assert_ne!(color, [1.0; 3]);
            assert_ne!(color, display_color(index + 1, &waiting));
        }
        assert_eq!(
            display_color(3, &waiting),
            display_color(3 + TINTS_SRGB.len(), &waiting)
        );
    }

    #[test]
    fn a_colour_of_its_own_is_kept() {
        for (diffuse, map) in [
            ([1.0; 3], None),
            ([0.8, 0.2, 0.1], Some("a.dds")),
            ([0.3; 3], Some("a.dds")),
        ] {
            assert_eq!(display_color(0, &material(diffuse, map)), diffuse);
        }
    }

    #[test]
    fn every_srgb_byte_survives_decoding_and_encoding() {
        for byte in 0..=255 {
            assert_eq!(srgb8_from_linear(linear_from_srgb8(byte)), byte);
        }
    }
}
