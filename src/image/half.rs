//! Half floats as pictures have them.

use half::f16;

/// The value of a half float's bits.
pub fn to_f32(bits: u16) -> f32 {
    f16::from_bits(bits).to_f32()
}

/// Bits of the nearest half float, of two equally near the even one. What is too large becomes the largest finite.
pub fn from_f32(value: f32) -> u16 {
    f16::from_f32(value.clamp(f16::MIN.to_f32(), f16::MAX.to_f32())).to_bits()
}
