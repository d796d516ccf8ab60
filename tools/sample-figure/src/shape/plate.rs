//! Plates: panels with bevelled edges that lie on a loft.

use glam::{DVec2, DVec3};

use super::loft::{Frame, Loft};
use super::solid::Grid;

/// A panel on a loft, its outline given by corners.
#[derive(Clone, Debug)]
pub(crate) struct Plate<'a> {
    pub(crate) on: &'a Loft,
    /// Corners in order: the turn round the loft, 0…1 from the back by the right, and the part of its length, 0…1.
    pub(crate) outline: &'a [[f64; 2]],
    /// Radius of its corners, metres.
    pub(crate) rounding: f64,
    /// How far it stands out of the loft, metres.
    pub(crate) lift: f64,
    pub(crate) bevel: f64,
    /// Segments of its outline are no longer than this, and its rings no further apart, metres.
    pub(crate) longest: f64,
}

/// The sides of a block are no wider in its chart, metres.
const WIDEST_SIDE: f64 = 0.02;
/// A rounding wider than this has a place in its middle too, metres.
const WIDE: f64 = 0.0065;
/// How deep a plate reaches into its loft, metres.
const SUNK: f64 = 0.006;

impl Plate<'_> {
    pub(crate) fn grid(&self) -> Grid {
        let count = self.outline.len() as f64;
        let middle: DVec2 = self
            .outline
            .iter()
            .map(|corner| DVec2::from_array(*corner))
            .sum::<DVec2>()
            / count;
        // Metres a turn and a length, in the plate's middle.
        let step = 1e-3;
        let place = |p: DVec2| self.on.at_part(p.x, p.y);
        let metres = DVec2::new(
            place(middle + DVec2::X * step).distance(place(middle - DVec2::X * step)) / (2.0 * step),
            place(middle + DVec2::Y * 10.0 * step).distance(place(middle - DVec2::Y * 10.0 * step)) / (20.0 * step),
        );
        let corners: Vec<DVec2> = self
            .outline
            .iter()
            .map(|corner| (DVec2::from_array(*corner) - middle) * metres)
            .collect();
        let outline = rounded(&corners, self.rounding, self.longest);
        let place = |p: DVec2, height: f64| {
            let at = p / metres + middle;
            let step = DVec2::splat(0.003) / metres;
            let along = |axis: DVec2| place(at + axis * step) - place(at - axis * step);
            let normal = along(DVec2::X).cross(along(DVec2::Y)).normalize();
            let outwards = if normal.dot(place(at) - self.axis_at(at.y)) < 0.0 {
                -normal
            } else {
                normal
            };
            (place(at) + outwards * height, p)
        };
        let reach = outline.iter().map(|point| point.length()).fold(0.0, f64::max);
        let steps = (reach / self.longest).ceil().clamp(1.0, 3.0) as usize;
        slab(&outline, [-SUNK, self.lift], self.bevel, steps, place)
    }

    fn axis_at(&self, part: f64) -> DVec3 {
        (0..4)
            .map(|quarter| self.on.at_part(f64::from(quarter) / 4.0, part))
            .sum::<DVec3>()
            / 4.0
    }
}

/// A flat block: `outline` across `right` and `front` of the frame, from the origin to `height` along its axis.
pub(crate) fn block(frame: &Frame, outline: &[[f64; 2]], rounding: f64, height: f64, bevel: f64) -> Grid {
    let corners: Vec<DVec2> = outline.iter().map(|corner| DVec2::from_array(*corner)).collect();
    let place = |p: DVec2, height: f64| {
        let across = frame.right * p.x + frame.front * p.y;
        (frame.origin + across + frame.along * height, p)
    };
    slab(
        &rounded(&corners, rounding, f64::INFINITY),
        [0.0, height],
        bevel,
        1,
        place,
    )
}

/// The same, with a lower face too.
pub(crate) fn tile(frame: &Frame, outline: &[[f64; 2]], rounding: f64, height: f64, bevel: f64) -> Grid {
    let mut grid = block(frame, outline, rounding, height, bevel);
    let edge = &grid.rows[0];
    let middle = edge.iter().map(|place| place.0).sum::<DVec3>() / edge.len() as f64;
    // It is seen from behind.
    let chart = |column: usize| grid.outline[column % grid.outline.len()] * DVec2::new(-1.0, 1.0);
    let rim = (0..edge.len()).map(|column| (edge[column].0, chart(column))).collect();
    let face = vec![(middle, DVec2::ZERO); edge.len()];
    grid.rows.splice(0..0, [face, rim]);
    grid
}

