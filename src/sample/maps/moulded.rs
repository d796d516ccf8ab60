//! Trim and shell: moulded panels that meet in grooves, riveted along their borders, worn a little.

use glam::DVec2;

use super::bake::Place;
use super::noise::{chance, clouds, noise};
use super::shapes::{bead, from_border, from_stretch, off_whole, ramp};

/// A panel's side.
pub(super) const SIDE_MM: f64 = 250.0;
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

pub(super) fn surface(u: f64, v: f64) -> Place {
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
