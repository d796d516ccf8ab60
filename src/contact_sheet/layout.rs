//! Where pictures and their labels are on a contact sheet.

/// The most pixels of a sheet: 1 GiB.
const MOST_PIXELS: u64 = 1 << 28;
/// The least side of a picture on a sheet, pixels.
const LEAST_SIDE: u32 = 8;

/// Size of the text in pixels, as a fraction of a cell's height, of its width, and of the sheet's shorter side: the least of them.
const TEXT_OF_CELL_HEIGHT: f32 = 1.0 / 16.0;
const TEXT_OF_CELL_WIDTH: f32 = 1.0 / 20.0;
const TEXT_OF_SHEET: f32 = 1.0 / 54.0;
/// Smaller text cannot be read.
const LEAST_TEXT: f32 = 9.0;
/// Height of a label, and the gap between cells, in sizes of the text.
const LABEL_HEIGHT: f32 = 1.8;
const GAP: f32 = 0.7;

/// Why a sheet cannot be made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ContactSheetError {
    #[error("a sheet of {width} × {height} pixels is too large: at most {MOST_PIXELS} pixels in all")]
    TooLarge {
        /// Pixels.
        width: u32,
        /// Pixels.
        height: u32,
    },
    #[error(
        "a sheet of {width} × {height} pixels has no room for {columns} × {rows} pictures of {LEAST_SIDE} × {LEAST_SIDE} pixels"
    )]
    NoRoom {
        /// Pixels.
        width: u32,
        /// Pixels.
        height: u32,
        /// Pictures beside each other.
        columns: u32,
        /// Pictures below each other.
        rows: u32,
    },
}

/// A rectangle of the sheet, pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    /// Left and top.
    pub at: [u32; 2],
    pub size: [u32; 2],
}

/// Cells of equal size with equal gaps between them, in the middle of the sheet.
#[derive(Clone, Copy, Debug)]
pub struct Layout {
    size: [u32; 2],
    columns: u32,
    rows: u32,
    cell: [u32; 2],
    label_height: u32,
    gap: u32,
    /// Left and top of the first cell.
    first: [u32; 2],
    text_size: f32,
}

impl Layout {
    pub fn new([width, height]: [u32; 2], [columns, rows]: [u32; 2]) -> Result<Self, ContactSheetError> {
        if u64::from(width) * u64::from(height) > MOST_PIXELS {
            return Err(ContactSheetError::TooLarge { width, height });
        }
        let no_room = ContactSheetError::NoRoom {
            width,
            height,
            columns,
            rows,
        };
        if columns == 0 || rows == 0 || columns > width || rows > height {
            return Err(no_room);
        }
        let of_cell = |side: u32, cells: u32, part: f32| side as f32 / cells as f32 * part;
        let text_size = of_cell(height, rows, TEXT_OF_CELL_HEIGHT)
            .min(of_cell(width, columns, TEXT_OF_CELL_WIDTH))
            .min(width.min(height) as f32 * TEXT_OF_SHEET)
            .max(LEAST_TEXT)
            .round();
        let [label_height, gap] = [LABEL_HEIGHT, GAP].map(|part| (text_size * part).round() as u32);
        // What the cells have to themselves when gaps and labels are taken away.
        let cell = |side: u32, cells: u32, label_height: u32| {
            let taken = u64::from(gap) * u64::from(cells + 1) + u64::from(label_height) * u64::from(cells);
            let left = u64::from(side).checked_sub(taken)? / u64::from(cells);
            u32::try_from(left).ok().filter(|&side| side >= LEAST_SIDE)
        };
        let (Some(cell_width), Some(cell_height)) = (cell(width, columns, 0), cell(height, rows, label_height)) else {
            return Err(no_room);
        };
        let left = |side: u32, cells: u32, each: u32| (side - cells * each - (cells - 1) * gap) / 2;
        Ok(Self {
            size: [width, height],
            columns,
            rows,
            cell: [cell_width, cell_height],
            label_height,
            gap,
            first: [
                left(width, columns, cell_width),
                // The last label has its own room below it.
                left(height, rows, cell_height + label_height),
            ],
            text_size,
        })
    }

    pub(super) fn size(&self) -> [u32; 2] {
        self.size
    }

    pub fn cell_size(&self) -> [u32; 2] {
        self.cell
    }

    pub(super) fn text_size(&self) -> f32 {
        self.text_size
    }

    pub(super) fn pixel_count(&self) -> usize {
        self.size[0] as usize * self.size[1] as usize
    }

    /// The number of a pixel, from the top left along the rows.
    pub fn pixel_index(&self, [x, y]: [u32; 2]) -> usize {
        y as usize * self.size[0] as usize + x as usize
    }

    /// The places of a picture and of its label.
    pub fn places(&self, index: usize) -> Option<(Place, Place)> {
        let index = u32::try_from(index).ok()?;
        let (column, row) = (index % self.columns, index / self.columns);
        if row >= self.rows {
            return None;
        }
        let [width, height] = self.cell;
        let at = [
            self.first[0] + column * (width + self.gap),
            self.first[1] + row * (height + self.label_height + self.gap),
        ];
        let label = Place {
            at: [at[0], at[1] + height],
            size: [width, self.label_height],
        };
        Some((Place { at, size: self.cell }, label))
    }
}
