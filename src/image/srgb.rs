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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_value_survives_and_the_middle_of_light_is_188() {
        for value in 0..=255 {
            assert_eq!(srgb_from_linear(linear_from_srgb(value)), value);
        }
        for (linear, srgb) in [(0.5, 188), (-1.0, 0), (2.0, 255), (f32::NAN, 0), (0.214_041_14, 128)] {
            assert_eq!(srgb_from_linear(linear), srgb, "{linear}");
        }
    }
}
