// Linear colour, its sRGB encoding, and the last step before eight bits.

fn srgb_from_linear(linear: vec3<f32>) -> vec3<f32> {
    let low = linear * 12.92;
    let high = 1.055 * pow(max(linear, vec3<f32>(0.0031308)), vec3<f32>(1.0 / 2.4)) - 0.055;
    return select(high, low, linear <= vec3<f32>(0.0031308));
}

fn linear_from_srgb(srgb: vec3<f32>) -> vec3<f32> {
    let low = srgb / 12.92;
    let high = pow((max(srgb, vec3<f32>(0.04045)) + 0.055) / 1.055, vec3<f32>(2.4));
    return select(high, low, srgb <= vec3<f32>(0.04045));
}

// Interleaved gradient noise: spread evenly over any small neighbourhood, and the same in every frame. -0.5..0.5.
fn dither_noise(pixel: vec2<f32>) -> f32 {
    return turned_noise(pixel, 0.0) - 0.5;
}

// The same from 0 to 1; pictures of which a mean is made differ in `turn`, 0..1.
fn turned_noise(pixel: vec2<f32>, turn: f32) -> f32 {
    return fract(52.9829189 * fract(dot(pixel, vec2<f32>(0.06711056, 0.00583715))) + turn);
}

// How far the taps of a pixel are turned, radians.
fn tap_turn(pixel: vec2<f32>, turn: f32) -> f32 {
    return turned_noise(pixel, turn) * 6.2831853;
}

// Dithers the rounding to eight bits, so that gradients show no bands. A little less than a whole step, so that what needs no rounding
// is not changed.
fn dithered(value: f32, pixel: vec2<f32>, turn: f32) -> f32 {
    return clamp(value + (turned_noise(pixel, turn) - 0.5) * (0.96 / 255.0), 0.0, 1.0);
}

// The same of an encoded colour. It is returned linear: the target encodes it again.
fn dithered_linear_from_srgb(srgb: vec3<f32>, pixel: vec2<f32>, turn: f32) -> vec3<f32> {
    let noise = (turned_noise(pixel, turn) - 0.5) * (0.96 / 255.0);
    return linear_from_srgb(clamp(srgb + noise, vec3<f32>(0.0), vec3<f32>(1.0)));
}
