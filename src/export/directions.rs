//! Normal maps as pictures that hold directions and nothing else.

use crate::image::{Channels, Image};

/// The texels of a normal map, RGBA, 8 bits a channel: z follows from x and y where the map has none, and alpha, which the DirectX 12 book
/// takes for gloss, is 1. Where `is_turned`, green points the other way.
pub fn directions(image: &Image, is_turned: bool) -> Vec<u8> {
    let mut texels = image.to_rgba8(0, 0).unwrap_or_default();
    for texel in texels.chunks_exact_mut(4) {
        if image.channels() == Channels::RedGreen {
            texel[2] = third(texel[0], texel[1]);
        }
        if is_turned {
            texel[1] = u8::MAX - texel[1];
        }
        texel[3] = u8::MAX;
    }
    texels
}

/// The z of a unit direction, as bytes tell it.
fn third(x: u8, y: u8) -> u8 {
    let [x, y] = [x, y].map(|byte| f32::from(byte) / 255.0 * 2.0 - 1.0);
    let z = (1.0 - x * x - y * y).max(0.0).sqrt();
    ((z * 0.5 + 0.5) * 255.0).round() as u8
}
