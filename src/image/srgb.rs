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
    /// For the beginning of each part of the range, how many bounds lie below it: the search begins there.
    static FIRST: LazyLock<[u8; PARTS]> = LazyLock::new(|| {
        std::array::from_fn(|part| BOUNDS.partition_point(|&bound| bound <= part as f32 / PARTS as f32) as u8)
    });
    let part = (linear * PARTS as f32) as usize;
    let first = FIRST[part.min(PARTS - 1)];
    let bounds = &*BOUNDS;
    let mut byte = first;
    while byte < u8::MAX && bounds[usize::from(byte)] <= linear {
        byte += 1;
    }
    byte
}

/// So many that hardly any has more than one bound.
const PARTS: usize = 4096;

/// Linear light of an encoded value, 0 … 1 (IEC 61966-2-1).
pub(crate) fn curve(srgb: f32) -> f32 {
    if srgb <= 0.040_45 {
        srgb / 12.92
    } else {
        ((srgb + 0.055) / 1.055).powf(2.4)
    }
}
