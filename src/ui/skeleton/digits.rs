//! How many digits numbers are shown with: as many as have room, and always the same.

use crate::model::Aabb;

/// Characters of a number: sign, digits, point.
const WIDTH: usize = 9;
/// The most decimals of a number of a matrix, and of a place.
const MATRIX_DECIMALS: usize = 5;
const PLACE_DECIMALS: usize = 4;
/// Numbers may become as large as this many times the model's reach before they lose decimals.
const HEADROOM: f32 = 4.0;

/// Decimals for numbers of one model. They follow from its size and not from the number that is shown, so that points stand
/// below each other and stay where they are while a clip plays.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Digits {
    decimals: usize,
}

impl Default for Digits {
    fn default() -> Self {
        Self {
            decimals: MATRIX_DECIMALS,
        }
    }
}

impl Digits {
    /// For a model with these bounds, in its own space.
    pub(super) fn for_bounds(bounds: &Aabb) -> Self {
        let reach = bounds.min.abs().max(bounds.max.abs()).max_element() * HEADROOM;
        if bounds.is_empty() || !reach.is_finite() {
            return Self::default();
        }
        let before_point = format!("{reach:.0}").len();
        Self {
            // Sign and point take two characters.
            decimals: WIDTH.saturating_sub(2 + before_point).min(MATRIX_DECIMALS),
        }
    }

    /// Coordinates of a place.
    pub(super) fn place(self, numbers: [f32; 3]) -> [String; 3] {
        numbers.map(|number| self.place_of(number))
    }

    /// One coordinate of a place.
    pub(super) fn place_of(self, number: f32) -> String {
        fitted(number, self.decimals.min(PLACE_DECIMALS))
    }

    /// Numbers of a row of a matrix.
    pub(super) fn matrix(self, numbers: [f32; 3]) -> [String; 3] {
        numbers.map(|number| fitted(number, self.decimals))
    }
}

/// A number of nine characters at most, with as many decimals as have room, up to `decimals`; with an exponent beyond.
/// Never a negative zero.
pub(super) fn fitted(number: f32, decimals: usize) -> String {
    if !number.is_finite() {
        return "–".to_owned();
    }
    for decimals in (0..=decimals).rev() {
        let text = format!("{number:.decimals$}");
        if text.len() <= WIDTH {
            let is_zero = text.bytes().all(|byte| matches!(byte, b'-' | b'0' | b'.'));
            return if is_zero { text.replace('-', "") } else { text };
        }
    }
    format!("{number:.2e}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_fit_nine_characters_and_zero_has_no_sign() {
        let cases = [
            (0.0, "0.00000"),
            (-1e-9, "0.00000"),
            (-12.345_678, "-12.34568"),
            (-123.456_78, "-123.4568"),
            (1_234_567.0, "1234567.0"),
            (-12_345_678.0, "-12345678"),
            (3e12, "3.00e12"),
            (f32::NAN, "–"),
        ];
        for (number, text) in cases {
            assert_eq!(fitted(number, 5), text);
        }
    }

    #[test]
    fn decimals_follow_from_the_size_of_the_model() {
        let of_reach = |reach: f32| {
            Digits::for_bounds(&Aabb {
                min: glam::Vec3::new(-0.1, -reach, 0.0),
                max: glam::Vec3::splat(0.1),
            })
        };
        for (reach, small, large) in [
            (1.8, "0.50000", "-7.20000"),
            (70.0, "0.5000", "-280.0000"),
            (3_000.0, "0.50", "-12000.00"),
            (1e9, "0", "-4.00e9"),
        ] {
            let [first, second, _] = of_reach(reach).matrix([0.5, -4.0 * reach, 0.0]);
            assert_eq!((first.as_str(), second.as_str()), (small, large), "{reach}");
        }
        assert_eq!(Digits::for_bounds(&Aabb::EMPTY), Digits::default());
        assert_eq!(of_reach(1.8).place_of(-0.00001), "0.0000");
    }
}
