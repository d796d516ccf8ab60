//! Inverse bind matrices of any format: finite and affine, and in which words it is told what was mended.

use glam::{DAffine3, DMat4, DVec4, Mat4};

use super::scene::is_invertible;
use crate::diagnostic::codes;
use crate::diagnostic::collect::{Diagnostics, Place, Tally, counted};

/// How a format calls them.
pub(super) struct Words {
    pub(super) one_has: &'static str,
    pub(super) many_have: &'static str,
    /// What is said of a matrix whose last row, as we have it, is not 0 0 0 1, and how far off it may be.
    pub(super) not_affine: (&'static str, f64),
    pub(super) singular: &'static str,
}

/// The matrices, each of 16 numbers column by column as we have them. `place` is where some are.
pub(super) fn mended<'a>(
    rows: impl IntoIterator<Item = &'a [f32; 16]>,
    words: &Words,
    place: impl Fn(&Tally) -> Place,
    diagnostics: &mut Diagnostics,
) -> Vec<DAffine3> {
    let (mut not_finite, mut not_affine, mut singular) = (Tally::default(), Tally::default(), Tally::default());
    let matrices = (0u32..).zip(rows).map(|(index, row)| {
        let matrix = Mat4::from_cols_array(row);
        if !matrix.is_finite() {
            not_finite.add(index);
            return DAffine3::IDENTITY;
        }
        let matrix: DMat4 = matrix.as_dmat4();
        if !matrix.row(3).abs_diff_eq(DVec4::W, words.not_affine.1) {
            not_affine.add(index);
        }
        let matrix = DAffine3::from_mat4(matrix);
        if !is_invertible(&matrix) {
            singular.add(index);
        }
        matrix
    });
    let matrices = matrices.collect();
    let stands_in = "a number that is not finite; the identity stands in.";
    for (code, tally, rule) in [
        (&codes::OFFSET_NOT_FINITE, not_finite, stands_in),
        (&codes::OFFSET_NOT_AFFINE, not_affine, words.not_affine.0),
        (&codes::OFFSET_SINGULAR, singular, words.singular),
    ] {
        if tally.count > 0 {
            let have = counted(tally.count, words.one_has, words.many_have);
            diagnostics.add(code, place(&tally), format!("{have} {rule}"));
        }
    }
    matrices
}
