//! Lofts: skins over rings along an axis. Limbs, helmets, bolts and boxes are all lofts.

use glam::{DVec2, DVec3};

use super::solid::Grid;

/// Axes that a loft is described in: `along` its axis, `right` and `front` across it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame {
    pub(crate) origin: DVec3,
    pub(crate) right: DVec3,
    pub(crate) front: DVec3,
    pub(crate) along: DVec3,
}

impl Frame {
    /// Upright through `origin`: along y, the figure's left to the right, its face to the front.
    pub(crate) fn upright(origin: DVec3) -> Frame {
        Frame {
            origin,
            right: DVec3::X,
            front: DVec3::NEG_Z,
            along: DVec3::Y,
        }
    }

    /// Along a direction, its front as near to `front` as that allows.
    pub(crate) fn along(origin: DVec3, along: DVec3, front: DVec3) -> Frame {
        let along = along.normalize();
        let right = along.cross(front).normalize();
        Frame {
            origin,
            right,
            front: right.cross(along),
            along,
        }
    }
}

/// A cross-section: an ellipse that can be squared.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ring {
    /// Along the axis, metres.
    pub(crate) at: f64,
    /// Half its size to the right and to the front, metres.
    pub(crate) half: DVec2,
    /// Its middle, metres.
    pub(crate) centre: DVec2,
    /// 0 for an ellipse, 1 for nearly a rectangle.
    pub(crate) square: f64,
    /// How much further along the axis its right and its front lie, metres a metre.
    pub(crate) tilt: DVec2,
    /// Width over which the edge here is rounded, metres.
    pub(crate) bevel: f64,
}

/// An ellipse about the axis.
pub(crate) fn ring(at: f64, right: f64, front: f64) -> Ring {
    Ring {
        at,
        half: DVec2::new(right, front),
        centre: DVec2::ZERO,
        square: 0.0,
        tilt: DVec2::ZERO,
        bevel: 0.0,
    }
}

impl Ring {
    pub(crate) fn centre(self, right: f64, front: f64) -> Ring {
        Ring {
            centre: DVec2::new(right, front),
            ..self
        }
    }

    pub(crate) fn square(self, square: f64) -> Ring {
        Ring { square, ..self }
    }

    pub(crate) fn tilt(self, right: f64, front: f64) -> Ring {
        Ring {
            tilt: DVec2::new(right, front),
            ..self
        }
    }

    pub(crate) fn bevel(self, bevel: f64) -> Ring {
        Ring { bevel, ..self }
    }

    /// Smaller by this on all sides.
    pub(crate) fn inset(self, by: f64) -> Ring {
        Ring {
            half: (self.half - by).max(DVec2::splat(0.001)),
            ..self
        }
    }

    /// Further along the axis.
    pub(crate) fn moved(self, by: f64) -> Ring {
        Ring {
            at: self.at + by,
            ..self
        }
    }

    /// A mean of rings.
    fn mix<const N: usize>(rings: [(Ring, f64); N]) -> Ring {
        let sum = |value: fn(&Ring) -> f64| rings.iter().map(|(ring, part)| value(ring) * part).sum::<f64>();
        let sum2 = |value: fn(&Ring) -> DVec2| rings.iter().map(|(ring, part)| value(ring) * *part).sum::<DVec2>();
        Ring {
            at: sum(|ring| ring.at),
            half: sum2(|ring| ring.half).max(DVec2::ZERO),
            centre: sum2(|ring| ring.centre),
            square: sum(|ring| ring.square).clamp(0.0, 1.0),
            tilt: sum2(|ring| ring.tilt),
            bevel: 0.0,
        }
    }

    fn distance(&self, other: &Ring) -> f64 {
        let across = (self.half - other.half).abs().max_element() + (self.centre - other.centre).length();
        let along = self.at - other.at;
        (across * across + along * along).sqrt()
    }
}

/// Rings on a curve through `rings`, `steps` from each to the next (Catmull and Rom).
pub(crate) fn smooth(rings: &[Ring], steps: usize) -> Vec<Ring> {
    let last = rings.len() - 1;
    let mut through = Vec::with_capacity(last * steps + 1);
    for span in 0..last {
        let near = [span.saturating_sub(1), span, span + 1, (span + 2).min(last)].map(|index| rings[index]);
        for step in 0..steps {
            let t = step as f64 / steps as f64;
            let (t2, t3) = (t * t, t * t * t);
            let parts = [
                (2.0 * t2 - t - t3) / 2.0,
                (3.0 * t3 - 5.0 * t2 + 2.0) / 2.0,
                (t + 4.0 * t2 - 3.0 * t3) / 2.0,
                (t3 - t2) / 2.0,
            ];
            through.push(Ring::mix([0, 1, 2, 3].map(|index| (near[index], parts[index]))));
        }
    }
    through.push(rings[last]);
    through
}

/// A bevel wider than this has a ring in its middle too, metres.
const WIDE: f64 = 0.0065;

