//! Transforms and matrices as numbers: how many digits they have, rows and tables of them, formulas as the books print them. The
//! columns stand still while values change.

use egui::text::{LayoutJob, TextFormat};
use egui::{Align, Align2, Color32, FontId, Rect, Role, Sense, Stroke, Ui, WidgetInfo, pos2, vec2};

use crate::anim::{RowMatrix, TransformParts};
use crate::model::Aabb;
use crate::ui::kit::theme::{self, ROW_HEIGHT, Tokens};
use crate::ui::kit::{Row, labelled, tell_node};

/// Characters of a number: sign, digits, point.
const NUMBER_CHARS: usize = 9;
/// The most decimals of a matrix element, and of a coordinate.
const MATRIX_DECIMALS: usize = 5;
const PLACE_DECIMALS: usize = 4;
/// Numbers keep their decimals up to this multiple of the model's largest coordinate.
const HEADROOM: f32 = 4.0;
/// Numbers below this fraction of their scale are rounding errors of the file and of the pose. They print as 0.
const NOISE_FRACTION: f32 = 1e-5;

/// Decimals for the numbers of one model. They follow from the model's size, not from each number, so that the decimal points align
/// and stay in place while a clip plays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Digits {
    decimals: usize,
    /// The model's largest coordinate.
    scale: f32,
}

impl Default for Digits {
    fn default() -> Self {
        Self {
            decimals: MATRIX_DECIMALS,
            scale: 1.0,
        }
    }
}

impl Digits {
    /// For a model with these bounds, in its own space.
    pub fn for_bounds(bounds: &Aabb) -> Self {
        let scale = bounds.min.abs().max(bounds.max.abs()).max_element();
        let reach = scale * HEADROOM;
        if bounds.is_empty() || !reach.is_finite() {
            return Self::default();
        }
        let before_point = format!("{reach:.0}").len();
        Self {
            // Sign and point take two characters.
            decimals: NUMBER_CHARS.saturating_sub(2 + before_point).min(MATRIX_DECIMALS),
            scale,
        }
    }

    pub(super) fn place(self, numbers: [f32; 3]) -> [String; 3] {
        numbers.map(|number| self.place_of(number))
    }

    pub fn place_of(self, number: f32) -> String {
        fitted(without_noise(number, self.scale), self.decimals.min(PLACE_DECIMALS))
    }

    /// A row of a matrix: axes for the first three, the origin's place for the last.
    pub fn matrix(self, row: usize, numbers: [f32; 3]) -> [String; 3] {
        let scale = if row < 3 { 1.0 } else { self.scale };
        numbers.map(|number| fitted(without_noise(number, scale), self.decimals))
    }
}

/// A number, or 0 where it is too small for its scale to mean something.
fn without_noise(number: f32, scale: f32) -> f32 {
    if number.abs() < NOISE_FRACTION * scale {
        0.0
    } else {
        number
    }
}

/// A number in at most nine characters: with up to `decimals` decimals, or with an exponent if it does not fit. Never a negative
/// zero.
pub fn fitted(number: f32, decimals: usize) -> String {
    if !number.is_finite() {
        return "–".to_owned();
    }
    for decimals in (0..=decimals).rev() {
        let text = format!("{number:.decimals$}");
        if text.len() <= NUMBER_CHARS {
            let is_zero = text.bytes().all(|byte| matches!(byte, b'-' | b'0' | b'.'));
            return if is_zero { text.replace('-', "") } else { text };
        }
    }
    format!("{number:.2e}")
}

/// Height of a line of a table.
pub(super) const LINE_HEIGHT: f32 = 19.0;
/// Least and greatest width of the three columns at the panel's right edge: nine characters with a gap, and what labels leave.
const LEAST_COLUMN: f32 = 63.0;
const MOST_COLUMN: f32 = 80.0;
const LABEL_WIDTH: f32 = 73.0;
/// The last column of an affine matrix is 0 0 0 1 and needs less room.
const LAST_COLUMN_WIDTH: f32 = 22.0;
const FONT_SIZE: f32 = 11.0;

