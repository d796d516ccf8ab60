//! Numbers in columns and matrices as the file has them, for text that a person copies.

use glam::{Affine3A, Mat4};

/// A number with six decimals, or with an exponent where it would be too long; never a negative zero.
pub(super) fn number(value: f32) -> String {
    if value.is_finite() && value.abs() >= 1e7 {
        return format!("{value:e}");
    }
    let text = format!("{value:.6}");
    match text.strip_prefix('-') {
        Some(rest) if rest.bytes().all(|byte| matches!(byte, b'0' | b'.')) => rest.to_owned(),
        _ => text,
    }
}

/// One line for each row, its cells to the right of columns as wide as their widest cell.
pub(super) fn aligned<const N: usize>(rows: &[[String; N]]) -> Vec<String> {
    let widths: [usize; N] = std::array::from_fn(|column| rows.iter().map(|row| row[column].len()).max().unwrap_or(0));
    let line = |row: &[String; N]| {
        let cells = row.iter().zip(widths).map(|(cell, width)| format!("{cell:>width$}"));
        cells.collect::<Vec<_>>().join("  ")
    };
    rows.iter().map(line).collect()
}

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
