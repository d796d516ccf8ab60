//! The visor: a smooth pane in a brushed frame; below it the badge, turned on a lathe, with three joints in relief.

use glam::DVec2;

use super::relief::{Place, bead, chance, clouds, from_stretch, ramp};

/// Side of the square.
pub(crate) const SIDE_MM: f64 = 1000.0 / PANE_PER_METRE;
/// Repeats per metre where the pane and the badge are drawn on the figure, and where in the square their middles lie.
pub(crate) const PANE_PER_METRE: f64 = 3.8;
pub(crate) const PANE_MIDDLE: DVec2 = DVec2::new(0.5, 0.33);
pub(crate) const BADGE_PER_METRE: f64 = 3.0;
pub(crate) const BADGE_MIDDLE: DVec2 = DVec2::new(0.5, 0.83);
/// Half of the pane.
const PANE_HALF_MM: DVec2 = DVec2::new(126.0, 83.0);
/// Radius of the badge, which is 50 mm on the figure.
const BADGE_MM: f64 = 50.0 * BADGE_PER_METRE / PANE_PER_METRE;

pub(crate) fn surface(u: f64, v: f64) -> Place {
    let place = DVec2::new(u, v);
    let from_badge = (place - BADGE_MIDDLE) * SIDE_MM;
    if from_badge.length() < BADGE_MM + 4.0 {
        badge(from_badge)
    } else {
        pane(place, (place - PANE_MIDDLE) * SIDE_MM / PANE_HALF_MM)
    }
}

/// `from_middle` in halves of the pane.
fn pane(place: DVec2, from_middle: DVec2) -> Place {
    let (x, y) = (from_middle.x * from_middle.x, from_middle.y * from_middle.y);
    // Between a circle and a square, as the pane's border is: 1 there.
    let ring = (x * x + y * y).sqrt().sqrt();
    let frame = ramp(0.885, 0.905, ring);
    let groove = bead(ring - 0.885, 0.016);
    let brushed = frame * (1.0 - ramp(1.06, 1.08, ring)) * (chance((ring * 120.0) as u32, 0, 51) - 0.5);
    let shade = 1.0 - 0.3 * groove;
    Place {
        height: 1.6 * frame - 1.2 * groove + 0.12 * brushed,
        tone: [shade; 3],
        polish: 1.0 + 0.02 * clouds(place.x, place.y, 4, 52) - 0.35 * frame - 0.6 * groove + 0.2 * brushed,
    }
}

/// Millimetres from the badge's middle.
fn badge(from_middle: DVec2) -> Place {
    let radius = from_middle.length();
    let rim = ramp(BADGE_MM - 6.5, BADGE_MM - 5.0, radius);
    let turned = chance((radius * 1.6) as u32, 1, 53) - 0.5;
    let joints = [DVec2::new(-15.0, 17.0), DVec2::new(-5.0, -2.0), DVec2::new(15.0, -15.0)];
    let end = DVec2::new(14.0, 10.0);
    let ball = |at: DVec2, size: f64| ramp(-0.8, 0.8, size - (from_middle - at).length());
    let bone = |from, to| ramp(-0.8, 0.8, 2.3 - from_stretch(from_middle, from, to));
    let balls = joints.map(|at| ball(at, 5.6) - 0.7 * ball(at, 2.6));
    let bones = bone(joints[0], joints[1])
        .max(bone(joints[1], joints[2]))
        .max(bone(joints[1], end));
    let emblem = balls.into_iter().fold(0.75 * bones, f64::max);
    Place {
        height: 1.5 * rim + 1.5 * emblem + 0.12 * turned * (1.0 - emblem),
        tone: [1.0; 3],
        polish: 0.75 + 0.25 * emblem.min(1.0) + 0.2 * turned * (1.0 - emblem),
    }
}
