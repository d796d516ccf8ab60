//! Transforms and matrices as numbers that stand still while they change.

use egui::{Align2, FontId, Role, Sense, Ui, WidgetInfo, pos2, vec2};

use crate::anim::{RowMatrix, TransformParts};
use crate::ui::theme::{self, ROW_HEIGHT, Tokens};

/// Characters of a number: sign, digits, point.
const WIDTH: usize = 9;
/// Height of a row of a matrix.
const MATRIX_ROW_HEIGHT: f32 = 19.0;
/// The last column of an affine matrix is 0 0 0 1 and needs less room.
const LAST_COLUMN_WIDTH: f32 = 22.0;
/// Of numbers, in points.
const FONT_SIZE: f32 = 11.0;

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

/// Position, quaternion, Euler angles and scale, and what these cannot say.
pub(super) fn show_parts(ui: &mut Ui, parts: &TransformParts) {
    row(
        ui,
        "Position",
        &parts.position.to_array().map(|number| fitted(number, 4)),
    );
    let quaternion = parts.rotation.to_array().map(|number| fitted(number, 4));
    row(ui, "Quaternion", &quaternion);
    let euler = parts.euler_xyz_degrees.to_array();
    row(ui, "Euler XYZ", &euler.map(|number| format!("{}°", fitted(number, 2))));
    row(ui, "Scale", &parts.scale.to_array().map(|number| fitted(number, 4)));
    if parts.is_sheared() {
        row(ui, "Shear", &parts.shear.to_array().map(|number| fitted(number, 4)));
    }
    if parts.is_mirrored() {
        row(ui, "Mirrored", &["yes".to_owned()]);
    }
}

/// A label and numbers to the right of columns of one width.
pub(super) fn row(ui: &mut Ui, label: &str, numbers: &[String]) {
    let tokens = Tokens::of(ui);
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), ROW_HEIGHT), Sense::hover());
    let (font, left) = (FontId::proportional(12.0), rect.left_center());
    ui.painter().text(left, Align2::LEFT_CENTER, label, font, tokens.muted);
    // Four numbers are those of a unit quaternion, which are short.
    let (column, size) = if numbers.len() > 3 {
        (48.0, FONT_SIZE - 0.5)
    } else {
        (63.0, FONT_SIZE)
    };
    for (place, number) in numbers.iter().rev().enumerate() {
        let at = pos2(rect.max.x - place as f32 * column, rect.center().y);
        let font = theme::mono(size);
        ui.painter().text(at, Align2::RIGHT_CENTER, number, font, tokens.text);
    }
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, format!("{label} {}", numbers.join(" "))));
}

/// A matrix row by row, as in the file.
pub(super) fn show_matrix(ui: &mut Ui, name: &str, matrix: &RowMatrix) {
    let tokens = Tokens::of(ui);
    for (index, numbers) in matrix.0.iter().enumerate() {
        let size = vec2(ui.available_width(), MATRIX_ROW_HEIGHT);
        let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
        let column = (rect.width() - LAST_COLUMN_WIDTH) / 3.0;
        let [x, y, z, w] = *numbers;
        let last = if w.fract() == 0.0 { fitted(w, 0) } else { fitted(w, 2) };
        let texts = [fitted(x, 5), fitted(y, 5), fitted(z, 5), last];
        for (place, text) in texts.iter().enumerate() {
            let right = match place {
                3 => rect.max.x,
                place => rect.min.x + (place + 1) as f32 * column - 6.0,
            };
            let color = if place == 3 { tokens.faint } else { tokens.text };
            let at = pos2(right, rect.center().y);
            ui.painter()
                .text(at, Align2::RIGHT_CENTER, text, theme::mono(FONT_SIZE), color);
        }
        let label = format!("{name}, row {}: {}", index + 1, texts.join(" "));
        response.widget_info(|| WidgetInfo::labeled(Role::Label, true, &label));
    }
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
}
