//! Which rows of a picture are drawn.

/// Texels beside a light's columns that its blurs read, and as many above and below: one radius for each of the book's four blurs.
pub(super) const BLUR_MARGIN: u32 = 4 * 5;

/// Rows of a picture that are drawn together: all of them, or some of one that is too large for the device's memory. Maps of what is in
/// view have bands too.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Band {
    /// Size of the whole picture, pixels.
    pub(super) whole: [u32; 2],
    /// Even, so that rows which are drawn in pairs stay together.
    pub(super) first_row: u32,
    pub(super) rows: u32,
}

impl Band {
    /// All of a picture.
    pub(super) fn all(whole: [u32; 2]) -> Self {
        let (first_row, rows) = (0, whole[1]);
        Self { whole, first_row, rows }
    }

    pub(super) fn size(self) -> [u32; 2] {
        [self.whole[0], self.rows]
    }

    /// With so many rows above and below, as far as there are any.
    pub(super) fn widened(self, by: u32) -> Self {
        let first_row = self.first_row.saturating_sub(by);
        let end = (self.first_row + self.rows + by).min(self.whole[1]);
        Self {
            first_row,
            rows: end - first_row,
            ..self
        }
    }

    /// In a map of half the resolution.
    pub(super) fn half(self) -> Self {
        Self {
            whole: half(self.whole),
            first_row: self.first_row / 2,
            rows: self.rows.div_ceil(2),
        }
    }

    /// Sets the viewport so that the band shows what it is in the whole picture, with depths from 0 to this.
    pub(super) fn set_viewport(self, pass: &mut wgpu::RenderPass<'_>, farthest: f32) {
        let [width, height] = self.whole.map(|side| side as f32);
        pass.set_viewport(0.0, -(self.first_row as f32), width, height, 0.0, farthest);
    }
}

/// Size of the maps of half the resolution for a picture of this size.
pub fn half(size: [u32; 2]) -> [u32; 2] {
    size.map(|side| side.div_ceil(2))
}
