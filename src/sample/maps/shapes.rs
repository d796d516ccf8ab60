//! Profiles and distances that reliefs are put together from. Lengths in millimetres unless said otherwise.

use glam::DVec2;

pub(super) use crate::sample::sdf::ramp;

/// 1 in the middle, 0 from `half_width` on, round on top.
pub(super) fn bead(distance: f64, half_width: f64) -> f64 {
    let x = distance / half_width;
    let rest = (1.0 - x * x).max(0.0);
    rest * rest
}

/// Distance to the nearest whole number and on which side of it: −0.5…0.5.
pub(super) fn off_whole(value: f64) -> f64 {
    value - value.round()
}

/// Distance from the border of a square of this side, which repeats; negative nowhere.
pub(super) fn from_border(u: f64, v: f64, side: f64) -> f64 {
    off_whole(u).abs().min(off_whole(v).abs()) * side
}

/// Distance from a stretch of a line.
pub(super) fn from_stretch(point: DVec2, from: DVec2, to: DVec2) -> f64 {
    let (offset, along) = (point - from, to - from);
    let part = (offset.dot(along) / along.length_squared()).clamp(0.0, 1.0);
    (offset - along * part).length()
}

/// Stitches along a line: how much thread lies at a place `across` the line, `along` it.
pub(super) fn stitches(across: f64, along: f64, spacing: f64) -> f64 {
    const THREAD_HALF_WIDTH: f64 = 1.15;
    bead(across, THREAD_HALF_WIDTH) * bead(off_whole(along / spacing), 0.44).sqrt()
}
