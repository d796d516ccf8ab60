//! Transforms and matrices as numbers that stand still while they change.

use egui::text::LayoutJob;
use egui::{Align2, FontId, Rect, Role, Sense, Stroke, Ui, WidgetInfo, pos2, vec2};

use super::digits::{Digits, fitted};
use crate::anim::{RowMatrix, TransformParts};
use crate::ui::theme::{self, ROW_HEIGHT, Tokens};

/// Height of a line of a table.
pub(super) const LINE_HEIGHT: f32 = 19.0;
/// Of the three columns that end at the panel's right edge: in the slimmest one nine characters and a gap, elsewhere what
/// labels leave.
const LEAST_COLUMN: f32 = 63.0;
const MOST_COLUMN: f32 = 80.0;
const LABEL_WIDTH: f32 = 73.0;
/// The last column of an affine matrix is 0 0 0 1 and needs less room.
const LAST_COLUMN_WIDTH: f32 = 22.0;
/// Of numbers, in points.
const FONT_SIZE: f32 = 11.0;

/// Position, quaternion, Euler angles and scale, and what these cannot say.
pub(super) fn show_parts(ui: &mut Ui, parts: &TransformParts, digits: Digits) {
    row(ui, "Position", &digits.place(parts.position.to_array()));
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
    paint_columns(ui, rect, numbers);
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, format!("{label} {}", numbers.join(" "))));
}

/// A line of a table: a label that is set already, which a reader calls `spoken`, and numbers in the columns of [`row`].
pub(super) fn show_line(ui: &mut Ui, spoken: &str, label: LayoutJob, numbers: &[String]) {
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), LINE_HEIGHT), Sense::hover());
    let galley = ui.painter().layout_job(label);
    let at = pos2(rect.min.x, rect.center().y - 0.5 * galley.size().y);
    ui.painter().galley(at, galley, Tokens::of(ui).muted);
    paint_columns(ui, rect, numbers);
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, format!("{spoken} {}", numbers.join(" "))));
}

/// The stroke under numbers that are added up.
pub(super) fn rule_over_numbers(ui: &mut Ui) {
    let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), 5.0), Sense::hover());
    let left = rect.max.x - 3.0 * number_column(rect.width());
    let stroke = Stroke::new(1.0, Tokens::of(ui).faint);
    ui.painter().hline(left..=rect.max.x, rect.center().y, stroke);
}

/// Width of each of three columns of numbers in a line so wide.
pub(super) fn number_column(width: f32) -> f32 {
    ((width - LABEL_WIDTH) / 3.0).clamp(LEAST_COLUMN, MOST_COLUMN)
}

/// Numbers in columns of one width that end at the right edge.
fn paint_columns(ui: &Ui, rect: Rect, numbers: &[String]) {
    // Four numbers are those of a unit quaternion, which are short.
    let (column, size) = if numbers.len() > 3 {
        (48.0, FONT_SIZE - 0.5)
    } else {
        (number_column(rect.width()), FONT_SIZE)
    };
    let (font, color) = (theme::mono(size), Tokens::of(ui).text);
    for (place, number) in numbers.iter().rev().enumerate() {
        let at = pos2(rect.max.x - place as f32 * column, rect.center().y);
        ui.painter().text(at, Align2::RIGHT_CENTER, number, font.clone(), color);
    }
}

/// A matrix row by row, as in the file.
pub(super) fn show_matrix(ui: &mut Ui, name: &str, matrix: &RowMatrix, digits: Digits) {
    let tokens = Tokens::of(ui);
    for (index, numbers) in matrix.0.iter().enumerate() {
        let size = vec2(ui.available_width(), LINE_HEIGHT);
        let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
        let column = (rect.width() - LAST_COLUMN_WIDTH) / 3.0;
        let [x, y, z, w] = *numbers;
        let last = if w.fract() == 0.0 { fitted(w, 0) } else { fitted(w, 2) };
        let [x, y, z] = digits.matrix([x, y, z]);
        let texts = [x, y, z, last];
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
