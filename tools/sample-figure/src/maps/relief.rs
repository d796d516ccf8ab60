//! What reliefs are made of: places, profiles and distances in millimetres, and noise that is the same every time.

use glam::DVec2;

pub(crate) use crate::sdf::ramp;

/// What a relief is like at one place.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    /// Millimetres outwards.
    pub(crate) height: f64,
    /// Of the material's own colour, sRGB, kept within 0…1: 1 is all of it.
    pub(crate) tone: [f64; 3],
    /// How polished: a factor of the material's shininess, kept within 0…1.
    pub(crate) polish: f64,
}

/// 1 in the middle, 0 from `half_width` on, round on top.
pub(crate) fn bead(distance: f64, half_width: f64) -> f64 {
    let x = distance / half_width;
    let rest = (1.0 - x * x).max(0.0);
    rest * rest
}

/// Distance to the nearest whole number and on which side of it: −0.5…0.5.
pub(crate) fn off_whole(value: f64) -> f64 {
    value - value.round()
}

/// Distance from the border of a square of this side, which repeats; negative nowhere.
pub(crate) fn from_border(u: f64, v: f64, side: f64) -> f64 {
    off_whole(u).abs().min(off_whole(v).abs()) * side
}

/// Distance from a stretch of a line.
pub(crate) fn from_stretch(point: DVec2, from: DVec2, to: DVec2) -> f64 {
    let (offset, along) = (point - from, to - from);
    let part = (offset.dot(along) / along.length_squared()).clamp(0.0, 1.0);
    (offset - along * part).length()
}

/// Stitches along a line: how much thread lies at a place `across` the line, `along` it.
pub(crate) fn stitches(across: f64, along: f64, spacing: f64) -> f64 {
    const THREAD_HALF_WIDTH: f64 = 1.15;
    bead(across, THREAD_HALF_WIDTH) * bead(off_whole(along / spacing), 0.44).sqrt()
}

/// 0…1 out of three whole numbers.
pub(crate) fn chance(x: u32, y: u32, seed: u32) -> f64 {
    // Spread with primes of xxHash, mixed as MurmurHash3 ends.
    let mut bits = x.wrapping_mul(0x9E37_79B1) ^ y.wrapping_mul(0x85EB_CA77) ^ seed.wrapping_mul(0xC2B2_AE3D);
    bits = (bits ^ (bits >> 16)).wrapping_mul(0x85EB_CA6B);
    bits = (bits ^ (bits >> 13)).wrapping_mul(0xC2B2_AE35);
    bits ^= bits >> 16;
    f64::from(bits) / f64::from(u32::MAX)
}

/// Smooth noise, −1…1, over the unit square, `cells` a side, that repeats.
pub(crate) fn noise(u: f64, v: f64, cells: u32, seed: u32) -> f64 {
    let (x, y) = (u * f64::from(cells), v * f64::from(cells));
    let (column, row) = (x.floor(), y.floor());
    let (s, t) = (smooth(x - column), smooth(y - row));
    let wrapped = |index: f64| (index as i64).rem_euclid(i64::from(cells)) as u32;
    let at = |dx: f64, dy: f64| chance(wrapped(column + dx), wrapped(row + dy), seed);
    let above = at(0.0, 0.0) + (at(1.0, 0.0) - at(0.0, 0.0)) * s;
    let below = at(0.0, 1.0) + (at(1.0, 1.0) - at(0.0, 1.0)) * s;
    (above + (below - above) * t) * 2.0 - 1.0
}

/// Three octaves of noise, −1…1.
pub(crate) fn clouds(u: f64, v: f64, cells: u32, seed: u32) -> f64 {
    (noise(u, v, cells, seed) * 4.0 + noise(u, v, 2 * cells, seed + 1) * 2.0 + noise(u, v, 4 * cells, seed + 2)) / 7.0
}

fn smooth(t: f64) -> f64 {
    t * t * (3.0 - 2.0 * t)
}