/// Corners of a rectangle about its middle.
pub(crate) fn rectangle(width: f64, height: f64) -> [[f64; 2]; 4] {
    let (x, y) = (width / 2.0, height / 2.0);
    [[-x, -y], [x, -y], [x, y], [-x, y]]
}

/// A slab with a bevelled upper edge, whose top has `steps` rings from there to its middle; `place` says where a place of
/// the outline's plane lies at a height.
fn slab(
    outline: &[DVec2],
    [bottom, top]: [f64; 2],
    bevel: f64,
    steps: usize,
    place: impl Fn(DVec2, f64) -> (DVec3, DVec2),
) -> Grid {
    let flat = inset(outline, bevel);
    let mut rings = vec![(outline.to_vec(), bottom)];
    if bevel > 0.0 {
        rings.push((outline.to_vec(), top - bevel));
    }
    if bevel > WIDE {
        rings.push((inset(outline, 0.3 * bevel), top - 0.3 * bevel));
    }
    rings.push((flat.clone(), top));
    for step in 1..steps {
        let scale = 1.0 - step as f64 / steps as f64;
        rings.push((flat.iter().map(|point| *point * scale).collect(), top));
    }
    rings.push((vec![DVec2::ZERO; outline.len()], top));
    let mut grid = Grid {
        outline: outline.to_vec(),
        ..Grid::default()
    };
    for (points, height) in rings {
        if height == top {
            let normal = |point: &DVec2| (place(*point, top + 0.001).0 - place(*point, top).0).normalize();
            let mut normals: Vec<DVec3> = points.iter().map(normal).collect();
            normals.push(normals[0]);
            grid.top_normals.push(normals);
        }
        let mut row: Vec<(DVec3, DVec2)> = points.iter().map(|point| place(*point, height)).collect();
        if grid.rows.is_empty() {
            // In the chart the sides lie round the top.
            let sides = inset(outline, (bottom - top).max(-WIDEST_SIDE));
            row = row.iter().zip(sides).map(|(place, chart)| (place.0, chart)).collect();
        }
        row.push(row[0]);
        grid.rows.push(row);
    }
    grid
}

/// The outline with its corners rounded and its edges divided.
fn rounded(corners: &[DVec2], rounding: f64, longest: f64) -> Vec<DVec2> {
    let mut outline: Vec<DVec2> = Vec::new();
    let count = corners.len();
    for index in 0..count {
        let (before, here, after) = (
            corners[(index + count - 1) % count],
            corners[index],
            corners[(index + 1) % count],
        );
        let towards = |other: DVec2| here + (other - here).normalize() * rounding.min(0.45 * other.distance(here));
        if rounding == 0.0 {
            outline.push(here);
            continue;
        }
        let (from, to) = (towards(before), towards(after));
        if let Some(&last) = outline.last() {
            divide(&mut outline, last, from, longest);
        }
        outline.push(from);
        if rounding > WIDE {
            outline.push(from * 0.25 + here * 0.5 + to * 0.25);
        }
        outline.push(to);
    }
    let (last, first) = (outline[outline.len() - 1], outline[0]);
    divide(&mut outline, last, first, longest);
    outline
}

/// Adds the places between both ends.
fn divide(outline: &mut Vec<DVec2>, from: DVec2, to: DVec2, longest: f64) {
    let parts = (from.distance(to) / longest).ceil().max(1.0) as usize;
    outline.extend((1..parts).map(|part| from + (to - from) * (part as f64 / parts as f64)));
}

/// The outline moved inwards.
fn inset(outline: &[DVec2], by: f64) -> Vec<DVec2> {
    let count = outline.len();
    let area: f64 = (0..count)
        .map(|index| outline[index].perp_dot(outline[(index + 1) % count]))
        .sum();
    let moved = |index: usize| {
        let (before, after) = (outline[(index + count - 1) % count], outline[(index + 1) % count]);
        outline[index] + (after - before).normalize().perp() * by * area.signum()
    };
    (0..count).map(moved).collect()
}
