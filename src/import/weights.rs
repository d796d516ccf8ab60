//! Blend weights of any format: what is mended in them, and in which words that is told.

use crate::diagnostic::codes;
use crate::diagnostic::collect::{Diagnostics, Place, Tally, counted};

/// A sum of weights that is off by more than this was not meant to be rounded.
pub(super) const SUM_TOLERANCE: f64 = 1e-3;

/// What is mended, counted over the vertices.
#[derive(Default)]
pub(super) struct Mended {
    pub(super) off_sum: Tally,
    pub(super) unweighted: Tally,
    pub(super) invalid: Tally,
}

impl Mended {
    /// Tells it; `place` is where some vertices are.
    pub(super) fn tell(&self, diagnostics: &mut Diagnostics, place: impl Fn(&Tally) -> Place) {
        let off_sum = format!("blend weights whose sum is off from 1 by more than {SUM_TOLERANCE}; normalised.");
        let invalid = "a blend weight that is negative or not finite; taken as 0.";
        let unweighted = "no blend weight; not moved by any bone.";
        for (code, tally, rule) in [
            (&codes::WEIGHTS_INVALID, &self.invalid, invalid),
            (&codes::WEIGHTS_NOT_NORMALIZED, &self.off_sum, &off_sum),
            (&codes::WEIGHTS_ALL_ZERO, &self.unweighted, unweighted),
        ] {
            if tally.count > 0 {
                let have = counted(tally.count, "vertex has", "vertices have");
                diagnostics.add(code, place(tally), format!("{have} {rule}"));
            }
        }
    }
}
