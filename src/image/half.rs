//! Half floats.

const MAX: f32 = 65_504.0;

/// Smallest normal half float, 2⁻¹⁴.
const MIN_NORMAL: f32 = 1.0 / 16_384.0;

/// The value of a half float's bits.
pub fn to_f32(bits: u16) -> f32 {
    let sign = if bits & 0x8000 == 0 { 1.0 } else { -1.0 };
    let exponent = u32::from(bits >> 10) & 31;
    let fraction = u32::from(bits & 0x3ff);
    let magnitude = match exponent {
        0 => fraction as f32 * (MIN_NORMAL / 1024.0),
        31 if fraction == 0 => f32::INFINITY,
        31 => f32::NAN,
        // The two exponents are biased by 15 and by 127.
        _ => f32::from_bits((exponent + 112) << 23 | fraction << 13),
    };
    sign * magnitude
}

/// Bits of the nearest half float, of two equally near the even one. What is too large becomes the largest finite.
pub fn from_f32(value: f32) -> u16 {
    if value.is_nan() {
        return 0x7e00;
    }
    let sign = if value.is_sign_negative() { 0x8000 } else { 0 };
    let magnitude = value.abs().min(MAX);
    let bits = if magnitude < MIN_NORMAL {
        (magnitude * (1024.0 / MIN_NORMAL)).round_ties_even() as u32
    } else {
        let bits = magnitude.to_bits();
        let rounded = bits + 0xfff + (bits >> 13 & 1);
        (rounded >> 13) - (112 << 10)
    };
    sign | bits as u16
}
