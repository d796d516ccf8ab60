//! The colour in which a material is shown while its maps are missing.

use crate::image::srgb;
use crate::model::Material;

/// Quiet colours that can be told apart, sRGB.
const SKIN: [u8; 3] = [0xC9, 0xA9, 0x8F];
const SAND: [u8; 3] = [0x8A, 0x84, 0x68];
const CLAY: [u8; 3] = [0x93, 0x76, 0x68];
const MOSS: [u8; 3] = [0x6A, 0x7A, 0x4C];
/// Steel, olive, sand, grey-green, slate, clay, heather: for materials whose names say nothing, in turn.
const TINTS_SRGB: [[u8; 3]; 7] = [
    [0x6B, 0x78, 0x86],
    [0x6F, 0x7A, 0x60],
    SAND,
    [0x55, 0x5A, 0x52],
    [0x3A, 0x3D, 0x42],
    CLAY,
    [0x7A, 0x6C, 0x80],
];

/// Words in the name of a material or its map, and the colour that they stand for.
const HINTS: [(&str, [u8; 3]); 16] = [
    ("head", SKIN),
    ("face", SKIN),
    ("skin", SKIN),
    ("hand", SKIN),
    ("leaf", MOSS),
    ("leaves", MOSS),
    ("grass", MOSS),
    ("plant", MOSS),
    ("bark", CLAY),
    ("wood", CLAY),
    ("brick", CLAY),
    ("rock", SAND),
    ("stone", SAND),
    ("temple", SAND),
    ("column", SAND),
    ("ground", SAND),
];

/// A colour whose channels are all above this counts as white. The books' files are white where the map has the colour.
const WHITE_FROM: f32 = 0.7;
/// How far the channels of a white may differ.
const WHITE_SPREAD: f32 = 0.1;

/// The colour in which a material is shown without its maps, linear: its diffuse colour; where that is a plain white to
/// be multiplied with a map, a quiet tint. A material that names no map keeps its white.
pub fn display_color(material_index: usize, material: &Material) -> [f32; 3] {
    stand_in_color(material_index, material).unwrap_or(material.base_color().map(|channel| channel.clamp(0.0, 1.0)))
}

/// The quiet tint, linear, of a material whose diffuse colour is a plain white to be multiplied with a map.
pub fn stand_in_color(material_index: usize, material: &Material) -> Option<[f32; 3]> {
    let [red, green, blue] = material.base_color();
    let least = red.min(green).min(blue);
    let greatest = red.max(green).max(blue);
    let is_placeholder = material.diffuse_map.is_some() && least >= WHITE_FROM && greatest - least <= WHITE_SPREAD;
    is_placeholder.then(|| tint_srgb(material_index, material).map(linear_from_srgb8))
}

fn tint_srgb(material_index: usize, material: &Material) -> [u8; 3] {
    let names = [Some(&material.name), material.diffuse_map.as_ref().map(|map| &map.name)];
    let names: Vec<_> = names.into_iter().flatten().map(|name| name.to_lowercase()).collect();
    let hinted = HINTS
        .iter()
        .find(|(word, _)| names.iter().any(|name| name.contains(word)));
    hinted.map_or(TINTS_SRGB[material_index % TINTS_SRGB.len()], |&(_, tint)| tint)
}

/// Decodes an sRGB channel: 0…255 -> linear 0…1.
pub fn linear_from_srgb8(encoded: u8) -> f32 {
    srgb::linear_from_srgb(encoded)
}

/// Encodes a linear channel, clamped to 0…1, as the nearest sRGB.
pub fn srgb8_from_linear(linear: f32) -> u8 {
    srgb::srgb_from_linear(linear)
}