/// Rings with every edge that has a bevel rounded.
pub(crate) fn bevelled(rings: &[Ring]) -> Vec<Ring> {
    let mut rounded = Vec::with_capacity(rings.len() * 2);
    for (index, &ring) in rings.iter().enumerate() {
        if ring.bevel == 0.0 || index == 0 || index + 1 == rings.len() {
            rounded.push(ring);
            continue;
        }
        let towards = |other: &Ring| {
            let part = (ring.bevel / ring.distance(other)).min(0.49);
            Ring::mix([(ring, 1.0 - part), (*other, part)])
        };
        let (before, after) = (towards(&rings[index - 1]), towards(&rings[index + 1]));
        rounded.push(before);
        if ring.bevel > WIDE {
            rounded.push(Ring::mix([(before, 0.25), (ring, 0.5), (after, 0.25)]));
        }
        rounded.push(after);
    }
    rounded
}

/// A hard shell with this wall: its ends are rounded by `edge`, turn inwards by `thickness`.
pub(crate) fn shell(wall: &[Ring], edge: f64, thickness: f64) -> Vec<Ring> {
    let (first, last) = (wall[0], wall[wall.len() - 1]);
    let mut rings = vec![first.inset(thickness), first.bevel(edge)];
    rings.extend(&wall[1..wall.len() - 1]);
    rings.extend([last.bevel(edge), last.inset(thickness)]);
    bevelled(&rings)
}

/// How near to round lacquer and metal are, and rubber, metres.
pub(crate) const FINE: f64 = 0.0017;
pub(crate) const COARSE: f64 = 0.0034;

/// A skin over rings.
#[derive(Clone, Debug)]
pub(crate) struct Loft {
    pub(crate) frame: Frame,
    pub(crate) rings: Vec<Ring>,
}

impl Loft {
    pub(crate) fn new(frame: Frame, rings: Vec<Ring>) -> Loft {
        Loft { frame, rings }
    }

    /// A hard shell with this skin as its wall, as [`shell`] has it.
    pub(crate) fn shelled(&self, edge: f64, thickness: f64) -> Loft {
        Loft::new(self.frame, shell(&self.rings, edge, thickness))
    }

    /// A place on the skin: `turn` goes round from the back by the right, 0…1, and `ring` counts rings.
    fn at(&self, turn: f64, place: f64) -> DVec3 {
        let place = place.clamp(0.0, (self.rings.len() - 1) as f64);
        let index = (place as usize).min(self.rings.len() - 2);
        let part = place - index as f64;
        let (a, b) = (self.point(index, turn), self.point(index + 1, turn));
        a + (b - a) * part
    }

    /// The same, as a part 0…1 of the way along the axis between the first and the last ring's middle.
    pub(crate) fn at_part(&self, turn: f64, part: f64) -> DVec3 {
        let (first, last) = (self.rings[0].at, self.rings[self.rings.len() - 1].at);
        let at = first + (last - first) * part;
        let sign = if last > first { 1.0 } else { -1.0 };
        let after = self.rings.iter().position(|ring| (ring.at - at) * sign > 0.0);
        let after = after.unwrap_or(self.rings.len() - 1).max(1);
        let (a, b) = (self.rings[after - 1].at, self.rings[after].at);
        self.at(turn, (after - 1) as f64 + ((at - a) / (b - a)).clamp(0.0, 1.0))
    }

    fn point(&self, ring: usize, turn: f64) -> DVec3 {
        let Frame {
            origin,
            right,
            front,
            along,
        } = self.frame;
        let ring = &self.rings[ring];
        let direction = direction(turn);
        let [x, y] = direction.to_array();
        let squared = direction / (x * x * x * x + y * y * y * y).sqrt().sqrt();
        let across = (direction + (squared - direction) * ring.square) * ring.half;
        let place = across + ring.centre;
        origin + along * (ring.at + across.dot(ring.tilt)) + right * place.x + front * place.y
    }

    /// Its mesh: u round it and v along it, metres. Its sides lie within about `error` metres of the round.
    pub(crate) fn grid(&self, error: f64) -> Grid {
        let mut grid = Grid::default();
        let widest = self
            .rings
            .iter()
            .map(|ring| ring.half.x + ring.half.y)
            .fold(0.0, f64::max);
        let round = widest * std::f64::consts::PI;
        // A chord of a circle is sin²(π / 2n) of its diameter away from it.
        let sides = 2 * ((widest / 2.0 / error).sqrt() * 1.11).ceil().max(3.0) as usize;
        let mut length = 0.0;
        for index in 0..self.rings.len() {
            if index > 0 {
                length += self.rings[index].distance(&self.rings[index - 1]);
            }
            let column = |side: usize| {
                let turn = side as f64 / sides as f64;
                // The last column closes the first to the bit.
                (self.point(index, turn.fract()), DVec2::new(turn * round, length))
            };
            grid.rows.push((0..=sides).map(column).collect());
        }
        grid
    }
}

/// The unit direction at a turn 0…1: from the back (0, −1) by the right (1, 0). A rational half-angle to each side of an
/// axis needs no sine, is even to a part in twenty, and is the same on both sides to the bit.
pub(super) fn direction(turn: f64) -> DVec2 {
    let quarters = turn * 4.0;
    let axis = quarters.round();
    let half_tangent = (quarters - axis) * 2.0 * (2f64.sqrt() - 1.0);
    let square = half_tangent * half_tangent;
    let (along, aside) = ((1.0 - square) / (1.0 + square), 2.0 * half_tangent / (1.0 + square));
    match (axis as i64).rem_euclid(4) {
        0 => DVec2::new(aside, -along),
        1 => DVec2::new(along, aside),
        2 => DVec2::new(-aside, along),
        _ => DVec2::new(-along, -aside),
    }
}
