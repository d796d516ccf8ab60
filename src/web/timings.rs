//! How long the stages of the last opening took, for scripts, and as marks in the browser's own timeline.

use std::cell::RefCell;
use std::collections::BTreeMap;

use super::now_secs;
use crate::slices::Stage;

/// What comes behind the stages of the core: a frame draws the model, and that is the end.
const DRAWING: &str = "drawing";
const DRAWN: &str = "drawn";

/// Names of stages and when each began, in seconds of the page's clock.
#[derive(Debug, Default)]
pub(super) struct Timings(RefCell<Vec<(&'static str, f64)>>);

impl Timings {
    /// Begins with files that come from a disk or a server.
    pub(super) fn begin(&self) {
        self.0.borrow_mut().clear();
        self.enter(Stage::Fetching.as_str());
    }

    /// A stage begins, and the one before it ends.
    pub(super) fn enter(&self, stage: &'static str) {
        let mut entered = self.0.borrow_mut();
        if entered.last().is_some_and(|&(last, _)| last == DRAWN) {
            entered.clear();
        }
        entered.push((stage, now_secs()));
        if let Some(performance) = web_sys::window().and_then(|window| window.performance()) {
            // The timeline is for people who look for where time goes: nothing depends on it.
            let _ = performance.mark(&format!("bindpose:{stage}"));
        }
    }

    /// What was opened is open, and the next frame draws it.
    pub(super) fn draw(&self) {
        self.enter(DRAWING);
    }

    /// A frame has been drawn.
    pub(super) fn note_drawn(&self) {
        if self.0.borrow().last().is_some_and(|&(stage, _)| stage == DRAWING) {
            self.enter(DRAWN);
        }
    }

    /// Milliseconds of each stage that has ended.
    pub(super) fn millis(&self) -> BTreeMap<&'static str, f64> {
        let mut millis = BTreeMap::new();
        for two in self.0.borrow().windows(2) {
            *millis.entry(two[0].0).or_default() += (two[1].1 - two[0].1) * 1e3;
        }
        millis
    }
}
