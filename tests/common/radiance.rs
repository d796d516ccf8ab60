//! Writes Radiance pictures.

use glam::Vec3;

/// A texel of a light: mantissas rounded down, as Ward's program wrote them.
pub(crate) fn rgbe(light: Vec3) -> [u8; 4] {
    let most = light.max_element();
    if most < 1e-32 {
        return [0; 4];
    }
    let power = most.log2().floor() as i32 + 1;
    let mantissa = |channel: f32| (channel * f32::exp2((8 - power) as f32)) as u8;
    [
        mantissa(light.x),
        mantissa(light.y),
        mantissa(light.z),
        (power + 128) as u8,
    ]
}

/// Bytes of a panorama of whole texels, with this light in the direction of each texel's middle. Its middle is +z, what is right of that +x.
pub(crate) fn panorama(width: u32, light: impl Fn(Vec3) -> Vec3) -> Vec<u8> {
    let height = width / 2;
    let mut bytes = header(width, height);
    for row in 0..height {
        for column in 0..width {
            bytes.extend(rgbe(light(direction(width, column, row))));
        }
    }
    bytes
}

/// The beginning of a file of this size.
pub(crate) fn header(width: u32, height: u32) -> Vec<u8> {
    format!("#?RADIANCE\n# made\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n").into_bytes()
}

/// Towards the middle of a texel of a panorama.
pub(crate) fn direction(width: u32, column: u32, row: u32) -> Vec3 {
    let turn = ((column as f32 + 0.5) / width as f32 - 0.5) * std::f32::consts::TAU;
    let down = (row as f32 + 0.5) / (width / 2) as f32 * std::f32::consts::PI;
    Vec3::new(turn.sin() * down.sin(), down.cos(), turn.cos() * down.sin())
}