/// Position, quaternion, Euler angles and scale, and shear and mirroring if there is any.
pub(super) fn show_parts(ui: &mut Ui, parts: &TransformParts, digits: Digits) {
    row(ui, "Position", &digits.place(parts.position.to_array()));
    quaternion_rows(ui, parts.rotation.to_array());
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

/// A quaternion: its four numbers have a line of their own.
fn quaternion_rows(ui: &mut Ui, numbers: [f32; 4]) {
    let tokens = Tokens::of(ui);
    let mut row = Row::new(ui, ROW_HEIGHT + LINE_HEIGHT);
    let (label, line) = row.rect.split_top_bottom_at_y(row.rect.min.y + ROW_HEIGHT);
    row.y = label.center().y;
    row.left_in(FontId::proportional(12.0), "Quaternion", tokens.muted);
    let numbers = numbers.map(|number| fitted(without_noise(number, 1.0), 4));
    let width = row.rect.width();
    paint_numbers(ui, line, number_column(width).min(0.25 * width), &numbers);
    row.told(Role::Label, format!("Quaternion {}", numbers.join(" ")));
}

/// A label and numbers to the right of columns of one width.
pub(super) fn row(ui: &mut Ui, label: &str, numbers: &[String]) {
    let tokens = Tokens::of(ui);
    let mut row = Row::new(ui, ROW_HEIGHT);
    row.left_in(FontId::proportional(12.0), label, tokens.muted);
    paint_columns(ui, row.rect, numbers);
    row.told(Role::Label, format!("{label} {}", numbers.join(" ")));
}

/// A line of a table: a label (`spoken` for screen readers), and numbers in the columns of [`row`].
pub(super) fn show_line(ui: &mut Ui, spoken: &str, label: LayoutJob, numbers: &[String]) {
    let row = Row::new(ui, LINE_HEIGHT);
    let galley = ui.painter().layout_job(label);
    let at = pos2(row.left, row.y - 0.5 * galley.size().y);
    ui.painter().galley(at, galley, Tokens::of(ui).muted);
    paint_columns(ui, row.rect, numbers);
    row.told(Role::Label, format!("{spoken} {}", numbers.join(" ")));
}

/// The stroke under numbers that are added up.
pub(super) fn rule_over_numbers(ui: &mut Ui) {
    let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), 5.0), Sense::hover());
    let left = rect.max.x - 3.0 * number_column(rect.width());
    let stroke = Stroke::new(1.0, Tokens::of(ui).faint);
    ui.painter().hline(left..=rect.max.x, rect.center().y, stroke);
}

/// Width of each of three columns of numbers in a line of this width.
pub(super) fn number_column(width: f32) -> f32 {
    ((width - LABEL_WIDTH) / 3.0).clamp(LEAST_COLUMN, MOST_COLUMN)
}

/// Numbers in columns of one width that end at the right edge.
fn paint_columns(ui: &Ui, rect: Rect, numbers: &[String]) {
    paint_numbers(ui, rect, number_column(rect.width()), numbers);
}

/// The same in columns of another width.
fn paint_numbers(ui: &Ui, rect: Rect, column: f32, numbers: &[String]) {
    let (font, color) = (theme::mono(FONT_SIZE), Tokens::of(ui).text);
    for (place, number) in numbers.iter().rev().enumerate() {
        let at = pos2(rect.max.x - place as f32 * column, rect.center().y);
        ui.painter().text(at, Align2::RIGHT_CENTER, number, font.clone(), color);
    }
}

/// A matrix row by row, as in the file.
pub(super) fn show_matrix(ui: &mut Ui, name: &str, matrix: &RowMatrix, digits: Digits) {
    labelled(ui, Role::Table, name, matrix.0.len(), |ui| {
        matrix_rows(ui, matrix, digits);
    });
}

