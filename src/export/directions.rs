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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_direction_of_two_numbers_gets_its_third() {
        assert_eq!(third(128, 128), 255);
        assert_eq!(third(255, 128), 128);
        assert_eq!(third(255, 255), 128);
    }

    #[test]
    fn green_is_turned_and_gloss_left_out() -> Result<(), Box<dyn std::error::Error>> {
        let image = Image::from_rgba8(2, 1, vec![10, 20, 30, 40, 50, 0, 70, 255], "test")?;
        assert_eq!(directions(&image, false), [10, 20, 30, 255, 50, 0, 70, 255]);
        assert_eq!(directions(&image, true), [10, 235, 30, 255, 50, 255, 70, 255]);
        Ok(())
    }
}
