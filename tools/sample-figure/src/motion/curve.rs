//! Smooth periodic curves through a few keys, as an animator draws them.

/// A periodic curve over phase 0…1 through keys of ascending phase. It has no overshoot: a key that is a peak stays the
/// peak, and equal neighbours are joined by a level line.
pub(crate) struct Curve<'a> {
    keys: &'a [(f64, f64)],
}

impl<'a> Curve<'a> {
    /// At least two keys with strictly ascending phases in 0…1; the last phase is less than 1 more than the first.
    pub(crate) const fn new(keys: &'a [(f64, f64)]) -> Curve<'a> {
        Curve { keys }
    }

    /// Key `index`, counted past either end into the periods before and after.
    fn key(&self, index: isize) -> (f64, f64) {
        let count = self.keys.len() as isize;
        let (phase, value) = self.keys[index.rem_euclid(count) as usize];
        (phase + index.div_euclid(count) as f64, value)
    }

    /// Slope at key `index`: the harmonic mean of its sides, level at peaks (Fritsch and Carlson).
    fn slope(&self, index: isize) -> f64 {
        let (before, here, after) = (self.key(index - 1), self.key(index), self.key(index + 1));
        let left = (here.1 - before.1) / (here.0 - before.0);
        let right = (after.1 - here.1) / (after.0 - here.0);
        if left * right <= 0.0 {
            0.0
        } else {
            2.0 * left * right / (left + right)
        }
    }

    /// Value at any phase.
    pub(crate) fn at(&self, phase: f64) -> f64 {
        let mut phase = phase.rem_euclid(1.0);
        if phase < self.keys[0].0 {
            phase += 1.0;
        }
        let from = self.keys.partition_point(|key| key.0 <= phase) as isize - 1;
        let ((start, a), (end, b)) = (self.key(from), self.key(from + 1));
        let span = end - start;
        hermite(
            (phase - start) / span,
            a,
            self.slope(from) * span,
            b,
            self.slope(from + 1) * span,
        )
    }
}

/// Cubic from `a` to `b` over 0…1 with the given slopes at its ends.
pub(crate) fn hermite(t: f64, a: f64, a_slope: f64, b: f64, b_slope: f64) -> f64 {
    let (t2, t3) = (t * t, t * t * t);
    a * (2.0 * t3 - 3.0 * t2 + 1.0) + a_slope * (t3 - 2.0 * t2 + t) + b * (3.0 * t2 - 2.0 * t3) + b_slope * (t3 - t2)
}
