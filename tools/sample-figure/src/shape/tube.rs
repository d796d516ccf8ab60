//! Tubes: hoses that follow a curve.

use glam::{DVec2, DVec3};

use super::solid::Grid;

/// A tube through places, `steps` from each to the next; its radius is given for each step in turn, so that it can be
/// ribbed.
pub(crate) fn tube(places: &[DVec3], steps: usize, sides: usize, radius: impl Fn(usize) -> f64) -> Grid {
    let last = places.len() - 1;
    let count = last * steps;
    let at = |step: usize| {
        let span = (step / steps).min(last - 1);
        let t = step as f64 / steps as f64 - span as f64;
        let [a, b, c, d] = [span.saturating_sub(1), span, span + 1, (span + 2).min(last)].map(|index| places[index]);
        (b * 2.0
            + (c - a) * t
            + (a * 2.0 - b * 5.0 + c * 4.0 - d) * (t * t)
            + (b * 3.0 - a - c * 3.0 + d) * (t * t * t))
            / 2.0
    };
    let circle = |side: usize, across: DVec3, up: DVec3| {
        let turn = (side % sides) as f64 / sides as f64;
        let direction = super::loft::direction(turn);
        across * direction.x + up * direction.y
    };
    let mut across = (at(1) - at(0)).normalize().any_orthonormal_vector();
    let mut grid = Grid::default();
    let mut length = 0.0;
    for step in 0..=count {
        let along = (at((step + 1).min(count)) - at(step.saturating_sub(1))).normalize();
        across = (across - along * across.dot(along)).normalize();
        if step > 0 {
            length += at(step).distance(at(step - 1));
        }
        let row = (0..=sides).map(|side| {
            let offset = circle(side, across, along.cross(across)) * radius(step);
            (at(step) + offset, DVec2::new(side as f64 / sides as f64 * 0.1, length))
        });
        grid.rows.push(row.collect());
    }
    grid
}
