//! The page's clock for openings: when a slice is over, and how long the stages of the last one took, for scripts, and as marks in the
//! browser's own timeline.

use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;
use std::rc::Rc;

use super::now_secs;
use crate::session::Session;
use crate::slices::{Slices, Stage};

/// How long one slice of work is: half a frame of most displays.
pub(super) const SLICE_SECS: f64 = 0.008;

/// What comes behind the stages of the core: a frame draws the model, and that is the end.
const DRAWING: &str = "drawing";
const DRAWN: &str = "drawn";

/// In seconds of the page's clock.
#[derive(Debug, Default)]
pub(super) struct Timings {
    /// Names of stages and when each began.
    entered: RefCell<Vec<(&'static str, f64)>>,
    /// When the slice that runs now is over.
    slice_ends: Cell<f64>,
}

impl Timings {
    /// Has a session open in slices of the page.
    pub(super) fn give_to(self: &Rc<Self>, session: &mut Session) {
        let (clock, told) = (Rc::clone(self), Rc::clone(self));
        let is_over = move || now_secs() >= clock.slice_ends.get();
        session.open_in(&Slices::told(is_over, move |stage| told.enter(stage.as_str())));
    }

    pub(super) fn begin_slice(&self) {
        self.slice_ends.set(now_secs() + SLICE_SECS);
    }

    /// Begins with files that come from a disk or a server.
    pub(super) fn begin(&self) {
        self.entered.borrow_mut().clear();
        self.enter(Stage::Fetching.as_str());
    }

    /// A stage begins, and the one before it ends.
    pub(super) fn enter(&self, stage: &'static str) {
        let mut entered = self.entered.borrow_mut();
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
        if self.entered.borrow().last().is_some_and(|&(stage, _)| stage == DRAWING) {
            self.enter(DRAWN);
        }
    }

    /// Milliseconds of each stage that has ended.
    pub(super) fn millis(&self) -> BTreeMap<&'static str, f64> {
        let mut millis = BTreeMap::new();
        for two in self.entered.borrow().windows(2) {
            *millis.entry(two[0].0).or_default() += (two[1].1 - two[0].1) * 1e3;
        }
        millis
    }
}
