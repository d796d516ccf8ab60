//! Hue, saturation and value of an encoded (sRGB) colour, as pickers show them. All from 0 to 1.

/// Hue, saturation, value.
pub(super) type Hsv = [f32; 3];

/// What a colour is made of. Grey has hue 0, black has saturation 0 too.
pub(super) fn hsv_from_srgb(srgb: [u8; 3]) -> Hsv {
    let [red, green, blue] = srgb.map(|channel| f32::from(channel) / 255.0);
    let (most, least) = (red.max(green).max(blue), red.min(green).min(blue));
    let spread = most - least;
    if spread <= 0.0 {
        return [0.0, 0.0, most];
    }
    let sixths = if most == red {
        (green - blue) / spread
    } else if most == green {
        2.0 + (blue - red) / spread
    } else {
        4.0 + (red - green) / spread
    };
    [(sixths / 6.0).rem_euclid(1.0), spread / most, most]
}

/// The colour made of these, rounded.
pub(super) fn srgb_from_hsv([hue, saturation, value]: Hsv) -> [u8; 3] {
    // Each channel is a trapezoid over the hue circle, a third of it apart from the next.
    let channel = |offset: f32| {
        let sixths = (offset + hue * 6.0).rem_euclid(6.0);
        let share = sixths.min(4.0 - sixths).clamp(0.0, 1.0);
        ((value - value * saturation * share) * 255.0).round() as u8
    };
    [channel(5.0), channel(3.0), channel(1.0)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_colours_are_taken_apart() {
        let cases = [
            ([0, 0, 0], [0.0, 0.0, 0.0]),
            ([255, 255, 255], [0.0, 0.0, 1.0]),
            ([255, 0, 0], [0.0, 1.0, 1.0]),
            ([0, 255, 0], [1.0 / 3.0, 1.0, 1.0]),
            ([0, 0, 255], [2.0 / 3.0, 1.0, 1.0]),
            ([255, 255, 0], [1.0 / 6.0, 1.0, 1.0]),
        ];
        for (srgb, hsv) in cases {
            let found = hsv_from_srgb(srgb);
            let off = found.iter().zip(hsv).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
            assert!(off < 1e-6, "{srgb:?}: {found:?}");
        }
    }

    #[test]
    fn what_was_taken_apart_comes_together_again() {
        for red in (0..=255).step_by(15) {
            for green in (0..=255).step_by(15) {
                for blue in (0..=255).step_by(15) {
                    let srgb = [red as u8, green as u8, blue as u8];
                    assert_eq!(srgb_from_hsv(hsv_from_srgb(srgb)), srgb);
                }
            }
        }
    }
}
