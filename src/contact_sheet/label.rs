//! Words in pixels, with the interface's font.

use ab_glyph::{Font as _, FontRef, Glyph, Point, PxScale, ScaleFont as _};

/// The font of labels and of the interface.
pub static INTER_REGULAR: &[u8] = include_bytes!("../../assets/fonts/Inter-Regular.otf");

/// Height of the font's capitals and digits, in ems.
const CAPITALS: f32 = 0.727;

/// Writes labels in one size.
pub(super) struct Labels {
    /// None if the font cannot be read: then nothing is written.
    font: Option<FontRef<'static>>,
    /// Pixels an em.
    size: f32,
}

impl Labels {
    pub(super) fn new(size: f32) -> Self {
        Self {
            font: FontRef::try_from_slice(INTER_REGULAR).ok(),
            size,
        }
    }

    pub(super) fn size(&self) -> f32 {
        self.size
    }

    /// How wide a text is, pixels.
    pub(super) fn width(&self, text: &str) -> f32 {
        self.lay_out(text, Point::default()).1
    }

    /// How much a text covers of each pixel of a rectangle, 0…255, rows from the top. It begins so far from the left, in the middle of the
    /// height.
    pub(super) fn coverage(&self, text: &str, left: f32, [width, height]: [u32; 2]) -> Vec<u8> {
        let mut coverage = vec![0_u8; width as usize * height as usize];
        // On a whole pixel, so that the feet of the letters are sharp.
        let foot = (0.5 * (height as f32 + CAPITALS * self.size)).round();
        let (glyphs, _) = self.lay_out(text, Point { x: left, y: foot });
        for glyph in glyphs {
            let Some(outline) = self.font.as_ref().and_then(|font| font.outline_glyph(glyph)) else {
                // A space has none.
                continue;
            };
            let corner = outline.px_bounds().min;
            outline.draw(|x, y, covered| {
                let place = [x as f32 + corner.x, y as f32 + corner.y];
                if place[0] >= 0.0 && place[1] >= 0.0 && place[0] < width as f32 && place[1] < height as f32 {
                    let pixel = &mut coverage[place[1] as usize * width as usize + place[0] as usize];
                    // Neighbours may share a pixel.
                    *pixel = pixel.saturating_add((covered * 255.0).round() as u8);
                }
            });
        }
        coverage
    }

    /// The glyphs of a text from a point on, and the text's width.
    fn lay_out(&self, text: &str, from: Point) -> (Vec<Glyph>, f32) {
        let Some(font) = &self.font else {
            return (Vec::new(), 0.0);
        };
        // A scale is the height of a line, not of an em.
        let per_em = font.height_unscaled() / font.units_per_em().unwrap_or(1000.0);
        let scale = PxScale::from(self.size * per_em);
        let font = font.as_scaled(scale);
        let mut width = 0.0;
        let place = |character| {
            let id = font.glyph_id(character);
            let position = Point {
                x: from.x + width,
                y: from.y,
            };
            width += font.h_advance(id);
            id.with_scale_and_position(scale, position)
        };
        let glyphs = text.chars().map(place).collect();
        (glyphs, width)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_are_equally_wide_and_words_as_wide_as_their_letters() {
        let labels = Labels::new(20.0);
        let width = |text| labels.width(text);
        assert!(width("0") > 5.0 && width("0") < 20.0, "{}", width("0"));
        for digits in ["1", "7", "8"] {
            assert_eq!(width(digits), width("0"), "{digits}");
        }
        assert!((width("frame 0") - width("frame") - width(" ") - width("0")).abs() < 1e-3);
        assert!(width("·") > 0.0 && width("°") > 0.0, "the font has what captions need");
    }

    #[test]
    fn a_text_covers_pixels_from_where_it_begins_to_its_width() {
        let labels = Labels::new(20.0);
        let (left, size) = (10.0, [100, 30]);
        let coverage = labels.coverage("0.5 s", left, size);
        assert_eq!(coverage.len(), 3000);
        let inked = |column: usize| (0..30).any(|row| coverage[row * 100 + column] > 0);
        let columns: Vec<usize> = (0..100).filter(|&column| inked(column)).collect();
        let (first, last) = (columns[0] as f32, columns[columns.len() - 1] as f32);
        assert!(first >= left && first < left + 4.0, "{first}");
        assert!(
            last <= left + labels.width("0.5 s") && last > left + labels.width("0.5"),
            "{last}"
        );
        assert!(coverage.contains(&255), "stems are solid");
        // In the middle of the height, give or take the rounding to a whole pixel.
        let rows: Vec<usize> = (0..30)
            .filter(|row| coverage[row * 100..][..100].iter().any(|&c| c > 128))
            .collect();
        let middle = (rows[0] + rows[rows.len() - 1] + 1) as f32 / 2.0;
        assert!((middle - 15.0).abs() <= 1.0, "{middle}");
        assert_eq!(coverage, labels.coverage("0.5 s", left, size), "the same every time");
    }
}
