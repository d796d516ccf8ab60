//! The sRGB transfer curve.

use std::sync::LazyLock;

use glam::Vec4;

/// Linear light of an 8-bit sRGB value: 0 … 1.
pub(crate) fn linear_from_srgb(value: u8) -> f32 {
    Srgb::tables().linear(value)
}

/// The nearest 8-bit sRGB value of linear light; values outside 0 … 1 are clamped, NaN becomes 0.
pub(crate) fn srgb_from_linear(linear: f32) -> u8 {
    // `max` gives the other number for NaN, where `clamp` would give NaN.
    let linear = linear.max(0.0).clamp(0.0, 1.0);
    Srgb::tables().byte(linear, (linear * LAST_PART + WHOLE).to_bits())
}

/// Parts of the range of light, so many that none has two bounds: at the dark end these are 1/3295 apart.
const PARTS: usize = 4096;
const LAST_PART: f32 = (PARTS - 1) as f32;

/// A number of 0 … 2²² that is added to this has its nearest whole number in the lowest bits.
pub(super) const WHOLE: f32 = 8_388_608.0;

/// The curve both ways. Whoever has many texels asks for it once.
pub(super) struct Srgb {
    linear: [f32; 256],
    /// Light half-way between each sRGB value and the next; none is beyond the last.
    bounds: [f32; 256],
    /// How many bounds lie below each part of the range.
    first: [u8; PARTS],
}

impl Srgb {
    pub(super) fn tables() -> &'static Self {
        static TABLES: LazyLock<Srgb> = LazyLock::new(|| {
            let bounds = std::array::from_fn(|value| match value {
                255 => f32::INFINITY,
                _ => curve((value as f32 + 0.5) / 255.0),
            });
            // A part reaches half-way to its neighbours, and a little further for what multiplying rounds.
            let start = |part: usize| (part as f32 - 0.51) / LAST_PART;
            Srgb {
                linear: std::array::from_fn(|value| curve(value as f32 / 255.0)),
                bounds,
                first: std::array::from_fn(|part| bounds.partition_point(|&bound| bound <= start(part)) as u8),
            }
        });
        &TABLES
    }

    /// Linear light of an sRGB value.
    pub(super) fn linear(&self, value: u8) -> f32 {
        self.linear[usize::from(value)]
    }

    /// The nearest sRGB values of red, green and blue light. None is NaN.
    pub(super) fn bytes(&self, light: Vec4) -> [u8; 3] {
        let light = light.max(Vec4::ZERO).min(Vec4::ONE);
        let [red, green, blue, _] = light.to_array();
        let parts = (light * LAST_PART + WHOLE).to_array();
        [
            self.byte(red, parts[0].to_bits()),
            self.byte(green, parts[1].to_bits()),
            self.byte(blue, parts[2].to_bits()),
        ]
    }

    /// The lowest bits of `part` are the part of the range in which `linear` is, 0 … 1.
    fn byte(&self, linear: f32, part: u32) -> u8 {
        let first = self.first[part as usize % PARTS];
        first + u8::from(self.bounds[usize::from(first)] <= linear)
    }
}

/// Linear light of an encoded value, 0 … 1 (IEC 61966-2-1).
pub(crate) fn curve(srgb: f32) -> f32 {
    if srgb <= 0.040_45 {
        srgb / 12.92
    } else {
        ((srgb + 0.055) / 1.055).powf(2.4)
    }
}
