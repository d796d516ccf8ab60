//! How fast a drag was when the pointer let go.

use glam::Vec2;

/// Only this last part of a drag counts: who slows down before letting go means to stop.
const RECENT_SECS: f64 = 0.08;

/// What a drag did lately.
#[derive(Clone, Debug, Default)]
pub(super) struct DragTrail {
    /// When, and how far since the step before.
    steps: Vec<(f64, Vec2)>,
}

impl DragTrail {
    /// The drag went on.
    pub(super) fn add(&mut self, now_secs: f64, moved: Vec2) {
        self.steps.retain(|&(at_secs, _)| now_secs - at_secs <= RECENT_SECS);
        self.steps.push((now_secs, moved));
    }

    /// Another drag, or none.
    pub(super) fn clear(&mut self) {
        self.steps.clear();
    }

    /// Movement a second over the recent part of the drag.
    pub(super) fn rate_per_sec(&self, now_secs: f64) -> Vec2 {
        let recent = self
            .steps
            .iter()
            .filter(|&&(at_secs, _)| now_secs - at_secs <= RECENT_SECS);
        recent.map(|&(_, moved)| moved).sum::<Vec2>() / RECENT_SECS as f32
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_steady_drag_has_its_rate_and_one_that_waits_has_none() {
        let mut trail = DragTrail::default();
        for step in 0..20 {
            trail.add(f64::from(step) * 0.01, Vec2::new(0.02, -0.01));
        }
        let rate = trail.rate_per_sec(0.19);
        assert!((rate - Vec2::new(2.0, -1.0)).abs().max_element() < 0.3, "{rate}");
        assert_eq!(trail.rate_per_sec(0.4), Vec2::ZERO, "it stood still before the end");
        trail.clear();
        assert_eq!(trail.rate_per_sec(0.19), Vec2::ZERO);
    }
}
