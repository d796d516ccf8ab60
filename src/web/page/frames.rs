//! The frames of a canvas, which eframe brings.

use super::contrast::ContrastWatch;

pub(in crate::web) struct Frames {
    pub(super) ctx: egui::Context,
    pub(super) runner: eframe::WebRunner,
    pub(super) _contrast_watch: ContrastWatch,
}

impl Frames {
    /// Asks for a frame.
    pub(in crate::web) fn request(&self) {
        self.ctx.request_repaint();
    }

    /// Whether a frame panicked. Then eframe has removed the listeners.
    pub(in crate::web) fn have_panicked(&self) -> bool {
        self.runner.has_panicked()
    }

    /// Ends them, and removes the listeners.
    pub(in crate::web) fn end(&self) {
        self.runner.destroy();
    }
}
