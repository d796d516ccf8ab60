//! Blend weights of any format: what is mended in them, and in which words that is told.

use crate::diagnostic::collect::{Diagnostics, Place, Tally, counted};
use crate::diagnostic::{Subject, codes};
use crate::model::Influences;

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

/// The same of vertices with any number of weights.
#[derive(Default)]
pub(super) struct Noted {
    pub(super) mended: Mended,
    cut: Tally,
    /// The greatest part of a vertex's weights that was left out.
    most_lost: f64,
}

impl Noted {
    /// The four greatest of a vertex's weights with their joints, brought to a sum of 1. All weights are above 0.
    pub(super) fn strongest(&mut self, vertex: u32, pairs: &mut Vec<(f32, u32)>) -> Influences {
        let sum = |pairs: &[(f32, u32)]| -> f64 { pairs.iter().map(|&(weight, _)| f64::from(weight)).sum() };
        let all = sum(pairs);
        if pairs.is_empty() {
            self.mended.unweighted.add(vertex);
            return Influences::default();
        }
        if (all - 1.0).abs() > SUM_TOLERANCE {
            self.mended.off_sum.add(vertex);
        }
        if pairs.len() > 4 {
            // Stable, so that of equal weights the first ones are kept.
            pairs.sort_by(|a, b| b.0.total_cmp(&a.0));
            pairs.truncate(4);
        }
        let kept = sum(pairs);
        if kept < all {
            self.cut.add(vertex);
            self.most_lost = self.most_lost.max(1.0 - kept / all);
        }
        let mut influences = Influences::default();
        for (slot, &(weight, joint)) in pairs.iter().enumerate() {
            influences.joints[slot] = joint;
            influences.weights[slot] = if kept == 1.0 {
                weight
            } else {
                (f64::from(weight) / kept) as f32
            };
        }
        influences
    }

    pub(super) fn tell(&self, diagnostics: &mut Diagnostics) {
        let place = |tally: &Tally| Place::of_rows(tally, Subject::Vertex, &[]);
        self.mended.tell(diagnostics, place);
        if self.cut.count > 0 {
            let message = format!(
                "{} weights for more than four joints; the four greatest are kept, and at most {:.2} % of a vertex's weight is lost.",
                counted(self.cut.count, "vertex has", "vertices have"),
                self.most_lost * 100.0
            );
            diagnostics.add(&codes::WEIGHTS_CUT, place(&self.cut), message);
        }
    }
}
