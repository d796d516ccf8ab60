//! Formulas as the books print them: vectors and matrices bold, small numbers below the line.

use egui::text::{LayoutJob, TextFormat};
use egui::{Align, Color32, FontId};

use crate::ui::theme;

/// A line of symbols that grows from left to right.
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

    /// A word, a sign, a number.
    pub(super) fn plain(self, text: &str) -> Self {
        let font = FontId::proportional(self.size);
        self.with(text, font, Align::Center)
    }

    /// A vector or a matrix.
    pub(super) fn bold(self, symbol: &str) -> Self {
        let font = theme::semibold(self.size);
        self.with(symbol, font, Align::Center)
    }

    /// Which of several.
    pub(super) fn below(self, index: usize) -> Self {
        let font = FontId::proportional(self.size * 0.72);
        self.with(&index.to_string(), font, Align::Max)
    }

    /// `v·F0`: the vertex through the final matrix of an influence.
    pub(super) fn moved(self, index: usize) -> Self {
        self.bold("v").plain("·").bold("F").below(index)
    }

    /// `w0·v·F0`: that, times the weight.
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
