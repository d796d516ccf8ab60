//! Light as three mantissas with a common exponent (Ward 1991, "Real Pixels").

use glam::Vec3A;

/// The light of a texel: three mantissas and their exponent. Linear, never negative.
pub(super) fn light_of([red, green, blue, exponent]: [u8; 4]) -> Vec3A {
    if exponent == 0 {
        return Vec3A::ZERO;
    }
    // Of a bright texel 2^(exponent - 136) has a float, and of a dark one too, which may have fewer bits.
    let scale = f32::exp2(f32::from(exponent) - 136.0);
    Vec3A::new(red.into(), green.into(), blue.into()) * scale
}

/// The nearest texel of a light; NaN and what is negative become 0, what is too large the largest.
pub(super) fn texel_of(light: Vec3A) -> [u8; 4] {
    let light = light.max(Vec3A::ZERO).min(Vec3A::splat(1e38));
    let most = light.max_element();
    if most < 1e-32 {
        return [0; 4];
    }
    // The power of two above the brightest channel. 255.5 of its parts would round to 256.
    let mut power = most.log2().floor() as i32 + 1;
    if most * f32::exp2((8 - power) as f32) >= 255.5 {
        power += 1;
    }
    let [red, green, blue] = (light * f32::exp2((8 - power) as f32)).round().to_array();
    [red as u8, green as u8, blue as u8, (power + 128) as u8]
}