fn matrix_rows(ui: &mut Ui, matrix: &RowMatrix, digits: Digits) {
    let tokens = Tokens::of(ui);
    for (index, numbers) in matrix.0.iter().enumerate() {
        let mut row = Row::new(ui, LINE_HEIGHT);
        let rect = row.rect;
        let column = (rect.width() - LAST_COLUMN_WIDTH) / 3.0;
        let [x, y, z, w] = *numbers;
        let last = if w.fract() == 0.0 { fitted(w, 0) } else { fitted(w, 2) };
        let [x, y, z] = digits.matrix(index, [x, y, z]);
        let texts = [x, y, z, last];
        for (place, text) in texts.iter().enumerate() {
            row.right = match place {
                3 => rect.max.x,
                place => rect.min.x + (place + 1) as f32 * column - 6.0,
            };
            let color = if place == 3 { tokens.faint } else { tokens.text };
            row.right_in(theme::mono(FONT_SIZE), text, color);
        }
        let response = row.told(Role::Row, format!("row {}: {}", index + 1, texts.join(" ")));
        tell_node(&response, |node| node.set_row_index(index));
    }
}

/// A formula as the books print it: vectors and matrices bold, indices as subscripts. It is built from left to right.
#[derive(Debug)]
pub(super) struct Formula {
    job: LayoutJob,
    size: f32,
    color: Color32,
}

impl Formula {
    pub(super) fn new(size: f32, color: Color32) -> Self {
        Self {
            job: LayoutJob::default(),
            size,
            color,
        }
    }

    /// Adds a word, a sign or a number.
    pub(super) fn plain(self, text: &str) -> Self {
        let font = FontId::proportional(self.size);
        self.with(text, font, Align::Center)
    }

    /// Adds a vector or a matrix.
    pub(super) fn bold(self, symbol: &str) -> Self {
        let font = theme::semibold(self.size);
        self.with(symbol, font, Align::Center)
    }

    /// Adds an index as a subscript.
    pub(super) fn below(self, index: usize) -> Self {
        let font = FontId::proportional(self.size * 0.72);
        self.with(&index.to_string(), font, Align::Max)
    }

    /// Adds `v·F0`: the vertex times the final matrix of an influence.
    pub(super) fn moved(self, index: usize) -> Self {
        self.bold("v").plain("·").bold("F").below(index)
    }

    /// Adds `w0·v·F0`: the same times the weight.
    pub(super) fn weighted(self, index: usize) -> Self {
        self.plain("w").below(index).plain("·").moved(index)
    }

    pub(super) fn into_job(self) -> LayoutJob {
        self.job
    }

    fn with(mut self, text: &str, font_id: FontId, valign: Align) -> Self {
        let format = TextFormat {
            font_id,
            color: self.color,
            valign,
            ..TextFormat::default()
        };
        self.job.append(text, 0.0, format);
        self
    }
}

/// What the books call their matrices means, in a sentence each.
pub(super) const OFFSET_EXPLAINED: &str =
    "offset brings a vertex from bind space, as the file has it, into the bone's space; it is the same in all poses.";
pub(super) const TO_ROOT_EXPLAINED: &str =
    "toRoot brings what is in the bone's space into that of the model, as the clip poses it now.";
pub(super) const FINAL_EXPLAINED: &str =
    "The final transform F brings a vertex from bind space to where this bone has it now: offset, then toRoot.";

pub(super) fn show_meaning(ui: &mut Ui) {
    let meaning = Formula::new(12.0, Tokens::of(ui).muted)
        .bold("F")
        .plain(" = offset · toRoot, for row vectors");
    show_spoken(ui, meaning, "F = offset · toRoot, for row vectors");
}

/// A line with a formula, and how it is spoken.
pub(super) fn show_spoken(ui: &mut Ui, formula: Formula, spoken: &str) {
    let galley = ui.painter().layout_job(formula.into_job());
    let size = vec2(ui.available_width(), galley.size().y + 4.0);
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    ui.painter()
        .galley(rect.min + vec2(0.0, 2.0), galley, Tokens::of(ui).text);
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, spoken));
}
