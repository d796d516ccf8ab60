//! Rubber: hexagonal studs with hollow tops.

use super::bake::Place;
use super::noise::clouds;
use super::shapes::ramp;

/// Side of the square.
pub(super) const SIDE_MM: f64 = 250.0;
/// Studs along u, and rows of them along v: nearly regular, and both repeat.
const COLUMNS: f64 = 18.0;
const ROWS: f64 = 20.0;
/// Distance between rows where hexagons are one wide: √3 / 2.
const ROW_HEIGHT: f64 = 0.866_025_403_784_438_6;

pub(super) fn surface(u: f64, v: f64) -> Place {
    let to_side = to_stud_side(u * COLUMNS, v * ROWS);
    let stud = ramp(0.05, 0.15, to_side);
    let hollow = ramp(0.24, 0.34, to_side);
    let worn = clouds(u, v, 5, 61);
    let shade = 0.95 + 0.05 * worn - 0.25 * (1.0 - stud) - 0.06 * hollow;
    Place {
        height: 1.7 * stud - 0.7 * hollow,
        tone: [shade; 3],
        polish: 0.75 + 0.12 * worn - 0.55 * (1.0 - stud) - 0.15 * hollow,
    }
}

/// Distance to the nearest side of the hexagon around a point, where hexagons are one wide and rows one apart: 0…0.5.
fn to_stud_side(x: f64, y: f64) -> f64 {
    let in_row = |row: f64| {
        let shift = if (row as i64).rem_euclid(2) == 0 { 0.0 } else { 0.5 };
        let (x, y) = ((x - shift) - (x - shift).round(), (y - row) * ROW_HEIGHT);
        0.5 - x.abs().max(0.5 * x.abs() + ROW_HEIGHT * y.abs())
    };
    in_row(y.floor()).max(in_row(y.floor() + 1.0))
}
