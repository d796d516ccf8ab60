//! How a window is shared, which its size decides.

use egui::{Rect, Ui};

use crate::ui::kit::theme::{LOW_HEIGHT, LOW_WIDTH, NARROW_WIDTH};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::ui) enum Arrangement {
    /// Panels stand around the view.
    Wide,
    /// A bar above, below a drawer with the timeline and with what was opened.
    Narrow,
    /// A bar above, the timeline in one row below, and between them what was opened, beside the model.
    Low,
}

impl Arrangement {
    pub(in crate::ui) fn of(window: Rect) -> Self {
        if window.height() < LOW_HEIGHT && window.width() >= LOW_WIDTH {
            Self::Low
        } else if window.width() >= NARROW_WIDTH {
            Self::Wide
        } else {
            Self::Narrow
        }
    }

    /// Of the window that something is shown in.
    pub(in crate::ui) fn here(ui: &Ui) -> Self {
        Self::of(ui.ctx().content_rect())
    }
}
