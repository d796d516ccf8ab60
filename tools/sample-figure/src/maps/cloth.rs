//! The suit: ripstop cloth, quilted in diamonds, with a felled seam along the border of each panel.

use super::relief::{Place, bead, chance, clouds, from_border, off_whole, ramp, stitches};

/// A panel's side.
pub(crate) const SIDE_MM: f64 = 360.0;
/// Threads along a side.
const THREADS: u32 = 128;
/// Every so many threads one is thicker.
const RIPSTOP: u32 = 8;
/// Diamonds along a side; their lines meet in the panel's middle.
const DIAMONDS: f64 = 8.0;
/// From the border to where the quilting starts: a row of the diamonds' corners.
const MARGIN_MM: f64 = SIDE_MM / DIAMONDS;
/// From the border to the rows of stitches.
const STITCHES_MM: [f64; 2] = [6.0, 32.0];

pub(crate) fn surface(u: f64, v: f64) -> Place {
    let from_border = from_border(u, v, SIDE_MM);
    let (weave, thread_tone) = weave(u, v);
    let quilted = ramp(MARGIN_MM - 7.0, MARGIN_MM + 2.0, from_border);
    let (puff, quilt_thread) = quilting(u, v);
    let (fold, seam_thread) = seam(u, v, from_border);
    let thread = (quilt_thread * ramp(MARGIN_MM - 2.0, MARGIN_MM, from_border)).max(seam_thread);

    let shade = 0.97 + 0.025 * clouds(u, v, 6, 11) + thread_tone - 0.1 * quilted * (1.0 - puff) * (1.0 - puff);
    let sewn = [0.9, 0.56, 0.34];
    Place {
        height: 3.4 * quilted * puff + fold + (0.16 * weave) * (1.0 - thread) + 0.8 * thread,
        tone: sewn.map(|sewn| shade + (sewn - shade) * thread),
        polish: 0.35 + 0.15 * weave + 0.35 * quilted * puff + 0.3 * thread - 0.2 * bead(from_border, 4.0),
    }
}

/// Plain weave: height, 1 on top of a usual thread, and how much lighter or darker this stretch of thread is.
fn weave(u: f64, v: f64) -> (f64, f64) {
    let (x, y) = (u * f64::from(THREADS), v * f64::from(THREADS));
    let (column, row) = (x as u32, y as u32);
    let (x, y) = ((x - x.floor()) * 2.0 - 1.0, (y - y.floor()) * 2.0 - 1.0);
    let thick = |index: u32| if index.is_multiple_of(RIPSTOP) { 1.5 } else { 1.0 };
    // The thread on top is round across and dives under its neighbours at both ends.
    let (across, along, size) = if (column + row).is_multiple_of(2) {
        (x, y, thick(column))
    } else {
        (y, x, thick(row))
    };
    let height = (1.0 - across * across) * (1.0 - 0.7 * along * along) * size;
    (height, 0.02 * (chance(column, row, 5) - 0.5))
}

/// Diamonds of wadding between stitched lines: height 0…1, and thread.
fn quilting(u: f64, v: f64) -> (f64, f64) {
    let (p, q) = ((u + v) * DIAMONDS / 2.0, (u - v) * DIAMONDS / 2.0);
    let (a, b) = (off_whole(p), off_whole(q));
    let full = |a: f64| 1.0 - (1.0 - 2.0 * a.abs()) * (1.0 - 2.0 * a.abs());
    // Lines of equal p are this far apart.
    let spacing = SIDE_MM / DIAMONDS * std::f64::consts::SQRT_2;
    let thread = stitches(a * spacing, q * spacing, 6.0).max(stitches(b * spacing, p * spacing, 6.0));
    ((full(a) * full(b)).sqrt(), thread)
}

/// The cloth doubled along the border and sewn down twice: height and thread.
fn seam(u: f64, v: f64, from_border: f64) -> (f64, f64) {
    let along_u = off_whole(v).abs() < off_whole(u).abs();
    let along = if along_u { u } else { v } * SIDE_MM;
    let fold = 1.3 * (1.0 - ramp(9.5, 12.5, from_border)) - 2.4 * bead(from_border, 3.2);
    let [inner, outer] = STITCHES_MM.map(|at| stitches(from_border - at, along, 5.0));
    (fold, inner.max(outer))
}
