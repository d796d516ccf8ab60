//! Half floats.

use bindpose::image::half::{from_f32, to_f32};

#[test]
fn known_values_convert_both_ways() {
    for (bits, value) in [
        (0x0000, 0.0),
        (0x0001, 5.960_464_5e-8),
        (0x03ff, 6.097_555e-5),
        (0x0400, 1.0 / 16_384.0),
        (0x3800, 0.5),
        (0x3c00, 1.0),
        (0xc000, -2.0),
        (0x7bff, 65_504.0),
    ] {
        assert_eq!((to_f32(bits), from_f32(value)), (value, bits));
    }
}

#[test]
fn every_finite_half_survives() {
    for bits in (0..=u16::MAX).filter(|bits| bits & 0x7c00 != 0x7c00) {
        assert_eq!(from_f32(to_f32(bits)), bits);
    }
}

#[test]
fn between_two_halves_the_nearer_is_taken_and_infinity_ends_at_the_largest() {
    // Halves next to 1 are 2⁻¹⁰ apart.
    for (value, bits) in [
        (1.0 + 0.4 / 1024.0, 0x3c00),
        (1.0 + 0.5 / 1024.0, 0x3c00),
        (1.0 + 1.5 / 1024.0, 0x3c02),
        (f32::INFINITY, 0x7bff),
        (-1e9, 0xfbff),
    ] {
        assert_eq!(from_f32(value), bits, "{value}");
    }
    assert!(to_f32(from_f32(f32::NAN)).is_nan());
    assert_eq!(to_f32(0xfc00), f32::NEG_INFINITY);
}
