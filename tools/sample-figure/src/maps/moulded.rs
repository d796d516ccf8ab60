//! Trim and shell: moulded panels that meet in grooves, riveted along their borders, worn a little. And rubber: hexagonal
//! studs with hollow tops.

use glam::DVec2;

use super::relief::{Place, bead, chance, clouds, from_border, from_stretch, noise, off_whole, ramp};

/// A panel's side.
pub(crate) const SIDE_MM: f64 = 250.0;
/// From the border to the middle of the rivets.
const RIVETS_IN_MM: f64 = 13.0;
const RIVET_RADIUS_MM: f64 = 3.4;
/// Rivets along a side.
const RIVETS: f64 = 4.0;
/// Ribs in the middle of a panel: half their length without the round ends, and how they follow each other.
const RIB_HALF_MM: f64 = 21.0;
const RIB_SPACING_MM: f64 = 9.0;
const RIBS_EACH_WAY: f64 = 2.0;
const SCRATCHES: u32 = 22;

pub(crate) fn surface(u: f64, v: f64) -> Place {
    let from_border = from_border(u, v, SIDE_MM);
    let groove = 1.0 - ramp(0.9, 2.6, from_border);
    let field = ramp(24.0, 27.0, from_border);
    let rivet = rivet(u, v);
    let head = bead(rivet, RIVET_RADIUS_MM).sqrt();
    let sunk = bead(rivet - RIVET_RADIUS_MM - 0.6, 1.3);
    let rib = rib(u, v);
    let scratch = scratches(u, v) * (1.0 - rib);
    // Grained as out of a blasted mould.
    let grain = noise(u, v, 96, 31);

    let shade = 0.97 + 0.03 * clouds(u, v, 5, 21) - 0.3 * groove - 0.2 * sunk + 0.12 * scratch;
    Place {
        height: 0.02 * grain * (1.0 - groove) - 1.6 * groove + 0.7 * field + 1.5 * head + 1.3 * rib
            - 0.5 * sunk
            - 0.12 * scratch,
        tone: [shade; 3],
        polish: 0.86 + 0.1 * clouds(u, v, 7, 41) - 0.6 * groove - 0.4 * sunk - 0.25 * scratch + 0.1 * head,
    }
}

/// Distance from the middle of the nearest rivet.
fn rivet(u: f64, v: f64) -> f64 {
    let beside = |across: f64, along: f64| {
        let across = off_whole(across).abs() * SIDE_MM - RIVETS_IN_MM;
        let along = (off_whole(along * RIVETS - 0.5) / RIVETS) * SIDE_MM;
        (across * across + along * along).sqrt()
    };
    beside(u, v).min(beside(v, u))
}

/// Ribs across the middle of a panel: 0…1. They come to lie on knuckles and insteps too.
fn rib(u: f64, v: f64) -> f64 {
    let (x, y) = (((u - 0.5).abs() * SIDE_MM - RIB_HALF_MM).max(0.0), (v - 0.5) * SIDE_MM);
    let y = y - (y / RIB_SPACING_MM).round().clamp(-RIBS_EACH_WAY, RIBS_EACH_WAY) * RIB_SPACING_MM;
    1.0 - ramp(1.6, 3.6, (x * x + y * y).sqrt())
}

/// Short straight marks of use: 0…1.
fn scratches(u: f64, v: f64) -> f64 {
    let mark = |index: u32| {
        let at = |what: u32| chance(index, what, 77);
        let middle = DVec2::new(at(0), at(1));
        // Near the border's end of the square a mark goes on at the other end.
        let point = DVec2::new(off_whole(u - middle.x), off_whole(v - middle.y)) * SIDE_MM;
        let reach = DVec2::new(at(2) * 2.0 - 1.0, at(3) - 0.5) * (4.0 + 14.0 * at(4));
        bead(from_stretch(point, -reach, reach), 0.75) * (0.4 + 0.6 * at(5))
    };
    (0..SCRATCHES).map(mark).fold(0.0, f64::max)
}

/// Side of the square of rubber.
pub(crate) const GRIP_SIDE_MM: f64 = 250.0;
/// Studs along u, and rows of them along v: nearly regular, and both repeat.
const COLUMNS: f64 = 18.0;
const ROWS: f64 = 20.0;
/// Distance between rows where hexagons are one wide: √3 / 2.
const ROW_HEIGHT: f64 = 0.866_025_403_784_438_6;

pub(crate) fn grip(u: f64, v: f64) -> Place {
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
