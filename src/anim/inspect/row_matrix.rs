//! Matrices as the file has them.

use glam::{Affine3A, Mat4};

use crate::anim::table::{aligned, number};

/// A matrix for row vectors, row by row, as files and books have it: `v · m`, the translation in the fourth row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RowMatrix(pub [[f32; 4]; 4]);

impl From<Affine3A> for RowMatrix {
    /// The rows of a matrix for row vectors are the columns of the same one for column vectors.
    fn from(matrix: Affine3A) -> Self {
        Self(Mat4::from(matrix).to_cols_array_2d())
    }
}

impl RowMatrix {
    /// The four rows, in aligned columns.
    pub fn lines(&self) -> Vec<String> {
        aligned(&self.0.map(|row| row.map(number)))
    }

    /// A line that names the matrix and its layout, and the four rows below it.
    pub fn to_text(&self, name: &str) -> String {
        format!(
            "{name} (row vectors, row by row as in the file; translation in the fourth row)\n{}\n",
            self.lines().join("\n")
        )
    }
}
