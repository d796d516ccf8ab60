//! The sRGB transfer curve.

use std::sync::LazyLock;

/// Linear light of an 8-bit sRGB value: 0 … 1.
pub(crate) fn linear_from_srgb(value: u8) -> f32 {
    static LINEAR: LazyLock<[f32; 256]> = LazyLock::new(|| std::array::from_fn(|value| curve(value as f32 / 255.0)));
    LINEAR[usize::from(value)]
}

/// The nearest 8-bit sRGB value of linear light; values outside 0 … 1 are clamped, NaN becomes 0.
pub(crate) fn srgb_from_linear(linear: f32) -> u8 {
    /// Light half-way between each sRGB value and the next.
    static BOUNDS: LazyLock<[f32; 255]> =
        LazyLock::new(|| std::array::from_fn(|value| curve((value as f32 + 0.5) / 255.0)));
    BOUNDS.partition_point(|&bound| bound <= linear) as u8
}

/// Linear light of an encoded value, 0 … 1 (IEC 61966-2-1).
pub(crate) fn curve(srgb: f32) -> f32 {
    if srgb <= 0.040_45 {
        srgb / 12.92
    } else {
        ((srgb + 0.055) / 1.055).powf(2.4)
    }
}
