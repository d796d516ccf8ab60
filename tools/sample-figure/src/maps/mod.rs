//! The figure's maps: reliefs in millimetres, baked to a diffuse and a normal map each. Squares that repeat.
//!
//! Only + − × ÷ √ and whole-number hashes, in a fixed order: the bytes are the same on every machine.

mod cloth;
mod moulded;
mod relief;
mod visor;

use relief::Place;
pub(crate) use visor::{BADGE_MIDDLE, BADGE_PER_METRE, PANE_MIDDLE, PANE_PER_METRE};

/// Names of a material's diffuse and normal map.
pub(crate) type MapNames = [&'static str; 2];

pub(crate) const SUIT: MapNames = ["suit_diff.png", "suit_norm.png"];
pub(crate) const TRIM: MapNames = ["trim_diff.png", "trim_norm.png"];
pub(crate) const RUBBER: MapNames = ["rubber_diff.png", "rubber_norm.png"];
pub(crate) const VISOR: MapNames = ["visor_diff.png", "visor_norm.png"];

/// A map that the figure's materials name. It repeats in both directions.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SampleMap {
    /// The file's name, as the materials have it.
    pub name: &'static str,
    /// Texels a side.
    pub side: u32,
    /// Red, green, blue and alpha, rows from the top. Diffuse maps are sRGB, near white, and opaque. Normal maps have green
    /// pointing down the picture, as in DirectX, and in alpha how polished the place is: a factor of the material's shininess.
    pub rgba: Vec<u8>,
}

/// All maps of the figure.
pub fn maps() -> Vec<SampleMap> {
    let baked = [
        (SUIT, bake(512, cloth::SIDE_MM, cloth::surface)),
        (TRIM, bake(512, moulded::SIDE_MM, moulded::surface)),
        (RUBBER, bake(256, moulded::GRIP_SIDE_MM, moulded::grip)),
        (VISOR, bake(512, visor::SIDE_MM, visor::surface)),
    ];
    let named = baked.into_iter().flat_map(|(names, maps)| names.into_iter().zip(maps));
    named
        .map(|(name, (side, rgba))| SampleMap { name, side, rgba })
        .collect()
}

/// A picture's side in texels, and its RGBA.
type Texels = (u32, Vec<u8>);

/// Distance over which a place is compared with its surroundings, texels each way.
const CAVITY_REACH: usize = 4;
/// Loss of tone per millimetre below the surroundings, and the most of it.
const CAVITY_PER_MM: f64 = 0.45;
const DEEPEST_CAVITY: f64 = 0.5;

/// The maps of a square that repeats, `side` texels and `side_mm` millimetres wide: diffuse with half as many texels a side,
/// since colour changes more slowly than relief, and normals. `surface` is given u and v in 0…1 at the middle of texels.
pub(crate) fn bake(side: usize, side_mm: f64, surface: impl Fn(f64, f64) -> Place) -> [Texels; 2] {
    let middle = |index: usize| (index as f64 + 0.5) / side as f64;
    let places: Vec<Place> = (0..side * side)
        .map(|index| surface(middle(index % side), middle(index / side)))
        .collect();
    let heights: Vec<f64> = places.iter().map(|place| place.height).collect();
    let around = blurred(&blurred(&heights, side, 1), side, side);
    let tones: Vec<[f64; 3]> = (places.iter().zip(around))
        .map(|(place, around)| {
            let cavity = ((around - place.height) * CAVITY_PER_MM).clamp(0.0, DEEPEST_CAVITY);
            place.tone.map(|tone| tone * (1.0 - cavity))
        })
        .collect();
    [
        (side as u32 / 2, diffuse(&tones, side)),
        (side as u32, normals(&places, side, side_mm)),
    ]
}

/// Means over a stretch of neighbours, `step` apart: 1 along rows, `side` along columns.
fn blurred(values: &[f64], side: usize, step: usize) -> Vec<f64> {
    let mean = |index: usize| {
        let at = (index / step) % side;
        let line = index - at * step;
        let sum: f64 = (0..=2 * CAVITY_REACH)
            .map(|offset| values[line + (at + side + offset - CAVITY_REACH) % side * step])
            .sum();
        sum / (2 * CAVITY_REACH + 1) as f64
    };
    (0..values.len()).map(mean).collect()
}

/// Each texel the mean of four tones.
fn diffuse(tones: &[[f64; 3]], side: usize) -> Vec<u8> {
    let half = side / 2;
    let texel = |index: usize| {
        let corner = (index / half) * 2 * side + (index % half) * 2;
        let four = [corner, corner + 1, corner + side, corner + side + 1];
        let channel = |channel: usize| byte(four.iter().map(|place| tones[*place][channel]).sum::<f64>() / 4.0);
        [channel(0), channel(1), channel(2), u8::MAX]
    };
    (0..half * half).flat_map(texel).collect()
}

/// x along growing u, y along growing v, which is down the picture.
fn normals(places: &[Place], side: usize, side_mm: f64) -> Vec<u8> {
    let two_texels_mm = 2.0 * side_mm / side as f64;
    let texel = |index: usize| {
        let (x, y) = (index % side, index / side);
        let height = |x: usize, y: usize| places[y % side * side + x % side].height;
        let rise_u = (height(x + 1, y) - height(x + side - 1, y)) / two_texels_mm;
        let rise_v = (height(x, y + 1) - height(x, y + side - 1)) / two_texels_mm;
        let length = (rise_u * rise_u + rise_v * rise_v + 1.0).sqrt();
        let direction = [-rise_u, -rise_v, 1.0].map(|part| byte(part / length * 0.5 + 0.5));
        [
            direction[0],
            direction[1],
            direction[2],
            polish_byte(places[index].polish),
        ]
    };
    (0..side * side).flat_map(texel).collect()
}

/// 0…1 to 0…255.
fn byte(value: f64) -> u8 {
    (value * 255.0).round().clamp(0.0, 255.0) as u8
}

/// In 64 steps: finer ones cannot be seen, but cost the download most of what alpha costs.
fn polish_byte(polish: f64) -> u8 {
    byte((polish.clamp(0.0, 1.0) * 63.0).round() / 63.0)
}
