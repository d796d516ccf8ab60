//! The figure's maps: reliefs in millimetres, baked to a diffuse and a normal map each. Squares that repeat.
//!
//! Only + − × ÷ √ and whole-number hashes, in a fixed order: the bytes are the same on every machine.

mod bake;
mod cloth;
mod grip;
mod moulded;
mod noise;
mod shapes;
mod visor;

pub(super) use visor::{BADGE_MIDDLE, BADGE_PER_METRE, PANE_MIDDLE, PANE_PER_METRE};

/// Names of a material's diffuse and normal map.
pub(super) type MapNames = [&'static str; 2];

pub(super) const SUIT: MapNames = ["suit_diff.png", "suit_norm.png"];
pub(super) const TRIM: MapNames = ["trim_diff.png", "trim_norm.png"];
pub(super) const RUBBER: MapNames = ["rubber_diff.png", "rubber_norm.png"];
pub(super) const VISOR: MapNames = ["visor_diff.png", "visor_norm.png"];

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
        (SUIT, bake::bake(512, cloth::SIDE_MM, cloth::surface)),
        (TRIM, bake::bake(512, moulded::SIDE_MM, moulded::surface)),
        (RUBBER, bake::bake(256, grip::SIDE_MM, grip::surface)),
        (VISOR, bake::bake(512, visor::SIDE_MM, visor::surface)),
    ];
    let named = baked.into_iter().flat_map(|(names, maps)| names.into_iter().zip(maps));
    named
        .map(|(name, (side, rgba))| SampleMap { name, side, rgba })
        .collect()
}
