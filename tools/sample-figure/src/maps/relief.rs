//! What reliefs are made of: places, profiles and distances.

use glam::DVec2;

/// Smooth step from 0 at `from` to 1 at `to`.
pub(crate) fn ramp(from: f64, to: f64, value: f64) -> f64 {
    let t = ((value - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

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

/// Distance from a stretch of a line.
pub(crate) fn from_stretch(point: DVec2, from: DVec2, to: DVec2) -> f64 {
    let (offset, along) = (point - from, to - from);
    let part = (offset.dot(along) / along.length_squared()).clamp(0.0, 1.0);
    (offset - along * part).length()
}
