//! What the last frame cost, at a pace that can be read.

use egui::Ui;

use crate::scene::FrameCost;
use crate::session::Session;

/// A read-out stays for so long.
const SHOWN_SECS: f64 = 0.25;

/// The cost that panels show. It changes a few times a second while the picture moves.
#[derive(Debug, Default)]
pub(in crate::ui) struct SteadyCost {
    shown: FrameCost,
    until_secs: f64,
    picture: u64,
}

impl SteadyCost {
    /// The cost to show. If that is not the last frame's yet, it asks for a pass in which it will be.
    pub(in crate::ui) fn read(&mut self, ui: &Ui, session: &Session) -> FrameCost {
        // A frame is drawn after the panels: its cost is read in the next pass.
        let rests = session.quality().rests_in_secs() == Some(0.0);
        if self.picture != session.picture_revision() || rests {
            self.picture = session.picture_revision();
            ui.ctx().request_repaint();
        }
        let cost = session.frame_cost();
        if cost != self.shown {
            let now_secs = ui.input(|input| input.time);
            if now_secs >= self.until_secs {
                self.shown = cost;
                self.until_secs = now_secs + SHOWN_SECS;
            } else {
                let left = std::time::Duration::from_secs_f64(self.until_secs - now_secs);
                ui.ctx().request_repaint_after(left);
            }
        }
        self.shown
    }
}
