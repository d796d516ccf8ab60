//! The slices in which a session of the page opens.

use std::cell::Cell;
use std::rc::Rc;

use super::now_secs;
use super::timings::Timings;
use crate::session::Session;
use crate::slices::Slices;

/// How long one slice of an opening is: half a frame of most displays.
const SLICE_SECS: f64 = 0.008;

/// When the slice of an opening that runs now is over, by the page's clock.
#[derive(Clone, Debug, Default)]
pub(super) struct Slice(Rc<Cell<f64>>);

impl Slice {
    pub(super) fn begin(&self) {
        self.0.set(now_secs() + SLICE_SECS);
    }

    /// Has a session open in such slices.
    pub(super) fn give_to(&self, session: &mut Session, timings: &Rc<Timings>) {
        let (ends_secs, timings) = (Rc::clone(&self.0), Rc::clone(timings));
        let is_over = move || now_secs() >= ends_secs.get();
        session.open_in(&Slices::told(is_over, move |stage| timings.enter(stage.as_str())));
    }
}
