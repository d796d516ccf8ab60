//! Words in pixels, with the interface's font and the rasteriser that draws its words: another one would make the program larger.

use skrifa::instance::{LocationRef, Size};
use skrifa::metrics::GlyphMetrics;
use skrifa::outline::{DrawSettings, OutlinePen};
use skrifa::{FontRef, GlyphId, MetadataProvider as _};
use vello_cpu::color::{OpaqueColor, Srgb};
use vello_cpu::kurbo::BezPath;
use vello_cpu::{Pixmap, RenderContext, Resources};

/// The font of labels and of the interface.
pub static INTER_REGULAR: &[u8] = include_bytes!("../../assets/fonts/Inter-Regular.otf");

pub struct Labels {
    /// None if the font cannot be read: then nothing is written.
    font: Option<FontRef<'static>>,
    /// Pixels an em.
    size: f32,
}

impl Labels {
    pub fn new(size: f32) -> Self {
        Self {
            font: FontRef::new(INTER_REGULAR).ok(),
            size,
        }
    }

    pub(super) fn size(&self) -> f32 {
        self.size
    }

    /// How wide a text is, pixels.
    pub fn width(&self, text: &str) -> f32 {
        let Some(font) = &self.font else { return 0.0 };
        glyphs(font, self.size, text).map(|(_, advance)| advance).sum()
    }

    /// How much a text covers of each pixel of a rectangle, 0…255, rows from the top. It begins so far from the left, in the middle of the
    /// height.
    pub fn coverage(&self, text: &str, left: f32, [width, height]: [u32; 2]) -> Vec<u8> {
        let ([Ok(columns), Ok(rows)], Some(font)) = ([width, height].map(u16::try_from), &self.font) else {
            return Vec::new();
        };
        let capitals = font.metrics(Size::new(self.size), LocationRef::default()).cap_height;
        let capitals = capitals.unwrap_or(0.7 * self.size);
        let mut pen = PathPen {
            path: BezPath::new(),
            // On a whole pixel, so that the feet of the letters are sharp.
            at: [left, (0.5 * (height as f32 + capitals)).round()],
        };
        let outlines = font.outline_glyphs();
        for (glyph, advance) in glyphs(font, self.size, text) {
            if let Some(outline) = outlines.get(glyph) {
                let settings = DrawSettings::unhinted(Size::new(self.size), LocationRef::default());
                // A glyph that is damaged is left out; its room stays.
                let _ = outline.draw(settings, &mut pen);
            }
            pen.at[0] += advance;
        }
        let mut context = RenderContext::new(columns, rows);
        context.set_paint(OpaqueColor::<Srgb>::WHITE);
        context.fill_path(&pen.path);
        let mut pixels = Pixmap::new(columns, rows);
        context.render(&mut pixels, &mut Resources::new());
        pixels.data().iter().map(|pixel| pixel.a).collect()
    }
}

/// The glyphs of a text and how far each moves the pen.
fn glyphs(font: &FontRef<'static>, size: f32, text: &str) -> impl Iterator<Item = (GlyphId, f32)> {
    let (characters, metrics) = (
        font.charmap(),
        GlyphMetrics::new(font, Size::new(size), LocationRef::default()),
    );
    text.chars().map(move |character| {
        let glyph = characters.map(character).unwrap_or_default();
        (glyph, metrics.advance_width(glyph).unwrap_or(0.0))
    })
}

/// Collects outlines. Fonts have y up, pictures have it down.
struct PathPen {
    path: BezPath,
    /// Where the glyph's origin is, pixels.
    at: [f32; 2],
}

impl PathPen {
    fn point(&self, x: f32, y: f32) -> (f64, f64) {
        (f64::from(self.at[0] + x), f64::from(self.at[1] - y))
    }
}

impl OutlinePen for PathPen {
    fn move_to(&mut self, x: f32, y: f32) {
        self.path.move_to(self.point(x, y));
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.path.line_to(self.point(x, y));
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        self.path.quad_to(self.point(x1, y1), self.point(x, y));
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        self.path
            .curve_to(self.point(x1, y1), self.point(x2, y2), self.point(x, y));
    }

    fn close(&mut self) {
        self.path.close_path();
    }
}
